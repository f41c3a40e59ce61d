#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/declaration/quantity.h"
#include "pipeline/formats/results_store.h"
#include "pipeline/measurement/time_series.h"

namespace blocklift::pipeline {

/// A quantity of a computed lift that can be measured too.
struct ComputedChannel {
  std::string name;      ///< as a record's header calls it: "ropes.R1", "bodies.block.roll"
  std::string unit;      ///< SI: "N"
  TimeSeries in_motion;  ///< the dynamic history, where it is a finite number
  TimeSeries at_rest;    ///< the static history; empty where there is none
};

/// Everything of a lift's results that a record may hold:
///
/// | name | is |
/// |---|---|
/// | `ropes.NAME`, `hoists.NAME` | tension |
/// | `hoists.NAME.length`, `hoists.NAME.swing` | as in the results |
/// | `drives.NAME`, `drives.NAME.force` | position, force |
/// | `bodies.NAME.roll` (`pitch`, `yaw`, `x`, `y`, `z`) | attitude, place of its origin in W |
/// | `measures.NAME` | angles, radii, crane loads, clearances |
///
/// @throws ResultsError.
std::vector<std::string> names_of_channels(const ResultsReader& results);

/// Reads one of them. @param name one of names_of_channels.
ComputedChannel read_computed_channel(const ResultsReader& results, const std::string& name);

/// A column of a record.
struct MeasuredChannel {
  std::string name;   ///< as in names_of_channels, or "wind.speed", "waves.elevation"
  std::string unit;   ///< SI
  TimeSeries series;  ///< by the clock of the record, s
};

/// One CSV file of measurements; its columns have one clock.
struct MeasuredRecord {
  std::string file;  ///< as it is shown
  std::vector<MeasuredChannel> channels;
  std::vector<std::string> remarks = {};  ///< what was put right in its time; no full stop
};

/// Wind and waves, which a record may hold and a lift's results do not.
inline constexpr const char* wind_channel = "wind.speed";
inline constexpr const char* wave_channel = "waves.elevation";

/// Reads records: CSV with one header, `time [s], ropes.R1 [kN], bodies.block.roll [deg], ...`,
/// each column with its unit in brackets. The group may be left out, and the names of results.csv
/// are taken ("R1.tension"), where only one quantity is meant. A mass where a force is due is its
/// weight under standard gravity. The time may be that of a clock (read_clock_time), without a
/// unit; it counts from the record's first row then. Cells that say nothing are left out of their
/// channel.
/// @param results of the lift that was measured, which say what columns may be called.
/// Of rows up to a twentieth may have no time, that of an earlier row, or come late (up to five at
/// once): the first are left out, the last are sorted in, and that is remarked.
/// @throws InputError with all that is wrong with all files: no header, no time, a time that does
///   not rise otherwise, a column with hardly a value, a unit that is unknown
///   or of another kind, a name that is not there or there twice.
std::vector<MeasuredRecord> read_records(const std::vector<std::filesystem::path>& paths,
                                         const ResultsReader& results);

}  // namespace blocklift::pipeline
