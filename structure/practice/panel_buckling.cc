#include "structure/practice/panel_buckling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include <Eigen/Dense>

#include "algebra/products.h"
#include "parallel/threads.h"
#include "structure/formulation/shell.h"
#include "structure/practice/bar_chains.h"
#include "structure/response/cell_finder.h"
#include "structure/stress/shell_stress.h"

namespace blocklift::structure {

namespace {

constexpr Eigen::Index rows_per_panel = 5;

bool is_lug(const Mesh& mesh, int shell) { return mesh.regions[mesh.shells[shell].region].is_lug; }

/// Fields that buckle as one: pads belong to their plates, beams and lugs' edges hold.
PlateFields find_buckling_fields(const Mesh& mesh, const std::set<EdgeKey>& beams) {
  return find_fields(mesh, 0.15, [&](int a, int b, int vertex_1, int vertex_2) {
    return is_lug(mesh, a) == is_lug(mesh, b) && beams.count({vertex_1, vertex_2}) == 0;
  });
}

/// A shell as it counts in its panel: area, middle and normal of the field's side.
struct ShellShare {
  double area = 0;
  Vector3 middle = Vector3::Zero();
  Vector3 normal = Vector3::Zero();
};

ShellShare share_of_shell(const Mesh& mesh, int number, bool is_flipped) {
  const Shell& shell = mesh.shells[number];
  const auto corner = [&](double x, double y) { return position(mesh, shell, {x, y}); };
  ShellShare share;
  // Two triangles: the middle of a triangle as a shell lies elsewhere than that of its square.
  const std::array<std::array<Vector3, 3>, 2> halves{
      {{corner(0, 0), corner(1, 0), corner(0, 1)}, {corner(1, 1), corner(0, 1), corner(1, 0)}}};
  Vector3 area_vector = Vector3::Zero();
  for (const auto& [a, b, c] : halves) {
    const Vector3 half = 0.5 * (b - a).cross(c - a);
    area_vector += half;
    share.area += half.norm();
    share.middle += half.norm() * (a + b + c) / 3;
  }
  share.middle /= share.area;
  share.normal = (is_flipped ? -1.0 : 1.0) * area_vector.normalized();
  return share;
}

/// The direction in which most of a field's outline runs, in the plane across a normal; of two
/// alike the one nearer to x, then y, so that square panels of a plate lie the same way.
Vector3 main_direction(const Mesh& mesh, const PlateField& field, const Vector3& normal) {
  constexpr double parallel = 0.995;  // cosine
  std::vector<Vector3> chords;
  for (const auto& outline : field.outlines)
    for (const FieldEdge& edge : outline) {
      const Vector3 chord =
          mesh.vertices[edge.pieces.back().to] - mesh.vertices[edge.pieces.front().from];
      chords.push_back(chord - normal * normal.dot(chord));
    }
  const auto preference = [](const Vector3& d) { return std::abs(d.x()) + 0.5 * std::abs(d.y()); };
  Vector3 best = normal.unitOrthogonal();
  double longest = 0;
  for (const Vector3& chord : chords) {
    if (chord.norm() == 0) continue;
    const Vector3 direction = chord.normalized();
    double total = 0;
    for (const Vector3& other : chords)
      if (std::abs(direction.dot(other)) > parallel * other.norm()) total += other.norm();
    const bool is_alike = std::abs(total - longest) <= 1e-6 * longest;
    if (is_alike ? preference(direction) <= preference(best) + 1e-6 : total < longest) continue;
    longest = total;
    best = direction;
  }
  Eigen::Index axis = 0;
  best.cwiseAbs().maxCoeff(&axis);
  return best[axis] < 0 ? Vector3(-best) : best;
}

void find_axes(const Mesh& mesh, const PlateField& field, Panel& panel) {
  Vector3 normal = Vector3::Zero();
  for (std::size_t i = 0; i < field.shells.size(); ++i) {
    const ShellShare share = share_of_shell(mesh, field.shells[i], field.is_flipped[i]);
    normal += share.area * share.normal;
  }
  panel.normal = normal.normalized();
  panel.e_1 = main_direction(mesh, field, panel.normal);
  panel.e_2 = panel.normal.cross(panel.e_1);
}

/// Bounding rectangle in a panel's own axes, m.
struct Bounds {
  Eigen::Vector2d lower = Eigen::Vector2d::Constant(1e300);
  Eigen::Vector2d upper = Eigen::Vector2d::Constant(-1e300);
};

Eigen::Vector2d in_plane(const Panel& panel, const Vector3& place) {
  return {panel.e_1.dot(place), panel.e_2.dot(place)};
}

Bounds bounds_of(const Mesh& mesh, const PlateField& field, const Panel& panel) {
  Bounds bounds;
  for (const int shell : field.shells)
    for (const int vertex : mesh.shells[shell].vertices) {
      const Eigen::Vector2d place = in_plane(panel, mesh.vertices[vertex]);
      bounds.lower = bounds.lower.cwiseMin(place);
      bounds.upper = bounds.upper.cwiseMax(place);
    }
  return bounds;
}

/// A panel but for its edges: named after the region that has most of its volume, as thick as the
/// thinnest plate that has a tenth of its area.
void measure(const Mesh& mesh, const PlateField& field, const Bounds& bounds, Panel& panel) {
  double volume = 0, area = 0;
  std::map<int, double> of_region;        // volume
  std::map<double, double> of_thickness;  // area
  for (std::size_t i = 0; i < field.shells.size(); ++i) {
    const Shell& shell = mesh.shells[field.shells[i]];
    const double thickness = mesh.section_of(shell).thickness;
    const ShellShare share = share_of_shell(mesh, field.shells[i], field.is_flipped[i]);
    panel.centre_B += share.area * thickness * share.middle;
    volume += share.area * thickness;
    area += share.area;
    of_region[shell.region] += share.area * thickness;
    of_thickness[thickness] += share.area;
  }
  panel.centre_B /= volume;
  const auto largest = std::max_element(of_region.begin(), of_region.end(),
                                        [](auto& a, auto& b) { return a.second < b.second; });
  panel.plate = mesh.regions[largest->first].name;
  panel.group = mesh.group_of_region(largest->first).name;
  const auto thinnest = std::find_if(of_thickness.begin(), of_thickness.end(),
                                     [&](auto& one) { return one.second > 0.1 * area; });
  const Eigen::Vector2d sides = bounds.upper - bounds.lower;
  panel.size = {sides[0], sides[1],
                thinnest == of_thickness.end() ? of_thickness.begin()->first : thinnest->first};
  for (const int shell : field.shells)
    if (mesh.section_of(mesh.shells[shell]).thickness == panel.size.thickness)
      panel.material = mesh.section_of(mesh.shells[shell]).material;
}

/// Twice the area that an outline encloses in a panel's plane; holes' are negative.
double enclosed_area(const Mesh& mesh, const std::vector<FieldEdge>& outline, const Panel& panel) {
  double area = 0;
  for (const FieldEdge& edge : outline)
    for (const FieldEdge::Piece& piece : edge.pieces) {
      const Eigen::Vector2d from = in_plane(panel, mesh.vertices[piece.from] - panel.centre_B),
                            to = in_plane(panel, mesh.vertices[piece.to] - panel.centre_B);
      area += from.x() * to.y() - from.y() * to.x();
    }
  return area;
}

/// The sides of the bounding rectangle that lie free. Each piece of the field's outer outline
/// counts for the sides to which it faces, as long as it is seen from there: a side is free where
/// more than half of what faces it is held by no other plate or beam. Holes do not count.
FreeEdges find_free_edges(const Mesh& mesh, const PlateField& field, const std::set<EdgeKey>& beams,
                          const Panel& panel) {
  const auto outer = std::max_element(
      field.outlines.begin(), field.outlines.end(), [&](const auto& one, const auto& other) {
        return enclosed_area(mesh, one, panel) < enclosed_area(mesh, other, panel);
      });
  if (outer == field.outlines.end()) return {};
  // Length that is free less what is held, of the sides across e_1 and e_2, lower and upper.
  std::array<std::array<double, 2>, 2> free{};
  for (const FieldEdge& edge : *outer)
    for (const FieldEdge::Piece& piece : edge.pieces) {
      const bool is_free = edge.is_free && beams.count(std::minmax(piece.from, piece.to)) == 0;
      const Eigen::Vector2d run =
          in_plane(panel, mesh.vertices[piece.to]) - in_plane(panel, mesh.vertices[piece.from]);
      const Eigen::Vector2d outward(run.y(), -run.x());  // the field is on the left
      for (int across = 0; across < 2; ++across)
        free[across][outward[across] > 0 ? 1 : 0] += (is_free ? 1 : -1) * std::abs(outward[across]);
    }
  FreeEdges result;
  for (std::size_t end = 0; end < 2; ++end) {
    result.along_b += free[0][end] > 0 ? 1 : 0;
    result.along_a += free[1][end] > 0 ? 1 : 0;
  }
  return result;
}

/// Membrane stresses (11, 22, 12) of a point's rows turned into a panel's axes.
Eigen::Matrix3d turn_into(const Panel& panel, const ShellPoint& point) {
  // The point's tangents in the panel's plane; the angle between them and its axes.
  const double angle = std::atan2(point.e_1.dot(panel.e_2), point.e_1.dot(panel.e_1));
  const double side = point.normal.dot(panel.normal) < 0 ? -1 : 1;
  const double c = std::cos(angle), s = std::sin(angle);
  Eigen::Matrix3d turn;
  turn << c * c, s * s, -2 * side * c * s,  //
      s * s, c * c, 2 * side * c * s,       //
      c * s, -c * s, side * (c * c - s * s);
  return turn;
}

/// Factor by which a stress that falls from 1 to psi across the width raises the coefficient.
double gradient_factor(double psi, bool is_wide) {
  const double least = is_wide ? 0 : -1;
  psi = std::clamp(psi, least, 1.0);
  return psi >= 0 ? 2.1 / (psi + 1.1) : (7.6 - 6.4 * psi + 10 * psi * psi) / 4;
}

/// Compression at the more compressed edge, Pa, and the ratio of the other edge's to it.
struct Compression {
  double largest = 0;
  double psi = 1;
};

Compression compression_of(double mean, double gradient) {
  const double larger = -mean + std::abs(gradient), smaller = -mean - std::abs(gradient);
  if (larger <= 0) return {};
  return {larger, smaller / larger};
}

/// What a direction has in the utilisation: demand over elastic and over critical stress.
struct Share {
  double elastic = 0, critical = 0;
};

Share share_of(double demand, double elastic, double yield) {
  return {demand / elastic, demand / johnson_ostenfeld(elastic, yield)};
}

/// Share of two compressions, c_1 along a and c_2 along b, in those of their ratio under which a
/// panel on four simple supports buckles elastically: the largest over half waves m along a and n
/// along b of (c_1 (m/a)^2 + c_2 (n/b)^2) / (e ((m/a)^2 + (n/b)^2)^2), e = pi^2 D / t; one of m and
/// n is 1.
double biaxial_share(const PanelSize& size, double e, double c_1, double c_2) {
  const auto share = [&](int m, int n) {
    const double along_a = std::pow(m / size.a, 2), along_b = std::pow(n / size.b, 2);
    return (c_1 * along_a + c_2 * along_b) / (e * std::pow(along_a + along_b, 2));
  };
  double largest = share(1, 1);
  const int most = static_cast<int>(std::ceil(std::max(size.a / size.b, size.b / size.a))) + 1;
  for (int waves = 2; waves <= most; ++waves)
    largest = std::max({largest, share(waves, 1), share(1, waves)});
  return largest;
}

/// The larger u of u = compression + shear^2 / u: both shares in their own critical stress, which
/// together are critical where compression + shear^2 = 1.
double with_shear(double compression, double shear) {
  return 0.5 * (compression + std::hypot(compression, 2 * shear));
}

/// How near compression along both sides, with shear, brings a panel on four simple supports to
/// buckling. Beyond half of the yield stress Johnson and Ostenfeld's curve goes by von Mises
/// stress.
BucklingUtilisation biaxial_utilisation(const PanelSize& size, const Material& material,
                                        const PanelStress& stress, const Share& shear) {
  const double c_1 = -stress.s11, c_2 = -stress.s22;
  if (!(c_1 > 0) || !(c_2 > 0)) return {};
  const double elastic = biaxial_share(size, euler_stress(material, size.thickness, 1), c_1, c_2);
  const double at_elastic = std::sqrt(c_1 * c_1 - c_1 * c_2 + c_2 * c_2) / elastic;
  const double critical =
      elastic * at_elastic / johnson_ostenfeld(at_elastic, material.yield_stress);
  return {with_shear(elastic, shear.elastic), with_shear(critical, shear.critical)};
}

/// Does a direction run along a panel's side a rather than b?
bool runs_along_1(const Panel& panel, const Vector3& along) {
  return std::abs(along.dot(panel.e_1)) >= std::abs(along.dot(panel.e_2));
}

/// The most compressed of `fields` fields that divide a side over which a stress varies linearly.
void take_field(double& mean, double& gradient, double fields) {
  mean -= std::abs(gradient) * (1 - 1 / fields);
  gradient /= fields;
}

}  // namespace

double compression_coefficient(double length, double width, double psi, int free_edges) {
  const double ratio = width / length;
  if (free_edges == 1) return 0.425 + ratio * ratio;
  if (free_edges > 1) return ratio * ratio;
  double k = 1e300;
  const int most = static_cast<int>(std::ceil(length / width)) + 1;
  for (int m = 1; m <= most; ++m) k = std::min(k, std::pow(m * ratio + 1 / (m * ratio), 2));
  return k * gradient_factor(psi, length < width);
}

double shear_coefficient(double a, double b, bool free_edge) {
  const double ratio = std::min(a, b) / std::max(a, b);
  return (5.34 + 4 * ratio * ratio) * (free_edge ? 0.5 : 1);
}

double euler_stress(const Material& material, double thickness, double width) {
  const double nu = material.poisson_ratio;
  return std::numbers::pi * std::numbers::pi * material.youngs_modulus / (12 * (1 - nu * nu)) *
         std::pow(thickness / width, 2);
}

double johnson_ostenfeld(double elastic, double yield) {
  return elastic <= yield / 2 ? elastic : yield * (1 - yield / (4 * elastic));
}

BucklingUtilisation buckling_utilisation(const PanelSize& size, const FreeEdges& free,
                                         const Material& material, const PanelStress& stress) {
  const double a = size.a, b = size.b, t = size.thickness;
  const double yield = material.yield_stress;
  const auto compressed = [&](double mean, double gradient, double length, double width,
                              int free_edges) {
    const Compression c = compression_of(mean, gradient);
    const double k = compression_coefficient(length, width, c.psi, free_edges);
    return share_of(c.largest, k * euler_stress(material, t, width), yield);
  };
  const bool is_open = free.along_a + free.along_b > 0;
  const std::array<Share, 3> shares = {
      compressed(stress.s11, stress.s11_gradient, a, b, free.along_a),
      compressed(stress.s22, stress.s22_gradient, b, a, free.along_b),
      share_of(std::abs(stress.s12),
               shear_coefficient(a, b, is_open) * euler_stress(material, t, std::min(a, b)),
               yield / std::numbers::sqrt3)};
  BucklingUtilisation result;
  for (const Share& share : shares) {
    result.elastic += share.elastic * share.elastic;
    result.critical += share.critical * share.critical;
  }
  result = {std::sqrt(result.elastic), std::sqrt(result.critical)};
  if (is_open) return result;
  const BucklingUtilisation biaxial = biaxial_utilisation(size, material, stress, shares[2]);
  return {std::max(result.elastic, biaxial.elastic), std::max(result.critical, biaxial.critical)};
}

BlockPanels::BlockPanels(const ElasticModel& model,
                         const Eigen::Ref<const Eigen::MatrixXd>& motions,
                         const std::vector<PlateStiffening>& stiffening)
    : materials_(model.mesh().materials) {
  describe(model.mesh());
  stiffen(stiffening);
  integrate(model, motions);
}

void BlockPanels::describe(const Mesh& mesh) {
  const std::set<EdgeKey> beams = edges_with_beams(mesh);
  panel_of_shell_.assign(mesh.shells.size(), -1);
  for (const PlateField& field : find_buckling_fields(mesh, beams).fields) {
    if (is_lug(mesh, field.shells.front())) continue;
    Panel& panel = panels_.emplace_back();
    find_axes(mesh, field, panel);
    const Bounds bounds = bounds_of(mesh, field, panel);
    measure(mesh, field, bounds, panel);
    panel.free = find_free_edges(mesh, field, beams, panel);
    for (const int shell : field.shells) panel_of_shell_[shell] = static_cast<int>(shells_.size());
    shells_.push_back(field.shells);
  }
}

void BlockPanels::stiffen(const std::vector<PlateStiffening>& stiffening) {
  constexpr double in_plane_share = 0.5;  // of a direction: more than 60 degrees out of it none run
  for (const PlateStiffening& stiffeners : stiffening)
    for (Panel& panel : panels_) {
      const double along_1 = std::abs(stiffeners.along.dot(panel.e_1)),
                   along_2 = std::abs(stiffeners.along.dot(panel.e_2));
      if (panel.group != stiffeners.group ||
          std::max(along_1, along_2) < in_plane_share * stiffeners.along.norm())
        continue;
      const bool across_b = along_1 >= along_2;
      const double side = across_b ? panel.size.b : panel.size.a;
      (across_b ? panel.fields_b : panel.fields_a) = std::max(1.0, side / stiffeners.spacing);
    }
}

void BlockPanels::integrate(const ElasticModel& model,
                            const Eigen::Ref<const Eigen::MatrixXd>& motions) {
  const Space& space = model.space();
  components_.setZero(rows_per_panel * static_cast<Eigen::Index>(panels_.size()), motions.cols());
  const Eigen::Matrix3Xd rule = square_rule(space.degree() + 1);
  const CellFinder finder(space);
  const auto add = [&](int p, int cell, ShellStress& recovery, Eigen::Vector3d& weights) {
    const Panel& panel = panels_[p];
    const Eigen::MatrixXd rows = recovery.of_all(cell, motions);
    auto sums = components_.middleRows<rows_per_panel>(rows_per_panel * p);
    for (Eigen::Index q = 0; q < rule.cols(); ++q) {
      const ShellPoint& point = recovery.points()[q];
      const Eigen::MatrixXd stress =
          turn_into(panel, point) * rows.middleRows<3>(shell_stress_rows * q + membrane_stress_11);
      const double volume = rule(2, q) * point.area * point.thickness;
      const Eigen::Vector2d off = in_plane(panel, point.place - panel.centre_B);
      sums.topRows<3>() += volume * stress;
      sums.row(3) += volume * off[1] * stress.row(0);
      sums.row(4) += volume * off[0] * stress.row(1);
      weights += volume * Eigen::Vector3d(1, off[1] * off[1], off[0] * off[0]);
    }
  };
  parallel::in_batches(static_cast<int>(panels_.size()), 4, 0, [&](int first, int count) {
    ShellStress recovery(space, rule.topRows<2>());
    for (int p = first; p < first + count; ++p) {
      Eigen::Vector3d weights = Eigen::Vector3d::Zero();  // volume and second moments
      for (const int shell : shells_[p])
        for (const int cell : finder.cells_of(shell)) add(p, cell, recovery, weights);
      const PanelSize& size = panels_[p].size;
      components_.middleRows<3>(rows_per_panel * p) /= weights[0];
      components_.row(rows_per_panel * p + 3) *= size.b / 2 / weights[1];
      components_.row(rows_per_panel * p + 4) *= size.a / 2 / weights[2];
    }
  });
}

double BlockPanels::field_width(int panel, const Vector3& along) const {
  const Panel& of = panels_[panel];
  return runs_along_1(of, along) ? of.size.b / of.fields_b : of.size.a / of.fields_a;
}

Eigen::RowVectorXd BlockPanels::stress_beside(int panel, const Vector3& along,
                                              const Vector3& place) const {
  const Panel& of = panels_[panel];
  const bool along_1 = runs_along_1(of, along);
  const Eigen::Index first = rows_per_panel * panel + (along_1 ? 0 : 1);
  const double fields = along_1 ? of.fields_b : of.fields_a;
  const double side = (along_1 ? of.e_2 : of.e_1).dot(place - of.centre_B) < 0 ? -1 : 1;
  return components_.row(first) + side * (1 - 0.5 / fields) * components_.row(first + 3);
}

std::vector<PanelStress> BlockPanels::stresses(const Eigen::VectorXd& factors) const {
  const Eigen::VectorXd all = components_ * factors;
  std::vector<PanelStress> result;
  for (Eigen::Index p = 0; p < all.size(); p += rows_per_panel)
    result.push_back({all[p], all[p + 1], all[p + 2], all[p + 3], all[p + 4]});
  return result;
}

BucklingUtilisation BlockPanels::utilisation(int panel, const PanelStress& stress) const {
  const Panel& of = panels_[panel];
  PanelSize size = of.size;
  PanelStress field = stress;
  size.a /= of.fields_a;
  size.b /= of.fields_b;
  take_field(field.s11, field.s11_gradient, of.fields_b);
  take_field(field.s22, field.s22_gradient, of.fields_a);
  return buckling_utilisation(size, of.free, materials_[of.material], field);
}

std::vector<BlockPanels::Worst> BlockPanels::find_worst(const Eigen::MatrixXd& factors,
                                                        int threads) const {
  std::vector<Worst> result(panels_.size());
  parallel::in_batches(static_cast<int>(panels_.size()), 8, threads, [&](int first, int count) {
    Eigen::MatrixXd all(rows_per_panel * count, factors.cols());
    algebra::multiply(components_.middleRows(rows_per_panel * first, rows_per_panel * count),
                      factors, all);
    for (int p = 0; p < count; ++p)
      for (Eigen::Index t = 0; t < factors.cols(); ++t) {
        const auto s = all.block<rows_per_panel, 1>(rows_per_panel * p, t);
        const PanelStress stress{s[0], s[1], s[2], s[3], s[4]};
        const BucklingUtilisation found = utilisation(first + p, stress);
        Worst& worst = result[first + p];
        if (found.critical > worst.utilisation.critical)
          worst = {found, stress, static_cast<int>(t)};
      }
  });
  return result;
}

}  // namespace blocklift::structure
