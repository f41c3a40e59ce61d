#include <fmt/format.h>

#include "pipeline/measurement/measured_lift.h"
#include "pipeline/measurement/measured_tables.h"

namespace blocklift::pipeline {
namespace {

std::string broken_sentence(const std::string& sentence) {
  std::string text;
  for (const std::string& line : wrap_text(sentence, terminal_width - 4))
    text += (text.empty() ? "" : "    ") + line + '\n';
  return text;
}

}  // namespace

std::string measured_text(const MeasuredLift& lift) {
  std::string text;
  for (const MeasuredTable& table : measured_tables(lift)) {
    TextTable shown(table.columns);
    for (const auto& row : table.rows) shown.add_row(row);
    text += (text.empty() ? "" : "\n") + table.caption + '\n' + shown.text();
  }
  if (const std::string remark = weighing_remark(lift); !remark.empty())
    text += broken_sentence(remark);
  for (const std::string& doubt : lift.doubts) text += broken_sentence("warning: " + doubt);
  return text;
}

}  // namespace blocklift::pipeline
