#include "models/blocks/double-bottom-300t/generator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <unordered_map>
#include <vector>

#include <Eigen/Dense>

#include "structure/mesh/beams/sections.h"
#include "structure/mesh/files/deck/shell_geometry.h"

namespace blocklift::models {

namespace {

using structure::Beam;
using structure::Deck;
using structure::Mesh;
using structure::Profile;
using structure::Shell;
using structure::Vector3;

constexpr double hole_radius = 0.3;  ///< of manholes, m

/// Group of plates or stiffeners with a section of its own.
struct Member {
  int region = 0;
  int section = 0;
  Profile profile;  ///< of stiffeners
};

class DoubleBottom {
 public:
  explicit DoubleBottom(const DoubleBottomMeasures& measures)
      : m_(measures), n_(measures.cells_per_spacing), step_(measures.spacing / n_) {}

  Deck make() {
    deck_.units = structure::unit_system("mm-t-N");
    deck_.title = "Double bottom with bilge and side, half breadth";
    mesh_.materials.push_back({.name = "AH36",
                               .youngs_modulus = 206e9,
                               .poisson_ratio = 0.3,
                               .density = 7850,
                               .yield_stress = 355e6});
    make_members();
    make_long_plates();
    make_transverse_plates();
    make_longitudinals();
    make_upright_bars();
    make_pumps();
    number();
    structure::LoadSet gravity;
    gravity.label = 1;
    gravity.gravity = Vector3(0, 0, -9.81);
    deck_.load_sets.push_back(gravity);
    deck_.load_cases.push_back({1, "at rest", {{0, 1.0}}, {}});
    return std::move(deck_);
  }

 private:
  /// A strip of plating: places along x at a cell's number, of a line's point.
  using Line = std::vector<Vector3>;

  double height() const { return 2 * m_.spacing; }  ///< of the double bottom
  double radius() const { return 2 * m_.spacing; }  ///< of the bilge
  double flat() const { return m_.bays_across * m_.spacing; }
  double breadth() const { return flat() + radius(); }
  int cells_along() const { return m_.bays * n_; }
  double x_of(int cell) const { return cell * step_; }

  Member plate(const std::string& name, double thickness) {
    Member member;
    member.section = static_cast<int>(mesh_.shell_sections.size());
    structure::ShellSection section;
    section.thickness = thickness;
    section.label = ++properties_;
    mesh_.shell_sections.push_back(section);
    member.region = region(name);
    return member;
  }

  Member stiffener(const std::string& name, const Profile& profile) {
    Member member;
    member.profile = profile;
    member.section = static_cast<int>(mesh_.beam_sections.size());
    mesh_.beam_sections.push_back(profile.section);
    mesh_.beam_sections.back().name = name;
    mesh_.beam_sections.back().label = ++properties_;
    member.region = region(name);
    return member;
  }

  int region(const std::string& name) {
    mesh_.groups.push_back({name, 0});
    mesh_.regions.push_back({.name = name, .group = static_cast<int>(mesh_.groups.size()) - 1});
    return static_cast<int>(mesh_.regions.size()) - 1;
  }

  void make_members() {
    bottom_ = plate("bottom", 0.016);
    bilge_ = plate("bilge", 0.016);
    side_ = plate("side", 0.014);
    inner_bottom_ = plate("inner bottom", 0.015);
    floors_ = plate("floors", 0.012);
    girders_ = plate("girders", 0.014);
    frames_ = plate("web frames", 0.012);
    brackets_ = plate("brackets", 0.014);
    stringer_ = plate("stringer", 0.012);
    bottom_bulbs_ = stiffener("bottom longitudinals", structure::bulb_flat(0.28, 0.011));
    inner_bulbs_ = stiffener("inner bottom longitudinals", structure::bulb_flat(0.26, 0.011));
    side_bulbs_ = stiffener("side longitudinals", structure::bulb_flat(0.24, 0.010));
    floor_bars_ = stiffener("floor stiffeners", structure::flat_bar(0.15, 0.012));
    girder_bars_ = stiffener("girder stiffeners", structure::flat_bar(0.15, 0.012));
    face_plates_ = stiffener("face plates", structure::solid_rectangle(0.015, 0.15));
  }

  /// Vertices at one place are one.
  int vertex(const Vector3& place) {
    const auto whole = [](double value) {
      return static_cast<std::int64_t>(std::llround(value * 1e6));
    };
    const std::array<std::int64_t, 3> key{whole(place[0]), whole(place[1]), whole(place[2])};
    const auto [found, is_new] =
        vertex_at_.try_emplace(key, static_cast<int>(mesh_.vertices.size()));
    if (is_new) mesh_.vertices.push_back(place);
    return found->second;
  }

  void shell(const Member& member, const std::vector<Vector3>& around) {
    std::vector<int> vertices;
    for (const Vector3& place : around) {
      const int v = vertex(place);
      if (vertices.empty() || (vertices.back() != v && vertices.front() != v))
        vertices.push_back(v);
    }
    Shell one;
    one.vertices = structure::lexicographic(vertices);
    one.section = member.section;
    one.region = member.region;
    mesh_.shells.push_back(one);
  }

  void beam(const Member& member, const Vector3& from, const Vector3& to, const Vector3& axis_2,
            double foot) {
    Beam one;
    one.vertices = {vertex(from), vertex(to)};
    one.section = member.section;
    one.region = member.region;
    one.axis_2 = axis_2;
    const Vector3 axis_3 = (to - from).normalized().cross(axis_2);
    const Vector3 offset =
        (foot + member.profile.centroid[0]) * axis_2 + member.profile.centroid[1] * axis_3;
    one.offset = {offset, offset};
    mesh_.beams.push_back(one);
  }

  static Line straight(const Vector3& from, const Vector3& to, int cells) {
    Line line;
    for (int i = 0; i <= cells; ++i)
      line.push_back(from + (to - from) * (static_cast<double>(i) / cells));
    return line;
  }

  int bilge_cells() const {
    return static_cast<int>(std::ceil(std::numbers::pi / 2 * radius() / step_));
  }
  Vector3 on_bilge(double share, double of_radius) const {
    const double angle = share * std::numbers::pi / 2;
    return {0, flat() + of_radius * std::sin(angle), height() - of_radius * std::cos(angle)};
  }

  /// Plating along x over a line of places at x = 0.
  void along(const Member& member, const Line& line) {
    for (int i = 0; i < cells_along(); ++i)
      for (std::size_t j = 0; j + 1 < line.size(); ++j)
        shell(member, {shifted(line[j], x_of(i)), shifted(line[j], x_of(i + 1)),
                       shifted(line[j + 1], x_of(i + 1)), shifted(line[j + 1], x_of(i))});
  }

  static Vector3 shifted(const Vector3& place, double x) { return place + Vector3(x, 0, 0); }

  void make_long_plates() {
    along(bottom_, straight({0, 0, 0}, {0, flat(), 0}, m_.bays_across * n_));
    Line bilge;
    for (int i = 0; i <= bilge_cells(); ++i)
      bilge.push_back(on_bilge(static_cast<double>(i) / bilge_cells(), radius()));
    along(bilge_, bilge);
    const double top = height() + m_.bays_up * m_.spacing;
    along(side_, straight({0, breadth(), height()}, {0, breadth(), top}, m_.bays_up * n_));
    along(inner_bottom_,
          straight({0, 0, height()}, {0, breadth(), height()}, (m_.bays_across + 2) * n_));
    const double level = height() + m_.bays_up / 2 * m_.spacing;
    along(stringer_, straight({0, breadth() - m_.spacing, level}, {0, breadth(), level}, n_));
    for (int bay = 0; bay <= m_.bays_across; bay += m_.bays_between_girders)
      make_girder(bay * m_.spacing);
  }

  // Between floors, each girder has a manhole in its middle.
  void make_girder(double y) {
    const auto place = [&](double x, double z) { return Vector3(x, y, z); };
    for (int bay = 0; bay < m_.bays; ++bay) {
      const bool is_middle = bay % m_.bays_between_floors == m_.bays_between_floors / 2;
      panel(girders_, bay * m_.spacing, is_middle, place);
    }
  }

  /// Two bays of height of a web of the double bottom, with or without a manhole, between two
  /// stiffeners. The hole is a circle about the middle of the panel; the cells around it follow.
  template <typename Place>
  void panel(const Member& member, double from, bool has_hole, const Place& place) {
    const int up = 2 * n_;
    has_hole = has_hole && can_have_holes();
    const auto node = [&](int i, int j) -> Vector3 {
      double u = i * step_, z = j * step_;
      if (has_hole) round(u, z);
      return place(from + u, z);
    };
    for (int i = 0; i < n_; ++i)
      for (int j = 0; j < up; ++j) {
        // Half a spacing above and below mid-height the square that becomes the circle.
        const bool is_hole = has_hole && i >= hole_begin() && i < n_ - hole_begin() &&
                             j >= n_ / 2 + hole_begin() && j < up - n_ / 2 - hole_begin();
        if (is_hole) continue;
        shell(member, {node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
      }
  }

  /// Cells between a stiffener and the square of cells that becomes the hole.
  int hole_begin() const {
    return std::max(1, static_cast<int>(std::floor(n_ / 2.0 - hole_radius / step_ + 1e-9)));
  }
  /// The hole's square is of whole cells about the middle of the panel.
  bool can_have_holes() const { return n_ >= 4 && n_ % 2 == 0; }

  /// Moves the edge of the hole's square onto the circle.
  void round(double& u, double& z) const {
    const double half = (n_ / 2.0 - hole_begin()) * step_;
    const double du = u - m_.spacing / 2, dz = z - height() / 2;
    if (std::abs(std::max(std::abs(du), std::abs(dz)) - half) > 1e-9) return;
    const double share = hole_radius / std::hypot(du, dz);
    u = m_.spacing / 2 + share * du;
    z = height() / 2 + share * dz;
  }

  void make_transverse_plates() {
    for (int bay = 0; bay <= m_.bays; bay += m_.bays_between_floors) {
      const double x = bay * m_.spacing;
      make_floor(x);
      make_bilge_floor(x);
      make_web_frame(x);
      make_bracket(x);
    }
  }

  void make_floor(double x) {
    const auto place = [&](double y, double z) { return Vector3(x, y, z); };
    for (int bay = 0; bay < m_.bays_across; ++bay)
      panel(floors_, bay * m_.spacing, bay % 2 == 1, place);
  }

  // The quarter disc about the point where floor, girder's line and inner bottom meet: rays and
  // rings.
  void make_bilge_floor(double x) {
    const int rings = 2 * n_, rays = bilge_cells();
    const auto node = [&](int ring, int ray) {
      return shifted(on_bilge(static_cast<double>(ray) / rays, radius() * ring / rings), x);
    };
    for (int ring = 0; ring < rings; ++ring)
      for (int ray = 0; ray < rays; ++ray)
        shell(floors_,
              {node(ring, ray), node(ring + 1, ray), node(ring + 1, ray + 1), node(ring, ray + 1)});
  }

  void make_web_frame(double x) {
    const double foot = height();
    for (int j = 0; j < m_.bays_up * n_; ++j) {
      const double low = foot + j * step_, high = low + step_;
      for (int i = 0; i < n_; ++i) {
        const double inner = breadth() - m_.spacing + i * step_;
        shell(
            frames_,
            {{x, inner, low}, {x, inner + step_, low}, {x, inner + step_, high}, {x, inner, high}});
      }
      // The face plate lies on the frame's free edge, its middle in the frame's plane.
      const double edge = breadth() - m_.spacing;
      beam(face_plates_, {x, edge, low}, {x, edge, high}, -Vector3::UnitY(), 0.0075);
    }
  }

  // A triangle between the frame's free edge and the inner bottom, of one spacing's legs.
  void make_bracket(double x) {
    const double corner = breadth() - m_.spacing;
    const auto node = [&](int i, int j) {
      return Vector3(x, corner - i * step_, height() + j * step_);
    };
    for (int i = 0; i < n_; ++i)
      for (int j = 0; i + j < n_; ++j) {
        if (i + j + 1 < n_)
          shell(brackets_, {node(i, j), node(i, j + 1), node(i + 1, j + 1), node(i + 1, j)});
        else
          shell(brackets_, {node(i, j), node(i, j + 1), node(i + 1, j)});
      }
  }

  void make_longitudinals() {
    const auto line = [&](const Member& bulb, const Vector3& at, const Vector3& away,
                          double plate) {
      for (int i = 0; i < cells_along(); ++i)
        beam(bulb, shifted(at, x_of(i)), shifted(at, x_of(i + 1)), away, plate / 2);
    };
    for (int bay = 1; bay < m_.bays_across; ++bay) {
      if (bay % m_.bays_between_girders == 0) continue;
      const double y = bay * m_.spacing;
      line(bottom_bulbs_, {0, y, 0}, Vector3::UnitZ(), 0.016);
      line(inner_bulbs_, {0, y, height()}, -Vector3::UnitZ(), 0.015);
    }
    for (int bay = 1; bay <= m_.bays_up; ++bay) {
      if (bay == m_.bays_up / 2) continue;
      line(side_bulbs_, {0, breadth(), height() + bay * m_.spacing}, -Vector3::UnitY(), 0.014);
    }
  }

  // Flat bars from bottom to inner bottom: on floors under each longitudinal, on girders between
  // floors. They stand inside the block.
  void make_upright_bars() {
    const auto line = [&](const Member& bar, const Vector3& foot, const Vector3& away,
                          double plate) {
      for (int j = 0; j < 2 * n_; ++j)
        beam(bar, foot + Vector3(0, 0, j * step_), foot + Vector3(0, 0, (j + 1) * step_), away,
             plate / 2);
    };
    for (int along = 0; along <= m_.bays; ++along)
      for (int across = 0; across <= m_.bays_across; ++across) {
        const bool is_floor = along % m_.bays_between_floors == 0;
        const bool is_girder = across % m_.bays_between_girders == 0;
        const Vector3 foot(along * m_.spacing, across * m_.spacing, 0);
        if (is_floor && !is_girder)
          line(floor_bars_, foot, (along == 0 ? 1 : -1) * Vector3::UnitX(), 0.012);
        if (is_girder && !is_floor)
          line(girder_bars_, foot, (across == 0 ? 1 : -1) * Vector3::UnitY(), 0.014);
      }
  }

  // Each pump of 8 t stands 1.2 m above the inner bottom on four feet two spacings apart.
  void make_pumps() {
    for (const int bay : {m_.bays / 4, 3 * m_.bays / 4}) {
      const double x = bay * m_.spacing, y = m_.bays_across / 2 * m_.spacing;
      structure::DistributingLink link;
      link.reference = vertex({x, y, height() + 1.2});
      for (const double dx : {-m_.spacing, m_.spacing})
        for (const double dy : {-m_.spacing, m_.spacing}) {
          link.vertices.push_back(vertex({x + dx, y + dy, height()}));
          link.weights.push_back(1);
        }
      mesh_.distributing_links.push_back(link);
      structure::PointMass pump;
      pump.vertex = link.reference;
      pump.mass = 8000;
      pump.inertia = Eigen::Vector3d(3000, 5000, 5000).asDiagonal();
      mesh_.masses.push_back(pump);
    }
  }

  void number() {
    long next = 0;
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v)
      mesh_.vertex_labels.push_back(static_cast<long>(v) + 1);
    for (Shell& one : mesh_.shells) one.label = ++next;
    for (Beam& one : mesh_.beams) one.label = ++next;
    for (structure::PointMass& one : mesh_.masses) one.label = ++next;
    for (structure::DistributingLink& one : mesh_.distributing_links) one.label = ++next;
  }

  struct KeyHash {
    std::size_t operator()(const std::array<std::int64_t, 3>& key) const {
      std::size_t hash = 0;
      for (const std::int64_t part : key) hash = hash * 1000003U + static_cast<std::size_t>(part);
      return hash;
    }
  };

  DoubleBottomMeasures m_;
  int n_;
  double step_;
  Deck deck_;
  Mesh& mesh_ = deck_.mesh;
  long properties_ = 0;
  Member bottom_, bilge_, side_, inner_bottom_, floors_, girders_, frames_, brackets_, stringer_;
  Member bottom_bulbs_, inner_bulbs_, side_bulbs_, floor_bars_, girder_bars_, face_plates_;
  std::unordered_map<std::array<std::int64_t, 3>, int, KeyHash> vertex_at_;
};

}  // namespace

structure::Deck make_double_bottom(const DoubleBottomMeasures& measures) {
  return DoubleBottom(measures).make();
}

}  // namespace blocklift::models
