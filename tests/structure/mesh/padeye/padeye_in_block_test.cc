// Padeyes of solids in the place of a block's lugs: motion, mass, compliance, stress beside them.
#include "structure/mesh/padeye/padeye_in_block.h"

#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "structure/envelope/block_envelope.h"
#include "structure/error.h"
#include "structure/mesh/fields/fields.h"
#include "structure/mesh/mass_properties.h"
#include "structure/mesh/plates/shell_generator.h"
#include "structure/part/padeye_model.h"
#include "structure/response/unit_responses.h"
#include "structure/stress/stress.h"
#include "structure/system/assembly.h"
#include "tests/structure/hull_block.h"
#include "tests/structure/motions.h"

namespace blocklift::structure {
namespace {

using ::testing::HasSubstr;

/// Rotation of a padeye's frame whose pin lies along y and whose top points along z.
Eigen::Matrix3d upright_along_y() {
  Eigen::Matrix3d R_BP;
  R_BP << -Vector3::UnitX(), Vector3::UnitZ(), Vector3::UnitY();
  return R_BP;
}

constexpr double strip_width = 0.4, strip_length = 3.2, strip_thickness = 0.03;

PadeyeGeometry strip_padeye() { return {0.1, strip_thickness, 0.06, 0.057, 0, 0, 0.25, 0.2, 0.2}; }

/// An upright strip, y = 0, with a lug of its own width and thickness on its upper end.
BlockDescription strip_with_lug() {
  BlockDescription block;
  block.name = "strip";
  block.materials = {test::steel()};
  const double top = strip_length;
  const Interval width{0, strip_width};
  block.plates = {{"strip", Axis::y, {0}, {{width, {}, {0, top}}}, strip_thickness, "AH36"}};
  block.pads = {{"pad", "strip", Axis::y, 0, {{width, {}, {top - 0.4, top}}}, strip_thickness, ""}};
  block.lugs = {{"L",
                 "pad",
                 Axis::y,
                 0,
                 {{width, {}, {top, top + 0.35}}},
                 strip_thickness,
                 "",
                 {strip_width / 2, 0, top + 0.25}}};
  block.largest_element = 0.4;
  return block;
}

PadeyeInBlock on_strip() {
  return {"L", strip_padeye(), upright_along_y(), {strip_width / 2, 0, strip_length + 0.25}};
}

Mesh strip_mesh(int divisions = 16) {
  Mesh mesh = generate_shell_mesh(strip_with_lug());
  stand_padeye(mesh, on_strip(), divisions);
  return mesh;
}

/// A structure that is held at z = 0.
class HeldAtFoot {
 public:
  explicit HeldAtFoot(const ElasticModel& model)
      : model_(model), system_(assemble_stiffness(model.space(), 1), foot(model.space())) {
    system_.factorise();
    const Eigen::MatrixXd loads = model.space().reduce(model.lug_loads());
    const Eigen::MatrixXd found = system_.solve(loads);
    motion_ = model.space().expand(found);
    reactions_ = system_.reactions(found, loads);
  }

  /// Motion under the unit forces at the lug.
  const Eigen::MatrixXd& motion() const { return motion_; }
  /// What the support exerts, force over moment about the origin.
  Eigen::Matrix<double, 6, 3> reaction() const {
    Eigen::Matrix<double, 6, 3> sum = Eigen::Matrix<double, 6, 3>::Zero();
    for (std::size_t i = 0; i < system_.fixed().size(); ++i) {
      const int freedom = freedom_of_.at(system_.fixed()[i].unknown);
      const Vector3 place = model_.space().nodes().col(freedom / 6);
      for (Eigen::Index load = 0; load < 3; ++load) {
        const double force = reactions_(static_cast<Eigen::Index>(i), load);
        if (freedom % 6 < 3) {
          sum.col(load).head<3>() += force * Vector3::Unit(freedom % 6);
          sum.col(load).tail<3>() += place.cross(force * Vector3::Unit(freedom % 6));
        } else {
          sum(freedom % 6, load) += force;
        }
      }
    }
    return sum;
  }
  /// Displacement of the lug's vertex under the unit forces.
  Eigen::Matrix3d compliance() const {
    const int node = model_.space().node_of_vertex(model_.mesh().lifting_points[0].vertex);
    return motion_.middleRows<3>(6 * static_cast<Eigen::Index>(node));
  }
  /// Displacement of the pin of a lug of shells: what the force does, by its load vector.
  Eigen::Matrix3d work() const { return model_.lug_loads().transpose() * motion_; }

 private:
  std::vector<FixedUnknown> foot(const Space& space) {
    for (int node = 0; node < space.node_count(); ++node)
      for (int f = 6 * node; space.nodes()(2, node) < 1e-9 && f < 6 * node + 6; ++f)
        if (space.end_of(f) - space.begin_of(f) == 1) freedom_of_[space.begin_of(f)->unknown] = f;
    std::vector<FixedUnknown> fixed;
    for (const auto& [unknown, freedom] : freedom_of_) fixed.push_back({unknown, 0});
    return fixed;
  }

  const ElasticModel& model_;
  std::map<int, int> freedom_of_;
  ConstrainedSystem system_;
  Eigen::MatrixXd motion_, reactions_;
};

// Every rigid motion of the whole is one that shells, ties and solids can have, and nothing resists
// it.
TEST(PadeyeInBlock, RigidMotionsAreFreeOfStrain) {
  const ElasticModel model(strip_mesh(), {3, {}});
  const Space& space = model.space();
  const SparseLower lower = assemble_stiffness(space, 1);
  const Eigen::SparseMatrix<double, Eigen::ColMajor, long> stiffness =
      lower.selfadjointView<Eigen::Lower>();
  const double stiffest = stiffness.diagonal().maxCoeff();
  for (int i = 0; i < 6; ++i) {
    const Eigen::VectorXd rigid = test::motion_of(space, [i](const Vector3& place) {
      Eigen::Matrix<double, 6, 1> motion = Eigen::Matrix<double, 6, 1>::Zero();
      motion[i] = 1;
      if (i >= 3) motion.head<3>() = Vector3::Unit(i - 3).cross(place);
      return motion;
    });
    Eigen::VectorXd unknowns = Eigen::VectorXd::Zero(space.unknowns());
    for (int f = 0; f < space.freedoms(); ++f)
      if (space.end_of(f) - space.begin_of(f) == 1 && space.begin_of(f)->weight == 1)
        unknowns[space.begin_of(f)->unknown] = rigid[f];
    const Eigen::VectorXd motion = space.expand(unknowns);
    for (Eigen::Index f = 0; f < motion.size(); ++f) {
      const auto freedom = static_cast<int>(f);
      if (space.begin_of(freedom) == space.end_of(freedom)) continue;  // no stiffness
      EXPECT_NEAR(motion[f], rigid[f], 1e-9);
    }
    EXPECT_LT((stiffness * unknowns).cwiseAbs().maxCoeff(), 1e-9 * stiffest * 4) << i;
    // The pin's forces do the work of their resultant at the pin.
    const Vector3 pin = model.mesh().lifting_points[0].p_BPin;
    const Vector3 moved = i < 3 ? Vector3(Vector3::Unit(i)) : Vector3::Unit(i - 3).cross(pin);
    EXPECT_LT((space.reduce(model.lug_loads()).transpose() * unknowns - moved).norm(), 1e-9);
  }
}

// Rounding: the strip is some ten thousand times as stiff along as across.
TEST(PadeyeInBlock, ForceAndMomentReachTheFoot) {
  const ElasticModel model(strip_mesh(), {3, {}});
  const Eigen::Matrix<double, 6, 3> reaction = HeldAtFoot(model).reaction();
  const Vector3 pin = model.mesh().lifting_points[0].p_BPin;
  for (int i = 0; i < 3; ++i) {
    EXPECT_LT((reaction.col(i).head<3>() + Vector3::Unit(i)).norm(), 1e-6);
    EXPECT_LT((reaction.col(i).tail<3>() + pin.cross(Vector3::Unit(i))).norm(), 1e-6);
  }
}

// The strip by Timoshenko's beam, on it the padeye that an independent model of solids has, held at
// its base. Two parts in a hundred: the foot keeps its width, and the part of the padeye takes
// another pressure on the bore (a cosine's) and a base that keeps plane by itself.
TEST(PadeyeInBlock, PinMovesAsAStripWithAPadeyeDoes) {
  const ElasticModel model(strip_mesh(), {3, {}});
  const Eigen::Matrix3d found = HeldAtFoot(model).compliance();
  const PadeyeModel padeye(strip_padeye(), test::steel(), 16);
  Eigen::Matrix3d own = Eigen::Matrix3d::Zero();  // along P's axes
  for (int i = 0; i < 3; ++i) {
    PadeyeLoad load;
    load.force = Vector3::Unit(i);
    const Eigen::VectorXd moved = padeye.solve(load).displacement;
    int nodes = 0;
    for (Eigen::Index n = 0; n < padeye.part().mesh.nodes.cols(); ++n)
      if (padeye.part().mesh.nodes.col(n).head<2>().norm() < 0.03 + 1e-9) {
        own.col(i) += moved.segment<3>(3 * n);
        ++nodes;
      }
    own.col(i) /= nodes;
  }
  const Material steel = test::steel();
  const double L = strip_length, b = strip_width, t = strip_thickness, h = 0.25;
  const double E = steel.youngs_modulus, area = b * t, shear = steel.shear_modulus() * area * 5 / 6;
  const auto bent = [&](double second_moment) {
    const double EI = E * second_moment;
    return L * L * L / (3 * EI) + h * L * L / EI + h * h * L / EI + L / shear;
  };
  const double along = L / (E * area) + own(1, 1), sideways = bent(t * b * b * b / 12) + own(0, 0),
               across = bent(b * t * t * t / 12) + own(2, 2);
  EXPECT_NEAR(found(2, 2), along, 0.02 * along);
  EXPECT_NEAR(found(0, 0), sideways, 0.02 * sideways);
  EXPECT_NEAR(found(1, 1), across, 0.02 * across);
  EXPECT_LT((found - found.transpose()).norm(), 1e-7 * found.norm());
}

// The lug of shells is a rectangle as wide as the base and pulls over all of it: its own share of
// the motion is smaller, which is most of the difference along and next to nothing in bending.
TEST(PadeyeInBlock, PinMovesALittleMoreThanThatOfShells) {
  const ElasticModel solid(strip_mesh(), {3, {}}),
      shells(generate_shell_mesh(strip_with_lug()), {3, {}});
  const Eigen::Matrix3d of_solid = HeldAtFoot(solid).compliance(),
                        of_shells = HeldAtFoot(shells).work();
  EXPECT_GT(of_solid(2, 2), of_shells(2, 2));
  EXPECT_LT(of_solid(2, 2), 1.25 * of_shells(2, 2));
  for (const int i : {0, 1}) EXPECT_NEAR(of_solid(i, i), of_shells(i, i), 0.02 * of_shells(i, i));
}

// Elements of the padeye as coarse as they may be serve the block: twice as many move the pin by
// less than half a per cent. Division of the shells below leaves the tie as it is; the plate's
// edge, on which the padeye pulls in its middle more than at its ends, gives way by a little more.
TEST(PadeyeInBlock, CompliancesStandOnFinerMeshes) {
  const ElasticModel model(strip_mesh(), {3, {}}), finer(strip_mesh(32), {3, {}});
  const Eigen::Matrix3d found = HeldAtFoot(model).compliance();
  const auto expect_near = [&](const ElasticModel& other, double share) {
    const Eigen::Matrix3d compliance = HeldAtFoot(other).compliance();
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(compliance(i, i), found(i, i), share * found(i, i)) << i;
  };
  expect_near(finer, 0.005);
  // At one end of the base alone, so that its cells are of several sizes.
  const auto divided = model.with({3, [](const Vector3& place) {
                                     const Vector3 end(0, 0, strip_length);
                                     return std::max(0.02, 0.5 * (place - end).norm());
                                   }});
  EXPECT_GT(divided->space().shells().size(), 2 * model.space().shells().size());
  expect_near(*divided, 0.02);
  const Eigen::Matrix<double, 6, 3> reaction = HeldAtFoot(*divided).reaction();
  for (int i = 0; i < 3; ++i)
    EXPECT_LT((reaction.col(i).head<3>() + Vector3::Unit(i)).norm(), 1e-6);
}

PadeyeGeometry box_padeye() { return {0.12, 0.03, 0.06, 0.057, 0.09, 0.01, 0.25, 0.4, 0.4}; }

/// The small block's lugs of these names as padeyes.
Mesh small_box(const std::vector<std::string>& solid_lugs) {
  const BlockDescription block = test::small_block();
  Mesh mesh = generate_shell_mesh(block);
  for (const Lug& lug : block.lugs)
    if (std::find(solid_lugs.begin(), solid_lugs.end(), lug.name) != solid_lugs.end())
      stand_padeye(mesh, {lug.name, box_padeye(), upright_along_y(), lug.p_BPin});
  return mesh;
}

// Main plate: base, two tangents and the arc; cheek plates: rings. Sixteen divisions are within two
// thousandths of the circles.
TEST(PadeyeInBlock, MassIsThatOfThePadeye) {
  const PadeyeGeometry g = box_padeye();
  const double to_corner = std::hypot(g.base_left, g.height);
  const double tangent = std::sqrt(to_corner * to_corner - g.radius * g.radius);
  const double arc = 2 * std::numbers::pi - 2 * std::atan2(g.base_left, g.height) -
                     2 * std::acos(g.radius / to_corner);
  const double outline =
      g.base_left * g.height + tangent * g.radius + arc * g.radius * g.radius / 2;
  const double hole = std::numbers::pi * g.hole_diameter * g.hole_diameter / 4;
  const double volume =
      (outline - hole) * g.thickness +
      2 * g.cheek_thickness * (std::numbers::pi * g.cheek_radius * g.cheek_radius - hole);
  const Mesh shells = small_box({}), mesh = small_box({"L1", "L4"});
  const double plate = 0.8 * 0.4 * 0.035;
  EXPECT_NEAR(mass_properties(mesh).mass - mass_properties(shells).mass,
              2 * 7850 * (volume - plate), 2 * 7850 * 0.002 * volume);
  for (std::size_t group = 0; group < mesh.groups.size(); ++group) {
    if (mesh.groups[group].name != "L1") continue;
    const MeshMass own = mass_by_group(mesh)[group];
    EXPECT_NEAR(own.mass, 7850 * volume, 0.002 * 7850 * volume);
    EXPECT_NEAR(own.centre.x(), 0.4, 1e-9);
    EXPECT_NEAR(own.centre.y(), 0, 1e-9);
  }
  // As stated, outfitting beside it.
  const ElasticModel model(mesh, {1, {}}, 8e3, Vector3(2.05, 1.48, 0.75));
  EXPECT_NEAR(model.mass_properties().mass, 8e3, 1e-6);
  EXPECT_LT((model.mass_properties().centre_of_mass_B - Vector3(2.05, 1.48, 0.75)).norm(), 1e-9);
  EXPECT_NEAR(model.mass_properties().steel_mass, mass_properties(mesh).mass, 1e-6);
}

/// Load cases of a free block: the unit force along an axis at a lug, balanced.
LoadCase pull_at(const ElasticModel& model, int lug, int axis) {
  LoadCase load;
  load.lug_forces_B.assign(model.lug_count(), Vector3::Zero());
  load.lug_forces_B[lug] = Vector3::Unit(axis);
  const Vector3 pin = model.mesh().lifting_points[lug].p_BPin;
  load.field = balancing_field(model.mass_properties(),
                               {Vector3::Unit(axis), pin.cross(Vector3::Unit(axis))});
  return load;
}

// Saint-Venant: three widths of the base away the strip feels the force and its moment alone.
TEST(PadeyeInBlock, StressAwayFromTheLugIsThatWithShells) {
  const ElasticModel solid(strip_mesh(), {3, {}}),
      shells(generate_shell_mesh(strip_with_lug()), {3, {}});
  const Eigen::MatrixXd of_solid = HeldAtFoot(solid).motion(),
                        of_shells = HeldAtFoot(shells).motion();
  const CheckedStress all(solid, of_solid);
  std::vector<Square> away;
  for (const Square& square : all.squares())
    if (square.centre_B.z() < strip_length - 3 * strip_width) away.push_back(square);
  ASSERT_GT(away.size(), 20U);
  // Without the padeye's solids both have the same shells below the lug, in another order.
  const CheckedStress theirs(shells, of_shells);
  const CheckedStress ours(solid, of_solid, away);
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::VectorXd a = ours.von_mises(Vector3::Unit(axis)),
                          b = theirs.von_mises(Vector3::Unit(axis));
    double largest = 0, difference = 0;
    int compared = 0;
    for (std::size_t i = 0; i < away.size(); ++i)
      for (std::size_t j = 0; j < theirs.squares().size(); ++j) {
        if ((theirs.squares()[j].centre_B - away[i].centre_B).norm() > 1e-6) continue;
        const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(j);
        largest = std::max(largest, b[column]);
        difference = std::max(difference, std::abs(a[row] - b[column]));
        ++compared;
      }
    EXPECT_GT(compared, 20);
    // Squares hold no bending, so that a pull across leaves the roundings of it in them.
    constexpr double bent = 6 * strip_length / (strip_width * strip_thickness * strip_thickness);
    EXPECT_LT(difference, 0.01 * largest + 1e-9 * bent) << "xyz"[axis];
  }
}

/// Places of what is singular in a mesh's plates, to a micrometre.
std::set<std::array<long, 3>> singular_places(const Mesh& mesh) {
  std::set<std::array<long, 3>> places;
  for (const int vertex : find_fields(mesh).singular_vertices) {
    const Vector3& p = mesh.vertices[vertex];
    if (p.z() > 2 + 1e-9) continue;  // on the lug itself
    places.insert({std::lround(1e6 * p.x()), std::lround(1e6 * p.y()), std::lround(1e6 * p.z())});
  }
  return places;
}

// The base is a joint of the plating: its toes are corners without a limit of the stress.
TEST(PadeyeInBlock, ToesAreSingularAsThoseOfShellsAre) {
  const auto of_shells = singular_places(small_box({}));
  EXPECT_EQ(of_shells.count({800000, 0, 2000000}), 1U);
  EXPECT_EQ(singular_places(small_box({"L1", "L2", "L3", "L4"})), of_shells);
}

// Of a lug of solids nothing is checked by its largest stress; plates are, and the peak is told.
TEST(PadeyeInBlock, PeaksOfSolidLugsAreNotChecked) {
  const ElasticModel model(small_box({"L1"}), {2, {}});
  const UnitResponses responses(model, 1);
  const StressRecovery recovery(responses);
  const LoadCase load = pull_at(model, 0, 2);
  const LoadCaseResult result = recovery.evaluate(load);
  const BlockEnvelope envelope =
      find_block_envelope(responses, recovery, responses.coefficients(load), 1);
  ASSERT_EQ(result.groups.size(), envelope.groups.size());
  for (std::size_t g = 0; g < result.groups.size(); ++g) {
    const GroupStress& group = result.groups[g];
    EXPECT_GT(group.peak_von_mises.value, 0) << group.group;
    EXPECT_EQ(group.checked_von_mises.part.empty(), group.group == "L1") << group.group;
    EXPECT_EQ(envelope.groups[g].checked_von_mises.instant < 0, group.group == "L1");
    EXPECT_EQ(envelope.groups[g].at_site[SquareSite::field].instant < 0, group.group == "L1");
  }
}

// What of a lug lies within its pad is an insert of the lug's thickness, and stays.
TEST(PadeyeInBlock, WhatLiesWithinThePadStays) {
  BlockDescription block = test::small_block();
  block.lugs[0].extent[2].lower = 1.7;
  Mesh mesh = generate_shell_mesh(block);
  stand_padeye(mesh, {"L1", box_padeye(), upright_along_y(), block.lugs[0].p_BPin});
  double area_of_lug = 0;
  for (const Shell& shell : mesh.shells)
    if (mesh.regions[shell.region].is_lug && mesh.group_of_region(shell.region).name == "L1") {
      area_of_lug += area(mesh, shell);
      for (const int vertex : shell.vertices) EXPECT_LT(mesh.vertices[vertex].z(), 2 + 1e-9);
    }
  EXPECT_NEAR(area_of_lug, 0.8 * 0.3, 1e-9);
  const ElasticModel model(std::move(mesh), {1, {}});
  const UnitResponses responses(model, 1);
  EXPECT_LT(responses.balance(pull_at(model, 0, 1)).reaction_over_weight, 1e-8);
}

std::string refusal_of(const BlockDescription& block, const PadeyeInBlock& padeye) {
  Mesh mesh = generate_shell_mesh(block);
  try {
    stand_padeye(mesh, padeye);
  } catch (const ModelError& error) {
    return error.what();
  }
  return {};
}

TEST(PadeyeInBlock, RefusesWhatHasNoRoom) {
  const BlockDescription box = test::small_block();
  const PadeyeInBlock good{"L1", box_padeye(), upright_along_y(), box.lugs[0].p_BPin};
  EXPECT_EQ(refusal_of(box, good), "");
  PadeyeInBlock wrong = good;
  wrong.lug = "L9";
  EXPECT_THAT(refusal_of(box, wrong), HasSubstr("there is no lug L9"));
  // A bracket beside the lug would hang in the air.
  BlockDescription braced = box;
  braced.plates.push_back({"bracket", Axis::x, {0.8}, {{{}, {0, 0.3}, {2, 2.4}}}, 0.012, "AH36"});
  EXPECT_THAT(refusal_of(braced, good),
              HasSubstr("lug L1 cannot be a solid: bracket at x = 0.8 m is joined to its plate"));
  // A base that reaches beyond the plating, and one that the plating does not reach.
  wrong = good;
  wrong.geometry.base_right = 0.5;  // against x
  EXPECT_THAT(refusal_of(box, wrong), HasSubstr("no plate lies below its base at (-0.1, 0, 2) m"));
  wrong = good;
  wrong.geometry.height = 0.15;
  EXPECT_THAT(refusal_of(box, wrong), HasSubstr("its plate is not divided at the padeye's base"));
  wrong = good;
  wrong.geometry.cheek_radius = 0.2;
  EXPECT_THAT(refusal_of(box, wrong), HasSubstr("reaches beyond the main plate"));
}

}  // namespace
}  // namespace blocklift::structure
