#include "structure/system/matter.h"

#include <cmath>
#include <memory>
#include <string>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "pipeline/verification/models/shells/shell_models.h"
#include "structure/error.h"
#include "structure/mesh/mass_properties.h"
#include "structure/system/mass_distribution.h"

namespace blocklift::structure {
namespace {

constexpr double exact = 1e-12;  // of the figure; sums of some hundred terms

Eigen::Matrix3d box_inertia(double mass, const Vector3& sides) {
  const Vector3 squares = sides.cwiseAbs2() * mass / 12;
  return Vector3(squares.y() + squares.z(), squares.z() + squares.x(), squares.x() + squares.y())
      .asDiagonal();
}

Mesh plate(double offset) {
  Mesh mesh = examples::sheet_mesh([](double x, double y) { return Vector3(3 * x, 2 * y, 0.4); }, 2,
                                   2, 0.1, examples::plain_steel());
  mesh.shell_sections[0].offset = offset;
  return mesh;
}

TEST(Matter, PlateIsABox) {
  for (const double offset : {0.0, 0.25}) {
    const Mesh mesh = plate(offset);
    const Space space(mesh, {2, {}});
    const MassProperties mass = find_mass_properties(space, nullptr, nullptr);
    const double expected = 7850 * 3 * 2 * 0.1;
    EXPECT_NEAR(mass.mass, expected, exact * expected);
    EXPECT_LT((mass.centre_of_mass_B - Vector3(1.5, 1, 0.4 + offset)).norm(), exact);
    const Eigen::Matrix3d inertia = box_inertia(expected, {3, 2, 0.1});
    EXPECT_LT((mass.inertia_BBcm_B - inertia).norm(), exact * inertia.norm());
  }
}

// A bar along a curved edge is as long as the edge, for the stock-taking of a mesh as for its
// elements of degree 2: a parabola of rise f over a chord l,
//   s = l / 2 (sqrt(1 + k^2) + asinh(k) / k), k = 4 f / l,
// of which three points of Gauss' rule miss 1.7e-5 here.
TEST(Matter, BeamAlongACurvedEdgeIsAsLongAsTheEdge) {
  for (const bool is_reversed : {false, true})
    for (const Vector3& offset : {Vector3(0, 0, 0), Vector3(0, 0.3, 0)}) {
      Mesh mesh = examples::empty_mesh(examples::plain_steel(), 0.01);
      const double chord = 2, rise = 0.25, k = 4 * rise / chord;
      mesh.vertices = {{0, 0, 0}, {chord, 0, 0}, {0, 3, 0}, {chord, 3, 0}};
      Shell shell;
      shell.vertices = {0, 1, 2, 3};
      shell.curvature = 0;
      mesh.shells = {shell};
      Eigen::Matrix3Xd points(3, 9);
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) points.col(3 * j + i) << i, 1.5 * j, i == 1 ? rise : 0;
      mesh.curved_shells = {points};
      // Mass and first moments, by either.
      using Sums = Eigen::Vector4d;
      const auto sums_of_mesh = [&] {
        const MeshMass stock = mass_properties(mesh);
        return Sums(stock.mass, stock.mass * stock.centre[0], stock.mass * stock.centre[1],
                    stock.mass * stock.centre[2]);
      };
      const auto sums_of_elements = [&] {
        const MassProperties mass = find_mass_properties(Space(mesh, {2, {}}), nullptr, nullptr);
        const Vector3 first = mass.mass * mass.centre_of_mass_B;
        return Sums(mass.mass, first[0], first[1], first[2]);
      };
      const Sums shells_of_mesh = sums_of_mesh(), shells_of_elements = sums_of_elements();
      BeamSection section;
      section.area = 0.02;
      section.second_moment_2 = section.second_moment_3 = 1e-5;
      section.torsion = 1e-5;
      section.shear_area_2 = section.shear_area_3 = 0.01;
      mesh.beam_sections = {section};
      Beam beam;
      beam.vertices = {is_reversed ? 3 : 2, is_reversed ? 2 : 3};
      beam.offset = {offset, offset};
      mesh.beams = {beam};
      const double length = chord / 2 * (std::sqrt(1 + k * k) + std::asinh(k) / k);
      const Sums of_mesh = sums_of_mesh() - shells_of_mesh,
                 of_elements = sums_of_elements() - shells_of_elements;
      EXPECT_NEAR(of_mesh[0], 7850 * 0.02 * length, 1e-4 * 7850 * 0.02 * length);
      EXPECT_LT((of_elements - of_mesh).norm(), 1e-10 * of_mesh.norm());
    }
}

TEST(Matter, BeamCarriesItsSectionsMoments) {
  Mesh mesh = examples::empty_mesh(examples::plain_steel(), 0.01);
  // A bar of 0.2 (axis 2 = y) by 0.6 (axis 3 = z), beside its vertices.
  BeamSection section;
  section.area = 0.12;
  section.second_moment_2 = 0.2 * std::pow(0.6, 3) / 12;
  section.second_moment_3 = 0.6 * std::pow(0.2, 3) / 12;
  section.torsion = 1e-3;
  section.shear_area_2 = section.shear_area_3 = 0.1;
  mesh.beam_sections = {section};
  mesh.vertices = {{0, 0, 0}, {4, 0, 0}};
  examples::add_beams(mesh, {0, 0, 0}, {4, 0, 0}, 0, Vector3::UnitY(), {0, 0.5, -0.7});
  const Space space(mesh, {2, {}});
  const MassProperties mass = find_mass_properties(space, nullptr, nullptr);
  const double expected = 7850 * 4 * 0.12;
  EXPECT_NEAR(mass.mass, expected, exact * expected);
  EXPECT_LT((mass.centre_of_mass_B - Vector3(2, 0.5, -0.7)).norm(), exact);
  const Eigen::Matrix3d inertia = box_inertia(expected, {4, 0.2, 0.6});
  EXPECT_LT((mass.inertia_BBcm_B - inertia).norm(), exact * inertia.norm());
}

TEST(Matter, PointMassCarriesItsInertia) {
  Mesh mesh = plate(0);
  PointMass mass;
  mass.vertex = 0;
  mass.mass = 500;
  mass.offset = {0.3, -0.2, 1};
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.4, Vector3(1, 1, 2).normalized()).toRotationMatrix();
  mass.inertia = turn * box_inertia(500, {1, 2, 0.5}) * turn.transpose();
  mesh.masses = {mass};
  mesh.materials[0].density = 1e-9;
  const Space space(mesh, {2, {}});
  const MassProperties found = find_mass_properties(space, nullptr, nullptr);
  EXPECT_NEAR(found.mass, 500, 1e-8);
  EXPECT_LT((found.centre_of_mass_B - (mesh.vertices[0] + mass.offset)).norm(), 1e-8);
  EXPECT_LT((found.inertia_BBcm_B - mass.inertia).norm(), 1e-8 * mass.inertia.norm());
}

// Half a cylinder's shell of radius r: area pi r l, centre at 2 r / pi, polar moment m (r^2 + t^2 /
// 4) (the two heights carry t^2 / 12 across; its area's change through the thickness is not in a
// shell). By isoparametric cells of degree 4 over 22.5 degrees the circle's error is 1e-7.
TEST(Matter, HalfACylinder) {
  const double r = 2, l = 3, t = 0.1;
  const Mesh mesh = examples::sheet_mesh(
      [&](double x, double y) {
        return Vector3(r * std::cos(M_PI * x), l * y, r * std::sin(M_PI * x));
      },
      8, 2, t, examples::plain_steel(), 4);
  const Space space(mesh, {4, {}});
  const MassProperties mass = find_mass_properties(space, nullptr, nullptr);
  const double expected = 7850 * M_PI * r * l * t;
  EXPECT_NEAR(mass.mass, expected, 1e-6 * expected);
  EXPECT_LT((mass.centre_of_mass_B - Vector3(0, l / 2, 2 * r / M_PI)).norm(), 1e-6);
  const double polar = expected * (r * r + t * t / 12 - std::pow(2 * r / M_PI, 2));
  EXPECT_NEAR(mass.inertia_BBcm_B(1, 1), polar, 1e-6 * polar);
}

Mesh everything() {
  Mesh mesh = plate(0.2);
  BeamSection section;
  section.area = 0.01;
  section.second_moment_2 = 1e-5;
  section.second_moment_3 = 2e-5;
  section.torsion = 1e-5;
  section.shear_area_2 = section.shear_area_3 = 0.008;
  mesh.beam_sections = {section};
  examples::add_beams(mesh, {0, 1, 0.4}, {3, 1, 0.4}, 0, Vector3::UnitY(), {0, 0, -0.3});
  PointMass mass;
  mass.vertex = 2;
  mass.mass = 300;
  mass.offset = {0, 0.5, 1};
  mass.inertia = box_inertia(300, {1, 1, 2});
  PointMass other = mass;
  other.vertex = 6;
  other.mass = 200;
  mesh.masses = {mass, other};
  return mesh;
}

// Each row of the loads is summed in one order, whatever the threads: shells that were divided to
// different depths, with a beam and point masses at their vertices.
TEST(Matter, ThreadsChangeNoDigit) {
  const Mesh mesh = everything();
  const Space space(mesh, {3, [](const Vector3& place) { return place.x() < 1 ? 0.1 : 0.6; }});
  const Matter matter(space, 3), by_one(space, 1);
  const MassProperties mass = find_mass_properties(matter, nullptr, nullptr);
  EXPECT_EQ(mass.mass, find_mass_properties(by_one, nullptr, nullptr).mass);
  EXPECT_EQ(mass.centre_of_mass_B, find_mass_properties(by_one, nullptr, nullptr).centre_of_mass_B);
  const Eigen::MatrixXd loads = inertia_loads(by_one, mass, 1);
  EXPECT_EQ(inertia_loads(matter, mass, 3), loads);
  Eigen::MatrixXd in_turn = Eigen::MatrixXd::Zero(space.freedoms(), 1);
  for_each_matter_point(space, [&](const MatterPoint& p) {
    add_forces(p, Vector3(-p.mass * mass.density_factor(p.place) * Vector3::UnitX()), in_turn);
  });
  EXPECT_EQ(in_turn.col(0), loads.col(0));
}

// Paint and outfit of sections weigh as the steel does, of tapered plates and beams too. Plates: 6
// m2 of 0.1 m at one side and 0.2 m at the other, and 12 kg/m2. Beams: 3 m of 0.01 m2, and each
// piece's 20 kg/m at one end and 40 kg/m at the other.
TEST(Matter, MassBeyondTheSectionsIsMass) {
  Mesh mesh = everything();
  mesh.shell_sections[0].mass_per_area = 12;
  mesh.shell_tapers = {{0.1, 0.2, 0.1, 0.2}};
  for (Shell& shell : mesh.shells) shell.taper = 0;
  mesh.beam_sections[0].mass_per_length = 20;
  mesh.beam_sections.push_back(mesh.beam_sections[0]);
  mesh.beam_sections[1].mass_per_length = 40;
  for (Beam& beam : mesh.beams) beam.end_section = 1;
  const double total = 6 * (7850 * 0.15 + 12) + 3 * (7850 * 0.01 + 30) + 500;
  const MeshMass before = mass_properties(mesh);
  EXPECT_NEAR(before.mass, total, exact * total);
  const Space space(mesh, {2, {}});
  const MassProperties mass = find_mass_properties(space, nullptr, nullptr);
  EXPECT_NEAR(mass.mass, total, exact * total);
  EXPECT_LT((mass.centre_of_mass_B - before.centre).norm(), exact);
  const Eigen::MatrixXd weight = inertia_loads(space, mass).leftCols<1>();
  EXPECT_NEAR(resultant(space, weight).force.x(), -total, exact * total);
}

// A plate of no density that bears 40 kg/m2, and a beam of no area that bears 5 kg/m.
TEST(Matter, SectionsMayHaveNoMassOfTheirOwn) {
  Mesh mesh = everything();
  mesh.materials[0].density = 0;
  mesh.masses.clear();
  mesh.shell_sections[0].mass_per_area = 40;
  mesh.beam_sections[0].area = 0;
  mesh.beam_sections[0].mass_per_length = 5;
  const Space space(mesh, {2, {}});
  const MassProperties mass = find_mass_properties(space, nullptr, nullptr);
  EXPECT_NEAR(mass.mass, 6 * 40 + 3 * 5, exact * 255);
  EXPECT_TRUE(mass.inertia_BBcm_B.allFinite());
}

TEST(MassDistribution, GivesAnyStatedMassWithoutTheElements) {
  const Mesh mesh = everything();
  auto space = std::make_unique<Space>(mesh, Resolution{2, {}});
  const double stated = 9000;
  const Vector3 centre(1.6, 1.02, 0.6);
  const MassProperties as_stated = find_mass_properties(*space, &stated, &centre);
  const MassProperties of_steel = find_mass_properties(*space, nullptr, nullptr);
  const MassDistribution distribution{Matter(*space)};
  space.reset();
  const MassProperties found = distribution.with(&stated, &centre);
  EXPECT_EQ(found.mass, as_stated.mass);
  EXPECT_EQ(found.centre_of_mass_B, as_stated.centre_of_mass_B);
  EXPECT_EQ(found.inertia_BBcm_B, as_stated.inertia_BBcm_B);
  EXPECT_EQ(found.factor_beta, as_stated.factor_beta);
  EXPECT_EQ(found.smallest_density_factor, as_stated.smallest_density_factor);
  EXPECT_NEAR(found.mass, stated, exact * stated);
  EXPECT_EQ(distribution.with(nullptr, nullptr).inertia_BBcm_B, of_steel.inertia_BBcm_B);
  const Vector3 far(40, 1, 0.4);
  EXPECT_THROW(distribution.with(&stated, &far), ModelError);
}

// Along a plate of the length l the density is 1 + 12 d (x - l / 2) / l^2 of the mean for a centre
// d beside the middle: it is zero at an end for d = l / 6, 0.5 m here, whatever the mass.
TEST(MassDistribution, SaysHowFarTheCentreMayBeStatedWhateverTheMass) {
  const Mesh mesh = plate(0);
  const MassDistribution distribution{Matter(Space(mesh, {2, {}}))};
  const Vector3 too_far(2.4, 1, 0.4), possible(1.995, 1, 0.4);
  for (const double stated : {1e3, 1e6}) {
    EXPECT_GT(distribution.with(&stated, &possible).smallest_density_factor, 0);
    try {
      distribution.with(&stated, &too_far);
      FAIL() << "the density would be negative";
    } catch (const ModelError& error) {
      const std::string text = error.what();
      EXPECT_NE(text.find("may lie as far as (1.995, 1.000, 0.400) m"), std::string::npos) << text;
      EXPECT_EQ(text.find("more mass"), std::string::npos) << text;
    }
  }
}

// d'Alembert: the loads' resultant is that of the whole mass as one rigid body,
// F = -m (a + alpha x c + omega x (omega x c)), and so is the moment, for a stated mass and
// centre too.
TEST(Matter, InertiaLoadsHaveTheRigidBodysResultant) {
  const Mesh mesh = everything();
  const Space space(mesh, {2, {}});
  const double stated = 9000;
  const Vector3 centre(1.6, 1.02, 0.6);
  for (const bool is_stated : {false, true}) {
    const MassProperties mass =
        find_mass_properties(space, is_stated ? &stated : nullptr, is_stated ? &centre : nullptr);
    if (is_stated) {
      EXPECT_NEAR(mass.mass, stated, exact * stated);
      EXPECT_LT((mass.centre_of_mass_B - centre).norm(), 1e-10);
    }
    const Vector3 a(1, -2, 9), alpha(0.3, 0.2, -0.1), omega(0.4, -0.3, 0.5);
    const InertiaField field = InertiaField::moving(a, Vector3::Zero(), alpha, omega);
    const Eigen::VectorXd load = inertia_loads(space, mass) * field.coefficients();
    const Wrench found = resultant(space, load);
    const Vector3 c = mass.centre_of_mass_B;
    const Vector3 force = -mass.mass * (a + alpha.cross(c) + omega.cross(omega.cross(c)));
    const Eigen::Matrix3d& inertia = mass.inertia_BBcm_B;
    const Vector3 moment = c.cross(force) - inertia * alpha - omega.cross(Vector3(inertia * omega));
    EXPECT_LT((found.force - force).norm(), 1e-11 * force.norm());
    EXPECT_LT((found.moment - moment).norm(), 1e-11 * moment.norm());
  }
}

// M a for a rigid acceleration is minus the inertia load of it; the kinetic energy of a rigid
// motion is the body's.
TEST(Matter, MassMatrixAgreesWithTheInertiaLoads) {
  const Mesh mesh = everything();
  const Space space(mesh, {3, {}});
  const MassProperties mass = find_mass_properties(space, nullptr, nullptr);
  Eigen::MatrixXd rigid = Eigen::MatrixXd::Zero(space.freedoms(), 6);
  for (int n = 0; n < space.node_count(); ++n)
    for (int c = 0; c < 3; ++c) {
      rigid(6 * n + c, c) = rigid(6 * n + 3 + c, 3 + c) = 1;
      rigid.block<3, 1>(6 * n, 3 + c) = Vector3::Unit(c).cross(Vector3(space.nodes().col(n)));
    }
  const Eigen::MatrixXd forces = mass_matrix(space, mass) * rigid;
  const Eigen::MatrixXd loads = inertia_loads(space, mass).leftCols<6>();
  EXPECT_LT((forces + loads).norm(), 1e-12 * loads.norm());
  const Eigen::Matrix<double, 6, 6> energy = rigid.transpose() * forces;
  EXPECT_NEAR(energy(0, 0), mass.mass, exact * mass.mass);
  const Vector3 c = mass.centre_of_mass_B;
  const Eigen::Matrix3d about_origin =
      mass.inertia_BBcm_B +
      mass.mass * (c.squaredNorm() * Eigen::Matrix3d::Identity() - c * c.transpose());
  EXPECT_LT((energy.bottomRightCorner<3, 3>() - about_origin).norm(), 1e-11 * about_origin.norm());
}

TEST(Matter, SpreadWrenchesHaveExactResultants) {
  const Mesh mesh = everything();
  const Space space(mesh, {2, [](const Vector3& x) { return x.x() < 1 ? 0.3 : 2; }});
  std::vector<int> cells;
  for (int cell = 0; cell < static_cast<int>(space.shells().size()); ++cell)
    if (space.place(cell, {0.5, 0.5}).x() < 1.2) cells.push_back(cell);
  const Vector3 pin(0.7, 0.3, 2);
  const Eigen::MatrixXd wrenches = Eigen::MatrixXd::Identity(6, 6) * 1e6;
  const Eigen::MatrixXd loads = spread_wrenches(space, cells, pin, wrenches);
  for (int k = 0; k < 6; ++k) {
    const Wrench found = resultant(space, loads.col(k));
    EXPECT_LT((found.force - wrenches.col(k).head<3>()).norm(), 1e-12 * 1e6);
    EXPECT_LT((found.moment - pin.cross(found.force) - wrenches.col(k).tail<3>()).norm(),
              1e-10 * 1e6);
  }
  EXPECT_THROW(spread_wrenches(space, {}, pin, wrenches), ModelError);
}

TEST(Matter, DensityBelowZeroIsRefused) {
  const Mesh mesh = plate(0);
  const Space space(mesh, {2, {}});
  const double stated = 5000;
  const Vector3 far(2.9, 1, 0.4);
  EXPECT_THROW(find_mass_properties(space, &stated, &far), ModelError);
}

}  // namespace
}  // namespace blocklift::structure
