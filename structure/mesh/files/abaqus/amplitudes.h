#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "structure/mesh/files/abaqus/model.h"

namespace blocklift::structure {

/// How the loads and displacements of steps grow with time (*AMPLITUDE). A load case has what they
/// are at the end of its step, which is when a static step has its result.
///
/// Known are tables of time and factor, linear between, constant before and beyond, by the time of
/// the step or of all steps. Source: Abaqus Analysis User's Guide, amplitude curves; CalculiX
/// CrunchiX user's manual, *AMPLITUDE and TIME DELAY of *CLOAD.
class AbaqusAmplitudes {
 public:
  explicit AbaqusAmplitudes(const AbaqusModel& model);

  /// Time passes by that of a step (*STATIC: first increment, period; 1 without).
  void begin_step(const std::vector<const AbaqusBlock*>& step);

  /// The factor of a keyword at the end of the step; 1 without AMPLITUDE.
  /// @throws CardError for one that is not there or no such table.
  double factor_of(const AbaqusBlock& block);

  /// The name of one by the time of all steps whose factor has changed since a step before took it:
  /// what was given with it has changed, too. Empty for none.
  std::string moved_on() const;

 private:
  using Table = std::vector<std::pair<double, double>>;  ///< times and factors
  struct Taken {
    std::string name;
    Table table;
    double delay = 0, factor = 1;
  };

  std::map<std::string, const AbaqusBlock*> tables_;
  std::vector<Taken> taken_;               ///< by the time of all steps
  double step_time_ = 0, total_time_ = 0;  ///< at the end of the step, s
};

/// The fields of a line whose value at a place is taken by a factor. They must not outlive it.
class ScaledFields {
 public:
  ScaledFields(const std::vector<std::string_view>& fields, std::size_t place, double factor,
               const char* what);
  ScaledFields(const ScaledFields&) = delete;
  ScaledFields& operator=(const ScaledFields&) = delete;
  const std::vector<std::string_view>& all() const { return fields_; }

 private:
  std::string text_;
  std::vector<std::string_view> fields_;
};

}  // namespace blocklift::structure
