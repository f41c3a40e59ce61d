#include "structure/practice/panel_buckling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include <Eigen/Dense>

#include "algebra/products.h"
#include "parallel/threads.h"
#include "structure/formulation/shell.h"
#include "structure/practice/bar_chains.h"
#include "structure/practice/buckling_fields.h"
#include "structure/practice/irregular_panel.h"
#include "structure/response/cell_finder.h"
#include "structure/stress/shell_stress.h"

namespace blocklift::structure {

namespace {

constexpr Eigen::Index rows_per_panel = 5;

bool is_lug(const Mesh& mesh, int shell) { return mesh.regions[mesh.shells[shell].region].is_lug; }

/// Bounding rectangle in a panel's own axes, m.
struct Bounds {
  Eigen::Vector2d lower = Eigen::Vector2d::Constant(1e300);
  Eigen::Vector2d upper = Eigen::Vector2d::Constant(-1e300);
};

Eigen::Vector2d in_plane(const Panel& panel, const Vector3& place) {
  return {panel.e_1.dot(place), panel.e_2.dot(place)};
}

Bounds bounds_of(const Mesh& mesh, const BucklingFields& fields, const PlateField& field,
                 const Panel& panel) {
  Bounds bounds;
  for (const int shell : field.shells)
    for (const int vertex : mesh.shells[shell].vertices) {
      const Eigen::Vector2d place = in_plane(panel, fields.place(mesh, vertex));
      bounds.lower = bounds.lower.cwiseMin(place);
      bounds.upper = bounds.upper.cwiseMax(place);
    }
  return bounds;
}

/// A panel but for its edges: named after the region that has most of its volume, as thick as the
/// thinnest plate that has a tenth of its area, of the weakest steel of that thickness.
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
  // Of the steels of that thickness the one that yields first, in whatever turn the shells come.
  bool is_found = false;
  for (const int shell : field.shells) {
    const ShellSection& section = mesh.section_of(mesh.shells[shell]);
    if (section.thickness != panel.size.thickness) continue;
    const bool is_weaker =
        mesh.materials[section.material].yield_stress < mesh.materials[panel.material].yield_stress;
    if (!is_found || is_weaker) panel.material = section.material;
    is_found = true;
  }
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

/// The outline of a field that is no hole's; none if it has none.
std::vector<FieldEdge> outer_outline(const Mesh& mesh, const PlateField& field,
                                     const Panel& panel) {
  const auto outer = std::max_element(
      field.outlines.begin(), field.outlines.end(), [&](const auto& one, const auto& other) {
        return enclosed_area(mesh, one, panel) < enclosed_area(mesh, other, panel);
      });
  return outer == field.outlines.end() ? std::vector<FieldEdge>() : *outer;
}

/// Gives a piece of a cut plate whose equivalent rectangle has less than nine tenths of the area of
/// the rectangle about it, such as a strip round a bend, the former's size and axes.
void straighten(const Mesh& mesh, const BucklingFields& fields, const PlateField& field,
                Panel& panel) {
  std::vector<Eigen::Vector2d> outline;
  for (const FieldEdge& edge : outer_outline(mesh, field, panel))
    for (const FieldEdge::Piece& piece : edge.pieces)
      outline.push_back(in_plane(panel, fields.place(mesh, piece.from)));
  const std::optional<EquivalentRectangle> rectangle = equivalent_rectangle(outline);
  if (!rectangle) return;
  constexpr double nearly_all = 0.9;
  if (rectangle->length * rectangle->width > nearly_all * panel.size.a * panel.size.b) return;
  const Vector3 along = rectangle->along[0] * panel.e_1 + rectangle->along[1] * panel.e_2;
  panel.e_1 = along.normalized();
  panel.e_2 = panel.normal.cross(panel.e_1);
  panel.size.a = rectangle->length;
  panel.size.b = rectangle->width;
}

/// Length of what faces a side of a panel's rectangle, m.
struct Facing {
  double free = 0, held = 0;  ///< by another plate or a beam
  double cut = 0;             ///< towards another piece of the same plate
};

/// By the sides across e_1 and e_2, lower and upper.
using FacingSides = std::array<std::array<Facing, 2>, 2>;

/// Each piece of the field's outer outline counts for the sides to which it faces, as long as it is
/// seen from there. Holes do not count.
FacingSides find_facing(const Mesh& mesh, const PlateField& field, const std::set<EdgeKey>& beams,
                        const std::set<EdgeKey>& cuts, const Panel& panel) {
  FacingSides result;
  for (const FieldEdge& edge : outer_outline(mesh, field, panel))
    for (const FieldEdge::Piece& piece : edge.pieces) {
      const EdgeKey key = std::minmax(piece.from, piece.to);
      const Eigen::Vector2d run =
          in_plane(panel, mesh.vertices[piece.to]) - in_plane(panel, mesh.vertices[piece.from]);
      const Eigen::Vector2d outward(run.y(), -run.x());  // the field is on the left
      for (int across = 0; across < 2; ++across) {
        Facing& side = result[across][outward[across] > 0 ? 1 : 0];
        const bool is_free = edge.is_free && beams.count(key) == 0;
        (cuts.count(key) != 0 ? side.cut
         : is_free            ? side.free
                              : side.held) += std::abs(outward[across]);
      }
    }
  return result;
}

/// A side is free where more than half of what faces it is neither held nor cut.
FreeEdges find_free_edges(const FacingSides& sides) {
  const auto count = [](const std::array<Facing, 2>& ends) {
    return static_cast<int>(std::count_if(
        ends.begin(), ends.end(), [](const Facing& end) { return end.free > end.held + end.cut; }));
  };
  return {count(sides[1]), count(sides[0])};
}

/// Longer sides for what a cut does not hold. Towards a cut over more than half of an edge the
/// panel counts as long as all of the plate, so that no half wave ends there; across the way on
/// which most is cut it stays the strip that it is. Over less of an edge, c of its length L, and
/// that way, the side s across it grows by half of c, times s / L where that is less than one. Of
/// an L of three squares that is held all round, its longer piece then buckles under equal
/// compression at 0.91 of what the L does, whose membrane frequency is known (Fox, Henrici and
/// Moler, 1967); with a support along the cut it would at 1.28.
void lengthen_at_cuts(const FacingSides& facing, double whole_length, Panel& panel) {
  const std::array<double, 2> sides = {panel.size.a, panel.size.b};
  const auto cut_share = [&](std::size_t across) {
    return std::max(facing[across][0].cut, facing[across][1].cut) / sides[1 - across];
  };
  const std::size_t along = cut_share(0) >= cut_share(1) ? 0 : 1;
  std::array<double, 2> counted = sides;
  for (std::size_t across = 0; across < 2; ++across)
    for (const Facing& end : facing[across]) {
      const double edge = sides[1 - across], cut = std::min(end.cut, edge);
      if (across == along && cut > 0.5 * edge * (1 + 1e-6))
        counted[across] = std::max(counted[across], whole_length);
      else
        counted[across] += 0.5 * cut * std::min(1.0, sides[across] / edge);
    }
  panel.size.a = counted[0];
  panel.size.b = counted[1];
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

/// Of compression round curved plating, spread over the side `width` along its generators.
Share share_round(double arc, double width, double thickness, int free_edges,
                  const Material& material, const Compression& compression) {
  const double k = compression_coefficient(arc, width, 1, free_edges);
  return share_of(compression.largest, k * euler_stress(material, thickness, width),
                  material.yield_stress);
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
  const BucklingFields found = find_buckling_fields(mesh, beams);
  for (const BucklingField& one : found.fields) {
    const PlateField& field = one.field;
    if (is_lug(mesh, field.shells.front())) continue;
    Panel& panel = panels_.emplace_back();
    const FieldAxes axes = axes_of(mesh, field);
    panel.normal = axes.normal;
    panel.e_1 = axes.e_1;
    panel.e_2 = axes.e_2;
    measure(mesh, field, bounds_of(mesh, found, field, panel), panel);
    if (one.whole_length > 0) straighten(mesh, found, field, panel);
    spans_.emplace_back(panel.size.a, panel.size.b);
    const FacingSides facing = find_facing(mesh, field, beams, found.cuts, panel);
    panel.free = find_free_edges(facing);
    if (one.whole_length > 0) lengthen_at_cuts(facing, one.whole_length, panel);
    if (one.arc > 0) (runs_along_1(panel, one.bend_axis) ? panel.arc_b : panel.arc_a) = one.arc;
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
      components_.middleRows<3>(rows_per_panel * p) /= weights[0];
      components_.row(rows_per_panel * p + 3) *= spans_[p][1] / 2 / weights[1];
      components_.row(rows_per_panel * p + 4) *= spans_[p][0] / 2 / weights[2];
    }
  });
}

double BlockPanels::field_width(int panel, const Vector3& along) const {
  const Panel& of = panels_[panel];
  return runs_along_1(of, along) ? std::min(spans_[panel][1], of.size.b / of.fields_b)
                                 : std::min(spans_[panel][0], of.size.a / of.fields_a);
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
  const Material& material = materials_[of.material];
  BucklingUtilisation result = buckling_utilisation(size, of.free, material, field);
  const auto take = [&](const Share& round) {
    result.elastic = std::max(result.elastic, round.elastic);
    result.critical = std::max(result.critical, round.critical);
  };
  // Stiffeners along the generators divide the arc.
  if (of.arc_b > 0 && of.fields_b == 1)
    take(share_round(of.arc_b, size.a, size.thickness, of.free.along_b, material,
                     compression_of(field.s22, field.s22_gradient)));
  if (of.arc_a > 0 && of.fields_a == 1)
    take(share_round(of.arc_a, size.b, size.thickness, of.free.along_a, material,
                     compression_of(field.s11, field.s11_gradient)));
  return result;
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
