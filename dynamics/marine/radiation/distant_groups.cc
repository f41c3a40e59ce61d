#include "dynamics/marine/radiation/distant_groups.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <tuple>
#include <utility>

#include "dynamics/marine/panels/coupling_reach.h"
#include "dynamics/marine/panels/panel_shapes.h"

namespace blocklift::dynamics {
namespace {

/// The circle about the middle of the bodies' extent that holds them: symmetric bodies keep their
/// planes of symmetry in it.
BodyGroup make_group(const PanelModel& model, std::vector<int> bodies) {
  BodyGroup group{std::move(bodies)};
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d high = -low;
  std::vector<PanelMesh> hulls;
  for (const int body : group.bodies) {
    hulls.push_back(expand_symmetry(model.bodies()[body].hull));
    for (const Panel& panel : hulls.back().panels) {
      for (const Vector3& vertex : panel.vertices) {
        low = low.cwiseMin(vertex.head<2>());
        high = high.cwiseMax(vertex.head<2>());
      }
    }
  }
  group.centre = 0.5 * (low + high);
  for (const PanelMesh& hull : hulls) {
    for (const Panel& panel : hull.panels) {
      for (const Vector3& vertex : panel.vertices)
        group.radius = std::max(group.radius, (vertex.head<2>() - group.centre).norm());
    }
  }
  return group;
}

std::vector<BodyGroup> make_groups(const PanelModel& model, const std::vector<int>& label) {
  std::vector<BodyGroup> groups;
  for (int first = 0; first < model.body_count(); ++first) {
    std::vector<int> bodies;
    for (int body = 0; body < model.body_count(); ++body) {
      if (label[body] == first) bodies.push_back(body);
    }
    if (!bodies.empty()) groups.push_back(make_group(model, std::move(bodies)));
  }
  return groups;
}

/// Bodies a and b, and all that go with them, under the lesser label.
void join(std::vector<int>& label, int a, int b) {
  const int la = label[a], lb = label[b];
  std::replace(label.begin(), label.end(), std::max(la, lb), std::min(la, lb));
}

/// Two groups whose circles meet; none: the same index twice.
std::pair<std::size_t, std::size_t> find_overlap(const std::vector<BodyGroup>& groups) {
  for (std::size_t a = 0; a < groups.size(); ++a) {
    for (std::size_t b = a + 1; b < groups.size(); ++b) {
      if ((groups[a].centre - groups[b].centre).norm() <= groups[a].radius + groups[b].radius)
        return {a, b};
    }
  }
  return {0, 0};
}

/// A group about the origin, on a surface of its own.
PanelModel make_group_model(const PanelModel& model, const BodyGroup& group,
                            const DatabaseSettings& settings) {
  const Vector3 back(-group.centre.x(), -group.centre.y(), 0.0);
  std::vector<WettedBody> bodies;
  for (const int index : group.bodies) {
    const WettedBody& body = model.bodies()[index];
    bodies.push_back(
        {body.name, translate(expand_symmetry(body.hull), back), body.reference_point + back});
  }
  const std::vector<WaterLine> lines = find_water_lines(bodies);
  const auto length = [&](double frequency) {
    return 2.0 * std::numbers::pi / calc_wave_number(frequency, model.water());
  };
  const SurfaceMesh surface =
      make_surface_mesh(lines, surface_settings(lines, length(settings.frequencies.back()),
                                                length(settings.frequencies.front())));
  const Symmetry symmetry = keep_symmetry(find_symmetry(bodies), settings.lids);
  return {std::move(bodies), surface, model.water(), symmetry};
}

/// With the waves of all directions that the coupling needs, seen from the group's centre.
DatabaseSettings settings_of(const BodyGroup& group, DatabaseSettings settings,
                             const Water& water) {
  settings.with_far_field = true;
  const int count =
      direction_count(group.radius, calc_wave_number(settings.frequencies.back(), water));
  settings.headings.clear();
  for (int j = 0; j < count; ++j) settings.headings.push_back(2.0 * std::numbers::pi * j / count);
  for (DampingLid& lid : settings.lids) {
    lid.low -= group.centre;
    lid.high -= group.centre;
  }
  return settings;
}

void add_to(DatabaseReport& sum, const DatabaseReport& one) {
  sum.body_panels += one.body_panels;
  sum.surface_panels += one.surface_panels;
  sum.parts += one.parts;
  sum.steps += one.steps;
  sum.peak_bytes = std::max(sum.peak_bytes, one.peak_bytes);
  sum.step_limit =
      std::isnan(sum.step_limit) ? one.step_limit : std::min(sum.step_limit, one.step_limit);
  sum.solution.influence_s += one.solution.influence_s;
  sum.solution.factorisation_s += one.solution.factorisation_s;
  sum.solution.reduction_s += one.solution.reduction_s;
  sum.march_s += one.march_s;
  sum.excitation_s += one.excitation_s;
  sum.reciprocity_error = std::max(sum.reciprocity_error, one.reciprocity_error);
  sum.asymmetry = std::max(sum.asymmetry, one.asymmetry);
}

}  // namespace

std::vector<BodyGroup> find_distant_groups(const PanelModel& model, double highest_frequency) {
  const double shortest =
      2.0 * std::numbers::pi / calc_wave_number(highest_frequency, model.water());
  std::vector<int> label(static_cast<std::size_t>(model.body_count()));
  std::iota(label.begin(), label.end(), 0);
  std::vector<std::vector<bool>> far(label.size(), std::vector<bool>(label.size(), false));
  for (const CouplingReach& reach : find_coupling_reaches(model)) {
    if (reach.shortest <= shortest) continue;
    const auto a = static_cast<std::size_t>(reach.first),
               b = static_cast<std::size_t>(reach.second);
    far[a][b] = far[b][a] = true;
  }
  for (int b = 1; b < model.body_count(); ++b) {
    for (int a = 0; a < b; ++a) {
      if (!far[a][b]) join(label, a, b);
    }
  }
  std::vector<BodyGroup> groups = make_groups(model, label);
  for (auto [a, b] = find_overlap(groups); a != b; std::tie(a, b) = find_overlap(groups)) {
    join(label, groups[a].bodies[0], groups[b].bodies[0]);
    groups = make_groups(model, label);
  }
  return groups;
}

HydrodynamicDatabase compute_distant_groups(const PanelModel& model,
                                            const std::vector<BodyGroup>& groups,
                                            const DatabaseSettings& settings,
                                            DatabaseReport* report) {
  if (groups.size() < 2) return compute_database(model, settings, report);
  std::vector<HydrodynamicDatabase> databases;
  DatabaseReport account;
  for (const BodyGroup& group : groups) {
    DatabaseSettings own = settings_of(group, settings, model.water());
    if (settings.progress) {
      const auto done = static_cast<double>(databases.size());
      own.progress = [&settings, &groups, done](double fraction, const char* what) {
        settings.progress((done + fraction) / static_cast<double>(groups.size()), what);
      };
    }
    const PanelModel alone = make_group_model(model, group, own);
    DatabaseReport one;
    databases.push_back(compute_database(alone, own, &one));
    add_to(account, one);
  }
  if (report != nullptr) *report = account;
  return couple_by_waves(groups, std::move(databases), settings.headings);
}

}  // namespace blocklift::dynamics
