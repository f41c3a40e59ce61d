#include <exception>
#include <filesystem>
#include <iostream>
#include <string>

#include <fmt/format.h>

#include "pipeline/formats/atomic_file.h"
#include "pipeline/measurement/measured_lift.h"
#include "tests/pipeline/measurement/sample_record.h"

/// Writes the page of a sample lift and its record, for measured_page_test.mjs.
int main(int argument_count, char** arguments) {
  using namespace blocklift::pipeline;
  try {
    if (argument_count != 2) throw std::runtime_error("usage: write_sample_measured FOLDER");
    const std::filesystem::path folder(arguments[1]);
    test::write_sample_lift(folder / "lift");
    std::string cells = "time [s],ropes.R1 [kN],bodies.block.roll [deg]\n";
    for (int i = 0; i <= 500; ++i)
      cells += fmt::format("{:.1f},{:.9g},0.5\n", 0.1 * i, test::sample_tension(0.1 * i) / 1000);
    write_file(folder / "cells.csv", cells);
    MeasurementSettings settings;
    settings.decay = TimeWindow{12, 50};
    write_file(folder / "measured.html", measured_page(hold_against_measurements(
                                             folder / "lift", {folder / "cells.csv"}, settings)));
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
