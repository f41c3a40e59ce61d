#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include <Eigen/Geometry>

#include "pipeline/declaration/geometry_format.h"
#include "pipeline/formats/results/results_layout.h"
#include "pipeline/measurement/record.h"

namespace blocklift::pipeline {
namespace {

constexpr const char* pose_names[] = {"x", "y", "z", "roll", "pitch", "yaw"};

/// Quantities of the results' groups with the endings of their names.
struct ChannelKind {
  const char* group;
  const char* dataset;  ///< below the thing; empty: the thing is the dataset
  const char* ending;
};
constexpr ChannelKind channel_kinds[] = {
    {"ropes", "tension", ""},      {"hoists", "tension", ""},  {"hoists", "length", ".length"},
    {"hoists", "swing", ".swing"}, {"drives", "position", ""}, {"drives", "force", ".force"},
    {"measures", "", ""},
};

std::string dataset_of(std::string_view history, const ChannelKind& kind,
                       const std::string& thing) {
  const std::string group = layout::join(history, std::string(kind.group), thing);
  return *kind.dataset == '\0' ? group : layout::join(group, std::string(kind.dataset));
}

std::vector<std::string> things_in(const ResultsReader& results, const std::string& group) {
  const std::string path = layout::join(layout::dynamic_history, group);
  return results.has(path) ? results.children(path) : std::vector<std::string>{};
}

std::string name_of_channel(const ChannelKind& kind, const std::string& thing) {
  return std::string(kind.group) + '.' + thing + kind.ending;
}

/// Samples that are numbers.
TimeSeries finite_samples(const std::vector<double>& time, const std::vector<double>& values) {
  TimeSeries series;
  for (std::size_t i = 0; i < std::min(time.size(), values.size()); ++i) {
    // Two samples of one instant are the two sides of a jump: the later one goes on.
    if (!std::isfinite(values[i])) continue;
    if (!series.time.empty() && !(time[i] > series.time.back())) {
      series.values.back() = values[i];
      continue;
    }
    series.time.push_back(time[i]);
    series.values.push_back(values[i]);
  }
  return series;
}

TimeSeries read_series(const ResultsReader& results, std::string_view history,
                       const std::string& dataset) {
  if (!results.has(dataset)) return {};
  return finite_samples(results.read(layout::join(history, std::string("time"))).values,
                        results.read(dataset).values);
}

TimeSeries read_pose_series(const ResultsReader& results, std::string_view history,
                            const std::string& body, std::size_t component) {
  const std::string dataset =
      layout::join(history, std::string("bodies"), body, std::string("pose"));
  if (!results.has(dataset)) return {};
  const Array<double> pose = results.read(dataset);
  std::vector<double> values;
  for (std::size_t i = 0; i < pose.rows(); ++i) {
    if (component < 3) {
      values.push_back(pose(i, component));
      continue;
    }
    const Eigen::Quaterniond turn(pose(i, 3), pose(i, 4), pose(i, 5), pose(i, 6));
    values.push_back(roll_pitch_yaw_of(turn.normalized().toRotationMatrix())[component - 3]);
  }
  // An angle goes on where it would jump by a turn.
  if (component >= 3)
    for (std::size_t i = 1; i < values.size(); ++i)
      values[i] = values[i - 1] + std::remainder(values[i] - values[i - 1], 2 * std::numbers::pi);
  return finite_samples(results.read(layout::join(history, std::string("time"))).values, values);
}

}  // namespace

std::vector<std::string> names_of_channels(const ResultsReader& results) {
  std::vector<std::string> names;
  for (const ChannelKind& kind : channel_kinds)
    for (const std::string& thing : things_in(results, kind.group))
      if (results.has(dataset_of(layout::dynamic_history, kind, thing)))
        names.push_back(name_of_channel(kind, thing));
  for (const std::string& body : things_in(results, "bodies"))
    for (const char* component : pose_names) {
      std::string name = "bodies.";
      name += body;
      name += '.';
      name += component;
      names.push_back(std::move(name));
    }
  return names;
}

ComputedChannel read_computed_channel(const ResultsReader& results, const std::string& name) {
  ComputedChannel channel;
  channel.name = name;
  for (const ChannelKind& kind : channel_kinds)
    for (const std::string& thing : things_in(results, kind.group)) {
      const std::string dataset = dataset_of(layout::dynamic_history, kind, thing);
      if (name_of_channel(kind, thing) != name || !results.has(dataset)) continue;
      channel.unit = results.read_meaning(dataset).units;
      channel.in_motion = read_series(results, layout::dynamic_history, dataset);
      channel.at_rest = read_series(results, layout::static_history,
                                    dataset_of(layout::static_history, kind, thing));
      return channel;
    }
  for (const std::string& body : things_in(results, "bodies"))
    for (std::size_t component = 0; component < std::size(pose_names); ++component) {
      if (name != "bodies." + body + '.' + pose_names[component]) continue;
      channel.unit = component < 3 ? "m" : "rad";
      channel.in_motion = read_pose_series(results, layout::dynamic_history, body, component);
      channel.at_rest = read_pose_series(results, layout::static_history, body, component);
      return channel;
    }
  throw ResultsError("the results hold no \"" + name + '"');
}

}  // namespace blocklift::pipeline
