#include "pipeline/files/lift_case/own_laws.h"

#include <algorithm>
#include <memory>
#include <utility>

#include <fmt/format.h>

namespace blocklift::pipeline {
namespace {

void miss_law(const Located<std::string>& law, Diagnostics& diagnostics) {
  diagnostics.error(
      law.mark,
      fmt::format("nobody gives the law \"{}\" by which this drive is steered", law.value),
      {fmt::format("laws are functions of Python, given by laws={{\"{}\": ...}} to simulate and "
                   "assess of blocklift.Case and to blocklift.sweep",
                   law.value)});
}

}  // namespace

void check_laws(const OwnLaws& laws, const std::vector<given::Stage>& operation,
                const std::filesystem::path& file, Diagnostics& diagnostics) {
  std::vector<std::string> known;
  std::vector<const Located<std::string>*> missing;
  for (const given::Stage& stage : operation)
    for (const given::Move& move : stage.moves) {
      if (!move.keeps || !move.keeps->law) continue;
      known.push_back(move.keeps->law->value);
      if (!laws.contains(known.back())) missing.push_back(&*move.keeps->law);
    }
  for (const auto& [name, law] : laws) {
    if (std::ranges::find(known, name) != known.end()) continue;
    const std::string hint =
        known.empty() ? fmt::format("a move has it by {{drives: [...], keeps: {{law: {}}}}}", name)
                      : names_hint("its laws are", known, name);
    diagnostics.error({std::make_shared<const std::string>(file.string()), 0, 0},
                      fmt::format("no drive of it is steered by a law \"{}\"", name), {hint});
  }
  for (const Located<std::string>* law : missing) miss_law(*law, diagnostics);
}

// A law is given the coordinate and the rate of its drive, then what it sees besides.
dynamics::OwnLaw make_own_law(const given::Keep& keep, const OwnLaws& laws) {
  const auto law = laws.find(keep.law->value);
  if (law == laws.end()) {
    Diagnostics diagnostics;
    miss_law(*keep.law, diagnostics);
    throw InputError(diagnostics);
  }
  dynamics::OwnLaw own{keep.law->value, {dynamics::SeenCoordinate{}, dynamics::SeenRate{}}, {}};
  std::vector<std::string> figures{"position", "speed"};
  for (const given::Sight& sight : keep.sees) figures.push_back(sight.name.value);
  own.begin = [make = law->second, figures] { return make(figures); };
  return own;
}

}  // namespace blocklift::pipeline
