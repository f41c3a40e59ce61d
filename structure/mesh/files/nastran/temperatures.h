#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "structure/mesh/files/nastran/model.h"

namespace blocklift::structure {

/// Sets of temperatures: TEMP, TEMPD, TEMPP1, TEMPRB.
class NastranTemperatures {
 public:
  /// Reads them all. The model must outlive this object.
  explicit NastranTemperatures(NastranModel& model);

  /// Place in Deck::temperatures of the field that a case has by TEMPERATURE(LOAD) and, unless it
  /// is 0, TEMPERATURE(INITIAL). Without the latter strains count from the materials' TREF.
  /// @throws CardError if there is no such set.
  int field(long load, long initial);

 private:
  struct Set {
    std::optional<double> everywhere;  ///< TEMPD
    std::map<int, double> at_vertices;
    std::map<int, TemperatureField::OfShell> shells;
    std::map<int, TemperatureField::OfBeam> beams;
    std::string obstacle;
  };

  Set& set(const CardView& card) { return sets_[card.label(0, "temperature set")]; }
  const Set& get(long number) const;
  void read_unknown();
  void add_grids(const CardView& card);
  void add_everywhere(const CardView& card);
  void add_plates(const CardView& card);
  void add_bars(const CardView& card);
  TemperatureField make(long load, long initial) const;
  double at_vertex(const Set& set, std::size_t vertex) const;
  std::vector<double> at_all_vertices(const Set& set) const;

  NastranModel& model_;
  std::map<long, Set> sets_;
  std::map<std::pair<long, long>, int> made_;
};

}  // namespace blocklift::structure
