#include "pipeline/study/members/asked_figures.h"

#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <optional>

namespace blocklift::pipeline {
namespace {

// Where list_figures has those of a simulation, loads at rest among them.
constexpr const char* usual_figures[] = {"ropes.static", "hoists.static", "cranes.static",
                                         "natural_periods"};

struct PartOfSummary {
  std::string_view key;
  RunExtent needs;
};

/// The ropes' tensions and what is named beside them.
RunExtent tensions_and(std::initializer_list<bool RunExtent::*> others) {
  RunExtent extent = RunExtent::tensions();
  for (bool RunExtent::*const other : others) extent.*other = true;
  return extent;
}

const std::vector<PartOfSummary>& known_parts() {
  using Extent = RunExtent;
  static const RunExtent least = RunExtent::tensions();
  static const std::vector<PartOfSummary> parts{
      {"ropes", least},
      {"hoists", least},
      {"cranes", least},
      {"parted", least},
      {"flexibility", least},
      {"worst_instant", least},
      {"solver", least},
      {"comparison", tensions_and({&Extent::at_rest})},
      {"stages", tensions_and({&Extent::at_rest, &Extent::rope_forces})},
      {"structure", RunExtent::block_loads()},
      {"measures", tensions_and({&Extent::at_rest, &Extent::righting_height, &Extent::motion,
                                 &Extent::rope_forces, &Extent::accelerations})},
      {"natural_periods", tensions_and({&Extent::at_rest, &Extent::natural_modes})},
      {"energy", tensions_and({&Extent::energy})},
  };
  return parts;
}

/// What a figure needs; none: everything.
std::optional<RunExtent> needs_of(std::string_view path) {
  const std::string_view key = path.substr(0, path.find('.'));
  const auto& parts = known_parts();
  const auto part = std::ranges::find(parts, key, &PartOfSummary::key);
  if (part == parts.end()) return std::nullopt;
  RunExtent needs = part->needs;
  // In the tables of loads; a name that holds the word only makes the run find more.
  const auto mentions = [&](std::string_view word) {
    return path.find(word) != std::string_view::npos;
  };
  if (mentions("static")) needs.at_rest = true;
  if (mentions("swing")) needs.rope_forces = true;
  // A rope may be bent round edges at rest alone.
  if (mentions("bend")) needs.at_rest = needs.rope_forces = true;
  return needs;
}

}  // namespace

std::vector<const Located<std::string>*> figures_of_search(const StudyFile& study) {
  std::vector<const Located<std::string>*> figures;
  for (const auto* goal : {&study.minimise, &study.maximise})
    if (*goal) figures.push_back(&**goal);
  for (const FigureBound& bound : study.subject_to) figures.push_back(&bound.figure);
  return figures;
}

AskedFigures::AskedFigures(const StudyFile& study) {
  for (const Located<std::string>* path : figures_of_search(study)) paths_.push_back(path->value);
  for (const Located<std::string>& path : study.figures) paths_.push_back(path.value);
  std::vector<std::string> needed = paths_;
  if (study.figures.empty())
    needed.insert(needed.end(), std::begin(usual_figures), std::end(usual_figures));
  if (study.figures.empty() && study.run == StudyRun::stress) needed.emplace_back("structure");
  for (const std::string& path : needed) {
    const std::optional<RunExtent> needs = needs_of(path);
    is_among_all_ = is_among_all_ || !needs;
    if (needs) extent_ = extent_ | *needs;
    parts_.insert(path.substr(0, path.find('.')));
  }
  if (is_among_all_) extent_ = RunExtent();
}

AskedFigures AskedFigures::among_all() const {
  AskedFigures asked = *this;
  asked.is_among_all_ = true;
  asked.extent_ = RunExtent();
  return asked;
}

}  // namespace blocklift::pipeline
