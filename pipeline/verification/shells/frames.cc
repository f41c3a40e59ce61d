#include <array>
#include <cmath>
#include <limits>

#include <Eigen/LU>
#include <fmt/format.h>

#include "pipeline/verification/models/shells/shell_models.h"
#include "pipeline/verification/shells/shell_cases.h"
#include "structure/system/matter.h"
#include "structure/system/natural_modes.h"

namespace blocklift::pipeline {
namespace {

using namespace structure;

BeamSection pipe() {  // 0.2 m by 8 mm, thin
  BeamSection section;
  const double r = 0.096, t = 0.008;
  section.area = 2 * M_PI * r * t;
  section.second_moment_2 = section.second_moment_3 = M_PI * r * r * r * t;
  section.torsion = 2 * M_PI * r * r * r * t;
  section.shear_area_2 = section.shear_area_3 = section.area / 2;
  return section;
}

Mesh frame(const std::vector<Vector3>& vertices, const std::vector<std::array<int, 2>>& beams) {
  Mesh mesh = examples::empty_mesh(examples::plain_steel(), 0.01);
  mesh.beam_sections = {pipe()};
  mesh.vertices = vertices;
  for (const std::array<int, 2>& ends : beams) {
    Beam beam;
    beam.vertices = ends;
    beam.axis_2 = Vector3(0.1, 1, 0.2);
    beam.label = static_cast<long>(mesh.beams.size()) + 1;
    mesh.beams.push_back(beam);
  }
  return mesh;
}

struct Pull {
  int vertex;
  Vector3 force;
};

Eigen::VectorXd solve(const Space& space, const std::vector<int>& clamped,
                      const std::vector<Pull>& pulls) {
  std::vector<FixedUnknown> fixed;
  for (const int vertex : clamped) {
    const Vector3 place = space.mesh().vertices[vertex];
    examples::hold(
        space, [&](const Vector3& p) { return (p - place).norm() < 1e-9; }, {0, 1, 2, 3, 4, 5},
        fixed);
  }
  Eigen::VectorXd load = Eigen::VectorXd::Zero(space.freedoms());
  for (const Pull& pull : pulls)
    load.segment<3>(6 * space.node_of_vertex(pull.vertex)) += pull.force;
  return examples::solve(space, load, fixed);
}

constexpr double rounding = 1e-7;

VerificationCase beams() {
  return {.name = "beams",
          .stage = "structure",
          .source = "Timoshenko's beam in closed form",
          .compute = [] {
            std::vector<VerificationRow> rows;
            const BeamSection s = pipe();
            const Material m = examples::plain_steel();
            const auto deflection = [&](double force, double length) {
              return force * (std::pow(length, 3) / (3 * m.youngs_modulus * s.second_moment_2) +
                              length / (m.shear_modulus() * s.shear_area_2));
            };
            for (const int degree : {1, 3}) {
              const Mesh cantilever = frame({{0, 0, 0}, {1, 2, 2}}, {{0, 1}});
              const Space space(cantilever, {degree, {}});
              const Vector3 across = Vector3(0, 1, -1).normalized();
              const Eigen::VectorXd motion = solve(space, {0}, {{1, 1000 * across}});
              const double theory = deflection(1000, 3);
              rows.push_back(compare(
                  fmt::format("cantilever, beams along plates of degree {}", degree), "m", theory,
                  across.dot(Vector3(motion.segment<3>(6 * space.node_of_vertex(1)))),
                  rounding * theory));
            }
            Mesh hinged = frame({{0, 0, 0}, {2, 0, 0}, {5, 0, 0}}, {{0, 1}, {1, 2}});
            hinged.beams[0].release[1] = {false, false, false, false, true, true};
            const Space space(hinged, {3, {}});
            const Eigen::VectorXd motion = solve(space, {0, 2}, {{1, {0, 0, 1000}}});
            const double theory = 1 / (1 / deflection(1000, 2) + 1 / deflection(1000, 3));
            rows.push_back(compare("two cantilevers joined by a hinge", "m", theory,
                                   motion[6 * space.node_of_vertex(1) + 2], rounding * theory));
            return rows;
          }};
}

VerificationCase truss() {
  return {.name = "truss",
          .stage = "structure",
          .source = "equilibrium of the joint by hand",
          .compute = [] {
            const std::vector<Vector3> places{
                {-1, 0.3, 0}, {1.2, 0.5, 0.1}, {0.1, -1, -0.2}, {0.2, 0.1, 1.5}};
            Mesh mesh = frame(places, {{0, 3}, {1, 3}, {2, 3}});
            for (Beam& beam : mesh.beams) beam.is_rod = true;
            const Space space(mesh, {3, {}});
            const Vector3 pull(300, -500, -1000);
            const Eigen::VectorXd motion = solve(space, {0, 1, 2}, {{3, pull}});
            Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero();
            for (std::size_t i = 0; i < 3; ++i) {
              const Vector3 leg = places[3] - places[i];
              stiffness += 210e9 * pipe().area / std::pow(leg.norm(), 3) * leg * leg.transpose();
            }
            const Vector3 theory = stiffness.inverse() * pull;
            const Vector3 found = motion.segment<3>(6 * space.node_of_vertex(3));
            std::vector<VerificationRow> rows;
            for (int c = 0; c < 3; ++c)
              rows.push_back(compare(fmt::format("displacement of the joint, {}", "xyz"[c]), "m",
                                     theory[c], found[c], rounding * theory.norm()));
            return rows;
          }};
}

// Four springs as bolts in a rectangle of 0.6 x 0.4; a hub above them spreads an eccentric force as
// a bolt pattern does: F / 4 and the moment by r / sum r^2.
VerificationCase bolt_pattern() {
  return {.name = "distributing-link",
          .stage = "structure",
          .source = "the bolt pattern's rule; Lagrange's multipliers by hand",
          .compute = [] {
            Mesh mesh = examples::empty_mesh(examples::plain_steel(), 0.01);
            mesh.vertices = {
                {0, 0, 0.5}, {-0.3, -0.2, 0}, {0.3, -0.2, 0}, {-0.3, 0.2, 0}, {0.3, 0.2, 0}};
            DistributingLink link;
            link.reference = 0;
            link.vertices = {1, 2, 3, 4};
            link.weights = {1, 1, 1, 1};
            mesh.distributing_links = {link};
            constexpr double stiffness = 1e6;
            for (int v = 1; v <= 4; ++v)
              for (int c = 0; c < 6; ++c) {
                Spring spring;
                spring.vertices = {v, -1};
                spring.components = {c, 0};
                spring.stiffness = stiffness;
                mesh.springs.push_back(spring);
              }
            const Space space(mesh, {1, {}});
            Eigen::VectorXd load = Eigen::VectorXd::Zero(space.freedoms());
            load.segment<6>(6 * space.node_of_vertex(0)) << 1000, 0, -2000, 100, 50, 300;
            const Eigen::VectorXd motion = examples::solve(space, load, {});
            // Moments about the pattern's centre.
            const double m_x = 100, m_y = 50 + 0.5 * 1000, m_z = 300;
            const double i_x = 4 * 0.04, i_y = 4 * 0.09, i_z = i_x + i_y;
            std::vector<VerificationRow> rows;
            for (int v = 1; v <= 4; ++v) {
              const Vector3 x = mesh.vertices[v];
              const Vector3 theory(1000.0 / 4 - m_z * x.y() / i_z, m_z * x.x() / i_z,
                                   -2000.0 / 4 + m_x * x.y() / i_x - m_y * x.x() / i_y);
              const Vector3 found = stiffness * motion.segment<3>(6 * space.node_of_vertex(v));
              for (int c = 0; c < 3; ++c)
                rows.push_back(compare(fmt::format("force on bolt {}, {}", v, "xyz"[c]), "N",
                                       theory[c], found[c], 1e-9 * 2000));
            }
            return rows;
          }};
}

// A rigid arm turns the force at its end into a moment on the cantilever.
VerificationCase rigid_arm() {
  return {.name = "rigid-link",
          .stage = "structure",
          .source = "Timoshenko's beam under a force and a moment",
          .compute = [] {
            Mesh mesh = frame({{0, 0, 0}, {3, 0, 0}, {4, 0, 0.5}}, {{0, 1}});
            RigidLink link;
            link.master = 1;
            link.slaves = {2};
            mesh.rigid_links = {link};
            const Space space(mesh, {3, {}});
            const Eigen::VectorXd motion = solve(space, {0}, {{2, {0, 0, -1000}}});
            const BeamSection s = pipe();
            const Material m = examples::plain_steel();
            const double bent = m.youngs_modulus * s.second_moment_2;
            // At the beam's end P and P a, with an arm a = 1.
            const double end = 1000 * (27 / (3 * bent) + 3 / (m.shear_modulus() * s.shear_area_2) +
                                       9 / (2 * bent));
            const double slope = 1000 * (9 / (2 * bent) + 3 / bent);
            const auto at_tip = motion.segment<3>(6 * space.node_of_vertex(2));
            return std::vector<VerificationRow>{compare("deflection of the arm's end", "m",
                                                        -(end + slope), at_tip.z(), rounding * end),
                                                compare("its displacement along the beam", "m",
                                                        0.5 * slope, at_tip.x(), rounding * end)};
          }};
}

// A mass on a light cantilever: f = sqrt(k / m) / 2 pi, with its distance and inertia as Rayleigh's
// two freedoms, exactly.
VerificationCase mass_on_a_beam() {
  return {.name = "mass-on-a-beam",
          .stage = "structure",
          .source = "eigenvalues of two freedoms (deflection and slope of the beam's end) by hand",
          .compute = [] {
            Mesh mesh = frame({{0, 0, 0}, {3, 0, 0}}, {{0, 1}});
            mesh.materials[0].density = 1e-6;
            PointMass mass;
            mass.vertex = 1;
            mass.mass = 500;
            mass.offset = {0.4, 0, 0};
            mass.inertia = Vector3(10, 60, 60).asDiagonal();
            mesh.masses = {mass};
            const Space space(mesh, {3, {}});
            std::vector<FixedUnknown> fixed;
            examples::hold(
                space, [](const Vector3& p) { return p.x() < 1e-9; }, {0, 1, 2, 3, 4, 5}, fixed);
            // Bending in one plane.
            examples::hold(
                space, [](const Vector3&) { return true; }, {0, 1, 3, 5}, fixed);
            const NaturalModes modes =
                find_natural_modes(space, find_mass_properties(space, nullptr, nullptr), fixed, 2);
            const BeamSection s = pipe();
            const Material m = examples::plain_steel();
            const double bent = m.youngs_modulus * s.second_moment_2, length = 3;
            Eigen::Matrix2d flexibility, inertia;  // of (w, slope)
            flexibility << std::pow(length, 3) / (3 * bent) +
                               length / (m.shear_modulus() * s.shear_area_2),
                length * length / (2 * bent), length * length / (2 * bent), length / bent;
            inertia << 500, 500 * 0.4, 500 * 0.4, 60 + 500 * 0.16;
            const Eigen::Matrix2d product = flexibility * inertia;
            const double half = product.trace() / 2,
                         root = std::sqrt(half * half - product.determinant());
            std::vector<VerificationRow> rows;
            for (const int i : {0, 1}) {
              const double f = std::sqrt(1 / (half + (i == 0 ? root : -root))) / (2 * M_PI);
              rows.push_back(compare(fmt::format("frequency {}", i + 1), "Hz", f,
                                     modes.frequencies[i], 1e-6 * f));
            }
            return rows;
          }};
}

}  // namespace

std::vector<VerificationCase> frame_cases() {
  return {beams(), truss(), bolt_pattern(), rigid_arm(), mass_on_a_beam()};
}

}  // namespace blocklift::pipeline
