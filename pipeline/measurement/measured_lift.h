#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "pipeline/comparison/compared_result.h"
#include "pipeline/measurement/agreement.h"
#include "pipeline/measurement/decay.h"
#include "pipeline/measurement/record.h"
#include "pipeline/measurement/record_alignment.h"
#include "pipeline/measurement/surroundings.h"
#include "pipeline/measurement/time_shift.h"
#include "pipeline/measurement/weighing.h"

namespace blocklift::pipeline {

/// How measurements are held against a lift; all instants are those of the lift, s.
struct MeasurementSettings {
  /// Shift of each record's clock, or one for all; found by correlation where empty.
  std::vector<double> shifts;
  std::optional<TimeWindow> window;  ///< what is compared; all that both have if not given
  std::optional<TimeWindow> decay;   ///< in which the lift swings freely
  std::optional<TimeWindow> rest;    ///< in which the load hangs and is to be weighed
  double cell_accuracy = 0.01;       ///< standard deviation of a load cell's scale
};

/// A record on the clock of the lift.
struct AlignedRecord {
  std::string file;
  double shift = 0;                ///< s, what was added to its instants
  std::optional<TimeShift> found;  ///< how the shift was found; none where it was not
  bool is_given = false;           ///< wind and waves alone go without both: their shift is zero
};

/// Samples of a channel that were not believed.
struct LeftOut {
  Fault fault = Fault::spike;
  TimeWindow window;  ///< of the lift
  std::size_t samples = 0;
};

/// A quantity that was measured and computed.
struct HeldChannel {
  std::string name;
  std::string unit;     ///< SI
  TimeSeries measured;  ///< what of it is believed
  ComputedChannel computed;
  std::optional<Agreement> agreement;
  std::optional<Sharing> sharing;  ///< of ropes, where more than one was measured
  std::optional<Decay> measured_decay, computed_decay;
  bool is_doubtful = false;  ///< constant, or hardly the computed quantity: the doubts say why
  std::size_t samples = 0;   ///< of the record
  std::vector<LeftOut> left_out = {};
  bool is_refused =
      false;  ///< less than half of its samples is believed: it is held against nothing
};

/// What the case was computed with, and what the load cells say.
struct HeldWeight {
  /// Where a coordinate of the centre of mass stays open, at that of the computed one, if there is
  /// one.
  Weighing measured;
  TimeWindow window;
  std::optional<double> computed_mass;               ///< kg
  std::optional<Eigen::Vector3d> computed_centre_B;  ///< m
};

/// Measurements beside a computed lift.
struct MeasuredLift {
  ComparedResult result;
  std::vector<AlignedRecord> records;
  std::vector<HeldChannel> channels;
  std::optional<HeldWeight> weight;
  std::optional<MeasuredWind> wind;
  std::optional<MeasuredWaves> waves;
  std::optional<double> computed_wind;         ///< mean of the case, m/s
  std::optional<double> computed_wave_height;  ///< significant height of the case's spectrum, m
  bool looked_for_decay = false;
  std::vector<std::string> doubts;  ///< sentences without a full stop
};

/// Aligns, compares, identifies and weighs.
/// @throws InputError if a record cannot be read or aligned, or the settings do not fit it;
///   ResultsError.
MeasuredLift hold_against_measurements(const std::filesystem::path& result,
                                       const std::vector<std::filesystem::path>& records,
                                       const MeasurementSettings& settings);

/// "10:25" as a window, s. @param option that gave it, for the message. @throws InputError.
TimeWindow parse_window(const std::string& option, const std::string& text);

/// For a terminal of 80 columns.
std::string measured_text(const MeasuredLift& lift);
/// In SI units.
nlohmann::ordered_json measured_json(const MeasuredLift& lift);
/// A page that opens offline: the tables, and measured and computed curves over each other.
std::string measured_page(const MeasuredLift& lift);

}  // namespace blocklift::pipeline
