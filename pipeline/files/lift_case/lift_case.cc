#include "pipeline/files/lift_case/lift_case.h"

#include <cmath>
#include <numbers>
#include <set>
#include <system_error>

#include "pipeline/declaration/document.h"
#include "pipeline/declaration/format_once.h"
#include "pipeline/declaration/reading.h"
#include "pipeline/files/file_kind.h"
#include "pipeline/files/lift_case/lift_case_check.h"
#include "pipeline/files/lift_case/load_table_keys.h"
#include "pipeline/files/lift_case/rope_points.h"
#include "pipeline/files/named_file.h"
#include "pipeline/formats/atomic_file.h"
#include "pipeline/formats/series_file.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;

/// The case file of a path: itself, or `case.yaml` in the folder that it is. Empty and a complaint
/// if the folder has none.
fs::path case_file(const fs::path& path, Diagnostics& diagnostics) {
  std::error_code error;
  if (path.empty()) {
    diagnostics.error({}, "the name of the case is empty",
                      {"a lift case is a file, or a folder with the file case.yaml in it"});
    return {};
  }
  if (!fs::is_directory(path, error)) return path;
  fs::path file = path / "case.yaml";
  if (fs::exists(file, error)) return file;
  diagnostics.error({std::make_shared<const std::string>(shown_path(path)), 0, 0},
                    "this folder has no case.yaml",
                    {"a lift case is a file, or a folder with the file case.yaml in it"});
  return {};
}

/// Reads the measured tensions of a case; complains at the file's name.
void read_measured_series(LiftCase& lift_case, Diagnostics& diagnostics) {
  if (!lift_case.compare) return;
  for (Named<MeasuredSeries>& named : lift_case.compare->series) {
    MeasuredSeries& measured = named.value;
    if (measured.file.value.empty()) continue;
    const auto path = path_of_named_file(measured.file, lift_case.file.parent_path(), diagnostics);
    if (!path) continue;
    try {
      const SeriesFile file = read_series_file(*path);
      if (file.columns.size() != 2) {
        throw SeriesFileError(measured.file.value + " has " + std::to_string(file.columns.size()) +
                              " columns; time in s and the tension are due");
      }
      for (const double time : file.columns[0]) measured.time.push_back(time + measured.offset);
      for (const double value : file.columns[1]) measured.tension.push_back(value * measured.unit);
      if (!std::is_sorted(measured.time.begin(), measured.time.end())) {
        throw SeriesFileError(measured.file.value + ": the times do not ascend");
      }
    } catch (const SeriesFileError& error) {
      diagnostics.error(measured.file.mark, error.what());
    }
  }
}

void load_models(LiftCase& lift_case, ModelLibrary& library, Diagnostics& diagnostics) {
  const fs::path folder = lift_case.file.parent_path();
  for (given::Crane& crane : lift_case.cranes) {
    if (crane.model_name.value.empty()) continue;
    crane.model = library.load_crane(crane.model_name, folder, diagnostics, crane.parameters);
  }
  if (!lift_case.load.model_name.value.empty()) {
    lift_case.load.model = library.load_block(lift_case.load.model_name, folder, diagnostics);
  }
  if (lift_case.load.vessel_name && !lift_case.load.vessel_name->value.empty()) {
    lift_case.load.vessel = library.load_vessel(*lift_case.load.vessel_name, folder, diagnostics);
  }
  if (lift_case.load.draughts && !lift_case.load.draughts->value.empty()) {
    lift_case.lowered_load = lift_case.load.vessel;
    lift_case.deepest_draught_of_load = lift_case.load.draughts->value.back();
  }
  load_marine_models(lift_case, folder, library, diagnostics);
  read_measured_series(lift_case, diagnostics);
  for (given::Rope& rope : lift_case.ropes) {
    rope.rope = library.resolve(rope.rope_choice, folder, diagnostics);
  }
  if (lift_case.standard) load_rules(*lift_case.standard, folder, library, diagnostics);
}

/// A file of another kind is named by that, once, rather than held against the keys of a case.
void refuse_other_kinds(const fs::path& path) {
  std::error_code error;
  if (path.empty() || fs::is_directory(path, error)) return;
  const auto refuse = [&](const char* what, const char* advice) {
    Diagnostics diagnostics;
    diagnostics.error({std::make_shared<const std::string>(shown_path(path)), 0, 0},
                      std::string("this file describes ") + what + ", not a lift case", {advice});
    throw InputError(diagnostics);
  };
  switch (kind_of_file(path)) {
    case FileKind::lift_case:
      return;
    case FileKind::study:
      return refuse("a study of many lifts", "blocklift sweep runs it");
    case FileKind::mechanism:
    case FileKind::robot:
      return refuse("a mechanism", "blocklift simulate runs it");
    case FileKind::part:
      return refuse("a part", "blocklift stress works out its stress");
    default:
      return refuse("a model", "a lift case names it; blocklift validate looks at it by itself");
  }
}

}  // namespace

dynamics::Pose given::Load::pose_afloat() const {
  const Eigen::Matrix3d R_start = rotation_of(attitude);
  const double yaw = afloat ? afloat->heading : std::atan2(R_start(1, 0), R_start(0, 0));
  const std::array<double, 2> place =
      afloat ? afloat->position : std::array<double, 2>{position.x(), position.y()};
  return {dynamics::rotation_about(Vector3::UnitZ(), yaw),
          {place[0], place[1], -vessel->hull.bounds()[0].z() - draughts->value.back()}};
}

const Located<Quantity>* given::Crane::find_start(const std::string& drive_or_hoist) const {
  const auto* found = find_by_name(start, drive_or_hoist);
  return found ? &found->value : nullptr;
}

std::string ResolvedPoint::body_name(const std::vector<given::Crane>& cranes) const {
  switch (kind) {
    case Kind::world:
      return "world";
    case Kind::load:
      return "load";
    case Kind::vessel:
    case Kind::spreader:
      return part;
    case Kind::crane_body:
    case Kind::hook:
      return cranes.at(crane).name.value + "." + part;
  }
  return {};
}

Vector3 LoadTable::direction_at(const std::string& lug) const {
  if (const Vector3* one = std::get_if<Vector3>(&direction)) return *one;
  const auto* each = find_by_name(std::get<std::vector<Named<Vector3>>>(direction), lug);
  if (!each) throw std::out_of_range("the load table has no direction for lug " + lug);
  return each->value;
}

std::optional<double> LiftCase::ground_height() const {
  if (ground || sea) return ground;
  double lowest = 0;
  for (const given::Support& support : supports) lowest = std::min(lowest, support.ground);
  return lowest;
}

double given::Rope::friction() const {
  if (sheave_friction) return sheave_friction->value;
  // exp(-mu pi) is left over half a turn.
  return sheave_efficiency ? -std::log(sheave_efficiency->value) / std::numbers::pi : 0;
}

bool LiftCase::hangs(const given::Rope& rope) const {
  return rope_weight && rope_weight->value && rope.rope.mass_per_length && rope.through.empty() &&
         rope.over.empty();
}

bool LiftCase::hangs(const given::Crane& crane, const HoistModel& hoist) const {
  if (!rope_weight || !rope_weight->value || !hoist.rope.mass_per_length) return false;
  if (hoist.hook_block.turning) return false;
  if (!crane.equalised) return true;
  const auto& pair = crane.equalised->value;
  return pair[0].value != hoist.name.value && pair[1].value != hoist.name.value;
}

std::optional<double> given::Rope::least_bend() const {
  std::optional<double> least;
  if (bend_diameter) least = bend_diameter->value;
  for (const LoadEdge& edge : edges)
    if (!least || 2 * edge.radius < *least) least = 2 * edge.radius;
  return least;
}

const given::Crane* LiftCase::find_crane(const std::string& crane) const {
  return find_by_name(cranes, crane);
}

const given::Rope* LiftCase::find_rope(const std::string& rope) const {
  return find_by_name(ropes, rope);
}

const given::Spreader* LiftCase::find_spreader(const std::string& spreader) const {
  return find_by_name(spreaders, spreader);
}

std::string LiftCase::hook_above(const given::Rope& rope) const {
  std::string hook;
  std::set<std::string> passed;  // spreaders; a ring of them hangs on nothing
  std::vector<const ResolvedPoint*> open = {&rope.path.front()};
  if (rope.is_basket()) open.push_back(&rope.path.back());
  while (!open.empty()) {
    const ResolvedPoint& first = *open.back();
    open.pop_back();
    if (first.kind == ResolvedPoint::Kind::hook) {
      const std::string found = first.body_name(cranes);
      if (!hook.empty() && found != hook) return {};
      hook = found;
    } else if (first.kind == ResolvedPoint::Kind::spreader) {
      if (!passed.insert(first.part).second) continue;
      for (const given::Rope& above : ropes)
        if (above.ends_at_spreader(first.part)) open.push_back(&above.path.front());
    } else {
      return {};
    }
  }
  return hook;
}

std::optional<LiftCase> read_lift_case(const fs::path& path, ModelLibrary& library,
                                       Diagnostics& diagnostics) {
  const std::size_t errors_before = diagnostics.error_count();
  library.begin_case();
  const fs::path file = case_file(path, diagnostics);
  if (file.empty()) return std::nullopt;
  const std::optional<Document> document = library.read_case(file, diagnostics);
  if (!document || complain_about_untold_kind(*document, diagnostics)) return std::nullopt;

  LiftCase lift_case;
  lift_case.file = file;
  lift_case.yaml = document->text;
  Reading reading(*document, diagnostics);
  format_once<lift_case_format>().read(document->root, reading, lift_case);
  load_models(lift_case, library, diagnostics);
  library.complain_about_unused_changes(diagnostics);
  if (document->root.IsMap()) {
    if (lift_case.load_table) check_keys_beside_load_table(*document, diagnostics);
    resolve_points(lift_case, diagnostics);
    check_lift_case(lift_case, diagnostics);
  }
  if (diagnostics.error_count() == errors_before && !lift_case.load_table) {
    check_loops_at_start(lift_case, diagnostics);
  }
  if (diagnostics.error_count() > errors_before) return std::nullopt;
  for (const FoundModel& model : library.found())
    lift_case.model_texts.push_back(
        {model.name, model.text.empty() ? read_file(model.file) : model.text});
  return lift_case;
}

LiftCase read_lift_case(const fs::path& path, std::vector<KeyChange> changes) {
  Diagnostics diagnostics;
  ModelLibrary library = ModelLibrary::of_installation();
  library.set_changes(std::move(changes));
  std::optional<LiftCase> lift_case = read_lift_case(path, library, diagnostics);
  if (lift_case) return std::move(*lift_case);
  refuse_other_kinds(path);
  throw InputError(diagnostics);
}

}  // namespace blocklift::pipeline
