#include "structure/mesh/files/abaqus/spread_loads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "structure/mesh/beams/beam_axes.h"
#include "structure/mesh/files/deck/line_loads.h"
#include "structure/mesh/files/deck/shell_geometry.h"
#include "structure/mesh/solid_shape.h"

namespace blocklift::structure {

namespace {

using LoadFields = std::vector<std::string_view>;

/// A pressure as its kind has it at places, and the direction that it has instead of the normal.
struct Traction {
  std::vector<double> pressure;  ///< Pa
  Vector3 direction = Vector3::Zero();
};

class SpreadLoadReader {
 public:
  SpreadLoadReader(const AbaqusModel& model, const AbaqusDeckElement& element,
                   const LoadFields& fields)
      : model_(model), mesh_(model.deck.mesh), element_(element), fields_(fields) {}

  /// @param sign -1: a pressure acts against the shell's normal.
  LoadSet on_shell(const std::string& kind, double sign) const {
    const Shell& shell = mesh_.shells[element_.shell];
    std::vector<Vector3> corners;
    for (const int vertex : shell.vertices) corners.push_back(model_.place(vertex));
    const Traction traction = traction_of(kind, corners, is_flat(corners) && shell.curvature < 0,
                                          unit_normal(mesh_, shell));
    PlateLoad load;
    load.shell = element_.shell;
    load.direction = traction.direction;
    const double factor = load.direction.isZero(0) ? sign : 1;
    for (std::size_t i = 0; i < 4; ++i) load.pressure[i] = factor * traction.pressure[i];
    LoadSet set;
    set.plate_loads.push_back(load);
    return set;
  }

  LoadSet on_face(const std::string& kind, const std::string& face) const {
    const Solid& solid = mesh_.solids[element_.solid];
    SolidLoad load;
    load.solid = element_.solid;
    load.face = face_of(solid, corners_of_face(element_, face));
    std::vector<Vector3> corners;
    for (const int i : topology_of(solid.shape).faces[load.face])
      corners.push_back(model_.place(solid.vertices[i]));
    const Vector3 normal = normal_of(corners);
    const Traction traction =
        traction_of(kind, corners, is_flat(corners) && has_straight_edges(solid), normal);
    load.direction = traction.direction;
    std::copy(traction.pressure.begin(), traction.pressure.end(), load.pressure.begin());
    LoadSet set;
    set.solid_loads.push_back(load);
    return set;
  }

  /// @param number of the edge, from 1; edges follow one another around the shell.
  LoadSet on_edge(const std::string& kind, char number) const {
    EdgeLoad load;
    load.shell = element_.shell;
    load.edge = edge_of(number);
    const double value = magnitude() * model_.units.force / model_.units.length;
    if (kind == "EDLD")
      load.force = value * direction();
    else
      load.own[kind == "EDSHR" ? 0 : kind == "EDNOR" ? 1 : 2] = kind == "EDTRA" ? -value : value;
    LoadSet set;
    set.edge_loads.push_back(load);
    return set;
  }

  LoadSet on_body(const Vector3& axis) const {
    const Vector3 force = magnitude() * model_.units.stress() / model_.units.length * axis;
    LoadSet set;
    if (element_.solid >= 0) set.volume_loads.push_back({element_.solid, force});
    if (element_.shell >= 0) set.plate_loads.push_back(weight_of_shell(force, axis));
    for (const int b : element_.beams) {
      const Beam& beam = mesh_.beams[b];
      BeamLoad load;
      load.beam = b;
      load.force.fill(mesh_.section_of(beam).area * force);
      load.arm = beam.offset;
      require_held(load);
      set.beam_loads.push_back(load);
    }
    return set;
  }

  LoadSet on_beams(const std::string& kind) const {
    LoadSet set;
    for (const int b : element_.beams) {
      const Beam& beam = mesh_.beams[b];
      const Eigen::Matrix3d axes =
          axes_along(model_.place(beam.vertices[1]) - model_.place(beam.vertices[0]), beam.axis_2);
      const Vector3 axis = kind == "P1" || kind == "P2" ? Vector3(axes.row(kind[1] - '0'))
                                                        : Vector3(Vector3::Unit(kind[1] - 'X'));
      BeamLoad load;
      load.beam = b;
      load.force.fill(magnitude() * model_.units.force / model_.units.length * axis);
      require_held(load);
      set.beam_loads.push_back(load);
    }
    return set;
  }

 private:
  void require_held(const BeamLoad& load) const {
    if (acts_on_released_ends(mesh_, load))
      throw CardError{fmt::format(
          "a load {} acts along what *RELEASE leaves free of element {}, which is not known",
          fields_[1], element_.label)};
  }

  double magnitude() const { return abaqus_real(fields_, 2, "magnitude"); }

  Vector3 direction() const {
    const Vector3 given(abaqus_real(fields_, 3, "direction", 0.0),
                        abaqus_real(fields_, 4, "direction", 0.0),
                        abaqus_real(fields_, 5, "direction", 0.0));
    if (!(given.norm() > 0)) throw CardError{fmt::format("{} has no direction", fields_[1])};
    return given.normalized();
  }

  /// The place of an edge among those of the shell, which may have lost one where nodes fall
  /// together.
  int edge_of(char number) const {
    const std::size_t count = element_.nodes.size() == 3 || element_.nodes.size() == 6 ? 3 : 4;
    const auto i = static_cast<std::size_t>(number - '1');
    if (i >= count)
      throw CardError{fmt::format("edge {} of element {} is not known; 1 to {} are", number,
                                  element_.label, count)};
    const Shell& shell = mesh_.shells[element_.shell];
    const auto& v = shell.vertices;
    const std::vector<int> around =
        shell.is_triangle() ? std::vector{v[0], v[1], v[2]} : std::vector{v[0], v[1], v[3], v[2]};
    const int from = element_.nodes[i], to = element_.nodes[(i + 1) % count];
    for (std::size_t e = 0; e < around.size(); ++e)
      if (around[e] == from && around[(e + 1) % around.size()] == to) return static_cast<int>(e);
    throw CardError{fmt::format("edge {} of element {} is a point", number, element_.label)};
  }

  Traction traction_of(const std::string& kind, const std::vector<Vector3>& corners, bool is_flat,
                       const Vector3& normal) const {
    const double stress = magnitude() * model_.units.stress();
    if (kind == "HP") return {hydrostatic(corners, stress)};
    Traction traction{std::vector<double>(corners.size(), stress)};
    if (kind == "P") return traction;
    traction.direction = direction();
    if (kind == "TRVEC") return traction;
    if (!is_flat)
      throw CardError{
          fmt::format("TRSHR on element {}, whose face is not flat, is not known; TRVEC "
                      "is",
                      element_.label)};
    traction.direction -= normal * normal.dot(traction.direction);
    if (!(traction.direction.norm() > 1e-6))
      throw CardError{
          fmt::format("TRSHR has no direction along the face of element {}", element_.label)};
    traction.direction.normalize();
    return traction;
  }

  // magnitude, z of the level without pressure, z of the level at which it is the magnitude
  std::vector<double> hydrostatic(const std::vector<Vector3>& corners, double stress) const {
    constexpr double rounding = 1e-6;
    const double surface = abaqus_real(fields_, 3, "z of no pressure"),
                 depth = abaqus_real(fields_, 4, "z of the pressure") - surface;
    if (depth == 0) throw CardError{"HP has no pressure and its magnitude at the same level"};
    std::vector<double> pressure;
    for (const Vector3& corner : corners) {
      const double share = (corner.z() / model_.units.length - surface) / depth;
      if (share < -rounding)
        throw CardError{fmt::format(
            "element {} reaches beyond the level at which HP is zero; what acts there is not "
            "known: end the elements that have it there",
            element_.label)};
      pressure.push_back(stress * std::max(share, 0.0));
    }
    return pressure;
  }

  PlateLoad weight_of_shell(const Vector3& force, const Vector3& axis) const {
    const Shell& shell = mesh_.shells[element_.shell];
    if (mesh_.section_of(shell).offset != 0)
      throw CardError{fmt::format("{} on element {}, whose middle lies off its nodes, is not known",
                                  fields_[1], element_.label)};
    PlateLoad load;
    load.shell = element_.shell;
    load.direction = axis;
    for (int i = 0; i < 4; ++i)
      load.pressure[i] =
          force.dot(axis) * thickness_at(mesh_, shell, Eigen::Vector2d(i % 2, i / 2));
    return load;
  }

  bool has_straight_edges(const Solid& solid) const {
    constexpr double rounding = 1e-6;
    const SolidTopology& topology = topology_of(solid.shape);
    for (std::size_t e = 0; e < topology.edges.size(); ++e) {
      const std::size_t node = static_cast<std::size_t>(topology.corners) + e;
      if (node >= solid.vertices.size() || solid.vertices[node] < 0) continue;
      const Vector3 &a = model_.place(solid.vertices[topology.edges[e][0]]),
                    &b = model_.place(solid.vertices[topology.edges[e][1]]);
      if ((model_.place(solid.vertices[node]) - (a + b) / 2).norm() > rounding * (b - a).norm())
        return false;
    }
    return true;
  }

  static Vector3 normal_of(const std::vector<Vector3>& around) {
    Vector3 area = Vector3::Zero();
    for (std::size_t i = 1; i + 1 < around.size(); ++i)
      area += (around[i] - around[0]).cross(around[i + 1] - around[0]);
    return area.normalized();
  }

  /// Do four places, in any order, lie in a plane?
  static bool is_flat(const std::vector<Vector3>& places) {
    constexpr double rounding = 1e-4;
    if (places.size() < 4) return true;
    const Vector3 a = places[1] - places[0], b = places[2] - places[0], c = places[3] - places[0];
    const double size = std::max({a.norm(), b.norm(), c.norm()});
    return std::abs(a.cross(b).dot(c)) < rounding * size * size * size;
  }

  const AbaqusModel& model_;
  const Mesh& mesh_;
  const AbaqusDeckElement& element_;
  const LoadFields& fields_;
};

bool is_traction(const std::string& kind) {
  return kind == "P" || kind == "HP" || kind == "TRVEC" || kind == "TRSHR";
}

bool is_edge_load(const std::string& kind) {
  return kind == "EDNOR" || kind == "EDSHR" || kind == "EDTRA" || kind == "EDLD";
}

/// A kind of *DLOAD without the number of a face or edge, and that number; 0: none.
std::pair<std::string, char> without_number(const std::string& kind) {
  const bool has_number = kind.size() > 1 && kind.back() >= '1' && kind.back() <= '9';
  return has_number ? std::pair{kind.substr(0, kind.size() - 1), kind.back()}
                    : std::pair{kind, '\0'};
}

}  // namespace

std::optional<LoadSet> abaqus_element_load(const AbaqusModel& model,
                                           const AbaqusDeckElement& element,
                                           const std::string& kind, const LoadFields& fields) {
  const SpreadLoadReader reader(model, element, fields);
  const auto [stem, number] = without_number(kind);
  const bool is_body = kind.size() == 2 && kind[0] == 'B' && kind[1] >= 'X' && kind[1] <= 'Z';
  const bool has_body = element.solid >= 0 || element.shell >= 0 || !element.beams.empty();
  if (is_body && has_body) return reader.on_body(Vector3::Unit(kind[1] - 'X'));
  if (element.kind == AbaqusKind::solid) {
    if (element.solid < 0 || number == 0 || !is_traction(stem)) return std::nullopt;
    return reader.on_face(stem, std::string{'S', number});
  }
  if (element.shell >= 0) {
    if (is_traction(kind)) return reader.on_shell(kind, 1);
    if (is_edge_load(stem) && number != 0) return reader.on_edge(stem, number);
    return std::nullopt;
  }
  const bool is_along = kind == "PX" || kind == "PY" || kind == "PZ";
  const bool is_own = kind == "P1" || kind == "P2";
  if (element.beams.empty() || !(is_along || (is_own && element.kind == AbaqusKind::beam)))
    return std::nullopt;
  return reader.on_beams(kind);
}

LoadSet abaqus_surface_load(const AbaqusModel& model, const AbaqusDeckElement& element,
                            const std::string& face, const std::string& kind,
                            const LoadFields& fields) {
  const SpreadLoadReader reader(model, element, fields);
  if (!is_traction(kind) && !is_edge_load(kind))
    throw CardError{fmt::format("a load {} is not known; {} are", kind, known_surface_loads)};
  if (element.kind == AbaqusKind::solid && is_traction(kind)) return reader.on_face(kind, face);
  if (element.shell >= 0 && is_traction(kind) && (face == "SPOS" || face == "SNEG"))
    return reader.on_shell(kind, face == "SPOS" ? -1 : 1);
  if (element.shell >= 0 && is_edge_load(kind) && face.size() == 2 && face[0] == 'E')
    return reader.on_edge(kind, face[1]);
  throw CardError{fmt::format(
      "a load {} on face {} of element {} is not known; pressures and tractions on SPOS and SNEG "
      "of shells and S1 ... of solids, and edge loads on E1 ... of shells are",
      kind, face, element.label)};
}

}  // namespace blocklift::structure
