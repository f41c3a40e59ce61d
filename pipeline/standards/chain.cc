#include "pipeline/standards/chain.h"

#include <algorithm>
#include <utility>

namespace blocklift::pipeline {

double Chain::standard_utilisation() const { return limit ? standard / *limit : 0; }

double Chain::simulated_utilisation() const {
  return limit ? simulated / simulated_limit.value_or(*limit) : 0;
}

double Chain::utilisation() const {
  return std::max(standard_utilisation(), simulated_utilisation());
}

ChainBuilder::ChainBuilder(std::string kind, std::string name, std::string unit) {
  chain_.object = kind + " " + name;
  chain_.name = std::move(name);
  chain_.kind = std::move(kind);
  chain_.unit = std::move(unit);
}

ChainBuilder& ChainBuilder::add(std::string name, double load, std::string clause,
                                std::string formula) {
  chain_.steps.push_back({ChainStep::Kind::load, std::move(name), load, load, chain_.unit,
                          std::move(clause), std::move(formula)});
  chain_.standard += load;
  chain_.simulated += load;
  return *this;
}

ChainBuilder& ChainBuilder::begin(std::string name, double standard, double simulated,
                                  std::string clause, std::string formula) {
  chain_.steps.push_back({ChainStep::Kind::load, std::move(name), standard, simulated, chain_.unit,
                          std::move(clause), std::move(formula)});
  chain_.standard = standard;
  chain_.simulated = simulated;
  return *this;
}

ChainBuilder& ChainBuilder::times(std::string name, std::optional<double> standard,
                                  std::optional<double> simulated, std::string clause,
                                  std::string formula) {
  chain_.steps.push_back({ChainStep::Kind::factor, std::move(name), standard, simulated, "1",
                          std::move(clause), std::move(formula)});
  chain_.standard *= standard.value_or(1);
  chain_.simulated *= simulated.value_or(1);
  return *this;
}

ChainBuilder& ChainBuilder::result(std::string name, std::string clause) {
  chain_.steps.push_back({ChainStep::Kind::result,
                          std::move(name),
                          chain_.standard,
                          chain_.simulated,
                          chain_.unit,
                          std::move(clause),
                          {}});
  return *this;
}

ChainBuilder& ChainBuilder::tell(ChainStep step) {
  step.kind = ChainStep::Kind::told;
  chain_.steps.push_back(std::move(step));
  return *this;
}

ChainBuilder& ChainBuilder::limit(double limit, std::string text, std::string clause,
                                  std::optional<double> simulated) {
  chain_.limit = limit;
  chain_.limit_text = std::move(text);
  chain_.limit_clause = std::move(clause);
  chain_.simulated_limit = simulated;
  return *this;
}

}  // namespace blocklift::pipeline
