#include "pipeline/formats/results/results_check.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <new>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "pipeline/formats/results/results_layout.h"

namespace blocklift::pipeline {
namespace {

using layout::join;

constexpr std::size_t most_complaints_about_results = 20;
constexpr std::size_t any_count = static_cast<std::size_t>(-1);
using Extents = std::vector<std::size_t>;

/// Whether numbers may be nan: a figure may have no value, the place of a body may not.
enum class Known { always, perhaps };

bool is_utf8(const std::string& text) {
  try {
    nlohmann::json(text).dump();
    return true;
  } catch (const nlohmann::json::exception&) {
    return false;
  }
}

std::string shown_shape(const Extents& shape) {
  if (shape.empty()) return "one number";
  std::string text;
  for (const std::size_t extent : shape)
    text += (text.empty() ? "" : " x ") + (extent == any_count ? "any" : std::to_string(extent));
  return text;
}

class ResultsCheck {
 public:
  ResultsCheck(const ResultsReader& results, const PlaceOfReading& next)
      : results_(results), next_(next) {}
  std::vector<std::string> take() { return std::move(complaints_); }

  void look() {
    look_at_head();
    if (results_.has("/part/yaml")) return;  // of a part alone: no reader knows more of it
    look_at_case();
    look_at_operation();
    look_at_history(std::string(layout::static_history));
    look_at_history(std::string(layout::dynamic_history));
    look_at_outputs();
    look_at_measured();
    look_at_modes();
    look_at_scene();
    look_at_surface();
    look_at_patches();
    look_at_padeyes();
  }

 private:
  bool is_full() const { return complaints_.size() >= most_complaints_about_results; }

  void complain(const std::string& path, const std::string& what) {
    if (!is_full()) complaints_.push_back(fmt::format("\"{}\" {}", path, what));
  }

  /// What `read` gives; none, and a complaint, where it cannot be read.
  template <class Read>
  auto attempt(const std::string& path, const Read& read) -> std::optional<decltype(read())> {
    if (is_full()) return std::nullopt;
    next_(path);
    try {
      return read();
    } catch (const ResultsError& error) {
      complaints_.emplace_back(error.what());
    } catch (const std::bad_alloc&) {
      complain(path, "has more values than the memory holds");
    } catch (const std::length_error&) {
      complain(path, "has more values than the memory holds");
    }
    return std::nullopt;
  }

  /// Whether a thing is there. Where it is not, that above it must be a group that can be read:
  /// of a damaged one everything seems to be missing.
  bool has(const std::string& path) {
    const std::optional<bool> found = attempt(path, [&] { return results_.has(path); });
    if (!found || *found) return found.value_or(false);
    std::string above = path;
    do {
      above = above.substr(0, above.rfind('/'));
      if (above.empty()) above = "/";
    } while (!results_.has(above));
    if (read_groups_.insert(above).second) attempt(above, [&] { return results_.children(above); });
    return false;
  }

  /// Names in a group; none where there is no such group.
  std::vector<std::string> children(const std::string& group) {
    if (!has(group)) return {};
    std::vector<std::string> names;
    if (auto read = attempt(group, [&] { return results_.children(group); })) {
      for (std::string& name : *read) {
        if (is_utf8(name))
          names.push_back(std::move(name));
        else
          complain(group, "has a member whose name is no text in UTF-8");
      }
    }
    return names;
  }

  // ------------------------------------------------------------------------------- single things

  void text_attribute(const std::string& object, const char* name) {
    attempt(object, [&] {
      if (results_.has_attribute(object, name) &&
          !is_utf8(results_.read_text_attribute(object, name)))
        complain(object, fmt::format("has an attribute \"{}\" that is no text in UTF-8", name));
      return true;
    });
  }

  void number_attribute(const std::string& object, const char* name, bool is_required = false) {
    attempt(object, [&] {
      if ((is_required || results_.has_attribute(object, name)) &&
          !std::isfinite(results_.read_number_attribute(object, name)))
        complain(object, fmt::format("has an attribute \"{}\" that is no number", name));
      return true;
    });
  }

  std::optional<std::vector<std::string>> texts(const std::string& path) {
    auto read = attempt(path, [&] { return results_.read_texts(path); });
    if (read && !std::all_of(read->begin(), read->end(), is_utf8))
      complain(path, "is not text in UTF-8");
    return read;
  }

  /// As many texts as are due.
  void texts(const std::string& path, std::size_t due) {
    const auto read = texts(path);
    if (read && due != any_count && read->size() != due)
      complain(path, fmt::format("holds {} texts; {} are due", read->size(), due));
  }

  template <class Number>
  bool fits(const std::string& path, const Array<Number>& array, const Extents& due,
            const std::string& why) {
    bool same = array.shape.size() == due.size();
    for (std::size_t i = 0; same && i < due.size(); ++i)
      same = due[i] == any_count || due[i] == array.shape[i];
    if (!same)
      complain(path, fmt::format("has shape {}; {} is due{}", shown_shape(array.shape),
                                 shown_shape(due), why));
    return same;
  }

  void meaning(const std::string& path) {
    text_attribute(path, "units");
    text_attribute(path, "description");
    attempt(path, [&] { return results_.read_meaning(path).units; });
  }

  /// Numbers of a dataset of the shape that is due, of which `why` tells the reason.
  std::optional<Array<double>> numbers(const std::string& path, const Extents& due, Known known,
                                       const std::string& why = "") {
    auto read = attempt(path, [&] { return results_.read(path); });
    if (!read || !fits(path, *read, due, why)) return std::nullopt;
    if (known == Known::always) {
      const auto unknown = std::find_if_not(read->values.begin(), read->values.end(),
                                            [](double value) { return std::isfinite(value); });
      if (unknown != read->values.end()) {
        complain(path, fmt::format("has {} as value {} of {}; a number is due", *unknown,
                                   unknown - read->values.begin() + 1, read->values.size()));
        return std::nullopt;
      }
    }
    return read;
  }

  /// Whole numbers from 0 up to below `bound`. @returns how many rows; none if they are unsound.
  std::optional<std::size_t> indices(const std::string& path, const Extents& due, std::size_t bound,
                                     const std::string& into, const std::string& why = "") {
    const auto read = attempt(path, [&] { return results_.read_indices(path); });
    if (!read || !fits(path, *read, due, why)) return std::nullopt;
    for (const std::int32_t value : read->values) {
      if (value >= 0 && static_cast<std::size_t>(value) < bound) continue;
      complain(path, fmt::format("holds {}; a number from 0 up to below {} is due, {}", value,
                                 bound, into));
      return std::nullopt;
    }
    return read->rows();
  }

  /// The number of samples of a series of instants that never goes back; none if it is unsound.
  std::optional<std::size_t> instants(const std::string& path) {
    const auto time = numbers(path, {any_count}, Known::always);
    if (!time) return std::nullopt;
    if (!std::is_sorted(time->values.begin(), time->values.end())) {
      complain(path, "goes back; instants in their order are due");
      return std::nullopt;
    }
    return time->values.size();
  }

  void series(const std::string& path, std::size_t count, Known known, const std::string& time) {
    numbers(path, {count}, known, fmt::format(", a value for each instant of \"{}\"", time));
    meaning(path);
  }

  void series_if_there(const std::string& path, std::size_t count, Known known,
                       const std::string& time) {
    if (has(path)) series(path, count, known, time);
  }

  // -------------------------------------------------------------------------------- parts of it

  void look_at_head() {
    if (!attempt("/", [&] { return results_.has_attribute("/", "format"); }).value_or(false))
      return;
    attempt("/", [&] {
      const std::string format = results_.read_text_attribute("/", "format");
      if (format != layout::format_name)
        complain("/", fmt::format("has the attribute format \"{}\"; \"{}\" is due",
                                  is_utf8(format) ? format : "?", layout::format_name));
      return true;
    });
    number_attribute("/", "format_version");
  }

  void look_at_case() {
    const std::string group(layout::case_group);
    if (!has(group)) return complain(group, "is not in the file; what was run is due");
    for (const char* name : {"name", "title", "created", "program_version", "run"})
      text_attribute(group, name);
    const std::string yaml(layout::case_yaml), names(layout::model_names);
    if (has(yaml)) texts(yaml, 1);
    if (!has(names)) return;
    if (const auto models = texts(names))
      texts(std::string(layout::model_contents), models->size());
  }

  void look_at_operation() {
    const std::string names(layout::stage_names);
    if (!has(names)) return;
    const auto stages = texts(names);
    if (!stages) return;
    const std::string why = fmt::format(", a value for each of \"{}\"", names);
    numbers(std::string(layout::stage_start), {stages->size()}, Known::always, why);
    numbers(std::string(layout::stage_end), {stages->size()}, Known::always, why);
  }

  void look_at_history(const std::string& history) {
    if (!has(history)) return;
    const std::string time = join(history, "time");
    const auto n = instants(time);
    if (!n) return;
    for (const std::string& rope : children(join(history, "ropes")))
      series(join(history, "ropes", rope, "tension"), *n, Known::always, time);
    for (const std::string& hoist : children(join(history, "hoists"))) {
      const std::string group = join(history, "hoists", hoist);
      series(join(group, "tension"), *n, Known::always, time);
      series_if_there(join(group, "length"), *n, Known::perhaps, time);
      series_if_there(join(group, "swing"), *n, Known::perhaps, time);
    }
    for (const std::string& body : children(join(history, "bodies")))
      numbers(join(history, "bodies", body, "pose"), {*n, 7}, Known::always,
              fmt::format(", a row for each instant of \"{}\"", time));
    for (const std::string& drive : children(join(history, "drives"))) {
      series_if_there(join(history, "drives", drive, "position"), *n, Known::perhaps, time);
      series_if_there(join(history, "drives", drive, "force"), *n, Known::perhaps, time);
    }
    for (const char* things : {"measures", "energy"})
      for (const std::string& name : children(join(history, things)))
        series(join(history, things, name), *n, Known::perhaps, time);
  }

  void look_at_outputs() {
    const std::string group(layout::outputs_group), time(layout::outputs_time);
    const auto names = children(group);
    if (names.empty()) return;
    const auto n = instants(time);
    if (!n) return;
    for (const std::string& name : names) look_at_output(join(group, name), *n);
  }

  /// A value at each instant, or a row of them.
  void look_at_output(const std::string& path, std::size_t instants) {
    const auto values = attempt(path, [&] { return results_.read(path); });
    if (!values) return;
    if (values->shape.empty() || values->shape.size() > 2 || values->shape[0] != instants)
      return complain(path,
                      fmt::format("has shape {}; {} rows are due, one for each instant of "
                                  "\"{}\"",
                                  shown_shape(values->shape), instants, layout::outputs_time));
    text_attribute(path, "columns");
    meaning(path);
    // Units of the columns stand side by side, or one serves all.
    attempt(path, [&] {
      const std::string units = results_.read_meaning(path).units;
      std::size_t count = 1;
      for (std::size_t at = units.find(", "); at != std::string::npos;
           at = units.find(", ", at + 2))
        ++count;
      if (count > 1 && count != values->columns())
        complain(path,
                 fmt::format("has the units \"{}\" for {} columns", units, values->columns()));
      return true;
    });
  }

  void look_at_measured() {
    for (const std::string& rope : children(std::string(layout::measured_group))) {
      const std::string group = join(layout::measured_group, rope), time = join(group, "time");
      if (const auto n = instants(time)) series(join(group, "tension"), *n, Known::always, time);
    }
  }

  void look_at_modes() {
    for (const std::string& instant : children(std::string(layout::modes_group))) {
      const std::string group = join(layout::modes_group, instant);
      number_attribute(group, "time", true);
      for (const std::string& body : children(join(group, "bodies")))
        numbers(join(group, "bodies", body, "motion"), {any_count, 12}, Known::always);
    }
  }

  void look_at_scene() {
    for (const std::string& body : children(std::string(layout::scene_bodies))) {
      const std::string group = join(layout::scene_bodies, body);
      text_attribute(group, "kind");
      numbers(join(group, "boxes"), {any_count, 10}, Known::always);
    }
    for (const std::string& rope : children(std::string(layout::scene_ropes))) {
      const std::string group = join(layout::scene_ropes, rope);
      text_attribute(group, "kind");
      if (const auto bodies = texts(join(group, "bodies")))
        numbers(join(group, "points"), {bodies->size(), 3}, Known::always,
                fmt::format(", a point for each of \"{}\"", join(group, "bodies")));
    }
    if (!has(std::string(layout::scene_lugs))) return;
    text_attribute(std::string(layout::scene_lugs), "body");
    if (!has(std::string(layout::scene_lug_names))) return;
    if (const auto lugs = texts(std::string(layout::scene_lug_names)))
      numbers(std::string(layout::scene_lug_points), {lugs->size(), 3}, Known::always,
              fmt::format(", a point for each of \"{}\"", layout::scene_lug_names));
  }

  void look_at_surface() {
    const std::string points_path(layout::surface_points), quads_path(layout::surface_quads);
    const bool has_points = has(points_path), has_quads = has(quads_path);
    if (!has_points && !has_quads) return;
    const auto points = numbers(points_path, {any_count, 3}, Known::always);
    if (!points) return;
    const std::size_t count = points->rows();
    const auto quads = indices(quads_path, {any_count, 4}, count,
                               fmt::format("an index into \"{}\"", points_path));
    const std::string group_path(layout::surface_quad_group);
    if (quads && has(group_path) && has(std::string(layout::surface_group_names)))
      if (const auto names = texts(std::string(layout::surface_group_names)))
        indices(group_path, {*quads}, names->size(),
                fmt::format("an index into \"{}\"", layout::surface_group_names),
                fmt::format(", a group for each of \"{}\"", quads_path));
    for (const std::string_view way :
         {layout::history, layout::simultaneous, layout::per_rope_maxima})
      for (const std::string_view state : {layout::static_state, layout::dynamic_state})
        look_at_field(join(layout::structure_group, way, state), count);
  }

  /// The squares of the checked stress, and the largest of each over the whole lift.
  void look_at_patches() {
    const std::string history = join(layout::structure_group, layout::history);
    const std::string plate = join(history, "patches", "plate"),
                      plates = join(history, "patches", "plates");
    if (!has(plate) || !has(plates)) return;
    const auto names = texts(plates);
    if (!names) return;
    const auto count =
        indices(plate, {any_count}, names->size(), fmt::format("an index into \"{}\"", plates));
    if (!count) return;
    for (const std::string_view state : {layout::static_state, layout::dynamic_state}) {
      const std::string values = join(history, state, "patches", "von_mises");
      if (has(values))
        numbers(values, {*count}, Known::always,
                fmt::format(", a value for each of \"{}\"", plate));
    }
  }

  void look_at_field(const std::string& group, std::size_t points) {
    if (!has(group)) return;
    const std::string why = fmt::format(", a row for each of \"{}\"", layout::surface_points);
    numbers(join(group, "von_mises"), {points}, Known::always, why);
    numbers(join(group, "displacement"), {points, 3}, Known::always, why);
    for (const char* place :
         {"peak_stress_point", "checked_stress_point", "max_displacement_point"})
      if (has(join(group, place))) numbers(join(group, place), {3}, Known::perhaps);
    text_attribute(group, "rope");
    number_attribute(group, "time");
  }

  void look_at_padeyes() {
    for (const std::string& lug : children(std::string(layout::padeyes_group))) {
      const std::string group = join(layout::padeyes_group, lug);
      const auto corners = numbers(join(group, "corners"), {any_count, 8}, Known::always);
      if (!corners) continue;
      const std::string why = fmt::format(", a value for each of \"{}\"", join(group, "corners"));
      indices(join(group, "plate"), {corners->rows()}, 3, "the main plate and two cheek plates");
      numbers(join(group, "von_mises"), {corners->rows()}, Known::always, why);
      numbers(join(group, "force"), {3}, Known::always);
      text_attribute(group, "state");
      text_attribute(group, "rope");
      number_attribute(group, "time");
    }
  }

  const ResultsReader& results_;
  const PlaceOfReading& next_;
  std::vector<std::string> complaints_;
  std::set<std::string> read_groups_;
};

}  // namespace

std::vector<std::string> complaints_about_results(const ResultsReader& results,
                                                  const PlaceOfReading& next) {
  ResultsCheck check(results, next);
  check.look();
  return check.take();
}

}  // namespace blocklift::pipeline
