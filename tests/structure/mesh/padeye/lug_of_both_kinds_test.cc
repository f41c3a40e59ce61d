// One straight lug on a corner of plating, of shells and of solids: what is checked below it is the
// same, and why a padeye's is another.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "structure/formulation/solid.h"
#include "structure/mesh/fields/shell_solid_joint.h"
#include "structure/mesh/padeye/padeye_in_block.h"
#include "structure/mesh/plates/shell_generator.h"
#include "structure/mesh/solid_shape.h"
#include "structure/response/unit_responses.h"
#include "structure/stress/squares.h"
#include "tests/structure/hull_block.h"

namespace blocklift::structure {
namespace {

constexpr double side_at = 6, deck_at = 3, lug_height = 0.9, lug_thickness = 0.1;
const Vector3 lug_pin(4, side_at - 0.5, deck_at + 0.55);

/// The corner of a hull that a lug stands on: deck and side meet there above a web frame with a
/// pad. The lug's outer edge goes on in the side's plane.
BlockDescription hull_corner(bool has_lug) {
  const Interval along{0, 8}, across{0, side_at};
  BlockDescription block;
  block.name = "corner";
  block.materials = {test::steel()};
  block.plates = {{"deck", Axis::z, {deck_at}, {{along, across, {}}}, 0.02, "AH36"},
                  {"side", Axis::y, {side_at}, {{along, {}, {0, deck_at}}}, 0.014, "AH36"},
                  {"stringer", Axis::z, {0}, {{along, {5, side_at}, {}}}, 0.012, "AH36"},
                  {"girder", Axis::y, {2}, {{along, {}, {2.2, deck_at}}}, 0.02, "AH36"},
                  {"webs", Axis::x, {0, 4, 8}, {{{}, across, {0, deck_at}}}, 0.016, "AH36"}};
  block.pads = {{"pad", "webs", Axis::x, 4, {{{}, {4, side_at}, {1, deck_at}}}, 0.05, ""}};
  if (has_lug)
    block.lugs = {{"L",
                   "pad",
                   Axis::x,
                   4,
                   {{{}, {side_at - 1, side_at}, {deck_at, deck_at + lug_height}}},
                   lug_thickness,
                   "",
                   lug_pin}};
  block.largest_element = 1;
  return block;
}

/// Vertices of a box of hexahedra in rows along the base, across it and upwards.
class BoxOfSolids {
 public:
  BoxOfSolids(Mesh& mesh, int along, int up) : mesh_(mesh), along_(along), up_(up) {}

  void stand() {
    mesh_.groups.push_back({"L", 0});
    mesh_.regions.push_back({"L", static_cast<int>(mesh_.groups.size()) - 1, true});
    first_ = static_cast<int>(mesh_.vertices.size());
    for (int k = 0; k <= up_; ++k)
      for (int j = 0; j <= along_; ++j)
        for (const double x : {-lug_thickness / 2, lug_thickness / 2})
          mesh_.vertices.emplace_back(lug_pin.x() + x,
                                      side_at - 1 + static_cast<double>(j) / along_,
                                      deck_at + lug_height * k / up_);
    while (!mesh_.vertex_labels.empty() && mesh_.vertex_labels.size() < mesh_.vertices.size())
      mesh_.vertex_labels.push_back(mesh_.vertex_labels.back() + 1);
    SolidEdgeMiddles middles(mesh_);
    for (int k = 0; k < up_; ++k)
      for (int j = 0; j < along_; ++j) {
        Solid solid;
        solid.region = static_cast<int>(mesh_.regions.size()) - 1;
        for (const int level : {k, k + 1})
          for (const auto& [x, y] : {std::pair{0, j}, {1, j}, {1, j + 1}, {0, j + 1}})
            solid.vertices.push_back(vertex(x, y, level));
        complete_solid(mesh_, solid, middles);
        mesh_.solids.push_back(std::move(solid));
      }
    tie();
  }

 private:
  int vertex(int x, int y, int level) const { return first_ + x + 2 * (y + (along_ + 1) * level); }

  void tie() {
    std::map<long, std::set<int>> rows;  // by their place along the base, micrometres
    for (const Solid& solid : mesh_.solids)
      for (const int vertex : solid.vertices)
        if (const Vector3& place = mesh_.vertices[vertex]; place.z() < deck_at + 1e-9)
          rows[std::lround(1e6 * place.y())].insert(vertex);
    StandingEdge edge;
    edge.through = Vector3::UnitX();
    for (const auto& [y, vertices] : rows)
      edge.columns.push_back({Vector3(lug_pin.x(), 1e-6 * static_cast<double>(y), deck_at),
                              std::vector<int>(vertices.begin(), vertices.end())});
    stand_on_plating(mesh_, edge);
  }

  Mesh& mesh_;
  int along_, up_, first_ = 0;
};

Eigen::Matrix3d cross_with(const Vector3& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// Unit forces at the pin, spread over the solids as those on a lug of shells are over its plate.
Eigen::MatrixXd spread_over_solids(const Space& space) {
  Eigen::MatrixXd fields = Eigen::MatrixXd::Zero(space.freedoms(), 6);
  Eigen::Matrix<double, 6, 6> resultants = Eigen::Matrix<double, 6, 6>::Zero();
  for (std::size_t s = 0; s < space.mesh().solids.size(); ++s)
    for (const SolidPoint& point : solid_points(space.mesh(), space.mesh().solids[s])) {
      const Vector3 arm = point.place - lug_pin;
      Eigen::Matrix<double, 3, 6> forces;
      forces << Eigen::Matrix3d::Identity(), -cross_with(arm);
      forces *= point.weight;
      resultants.topRows<3>() += forces;
      resultants.bottomRows<3>() += cross_with(arm) * forces;
      for (Eigen::Index i = 0; i < point.values.size(); ++i)
        fields.middleRows<3>(
            6 * static_cast<Eigen::Index>(space.solid_nodes(static_cast<int>(s))[i])) +=
            point.values[i] * forces;
    }
  return fields * resultants.fullPivLu().solve(Eigen::Matrix<double, 6, 3>::Identity());
}

/// Cells of a twentieth of a metre at the lug's toes, growing with the distance.
double edge_beside_lug(const Vector3& place) {
  const Vector3 outer(lug_pin.x(), side_at, deck_at), inner(lug_pin.x(), side_at - 1, deck_at);
  return std::clamp(0.5 * std::min((place - outer).norm(), (place - inner).norm()), 0.05, 1.0);
}

/// The checked stress of the plating by the squares' places, under three pulls at the pin.
struct BesideLug {
  std::vector<Square> squares;
  std::array<Eigen::VectorXd, 3> stress;  ///< Pa

  /// The largest in the side below the deck, beside the lug's outer toe.
  double largest_in_side(std::size_t pull) const {
    double largest = 0;
    for (std::size_t s = 0; s < squares.size(); ++s)
      if (squares[s].centre_B.y() > side_at - 1e-6)
        largest = std::max(largest, stress[pull][static_cast<Eigen::Index>(s)]);
    return largest;
  }
};

/// @param is_spread over all solids, as over a lug of shells; else as the mesh has the pin.
BesideLug stress_beside_lug(Mesh mesh, bool is_spread) {
  const ElasticModel model(std::move(mesh), {3, edge_beside_lug});
  const Eigen::MatrixXd unit =
      is_spread ? spread_over_solids(model.space()) : Eigen::MatrixXd(model.lug_loads());
  Eigen::Matrix3d pulls;  // straight up, and inclined in the lug's plane
  pulls << 0, 0, 0, 0, -0.6, 0.6, 1, 0.8, 0.8;
  pulls *= 1e6;
  Eigen::MatrixXd loads = unit * pulls;
  for (int pull = 0; pull < 3; ++pull) {
    const Vector3 force = pulls.col(pull);
    loads.col(pull) +=
        model.inertia_loads() *
        balancing_field(model.mass_properties(), {force, lug_pin.cross(force)}).coefficients();
  }
  const UnitResponses responses(model, 1);
  const CheckedStress checked(model, responses.solve(loads), 0.05, 1);
  BesideLug result;
  std::vector<Eigen::Index> places;
  for (std::size_t s = 0; s < checked.squares().size(); ++s) {
    const Square& square = checked.squares()[s];
    if (model.mesh().regions[square.region].is_lug) continue;
    if ((square.centre_B - lug_pin).norm() > 1.6) continue;
    result.squares.push_back(square);
    places.push_back(static_cast<Eigen::Index>(s));
  }
  for (int pull = 0; pull < 3; ++pull)
    result.stress[pull] = checked.von_mises(Vector3::Unit(pull))(places);
  return result;
}

Mesh corner_with_shells() { return generate_shell_mesh(hull_corner(true)); }

Mesh corner_with_box(int along) {
  Mesh mesh = generate_shell_mesh(hull_corner(false));
  BoxOfSolids(mesh, along, along).stand();
  return mesh;
}

Mesh corner_with_padeye(double radius, double thickness) {
  Mesh mesh = corner_with_shells();
  PadeyeInBlock padeye{
      "L", {radius, thickness, 0.145, 0.14, 0.22, 0.035, 0.55, 0.5, 0.5}, {}, lug_pin};
  padeye.R_BP << Vector3::UnitY(), Vector3::UnitZ(), Vector3::UnitX();
  stand_padeye(mesh, padeye, 32);
  return mesh;
}

// The same rectangle with the same forces: what both say of the plating below differs by the
// elements along the base alone, 16 of them here. With four, as a padeye in a block has, the
// largest stresses are 3 % lower in the side and 20 % higher in the pad at the inner toe.
TEST(LugOfBothKinds, PlatingBelowBearsTheSameStress) {
  const BesideLug shells = stress_beside_lug(corner_with_shells(), false),
                  solids = stress_beside_lug(corner_with_box(16), true);
  for (std::size_t pull = 0; pull < 3; ++pull) {
    const double largest = shells.stress[pull].maxCoeff();
    EXPECT_NEAR(solids.stress[pull].maxCoeff(), largest, 0.01 * largest);
    int compared = 0;
    for (std::size_t i = 0; i < shells.squares.size(); ++i)
      for (std::size_t j = 0; j < solids.squares.size(); ++j) {
        if ((shells.squares[i].centre_B - solids.squares[j].centre_B).norm() > 1e-6) continue;
        EXPECT_NEAR(solids.stress[pull][static_cast<Eigen::Index>(j)],
                    shells.stress[pull][static_cast<Eigen::Index>(i)], 0.03 * largest)
            << shells.squares[i].centre_B.transpose();
        ++compared;
      }
    EXPECT_GT(compared, 100);
  }
}

// A padeye pulls at its bore and not all over, and its sides lean inwards: less of the force enters
// at its toes, whatever its thickness. Upright sides alone, then both.
TEST(LugOfBothKinds, APadeyeLeavesLessToItsToes) {
  const std::size_t inclined = 1;  // towards the middle of the deck: the side bears most
  const double shells = stress_beside_lug(corner_with_shells(), false).largest_in_side(inclined);
  const double upright =
      stress_beside_lug(corner_with_padeye(0.49, 0.1), false).largest_in_side(inclined);
  const double leaning =
      stress_beside_lug(corner_with_padeye(0.3, 0.1), false).largest_in_side(inclined);
  const double thinner =
      stress_beside_lug(corner_with_padeye(0.3, 0.08), false).largest_in_side(inclined);
  EXPECT_NEAR(upright, 0.97 * shells, 0.01 * shells);
  EXPECT_NEAR(leaning, 0.92 * shells, 0.01 * shells);
  EXPECT_NEAR(thinner, leaning, 0.01 * shells);
}

}  // namespace
}  // namespace blocklift::structure
