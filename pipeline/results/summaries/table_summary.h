#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "pipeline/checks/assessment.h"
#include "pipeline/lift/table_balance.h"

namespace blocklift::pipeline {

/// The two sets of a load table.
struct TableBalances {
  TableBalance at_rest, in_motion;
};

/// None where the lift was simulated.
std::optional<TableBalances> find_table_balances(const Assessment& assessment);

/// Why loads at rest that do not bear the block still are to be doubted. Each a sentence.
std::vector<std::string> list_doubts(const TableBalances& balances);

/// Sums, levers and accelerations of both sets, in sentences.
std::string describe_balances(const TableBalances& balances);

/// In SI units, for summary.json.
nlohmann::ordered_json table_balances_json(const TableBalances& balances);

}  // namespace blocklift::pipeline
