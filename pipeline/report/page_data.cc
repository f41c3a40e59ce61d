#include "pipeline/report/page_data.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "pipeline/formats/results/results_layout.h"
#include "pipeline/report/block_surface.h"
#include "pipeline/report/decimation.h"
#include "pipeline/report/packed_array.h"

namespace blocklift::pipeline {
namespace {

using layout::join;
using json = nlohmann::ordered_json;  // the tables of the page keep the order of the summary

/// Histories are thinned to this many buckets: enough to zoom in by four on a wide screen.
constexpr std::size_t history_buckets = 4000;
constexpr std::size_t small_history_buckets = 1000;
constexpr std::size_t motion_frames = 600;
/// Bytes that the pictures of the structure may take of the page's 10 MB.
constexpr std::size_t picture_budget = 8'000'000;

// -------------------------------------------------------------------------------------- histories

std::vector<std::string> children_of(const ResultsReader& results, const std::string& group) {
  return results.has(group) ? results.children(group) : std::vector<std::string>{};
}

json packed_series(const std::string& name, const std::string& quantity, const Meaning& meaning,
                   const std::vector<double>& time, const std::vector<double>& values,
                   std::size_t buckets) {
  std::vector<double> kept_time;
  std::vector<double> kept_values;
  for (const std::size_t i : indices_to_draw(values, buckets)) {
    if (!std::isfinite(values[i])) continue;
    kept_time.push_back(time[i]);
    kept_values.push_back(values[i]);
  }
  return {{"name", name},
          {"quantity", quantity},
          {"units", meaning.units},
          {"description", meaning.description},
          {"time", packed_floats(kept_time)},
          {"values", packed_floats(kept_values)}};
}

json series(const ResultsReader& results, const std::string& dataset, const std::string& name,
            const std::string& quantity, const std::vector<double>& time, std::size_t buckets) {
  const Array<double> values = results.read(dataset);
  if (values.values.size() != time.size())
    throw ResultsError("\"" + dataset + "\" has " + std::to_string(values.values.size()) +
                       " samples, its time has " + std::to_string(time.size()));
  return packed_series(name, quantity, results.read_meaning(dataset), time, values.values, buckets);
}

/// All series of one kind of thing: <history>/<things>/<thing>/<quantity>.
json series_of_things(const ResultsReader& results, const std::string& group,
                      const std::vector<std::pair<std::string, std::size_t>>& quantities,
                      const std::vector<double>& time) {
  json list = json::array();
  for (const std::string& thing : children_of(results, group))
    for (const auto& [quantity, buckets] : quantities) {
      const std::string dataset = join(group, thing, quantity);
      if (results.has(dataset))
        list.push_back(series(results, dataset, thing, quantity, time, buckets));
    }
  return list;
}

json history(const ResultsReader& results, const std::string& group) {
  if (!results.has(group)) return nullptr;
  const std::vector<double> time = results.read(join(group, "time")).values;
  if (time.empty()) return nullptr;
  json energy = json::array();
  for (const std::string& term : children_of(results, join(group, "energy")))
    energy.push_back(
        series(results, join(group, "energy", term), term, "energy", time, small_history_buckets));
  json measures = json::array();
  for (const std::string& measure : children_of(results, join(group, "measures")))
    measures.push_back(series(results, join(group, "measures", measure), measure, "measure", time,
                              small_history_buckets));
  return {
      {"start", time.front()},
      {"end", time.back()},
      {"samples", time.size()},
      {"ropes",
       series_of_things(results, join(group, "ropes"), {{"tension", history_buckets}}, time)},
      {"hoists", series_of_things(
                     results, join(group, "hoists"),
                     {{"tension", small_history_buckets}, {"swing", small_history_buckets}}, time)},
      {"drives",
       series_of_things(results, join(group, "drives"),
                        {{"position", small_history_buckets}, {"force", small_history_buckets}},
                        time)},
      {"energy", std::move(energy)},
      {"measures", std::move(measures)}};
}

std::string attribute_or(const ResultsReader& results, std::string_view object, const char* name,
                         const std::string& otherwise) {
  return results.has_attribute(object, name) ? results.read_text_attribute(object, name)
                                             : otherwise;
}

/// "x, y, z" in parts.
std::vector<std::string> parts_of(const std::string& text) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find(", ", begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 2;
  }
  return parts;
}

/// The columns of an output, a series each.
json output_series(const ResultsReader& results, const std::string& output,
                   const std::vector<double>& time) {
  const std::string dataset = join(layout::outputs_group, output);
  const Array<double> values = results.read(dataset);
  if (values.rows() != time.size())
    throw ResultsError("\"" + dataset + "\" has " + std::to_string(values.rows()) +
                       " samples, its time has " + std::to_string(time.size()));
  const std::vector<std::string> names = parts_of(attribute_or(results, dataset, "columns", ""));
  const Meaning meaning = results.read_meaning(dataset);
  const std::vector<std::string> units = parts_of(meaning.units);
  json list = json::array();
  for (std::size_t column = 0; column < values.columns(); ++column) {
    std::vector<double> one;
    for (std::size_t i = 0; i < values.rows(); ++i) one.push_back(values(i, column));
    list.push_back(
        packed_series(output, column < names.size() ? names[column] : "",
                      {units.size() > 1 ? units[column] : meaning.units, meaning.description}, time,
                      one, small_history_buckets));
  }
  return list;
}

json outputs(const ResultsReader& results) {
  json list = json::array();
  const auto names = children_of(results, std::string(layout::outputs_group));
  if (names.empty()) return list;
  const std::vector<double> time = results.read(layout::outputs_time).values;
  for (const std::string& name : names)
    for (json& one : output_series(results, name, time)) list.push_back(std::move(one));
  return list;
}

json motion(const ResultsReader& results, const std::string& group) {
  if (!results.has(join(group, "bodies"))) return nullptr;
  const std::vector<double> time = results.read(join(group, "time")).values;
  const std::vector<std::size_t> frames = evenly_spread_indices(time.size(), motion_frames);
  std::vector<double> frame_time;
  for (const std::size_t frame : frames) frame_time.push_back(time[frame]);
  json bodies = json::object();
  for (const std::string& body : results.children(join(group, "bodies"))) {
    const std::string dataset = join(group, "bodies", body, "pose");
    if (!results.has(dataset)) continue;
    const Array<double> pose = results.read(dataset);
    if (pose.rows() != time.size() || pose.columns() != 7)
      throw ResultsError("\"" + dataset + "\" is " + std::to_string(pose.rows()) + " x " +
                         std::to_string(pose.columns()) + "; " + std::to_string(time.size()) +
                         " x 7 is due");
    std::vector<double> kept;
    for (const std::size_t frame : frames)
      for (std::size_t k = 0; k < 7; ++k) kept.push_back(pose(frame, k));
    bodies[body] = packed_floats(kept);
  }
  return {{"time", packed_floats(frame_time)}, {"bodies", std::move(bodies)}};
}

/// Measured tensions by rope.
json measured(const ResultsReader& results) {
  json list = json::array();
  for (const std::string& rope : children_of(results, std::string(layout::measured_group))) {
    const std::string group = join(layout::measured_group, rope);
    const std::vector<double> time = results.read(join(group, "time")).values;
    list.push_back(series(results, join(group, "tension"), rope, "tension", time, history_buckets));
  }
  return list;
}

/// Shapes of the natural modes, an instant each: 12 numbers a mode and body.
json modes(const ResultsReader& results) {
  json list = json::array();
  for (const std::string& instant : children_of(results, std::string(layout::modes_group))) {
    const std::string group = join(layout::modes_group, instant);
    json bodies = json::object();
    for (const std::string& body : children_of(results, join(group, "bodies"))) {
      const std::string dataset = join(group, "bodies", body, "motion");
      const Array<double> motion = results.read(dataset);
      if (motion.columns() != 12)
        throw ResultsError("\"" + dataset + "\" has " + std::to_string(motion.columns()) +
                           " columns; 12 are due");
      bodies[body] = packed_floats(motion.values);
    }
    list.push_back(
        {{"time", results.read_number_attribute(group, "time")}, {"bodies", std::move(bodies)}});
  }
  return list;
}

json stages(const ResultsReader& results) {
  json list = json::array();
  if (!results.has(layout::stage_names)) return list;
  const auto names = results.read_texts(layout::stage_names);
  const auto start = results.read(layout::stage_start);
  const auto end = results.read(layout::stage_end);
  if (start.values.size() != names.size() || end.values.size() != names.size())
    throw ResultsError("the stages' names, starts and ends differ in number");
  for (std::size_t i = 0; i < names.size(); ++i)
    list.push_back({{"name", names[i]}, {"start", start(i)}, {"end", end(i)}});
  return list;
}

// ------------------------------------------------------------------------------------------ scene

json points_of(const ResultsReader& results, const std::string& dataset, std::size_t columns) {
  const Array<double> values = results.read(dataset);
  json rows = json::array();
  if (values.values.empty()) return rows;
  if (values.columns() != columns)
    throw ResultsError("\"" + dataset + "\" has " + std::to_string(values.columns()) +
                       " columns; " + std::to_string(columns) + " are due");
  for (std::size_t i = 0; i < values.rows(); ++i) {
    json row = json::array();
    for (std::size_t k = 0; k < columns; ++k) row.push_back(values(i, k));
    rows.push_back(std::move(row));
  }
  return rows;
}

json scene(const ResultsReader& results) {
  if (!results.has(layout::scene_group)) return nullptr;
  json bodies = json::array();
  for (const std::string& body : children_of(results, std::string(layout::scene_bodies))) {
    const std::string group = join(layout::scene_bodies, body);
    bodies.push_back({{"name", body},
                      {"kind", attribute_or(results, group, "kind", "")},
                      {"boxes", points_of(results, join(group, "boxes"), 10)}});
  }
  json ropes = json::array();
  for (const std::string& rope : children_of(results, std::string(layout::scene_ropes))) {
    const std::string group = join(layout::scene_ropes, rope);
    ropes.push_back({{"name", rope},
                     {"kind", attribute_or(results, group, "kind", "sling")},
                     {"bodies", results.read_texts(join(group, "bodies"))},
                     {"points", points_of(results, join(group, "points"), 3)}});
  }
  json lugs = json::array();
  if (results.has(layout::scene_lug_names)) {
    const auto names = results.read_texts(layout::scene_lug_names);
    const json points = points_of(results, std::string(layout::scene_lug_points), 3);
    for (std::size_t i = 0; i < std::min(names.size(), points.size()); ++i)
      lugs.push_back({{"name", names[i]}, {"point", points[i]}});
  }
  return {{"load", attribute_or(results, layout::scene_lugs, "body", "")},
          {"bodies", std::move(bodies)},
          {"ropes", std::move(ropes)},
          {"lugs", std::move(lugs)}};
}

// -------------------------------------------------------------------------------------- structure

json fields(const ResultsReader& results, std::string_view way, std::size_t point_count) {
  json states = json::object();
  for (const std::string_view state : {layout::static_state, layout::dynamic_state})
    if (const auto field = read_surface_field(results, way, state, point_count))
      states[std::string(state)] = surface_field_json(*field);
  return states;
}

json surface(const ResultsReader& results) {
  const std::optional<BlockSurface> surface = read_block_surface(results);
  if (!surface) return nullptr;
  const std::size_t point_count = surface->point_count();
  const std::size_t shape_bytes = bytes_of_shape(*surface);
  const std::size_t pair_bytes = 2 * bytes_of_field(point_count);
  if (shape_bytes + pair_bytes > picture_budget)
    return {{"note",
             "The mesh is too fine for pictures in this page; open the .vtu files of the "
             "result folder in ParaView."}};

  json result = surface_shape_json(*surface);
  // What leads the page comes first: the envelope of the whole lift, where there is one.
  json ways = json::object();
  bool left_out = false;
  for (const std::string_view way : surface_ways) {
    json states = fields(results, way, point_count);
    if (states.empty()) continue;
    if (ways.empty() || shape_bytes + (ways.size() + 1) * pair_bytes <= picture_budget)
      ways[std::string(way)] = std::move(states);
    else
      left_out = true;
  }
  if (left_out)
    result["note"] =
        "To keep this page small it has not the pictures of all ways to take the loads; the others "
        "are in results.h5.";
  result["fields"] = std::move(ways);
  return result;
}

json padeyes(const ResultsReader& results) {
  json rows = json::array();
  if (!results.has(layout::padeyes_group)) return rows;
  for (const std::string& lug : children_of(results, std::string(layout::padeyes_group))) {
    const std::string group = join(layout::padeyes_group, lug);
    const auto plates = results.read_indices(join(group, "plate")).values;
    const auto stresses = results.read(join(group, "von_mises")).values;
    const json corners = points_of(results, join(group, "corners"), 8);
    if (plates.size() != stresses.size() || corners.size() != plates.size())
      throw ResultsError("\"" + group + "\" has lists of different lengths");
    json row{{"lug", lug},
             {"state", attribute_or(results, group, "state", "")},
             {"rope", attribute_or(results, group, "rope", "")},
             {"force", results.read(join(group, "force")).values},
             {"plate", plates},
             {"von_mises", stresses},
             {"corners", corners}};
    if (results.has_attribute(group, "time"))
      row["time"] = results.read_number_attribute(group, "time");
    rows.push_back(std::move(row));
  }
  return rows;
}

json case_of(const ResultsReader& results, const json& summary) {
  const auto take = [&](const char* name) -> std::string {
    if (results.has_attribute(layout::case_group, name))
      return results.read_text_attribute(layout::case_group, name);
    return summary.contains(name) && summary[name].is_string() ? summary[name].get<std::string>()
                                                               : "";
  };
  std::string name = take("name");
  if (name.empty()) name = summary.value("case", "");
  const std::string yaml =
      results.has(layout::case_yaml) ? results.read_text(layout::case_yaml) : "";
  return {{"name", name},
          {"title", take("title")},
          {"created", take("created")},
          {"program_version", take("program_version")},
          {"hash", summary.value("input_hash", "")},
          {"yaml", yaml}};
}

}  // namespace

nlohmann::ordered_json tension_series(const ResultsReader& results, std::string_view group) {
  json list = json::array();
  if (!results.has(join(group, "time"))) return list;
  const std::vector<double> time = results.read(join(group, "time")).values;
  for (const char* things : {"ropes", "hoists"})
    for (json& one :
         series_of_things(results, join(group, things), {{"tension", small_history_buckets}}, time))
      list.push_back(std::move(one));
  return list;
}

nlohmann::ordered_json page_series(const std::string& name, const std::string& quantity,
                                   const Meaning& meaning, const std::vector<double>& time,
                                   const std::vector<double>& values) {
  return packed_series(name, quantity, meaning, time, values, small_history_buckets);
}

nlohmann::ordered_json make_page_data(const ResultsReader& results, const json& summary) {
  const std::string still(layout::static_history);
  const std::string moving(layout::dynamic_history);
  return {
      {"summary", summary},
      {"case", case_of(results, summary)},
      {"stages", stages(results)},
      {"histories", {{"static", history(results, still)}, {"dynamic", history(results, moving)}}},
      {"motion", {{"static", motion(results, still)}, {"dynamic", motion(results, moving)}}},
      {"outputs", outputs(results)},
      {"measured", measured(results)},
      {"modes", modes(results)},
      {"scene", scene(results)},
      {"surface", surface(results)},
      {"padeyes", padeyes(results)}};
}

}  // namespace blocklift::pipeline
