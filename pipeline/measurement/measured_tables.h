#pragma once

#include <string>
#include <utility>
#include <vector>

#include "pipeline/measurement/measured_lift.h"
#include "pipeline/terminal/text_table.h"

namespace blocklift::pipeline {

/// A table of the comparison, for terminal and page.
struct MeasuredTable {
  std::string caption;
  std::vector<TableColumn> columns;
  std::vector<std::vector<TextTable::Cell>> rows;
};

/// All that was found, in kN, degrees, t and m. Tables without rows are left out.
std::vector<MeasuredTable> measured_tables(const MeasuredLift& lift);

/// The unit in which a quantity of this SI unit is shown, and how many of them one of it is.
std::pair<std::string, double> shown_unit(const std::string& unit);

/// What has to be said of the weighing in a sentence; empty without one.
std::string weighing_remark(const MeasuredLift& lift);

}  // namespace blocklift::pipeline
