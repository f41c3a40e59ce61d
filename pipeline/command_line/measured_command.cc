#include "pipeline/command_line/measured_command.h"

#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "pipeline/declaration/diagnostics.h"
#include "pipeline/declaration/quantity.h"
#include "pipeline/formats/atomic_file.h"
#include "pipeline/formats/results_store.h"
#include "pipeline/measurement/measured_lift.h"
#include "pipeline/processes/exit_code.h"
#include "pipeline/terminal/run_log.h"

namespace blocklift::pipeline {
namespace {

double accuracy_of(const std::string& text) {
  Diagnostics diagnostics;
  const Mark mark{std::make_shared<const std::string>("--cell-accuracy " + text), 0, 0};
  try {
    const double accuracy = parse_quantity(text, Dimension::ratio);
    if (accuracy >= 0 && accuracy < 1) return accuracy;
    diagnostics.error(mark, "a share from 0 up to 100 % is due");
  } catch (const QuantityError& error) {
    diagnostics.error(mark, error.what());
  }
  throw InputError(diagnostics);
}

int hold_and_show(const MeasuredOptions& options) {
  MeasurementSettings settings;
  settings.shifts = options.shifts;
  if (options.window) settings.window = parse_window("--window", *options.window);
  if (options.decay) settings.decay = parse_window("--decay", *options.decay);
  if (options.rest) settings.rest = parse_window("--rest", *options.rest);
  settings.cell_accuracy = accuracy_of(options.accuracy);
  const MeasuredLift lift = hold_against_measurements(
      options.result, {options.records.begin(), options.records.end()}, settings);
  if (options.page) write_file(*options.page, measured_page(lift));
  if (options.json)
    fmt::print("{}\n", measured_json(lift).dump(2));
  else if (!is_quiet())
    fmt::print("{}", measured_text(lift));
  if (options.page && !options.json && !is_quiet()) fmt::print("\npage: {}\n", *options.page);
  return exit_code::done;
}

}  // namespace

int show_measured(const MeasuredOptions& options) {
  try {
    return hold_and_show(options);
  } catch (const ResultsError& error) {
    // Results are only read here.
    fmt::print(stderr, "blocklift: error: {}\n", error.what());
    return exit_code::wrong_input;
  }
}

}  // namespace blocklift::pipeline
