#include "dynamics/marine/panels/panel_model.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "dynamics/errors.h"
#include "dynamics/marine/hull/point_text.h"
#include "dynamics/marine/panels/hull_intersection.h"

namespace blocklift::dynamics {
namespace {

/// Is each panel the image of another under a reflection?
bool is_symmetric(const std::vector<Panel>& panels, const Symmetry& reflection) {
  std::vector<std::size_t> order(panels.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  // Ordered by depth, which a reflection keeps, only the panels of one depth need be compared.
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return panels[a].centroid.z() < panels[b].centroid.z();
  });
  for (const Panel& panel : panels) {
    const Vector3 image = reflection.reflect(1, panel.centroid);
    const double tolerance = 1e-6 * panel.diameter();
    auto it = std::lower_bound(order.begin(), order.end(), image.z() - tolerance,
                               [&](std::size_t k, double z) { return panels[k].centroid.z() < z; });
    bool found = false;
    for (; it != order.end() && panels[*it].centroid.z() <= image.z() + tolerance; ++it) {
      found = (panels[*it].centroid - image).norm() < tolerance &&
              std::abs(panels[*it].area - panel.area) < 1e-6 * panel.area;
      if (found) break;
    }
    if (!found) return false;
  }
  return true;
}

bool crosses(const Panel& panel, int axis) {
  const double tolerance = 1e-6 * panel.diameter();
  double lowest = 0.0, highest = 0.0;
  for (const Vector3& vertex : panel.vertices) {
    lowest = std::min(lowest, vertex[axis]);
    highest = std::max(highest, vertex[axis]);
  }
  return lowest < -tolerance && highest > tolerance;
}

std::vector<Panel> all_panels(const std::vector<WettedBody>& bodies) {
  std::vector<Panel> panels;
  for (const WettedBody& body : bodies) {
    const PanelMesh whole = expand_symmetry(body.hull);
    panels.insert(panels.end(), whole.panels.begin(), whole.panels.end());
  }
  return panels;
}

/// Area-weighted mean of the panels' centroids, m.
Vector3 middle(const PanelMesh& mesh) {
  Vector3 sum = Vector3::Zero();
  for (const Panel& panel : mesh.panels) sum += panel.area * panel.centroid;
  return sum / mesh.total_area();
}

/// @throws ModelError if two of the bodies cut each other, or one holds another.
void require_apart(const std::vector<WettedBody>& bodies) {
  std::vector<Triangles> surfaces;
  for (const WettedBody& body : bodies) surfaces.push_back(triangles_of(body.hull));
  for (std::size_t a = 0; a < bodies.size(); ++a) {
    for (std::size_t b = a + 1; b < bodies.size(); ++b) {
      const std::optional<Vector3> place = find_intersection(surfaces[a], surfaces[b]);
      if (!place) continue;
      throw ModelError("bodies " + bodies[a].name + " and " + bodies[b].name +
                       " intersect under water, at " + text_of_point(*place) + ": move them apart");
    }
  }
}

Eigen::VectorXd areas_of(const PanelMesh& mesh) {
  Eigen::VectorXd areas(mesh.size());
  for (int k = 0; k < mesh.size(); ++k) areas[k] = mesh.panels[k].area;
  return areas;
}

}  // namespace

PanelModel::PanelModel(std::vector<WettedBody> bodies, const SurfaceMesh& surface,
                       const Water& water, const Symmetry& symmetry)
    : bodies_(std::move(bodies)), water_(water), symmetry_(symmetry), surface_(surface) {
  if (bodies_.empty()) throw ModelError("a hydrodynamic problem needs at least one body");
  if (!(water.density > 0.0) || !(water.gravity > 0.0) || !(water.depth > 0.0)) {
    throw ModelError("density, gravity and depth of the water must be positive");
  }
  for (WettedBody& body : bodies_) {
    body.hull = expand_symmetry(body.hull);
    check(body);
  }
  require_apart(bodies_);
  const Symmetry have = find_symmetry(bodies_);
  if ((symmetry.x && !have.x) || (symmetry.y && !have.y)) {
    throw ModelError(
        std::string("the bodies together are not symmetric in the plane ") +
        (symmetry.x && !have.x ? "x" : "y") +
        " = 0, panel by panel: do without that symmetry, or mesh one half and mirror it");
  }
  body_mesh_.symmetry = symmetry;
  for (int b = 0; b < body_count(); ++b) {
    for (const Panel& panel : bodies_[b].hull.panels) {
      if ((symmetry.x && panel.centroid.x() < 0.0) || (symmetry.y && panel.centroid.y() < 0.0)) {
        continue;
      }
      body_mesh_.panels.push_back(panel);
      body_of_panel_.push_back(b);
    }
  }
  if (surface_.mesh.symmetry != symmetry) {
    surface_.mesh = restrict_to_symmetry(expand_symmetry(surface_.mesh), symmetry);
  }
  body_areas_ = areas_of(body_mesh_);
  surface_areas_ = areas_of(surface_.mesh);
  find_images();
}

void PanelModel::check(const WettedBody& body) const {
  const double size = std::sqrt(body.hull.total_area());
  if (body.hull.panels.empty())
    throw ModelError("body " + body.name + " has no panel in the water");
  Vector3 vector_area = Vector3::Zero();
  bool stands_on_bottom = false;
  for (const Panel& panel : body.hull.panels) {
    vector_area += panel.area * panel.normal;
    for (const Vector3& vertex : panel.vertices) {
      if (vertex.z() > 1e-6 * size) {
        throw ModelError("body " + body.name + " has a panel above the water at " +
                         text_of_point(vertex) + ": cut the hull at z = 0 first");
      }
      if (vertex.z() < -water_.depth + 1e-6 * size) stands_on_bottom = true;
      if (vertex.z() < -water_.depth - 1e-6 * size) {
        throw ModelError("body " + body.name + " reaches below the bottom at " +
                         text_of_point(vertex) + ": the water is " + std::to_string(water_.depth) +
                         " m deep");
      }
    }
  }
  if (body.hull.displaced_volume() < 0.0) {
    throw ModelError("body " + body.name + " keeps out a volume of " +
                     std::to_string(body.hull.displaced_volume()) +
                     " m3: its panels' normals point into the body; reverse their vertices");
  }
  // The normals of a closed surface sum up to zero; what is open lies in z = 0 or on the bottom.
  double level_gap = 0.0;
  if (!stands_on_bottom) {
    level_gap = vector_area.z();
    for (const WaterLine& line : find_water_lines(std::vector<WettedBody>{body})) {
      level_gap += enclosed_area(line);
    }
  }
  const Vector3 gap(vector_area.x(), vector_area.y(), level_gap);
  if (gap.norm() > 1e-5 * body.hull.total_area()) {
    std::ostringstream message;
    message << "body " << body.name << " is open: its panels' areas times normals and its water "
            << "plane sum up to (" << gap.transpose()
            << ") m2 instead of zero; a panel is missing, doubled or reversed";
    throw ModelError(message.str());
  }
}

void PanelModel::find_images() {
  for (int image = 0; image < symmetry_.image_count(); ++image) {
    std::vector<int> images;
    for (const WettedBody& body : bodies_) {
      const Vector3 target = symmetry_.reflect(image, middle(body.hull));
      int nearest = 0;
      double best = std::numeric_limits<double>::infinity();
      for (int b = 0; b < body_count(); ++b) {
        const double distance = (middle(bodies_[b].hull) - target).norm();
        if (distance < best) {
          best = distance;
          nearest = b;
        }
      }
      images.push_back(nearest);
    }
    image_body_.push_back(std::move(images));
  }
}

std::vector<Parity> PanelModel::parities() const {
  std::vector<Parity> result;
  for (const int x : {1, -1}) {
    if (x < 0 && !symmetry_.x) continue;
    for (const int y : {1, -1}) {
      if (y < 0 && !symmetry_.y) continue;
      result.push_back({x, y});
    }
  }
  return result;
}

int PanelModel::sign(const Parity& parity, int image) const {
  const Vector3 reflected = symmetry_.reflect(image, {1, 1, 1});
  return (reflected.x() < 0 ? parity.x : 1) * (reflected.y() < 0 ? parity.y : 1);
}

Eigen::MatrixXd PanelModel::normal_velocities(const Parity& parity) const {
  const int images = symmetry_.image_count();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(body_mesh_.size(), mode_count());
  for (int k = 0; k < body_mesh_.size(); ++k) {
    const Panel& panel = body_mesh_.panels[k];
    const int own = body_of_panel_[k];
    for (int g = 0; g < images; ++g) {
      const int body = image_body_[g][own];
      const Vector3 n = symmetry_.reflect(g, panel.normal);
      const Vector3 arm = symmetry_.reflect(g, panel.centroid) - bodies_[body].reference_point;
      Eigen::Matrix<double, 1, modes_per_body> row;
      row << n.transpose(), arm.cross(n).transpose();
      result.block<1, modes_per_body>(k, modes_per_body * body) +=
          static_cast<double>(sign(parity, g)) / images * row;
    }
  }
  // What is left of a mode without this part is rounding.
  for (Eigen::Index m = 0; m < result.cols(); ++m) {
    const double size = m % modes_per_body < 3 ? 1.0 : body_mesh_.panels[0].diameter();
    if (result.col(m).cwiseAbs().maxCoeff() < 1e-9 * size) result.col(m).setZero();
  }
  return result;
}

Symmetry find_symmetry(const std::vector<WettedBody>& bodies) {
  const std::vector<Panel> panels = all_panels(bodies);
  Symmetry result;
  for (int axis = 0; axis < 2; ++axis) {
    const Symmetry plane{axis == 0, axis == 1};
    const bool cut = std::any_of(panels.begin(), panels.end(),
                                 [&](const Panel& panel) { return crosses(panel, axis); });
    if (!cut && is_symmetric(panels, plane)) (axis == 0 ? result.x : result.y) = true;
  }
  return result;
}

std::vector<WaterLine> find_water_lines(const std::vector<WettedBody>& bodies) {
  std::vector<WaterLine> lines;
  for (const WettedBody& body : bodies) {
    try {
      for (WaterLine& line : find_water_lines(body.hull)) lines.push_back(std::move(line));
    } catch (const ModelError& error) {
      throw ModelError("body " + body.name + ": " + error.what());
    }
  }
  return lines;
}

}  // namespace blocklift::dynamics
