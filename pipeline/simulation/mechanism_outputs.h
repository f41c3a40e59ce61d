#pragma once

#include <functional>
#include <string>
#include <vector>

#include "dynamics/simulation/history.h"
#include "pipeline/build/build_mechanism.h"
#include "pipeline/formats/results_store.h"

namespace blocklift::pipeline {

/// One column of an output.
struct OutputColumn {
  std::string name;  ///< "x", "angle"; empty where the output has one column only
  std::string unit;  ///< as UDUNITS writes it
};

/// An output over time: a row a sample, SI.
struct OutputSeries {
  std::string name;
  std::string description;
  std::vector<OutputColumn> columns;
  RowMajorMatrix values;

  /// The columns' unit, or their units separated by commas where they differ.
  std::string units() const;
  /// "tip.x", or the output's name alone where it has one column.
  std::string column_name(std::size_t column) const;
};

/// Gathers the outputs of a mechanism file from the samples of its motion.
class OutputRecorder {
 public:
  /// @param mechanism must outlive the recorder.
  OutputRecorder(const MechanismFile& file, const BuiltMechanism& mechanism,
                 Eigen::Index sample_count);

  /// Records what is known at a sample; see IntegrationSettings::observe.
  void observe(Eigen::Index sample, double t, const dynamics::LiftWorkspace& w);
  /// The outputs, energies taken from the history. To be called once, last.
  std::vector<OutputSeries> finish(const dynamics::History& history);

 private:
  /// What a recorded output is filled by: writes one row.
  struct Instant {
    double time;
    const dynamics::LiftWorkspace& w;
    const std::vector<dynamics::MotionVector>& A_WB;
  };
  using Fill = std::function<void(const Instant&, Eigen::Ref<Eigen::RowVectorXd>)>;

  void add(const OutputModel& output);
  void add_series(const std::string& name, std::string description,
                  std::vector<OutputColumn> columns, Fill fill);
  void add_joint(const std::string& name, const std::string& joint, const std::string& quantity);
  void add_point(const std::string& name, const PointModel& point, const std::string& quantity);
  void add_spring(const std::string& name, const std::string& spring, const std::string& quantity);
  void add_rope(const std::string& name, const std::string& rope, const std::string& quantity);
  /// The tension of a mooring or a tugger.
  void add_line(const std::string& name, const std::string& line);
  void add_loop(const std::string& name, const std::string& loop, const std::string& quantity);
  void add_energy(const std::string& name, const std::string& energy);
  void add_everything(const MechanismFile& file);

  const BuiltMechanism& mechanism_;
  Eigen::Index sample_count_;
  std::vector<OutputSeries> series_;
  std::vector<Fill> fills_;            ///< one a series; empty for energies
  std::vector<std::string> energies_;  ///< one a series; empty but for energies
  std::vector<dynamics::MotionVector> A_WB_;
};

}  // namespace blocklift::pipeline
