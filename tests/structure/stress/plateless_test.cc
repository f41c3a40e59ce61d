// Blocks of bars alone and of solids alone: stress, envelope, error of the mesh.
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "structure/accuracy/accuracy.h"
#include "structure/accuracy/block_error.h"
#include "structure/envelope/block_envelope.h"
#include "structure/error.h"
#include "structure/formulation/solid.h"
#include "structure/mesh/directional.h"
#include "structure/mesh/solid_shape.h"
#include "structure/stress/stress.h"

namespace blocklift::structure {
namespace {

constexpr double gravity = 9.81;
const Material plateless_steel{"steel", 206e9, 0.3, 7850, 235e6};

/// The load case of a block that hangs at rest on vertical ropes with equal forces.
LoadCase hanging_at_rest(const ElasticModel& model) {
  LoadCase load_case{"at rest", {}, {}};
  load_case.field.acceleration_less_gravity = Vector3(0, 0, gravity);
  const double share = model.mass_properties().mass * gravity / model.lug_count();
  load_case.lug_forces_B.assign(model.lug_count(), {0, 0, share});
  return load_case;
}

constexpr double frame_length = 6, frame_width = 2, square_side = 0.1;

/// Two bars of two elements each along x, hung at their ends, which two cross bars join; these have
/// next to no stiffness in torsion, so that the long bars' ends turn as on hinges.
Mesh frame() {
  Mesh mesh;
  mesh.materials = {plateless_steel};
  mesh.groups = {{"long bars"}, {"cross bars"}};
  mesh.regions = {{.name = "long bars", .group = 0}, {.name = "cross bars", .group = 1}};
  const double a = square_side, second = std::pow(a, 4) / 12;
  BeamSection section;
  section.name = "square";
  section.area = a * a;
  section.second_moment_2 = section.second_moment_3 = second;
  section.torsion = 1e-6 * second;
  section.shear_area_2 = section.shear_area_3 = 5.0 / 6 * a * a;
  section.stress_points = {{a / 2, a / 2}, {a / 2, -a / 2}, {-a / 2, a / 2}, {-a / 2, -a / 2}};
  mesh.beam_sections = {section};
  for (const double y : {0.0, frame_width})
    for (const double x : {0.0, frame_length / 2, frame_length})
      mesh.vertices.emplace_back(x, y, 0);
  const auto bar = [&](int from, int to, int region) {
    Beam beam;
    beam.vertices = {from, to};
    beam.region = region;
    mesh.beams.push_back(beam);
  };
  for (const int row : {0, 3})
    for (const int i : {0, 1}) bar(row + i, row + i + 1, 0);
  bar(0, 3, 1);
  bar(2, 5, 1);
  for (const int vertex : {0, 2, 3, 5})
    mesh.lifting_points.push_back({.name = "L" + std::to_string(vertex),
                                   .p_BPin = mesh.vertices[vertex],
                                   .radius = 0.5,
                                   .vertex = vertex});
  return mesh;
}

// A bar on hinges under its own weight q: M = q L^2 / 8, sigma = M / W, and the middle sinks by 5 q
// L^4 / (384 E I) + q L^2 / (8 G A_s). What the torsion of the cross bars holds is 1e-6 of it.
TEST(BlocksWithoutPlates, BarsOfAHangingFrame) {
  const ElasticModel model(frame(), {.degree = 2, .largest_edge = {}}, {}, {});
  const UnitResponses responses(model);
  const StressRecovery recovery(responses);
  EXPECT_TRUE(recovery.checked().squares().empty());
  const LoadCase load_case = hanging_at_rest(model);
  const LoadCaseResult result = recovery.evaluate(load_case);
  const double a = square_side, q = plateless_steel.density * gravity * a * a;
  const double stress = q * frame_length * frame_length / 8 / (a * a * a / 6);
  EXPECT_NEAR(result.checked_von_mises.value, stress, 1e-5 * stress);
  EXPECT_EQ(result.checked_von_mises.part, "long bars");
  EXPECT_NEAR(result.checked_von_mises.point_B.x(), frame_length / 2, 1e-9);
  EXPECT_EQ(result.groups[0].checked_von_mises.value, result.checked_von_mises.value);

  const Eigen::Matrix3Xd moved = responses.elastic_displacement(load_case);
  const auto sinks = [&](int vertex) { return moved(2, model.space().node_of_vertex(vertex)); };
  const double inertia = std::pow(a, 4) / 12, shear = 5.0 / 6 * a * a;
  const double length_2 = frame_length * frame_length;
  const double sag = q * length_2 *
                     (5 * length_2 / (384 * plateless_steel.youngs_modulus * inertia) +
                      1 / (8 * plateless_steel.shear_modulus() * shear));
  EXPECT_NEAR(sinks(0) - sinks(1), sag, 1e-5 * sag);
  EXPECT_GT(result.displacement.value, 0);

  Eigen::MatrixXd factors(responses.count(), 2);
  factors << responses.coefficients(load_case), 1.25 * responses.coefficients(load_case);
  const BlockEnvelope envelope = find_block_envelope(responses, recovery, factors);
  EXPECT_NEAR(envelope.checked_von_mises.value, 1.25 * stress, 1e-5 * stress);
  EXPECT_EQ(envelope.checked_von_mises.instant, 1);
  EXPECT_EQ(estimate_block_error(model, responses.displacement(load_case)).relative, 0);
}

// Two bars that rods join slide along each other: rounding leaves this no stiffness, or hardly any.
TEST(BlocksWithoutPlates, MechanismsAreRefused) {
  Mesh ladder = frame();
  for (Beam& beam : ladder.beams)
    if (beam.region == 1) beam.is_rod = true;
  for (const double tilt : {0.0, 0.3, 1.1}) {
    Mesh turned = ladder;
    for (Vector3& place : turned.vertices)
      place = Eigen::AngleAxisd(tilt, Vector3(1, 2, 3).normalized()) * place;
    for (LiftingPoint& lug : turned.lifting_points) lug.p_BPin = turned.vertices[lug.vertex];
    const ElasticModel model(std::move(turned), {.degree = 2, .largest_edge = {}}, {}, {});
    try {
      const UnitResponses responses(model);
      FAIL() << tilt;
    } catch (const ModelError& error) {
      EXPECT_NE(std::string(error.what()).find("the block is a mechanism"), std::string::npos)
          << error.what();
    }
  }
}

TEST(BlocksWithoutPlates, AreNotRefined) {
  auto model = std::make_unique<ElasticModel>(frame(), Resolution{.degree = 2, .largest_edge = {}},
                                              std::nullopt, std::nullopt);
  const int unknowns = model->space().unknowns();
  int calls = 0;
  const RefinedBlock refined = refine_checked_stress(
      std::move(model), nullptr,
      [&](const ElasticModel& of, UnitResponses& responses) {
        ++calls;
        const Eigen::MatrixXd factors = responses.coefficients(hanging_at_rest(of));
        return LoadFactors{factors, factors};
      },
      {});
  EXPECT_EQ(refined.model->space().unknowns(), unknowns);
  EXPECT_TRUE(refined.responses);
  EXPECT_TRUE(refined.accuracy.steps.empty());
  EXPECT_EQ(calls, 1);
}

/// A slab 4 x 2 x 0.4 m of n times (4 x 2 x 1) hexahedra on four lugs at its upper corners.
Mesh slab(int n) {
  Mesh mesh;
  mesh.materials = {plateless_steel};
  mesh.groups = {{"slab"}};
  mesh.regions = {{.name = "slab"}};
  const std::array<int, 3> cells{4 * n, 2 * n, n};
  const Vector3 size(4, 2, 0.4);
  for (int k = 0; k <= cells[2]; ++k)
    for (int j = 0; j <= cells[1]; ++j)
      for (int i = 0; i <= cells[0]; ++i)
        mesh.vertices.push_back(Vector3(i, j, k)
                                    .cwiseQuotient(Vector3(cells[0], cells[1], cells[2]))
                                    .cwiseProduct(size));
  const auto vertex = [&](int i, int j, int k) {
    return (k * (cells[1] + 1) + j) * (cells[0] + 1) + i;
  };
  SolidEdgeMiddles middles(mesh);
  for (int k = 0; k < cells[2]; ++k)
    for (int j = 0; j < cells[1]; ++j)
      for (int i = 0; i < cells[0]; ++i) {
        Solid solid;
        for (const int z : {k, k + 1})
          for (const auto& [x, y] : std::initializer_list<std::pair<int, int>>{
                   {i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}})
            solid.vertices.push_back(vertex(x, y, z));
        complete_solid(mesh, solid, middles);
        mesh.solids.push_back(std::move(solid));
      }
  return mesh;
}

// A smooth motion, bending of the slab, as each mesh interpolates it: the estimated error of
// quadratic solids falls with the square of their size, and comes near the true one.
TEST(BlocksWithoutPlates, EstimatedErrorOfSolidsFollowsTheTrueOne) {
  // u = (sin(k x) z, 0, cos(k x) / k), whose strain is e_xx = k cos(k x) z alone.
  const double k = 1.5;
  const Material& m = plateless_steel;
  const Elasticity compliance = isotropic_elasticity(m).inverse();
  double before = 0;
  for (const int n : {1, 2, 4}) {
    Mesh mesh = slab(n);
    for (const int v : {0, 4 * n, 4 * n * (2 * n + 1)})
      mesh.lifting_points.push_back({.name = "L", .p_BPin = mesh.vertices[v], .vertex = v});
    const ElasticModel model(std::move(mesh), {.degree = 2, .largest_edge = {}}, {}, {});
    const Space& space = model.space();
    Eigen::VectorXd motion = Eigen::VectorXd::Zero(model.freedoms());
    for (Eigen::Index node = 0; node < space.node_count(); ++node) {
      const Vector3 x = space.nodes().col(node);
      motion.segment<3>(6 * node) =
          1e-3 * Vector3(std::sin(k * x.x()) * x.z(), 0, std::cos(k * x.x()) / k);
    }
    double error = 0, norm = 0;
    for (int s = 0; s < static_cast<int>(model.mesh().solids.size()); ++s) {
      const Solid& solid = model.mesh().solids[s];
      const Eigen::VectorXd own = solid_stresses(space, s, motion);
      const auto points = solid_points(model.mesh(), solid);
      for (std::size_t q = 0; q < points.size(); ++q) {
        const Vector3& x = points[q].place;
        const double strain = 1e-3 * k * std::cos(k * x.x()) * x.z();
        Stress exact = Stress::Zero();
        exact.head<3>().setConstant(m.lame_lambda() * strain);
        exact[0] += 2 * m.shear_modulus() * strain;
        const Stress s_h = own.segment<6>(6 * static_cast<Eigen::Index>(q));
        error += points[q].weight * (exact - s_h).dot(compliance * (exact - s_h));
        norm += points[q].weight * s_h.dot(compliance * s_h);
      }
    }
    const double exact = std::sqrt(error / (error + norm));
    const BlockError found = estimate_block_error(model, motion);
    EXPECT_GT(found.relative, 0.5 * exact) << n;
    EXPECT_LT(found.relative, 2 * exact) << n;
    if (before > 0) {
      EXPECT_NEAR(std::log2(before / found.relative), 2, 0.4) << n;
    }
    before = found.relative;
    EXPECT_EQ(found.worst_part, "slab");
    // Sums of the same terms in another order.
    EXPECT_NEAR(found.of_groups.front(), found.relative, 1e-14 * found.relative);
  }
}

}  // namespace
}  // namespace blocklift::structure
