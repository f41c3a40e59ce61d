#include "structure/mesh/diagnosis/diagnosis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <set>
#include <unordered_map>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "algebra/decompositions.h"
#include "structure/index.h"
#include "structure/mesh/beam_lines.h"
#include "structure/mesh/beams/beam_axes.h"
#include "structure/mesh/beams/section_shear.h"
#include "structure/mesh/diagnosis/touching_parts.h"
#include "structure/mesh/quarter_points.h"
#include "structure/mesh/shell_shape.h"
#include "structure/mesh/solid_shape.h"
#include "structure/mesh/spring_motion.h"

namespace blocklift::structure {

namespace {

/// Edge of one shell; its key is alike for all shells that share it.
struct ShellEdge {
  std::uint64_t key = 0;
  int shell = 0;
  bool is_forward = true;  ///< from the lower vertex to the higher, around the normal
};

class Doctor {
 public:
  Doctor(const Mesh& mesh, const DiagnosisOptions& options) : mesh_(mesh), options_(options) {}

  Diagnosis look() {
    result_.mass = mass_properties(mesh_);
    result_.groups = mass_by_group(mesh_);
    find_used();
    check_sections();
    check_shapes();
    check_edges();
    check_parts();
    check_vertices();
    check_cells_twice();
    check_solids();
    check_middles();
    check_mechanisms();
    check_shear();
    return std::move(result_);
  }

 private:
  Finding& finding(const char* kind, Severity severity) {
    for (Finding& known : result_.findings)
      if (known.kind == kind) return known;
    result_.findings.push_back({kind, severity, "", 0, {}, {}});
    return result_.findings.back();
  }

  void add(const char* kind, Severity severity, long label, const Vector3& place) {
    Finding& known = finding(kind, severity);
    ++known.count;
    if (known.labels.size() < 10) known.labels.push_back(label);
    known.places.push_back(place);
  }

  template <typename... Values>
  void say(const char* kind, fmt::format_string<Values...> text, Values&&... values) {
    for (Finding& known : result_.findings)
      if (known.kind == kind) known.text = fmt::format(text, std::forward<Values>(values)...);
  }
  int count(const char* kind) const {
    const Finding* known = result_.find(kind);
    return known == nullptr ? 0 : known->count;
  }

  const Vector3& vertex(int i) const { return mesh_.vertices[i]; }
  long label(int i) const { return mesh_.vertex_labels.empty() ? i + 1 : mesh_.vertex_labels[i]; }

  /// Vertices around a shell: four, or three.
  static std::vector<int> around(const Shell& shell) {
    const auto& v = shell.vertices;
    if (shell.is_triangle()) return {v[0], v[1], v[2]};
    return {v[0], v[1], v[3], v[2]};
  }

  Vector3 centre(const Shell& shell) const {
    Vector3 sum = Vector3::Zero();
    const std::vector<int> corners = around(shell);
    for (const int corner : corners) sum += vertex(corner);
    return sum / static_cast<double>(corners.size());
  }

  void find_used() {
    used_.assign(mesh_.vertices.size(), 0);
    for (const Shell& shell : mesh_.shells)
      for (const int v : shell.vertices) used_[v] = 1;
    for (const Beam& beam : mesh_.beams)
      for (const int v : beam.vertices) used_[v] = 1;
    for (const Solid& solid : mesh_.solids)
      for (const int v : solid.vertices) used_[v] = 1;
    for_each_link(mesh_, [&](const std::vector<int>& vertices, long) {
      for (const int v : vertices) used_[v] = 1;
    });
    for (const Spring& spring : mesh_.springs)
      for (const int v : spring.vertices)
        if (v >= 0) used_[v] = 1;
    for (const SurfacePoint& point : mesh_.surface_points) used_[point.vertex] = 1;
    for (const PointMass& mass : mesh_.masses) used_[mass.vertex] = 1;
    find_middles();
  }

  /// Middles of quadratic shells' edges belong to them, though they are no corners.
  void find_middles() {
    std::set<std::array<double, 3>> middles;
    for (const Eigen::Matrix3Xd& points : mesh_.curved_shells)
      if (points.cols() == 9)
        for (const Eigen::Index i : {1, 3, 5, 7})
          middles.insert({points(0, i), points(1, i), points(2, i)});
    if (middles.empty()) return;
    for (std::size_t v = 0; v < used_.size(); ++v) {
      const Vector3& place = mesh_.vertices[v];
      if (middles.count({place.x(), place.y(), place.z()}) > 0) used_[v] = 1;
    }
  }

  void check_sections() {
    for (const Shell& shell : mesh_.shells)
      if (shell.section < 0 || !(mesh_.section_of(shell).thickness > 0))
        add("shells without thickness", Severity::error, shell.label, centre(shell));
    say("shells without thickness", "{} shells have no thickness: give it by their groups",
        count("shells without thickness"));
    std::string names;
    for (const Material& material : mesh_.materials)
      if (!(material.density > 0)) {
        names += (names.empty() ? "" : ", ") + material.name;
        add("materials without density", Severity::warning, 0, Vector3::Zero());
      }
    if (Finding* known =
            names.empty() ? nullptr : &finding("materials without density", Severity::warning)) {
      known->labels.clear();
      known->places.clear();
      known->text = fmt::format("{} materials have no density: {}", known->count, names);
    }
  }

  void check_shapes() {
    double worst_aspect = 0, worst_warp = 0;
    for (const Shell& shell : mesh_.shells) {
      const double size = longest_edge(mesh_, shell);
      const std::vector<int> corners = around(shell);
      const double surface = area(mesh_, shell);
      result_.plate_area += surface;
      if (is_folded(mesh_, shell)) {
        add("folded shells", Severity::error, shell.label, centre(shell));
        continue;
      }
      if (!(surface > 1e-6 * size * size)) {
        add("shells without area", Severity::error, shell.label, centre(shell));
        continue;
      }
      const double height = surface / size * (corners.size() == 3 ? 2 : 1);
      if (const double aspect = size / height; aspect > options_.aspect_ratio) {
        worst_aspect = std::max(worst_aspect, aspect);
        add("slender shells", Severity::note, shell.label, centre(shell));
      }
      check_angles(shell, corners);
      if (corners.size() != 4 || shell.curvature >= 0) continue;
      const auto normal = [&](std::size_t i) {
        return (vertex(corners[(i + 1) % 4]) - vertex(corners[i]))
            .cross(vertex(corners[(i + 2) % 4]) - vertex(corners[i]));
      };
      const double warp = std::max(angle(normal(0), normal(2)), angle(normal(1), normal(3)));
      if (warp > options_.warp) {
        worst_warp = std::max(worst_warp, warp);
        add("warped shells", Severity::warning, shell.label, centre(shell));
      }
    }
    const BeamLines lines(mesh_);
    for (const Beam& beam : mesh_.beams) result_.beam_length += lines.length(beam);
    say("folded shells",
        "{} shells are folded: their corners are not in turn about them, or one turns inwards",
        count("folded shells"));
    say("shells without area", "{} shells have no area", count("shells without area"));
    say("slender shells", "{} shells are slender, up to {:.0f} times longer than high",
        count("slender shells"), worst_aspect);
    say("warped shells", "{} quadrangles are warped, up to {:.0f} degrees", count("warped shells"),
        worst_warp * 180 / std::numbers::pi);
    say("skewed shells", "{} shells have corners of less than {:.0f} or more than {:.0f} degrees",
        count("skewed shells"), options_.least_angle * 180 / std::numbers::pi,
        options_.greatest_angle * 180 / std::numbers::pi);
  }

  static double angle(const Vector3& a, const Vector3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
  }

  void check_angles(const Shell& shell, const std::vector<int>& corners) {
    const std::size_t n = corners.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Vector3& corner = vertex(corners[i]);
      const double at_corner =
          angle(vertex(corners[(i + 1) % n]) - corner, vertex(corners[(i + n - 1) % n]) - corner);
      if (at_corner > options_.least_angle && at_corner < options_.greatest_angle) continue;
      add("skewed shells", Severity::note, shell.label, centre(shell));
      return;
    }
  }

  void check_edges() {
    std::vector<ShellEdge> edges;
    edges.reserve(4 * mesh_.shells.size());
    for (std::size_t s = 0; s < mesh_.shells.size(); ++s) {
      const std::vector<int> corners = around(mesh_.shells[s]);
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const int a = corners[i], b = corners[(i + 1) % corners.size()];
        const auto low = static_cast<std::uint64_t>(std::min(a, b));
        const auto high = static_cast<std::uint64_t>(std::max(a, b));
        edges.push_back({low << 32U | high, static_cast<int>(s), a < b});
      }
    }
    std::sort(edges.begin(), edges.end(), [](const ShellEdge& a, const ShellEdge& b) {
      return a.key != b.key ? a.key < b.key : a.shell < b.shell;
    });
    for (std::size_t i = 0; i < edges.size();) {
      std::size_t end = i + 1;
      while (end < edges.size() && edges[end].key == edges[i].key) ++end;
      const Vector3 &a = vertex(static_cast<int>(edges[i].key >> 32U)),
                    &b = vertex(static_cast<int>(edges[i].key & 0xffffffffU));
      if (end - i == 1) {
        ++result_.free_edges;
        result_.free_edge_length += (b - a).norm();
        add("free edges", Severity::note, mesh_.shells[edges[i].shell].label, (a + b) / 2);
      } else if (end - i == 2) {
        check_normals(edges[i], edges[i + 1], (a + b) / 2);
      }
      i = end;
    }
    say("free edges", "{} edges of shells are free, {:.1f} m in all", result_.free_edges,
        result_.free_edge_length);
    say("opposed normals", "{} pairs of neighbouring shells have opposed normals",
        count("opposed normals"));
  }

  void check_normals(const ShellEdge& one, const ShellEdge& other, const Vector3& place) {
    if (one.shell == other.shell || one.is_forward != other.is_forward) return;
    const auto normal = [&](int shell) -> Vector3 {
      const auto& v = mesh_.shells[shell].vertices;
      return (vertex(v[3]) - vertex(v[0])).cross(vertex(v[2]) - vertex(v[1])).normalized();
    };
    // Seen from one side, both run along the edge the same way: one of them is turned over. Where
    // they meet at an angle, which side is whose is a matter of taste.
    if (normal(one.shell).dot(normal(other.shell)) < -std::sqrt(0.5))
      add("opposed normals", Severity::warning, mesh_.shells[one.shell].label, place);
  }

  void check_touching_parts(const std::vector<int>& part) {
    const std::vector<TouchingParts> touching = find_touching_parts(mesh_, part);
    if (touching.empty()) return;
    for (const TouchingParts& pair : touching)
      add("parts that touch", Severity::warning, label(pair.vertex), vertex(pair.vertex));
    const auto nearest =
        std::min_element(touching.begin(), touching.end(),
                         [](const auto& a, const auto& b) { return a.gap < b.gap; });
    const Vector3& place = vertex(nearest->vertex);
    say("parts that touch",
        "{} pairs of parts face each other closely and nothing joins them, the nearest across "
        "{:.3g} mm at ({:.4g}, {:.4g}, {:.4g}) m, where {} vertices lie beside the other part; a "
        "vertex of each pair",
        touching.size(), 1000 * nearest->gap, place.x(), place.y(), place.z(), nearest->vertices);
  }

  void check_parts() {
    const std::vector<int> part = connected_parts(mesh_);
    result_.parts = part.empty() ? 0 : *std::max_element(part.begin(), part.end()) + 1;
    if (result_.parts > 1) {
      std::vector<int> vertices(at(result_.parts), 0);
      for (const int p : part)
        if (p >= 0) ++vertices[p];
      const int main =
          static_cast<int>(std::max_element(vertices.begin(), vertices.end()) - vertices.begin());
      std::vector<char> seen(at(result_.parts), 0);
      const auto see = [&](int v, long cell) {
        const int p = part[v];
        if (p < 0 || p == main || seen[p] != 0) return;
        seen[p] = 1;
        add("unconnected parts", Severity::error, cell, vertex(v));
      };
      for (const Shell& shell : mesh_.shells) see(shell.vertices[0], shell.label);
      for (const Beam& beam : mesh_.beams) see(beam.vertices[0], beam.label);
      for (const Solid& solid : mesh_.solids) see(solid.vertices[0], solid.label);
      for_each_link(mesh_, [&](const std::vector<int>& vertices, long number) {
        see(vertices.front(), number);
      });
      for (const Spring& spring : mesh_.springs)
        see(std::max(spring.vertices[0], spring.vertices[1]), spring.label);
      say("unconnected parts", "{} parts hang together with nothing else; a cell of each",
          count("unconnected parts"));
      check_touching_parts(part);
    }
    for (const PointMass& mass : mesh_.masses)
      if (part[mass.vertex] < 0)
        add("masses of nothing", Severity::error, mass.label, vertex(mass.vertex));
    say("masses of nothing", "{} point masses are at vertices that nothing carries",
        count("masses of nothing"));
    for (std::size_t v = 0; v < used_.size(); ++v)
      if (used_[v] == 0)
        add("unused vertices", Severity::note, label(static_cast<int>(v)), mesh_.vertices[v]);
    say("unused vertices", "{} vertices belong to nothing", count("unused vertices"));
  }

  /// Solids that are folded, and plates and beams that end on solids, which take no moments.
  void check_solids() {
    std::set<int> of_solids;
    for (const Solid& solid : mesh_.solids) {
      of_solids.insert(solid.vertices.begin(), solid.vertices.end());
      const double ratio = least_jacobian_ratio(mesh_, solid);
      const Vector3 centre = places_of(mesh_, solid).rowwise().mean();
      if (!(ratio > 0)) add("folded solids", Severity::error, solid.label, centre);
      if (ratio > 0 && ratio < 0.05) add("bad solids", Severity::warning, solid.label, centre);
    }
    say("folded solids", "{} solids are folded or have no volume", count("folded solids"));
    say("bad solids", "{} solids are nearly folded", count("bad solids"));
    const auto is_on_solid = [&](int v) { return of_solids.count(v) > 0; };
    for (const Shell& shell : mesh_.shells) {
      const std::vector<int> corners = around(shell);
      const auto shared = std::count_if(corners.begin(), corners.end(), is_on_solid);
      if (shared > 0 && shared < 3)
        add("plates hinged to solids", Severity::warning, shell.label, centre(shell));
    }
    for (const Beam& beam : mesh_.beams)
      if (is_on_solid(beam.vertices[0]) != is_on_solid(beam.vertices[1]))
        add("beams hinged to solids", Severity::warning, beam.label, vertex(beam.vertices[0]));
    say("plates hinged to solids",
        "{} shells end on solids, whose nodes take no moments: the plate is hinged there unless it "
        "goes on along the solid's face",
        count("plates hinged to solids"));
    say("beams hinged to solids",
        "{} beams end on solids, whose nodes take no moments: the beam is hinged there",
        count("beams hinged to solids"));
  }

  /// Quadratic shells and solids that are singular in a corner.
  void check_middles() {
    const char* const kind = "middles at quarter points";
    std::optional<QuarterMiddle> nearest;
    const auto take = [&](const std::optional<QuarterMiddle>& middle, long label) {
      if (!middle) return;
      add(kind, Severity::warning, label, middle->place);
      if (!nearest || middle->share < nearest->share) nearest = middle;
    };
    for (const Shell& shell : mesh_.shells) take(quarter_middle_of(mesh_, shell), shell.label);
    for (const Solid& solid : mesh_.solids) take(quarter_middle_of(mesh_, solid), solid.label);
    if (!nearest) return;
    say(kind,
        "{} quadratic {} the middle of an edge near a quarter of it, the one nearest to a corner "
        "at ({:.4g}, {:.4g}, {:.4g}) m, {:.3g} of the edge from there: in that corner the stress "
        "grows without end, which is meant where a crack ends alone",
        count(kind), count(kind) == 1 ? "element has" : "elements have", nearest->place.x(),
        nearest->place.y(), nearest->place.z(), nearest->share);
  }

  /// Vertices in the cells of a grid; neighbours are looked for in the cells around.
  void check_vertices() {
    Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (std::size_t v = 0; v < used_.size(); ++v) {
      if (used_[v] == 0) continue;
      low = low.cwiseMin(mesh_.vertices[v]);
      high = high.cwiseMax(mesh_.vertices[v]);
    }
    if (!(low[0] <= high[0])) return;
    const double near =
        options_.duplicate_distance > 0 ? options_.duplicate_distance : 1e-6 * (high - low).norm();
    if (!(near > 0)) return;
    const auto joints = vertices_joined();
    // Sorted along a slanted line, what is near in space is near in the list, and few others are.
    const Vector3 slant = Vector3(0.5257, 0.7236, 0.4472).normalized();
    std::vector<std::pair<double, int>> along;
    for (std::size_t v = 0; v < used_.size(); ++v)
      if (used_[v] != 0) along.emplace_back(slant.dot(mesh_.vertices[v]), static_cast<int>(v));
    std::sort(along.begin(), along.end());
    for (std::size_t i = 0; i < along.size(); ++i)
      for (std::size_t j = i + 1; j < along.size() && along[j].first - along[i].first < near; ++j) {
        const int a = along[i].second, b = along[j].second;
        if ((vertex(a) - vertex(b)).norm() > near || are_joined(joints, a, b)) continue;
        add("duplicated vertices", Severity::warning, label(b), vertex(b));
      }
    say("duplicated vertices",
        "{} vertices lie within {:.2g} mm of another that nothing joins them to",
        count("duplicated vertices"), 1000 * near);
  }

  /// Which links, ties to shells and springs a vertex is in, by numbers.
  std::unordered_map<int, std::vector<int>> vertices_joined() const {
    std::unordered_map<int, std::vector<int>> joints;
    int number = 0;
    for_each_link(mesh_, [&](const std::vector<int>& vertices, long) {
      ++number;
      for (const int v : vertices) joints[v].push_back(number);
    });
    for (const Spring& spring : mesh_.springs) {
      ++number;
      for (const int v : spring.vertices)
        if (v >= 0) joints[v].push_back(number);
    }
    for (const SurfacePoint& point : mesh_.surface_points) {
      ++number;
      joints[point.vertex].push_back(number);
      for (const int v : mesh_.shells[point.shell].vertices) joints[v].push_back(number);
    }
    return joints;
  }

  static bool are_joined(const std::unordered_map<int, std::vector<int>>& joints, int a, int b) {
    const auto of_a = joints.find(a), of_b = joints.find(b);
    if (of_a == joints.end() || of_b == joints.end()) return false;
    return std::find_first_of(of_a->second.begin(), of_a->second.end(), of_b->second.begin(),
                              of_b->second.end()) != of_a->second.end();
  }

  void check_cells_twice() {
    std::vector<std::pair<std::array<int, 4>, int>> cells;
    for (std::size_t s = 0; s < mesh_.shells.size(); ++s) {
      std::array<int, 4> key = mesh_.shells[s].vertices;
      std::sort(key.begin(), key.end());
      cells.emplace_back(key, static_cast<int>(s));
    }
    std::sort(cells.begin(), cells.end());
    for (std::size_t i = 1; i < cells.size(); ++i) {
      const Shell& shell = mesh_.shells[cells[i].second];
      if (cells[i].first == cells[i - 1].first)
        add("duplicated shells", Severity::warning, shell.label, centre(shell));
    }
    say("duplicated shells", "{} shells have the corners of another", count("duplicated shells"));
    std::vector<std::pair<std::array<int, 2>, int>> lines;
    for (std::size_t b = 0; b < mesh_.beams.size(); ++b) {
      std::array<int, 2> key = mesh_.beams[b].vertices;
      std::sort(key.begin(), key.end());
      lines.emplace_back(key, static_cast<int>(b));
    }
    std::sort(lines.begin(), lines.end());
    for (std::size_t i = 1; i < lines.size(); ++i) {
      const Beam& beam = mesh_.beams[lines[i].second];
      if (lines[i].first == lines[i - 1].first)
        add("duplicated beams", Severity::note, beam.label, vertex(beam.vertices[0]));
    }
    say("duplicated beams", "{} beams run between the ends of another", count("duplicated beams"));
  }

  using Six = Eigen::Matrix<double, 6, 1>;
  using Resistance = Eigen::Matrix<double, 6, 6>;

  static Six motion(const Vector3& direction, const Vector3& arm, bool is_rotation) {
    Six freedom = Six::Zero();
    if (is_rotation) {
      freedom.tail<3>() = direction;
    } else {
      // (u + theta x arm) . direction
      freedom.head<3>() = direction;
      freedom.tail<3>() = arm.cross(direction);
    }
    return freedom;
  }

  /// What resists each vertex' motion: shells and links all of it, beams and springs some
  /// directions.
  void check_mechanisms() {
    std::vector<char> is_held(mesh_.vertices.size(), 0), has_beam(mesh_.vertices.size(), 0);
    for (const Shell& shell : mesh_.shells)
      for (const int v : shell.vertices) is_held[v] = 1;
    for (const SurfacePoint& point : mesh_.surface_points) is_held[point.vertex] = 1;
    for_each_link(mesh_, [&](const std::vector<int>& vertices, long) {
      for (const int v : vertices) is_held[v] = 1;
    });
    std::unordered_map<int, Resistance> resistance;
    const auto resist = [&](int v, const Six& freedom) {
      if (is_held[v] != 0) return;
      const auto [found, is_new] = resistance.try_emplace(v, Resistance::Zero());
      found->second += freedom * freedom.transpose();
    };
    for (const Beam& beam : mesh_.beams) {
      check_spin(beam);
      resist_by(beam, resist);
      if (!beam.is_rod)
        for (const int v : beam.vertices) has_beam[v] = 1;
    }
    bool has_ground = false;
    for (const Spring& spring : mesh_.springs) {
      for (std::size_t end = 0; end < 2; ++end) {
        const int v = spring.vertices[end];
        if (v < 0) {
          has_ground = true;
          continue;
        }
        resist(v, spring_motion(spring, end));
      }
      if (spring.vertices[0] < 0 || spring.vertices[1] < 0)
        add("springs to the ground", Severity::warning, spring.label,
            vertex(std::max(spring.vertices[0], spring.vertices[1])));
    }
    if (has_ground)
      say("springs to the ground",
          "{} springs hold the block to the ground, which a lifted one has not",
          count("springs to the ground"));
    judge(resistance, has_beam);
  }

  void judge(const std::unordered_map<int, Resistance>& resistance,
             const std::vector<char>& has_beam) {
    std::vector<int> order;
    for (const auto& [v, matrix] : resistance) order.push_back(v);
    std::sort(order.begin(), order.end());
    constexpr double least = 1e-9;
    for (const int v : order) {
      const Resistance& matrix = resistance.at(v);
      const Eigen::Matrix3d moves = matrix.topLeftCorner<3, 3>();
      if (algebra::symmetric_eigenvalues(moves)[0] < least)
        add("vertices free to move", Severity::error, label(v), vertex(v));
      else if (has_beam[v] != 0 && algebra::symmetric_eigenvalues(matrix)[0] < least)
        add("vertices free to turn", Severity::warning, label(v), vertex(v));
    }
    say("vertices free to move", "{} vertices can move in a direction that nothing there resists",
        count("vertices free to move"));
    say("vertices free to turn", "{} vertices can turn about an axis that nothing there resists",
        count("vertices free to turn"));
    say("beams free to spin", "{} beams are released about their axis at both ends",
        count("beams free to spin"));
    say("beams free to slide", "{} beams are released along their axis at both ends",
        count("beams free to slide"));
  }

  void check_shear() {
    const char* const kind = "beams by figures";
    for (const Beam& beam : mesh_.beams)
      if (is_shear_estimated(section_at(mesh_, beam, 0)))
        add(kind, Severity::note, beam.label, vertex(beam.vertices[0]));
    say(kind,
        "the shear stress of {} beams is an estimate, for their sections are known by figures "
        "alone: where recovery points tell height and width, that of a web between two flanges as "
        "wide as the points reach, else, by the torsion constant, that of an open I-beam, and no "
        "less than that of a pipe; thin webs of a box without such points have more, for which its "
        "shear areas are due",
        count(kind));
  }

  void check_spin(const Beam& beam) {
    const auto both = [&](std::size_t i) { return beam.release[0][i] && beam.release[1][i]; };
    if (both(3)) add("beams free to spin", Severity::error, beam.label, vertex(beam.vertices[0]));
    if (both(0)) add("beams free to slide", Severity::error, beam.label, vertex(beam.vertices[0]));
  }

  template <typename Resist>
  void resist_by(const Beam& beam, const Resist& resist) const {
    const Eigen::Matrix3d axes = beam_axes(mesh_, beam);
    // Hinged at both ends about an axis, a beam is a rod across the other.
    const bool hinged_2 = beam.release[0][4] && beam.release[1][4];
    const bool hinged_3 = beam.release[0][5] && beam.release[1][5];
    for (std::size_t end = 0; end < 2; ++end)
      for (int i = 0; i < 6; ++i) {
        // What one end does not pass on in these, the other has nothing to push against.
        if (i < 4 && (beam.release[0][i] || beam.release[1][i])) continue;
        if (beam.release[end][i] || (beam.is_rod && i != 0)) continue;
        if ((i == 1 && hinged_3) || (i == 2 && hinged_2)) continue;
        resist(beam.vertices[end], motion(axes.row(i % 3), beam.offset[end], i >= 3));
      }
  }

  const Mesh& mesh_;
  const DiagnosisOptions& options_;
  Diagnosis result_;
  std::vector<char> used_;
};

}  // namespace

const Finding* Diagnosis::find(const std::string& kind) const {
  for (const Finding& finding : findings)
    if (finding.kind == kind) return &finding;
  return nullptr;
}

Diagnosis diagnose(const Mesh& mesh, const DiagnosisOptions& options) {
  return Doctor(mesh, options).look();
}

}  // namespace blocklift::structure
