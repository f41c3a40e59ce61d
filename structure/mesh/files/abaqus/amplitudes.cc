#include "structure/mesh/files/abaqus/amplitudes.h"

#include <fmt/format.h>

namespace blocklift::structure {

namespace {

/// Times, which rise, and the factors that belong to them.
std::vector<std::pair<double, double>> table_of(const AbaqusBlock& block) {
  std::vector<std::pair<double, double>> table;
  for (const AbaqusLine& line : block.data) {
    const auto fields = line.fields();
    for (std::size_t i = 0; i + 1 < fields.size(); i += 2) {
      if (fields[i].empty()) continue;
      table.emplace_back(abaqus_real(fields, i, "time"), abaqus_real(fields, i + 1, "amplitude"));
      if (table.size() > 1 && !(table.back().first >= table[table.size() - 2].first))
        throw CardError{"the times of its amplitude do not rise"};
    }
  }
  return table;
}

double value_at(const std::vector<std::pair<double, double>>& table, double time) {
  if (time <= table.front().first) return table.front().second;
  for (std::size_t i = 1; i < table.size(); ++i) {
    const auto& [from, start] = table[i - 1];
    const auto& [to, end] = table[i];
    if (time <= to) return to > from ? start + (end - start) * (time - from) / (to - from) : end;
  }
  return table.back().second;
}

}  // namespace

AbaqusAmplitudes::AbaqusAmplitudes(const AbaqusModel& model) {
  const auto note = [&](const AbaqusBlock* block) {
    if (block->name == "AMPLITUDE") tables_[block->value("NAME")] = block;
  };
  for (const AbaqusScope& scope : model.scopes)
    for (const AbaqusBlock* block : scope.blocks) note(block);
  for (const auto& step : model.steps)
    for (const AbaqusBlock* block : step) note(block);
}

void AbaqusAmplitudes::begin_step(const std::vector<const AbaqusBlock*>& step) {
  step_time_ = 1;
  for (const AbaqusBlock* block : step) {
    if (block->name != "STATIC" || block->data.empty()) continue;
    const auto fields = block->data.front().fields();
    if (fields.size() > 1) step_time_ = to_real(fields[1]).value_or(1);
  }
  if (step.front()->has("PERTURBATION")) step_time_ = 0;  // no time passes
  total_time_ += step_time_;
}

double AbaqusAmplitudes::factor_of(const AbaqusBlock& block) {
  if (!block.has("AMPLITUDE")) return 1;
  const std::string name = block.required("AMPLITUDE");
  const auto found = tables_.find(name);
  if (found == tables_.end()) throw CardError{fmt::format("amplitude {} does not exist", name)};
  const AbaqusBlock& amplitude = *found->second;
  for (const char* parameter : {"DEFINITION", "VALUE", "INPUT", "USER", "SHIFTX", "SHIFTY"}) {
    const std::string value = amplitude.value(parameter);
    if (amplitude.has(parameter) && value != "TABULAR" && value != "RELATIVE")
      throw CardError{
          fmt::format("amplitude {} has {}, which is not known: a table of times and "
                      "factors is due",
                      name, parameter)};
  }
  const Table table = table_of(amplitude);
  if (table.empty()) throw CardError{fmt::format("amplitude {} has no table", name)};
  const std::string delay = block.value("TIME DELAY");
  const auto later = delay.empty() ? 0 : to_real(delay);
  if (!later) throw CardError{fmt::format("TIME DELAY = {} is no number", delay)};
  if (amplitude.value("TIME") != "TOTAL TIME") return value_at(table, step_time_ - *later);
  const double factor = value_at(table, total_time_ - *later);
  taken_.push_back({name, table, *later, factor});
  return factor;
}

std::string AbaqusAmplitudes::moved_on() const {
  for (const Taken& taken : taken_)
    if (value_at(taken.table, total_time_ - taken.delay) != taken.factor) return taken.name;
  return {};
}

ScaledFields::ScaledFields(const std::vector<std::string_view>& fields, std::size_t place,
                           double factor, const char* what)
    : fields_(fields) {
  if (factor == 1 || place >= fields.size() || fields[place].empty()) return;
  text_ = fmt::format("{:.17g}", factor * abaqus_real(fields, place, what));
  fields_[place] = text_;
}

}  // namespace blocklift::structure
