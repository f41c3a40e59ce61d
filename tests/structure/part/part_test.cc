// Parts on any mesh: elements of each kind, loads, supports, what is refused.
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include <Eigen/Dense>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "structure/error.h"
#include "structure/mesh/element_shape.h"
#include "structure/mesh/files/part_reader.h"
#include "structure/mesh/quarter_points.h"
#include "structure/output/part_files.h"
#include "structure/part/part_solution.h"

namespace blocklift::structure {
namespace {

using ::testing::HasSubstr;

/// Kinds of elements that a box is meshed with.
enum class Shape { hexahedra, wedges, tetrahedra };

/// A box [0, a] x [0, b] x [0, c] meshed through a .geo file; its faces are named "x0", "x1", ...,
/// the whole is "box". The circle's middle is a point that no element has.
PartMesh box(Shape shape, int order, const Vector3& size, const std::array<int, 3>& counts,
             PartReading reading = {}) {
  const auto path = std::filesystem::temp_directory_path() /
                    ("blocklift-part-" + std::to_string(::getpid()) + ".geo");
  std::ofstream file(path);
  file << "Point(9) = {-1, -1, -1};\nPoint(1) = {0, 0, 0};\nPoint(2) = {" << size.x()
       << ", 0, 0};\nPoint(3) = {" << size.x() << ", " << size.y() << ", 0};\nPoint(4) = {0, "
       << size.y() << ", 0};\n"
       << "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};\n"
       << "Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};\n"
       << "Transfinite Curve{1, 3} = " << counts[0] + 1
       << "; Transfinite Curve{2, 4} = " << counts[1] + 1 << "; Transfinite Surface{1};\n"
       << (shape == Shape::hexahedra ? "Recombine Surface{1};\n" : "") << "out[] = Extrude{0, 0, "
       << size.z() << "}{ Surface{1}; Layers{" << counts[2] << "};"
       << (shape == Shape::tetrahedra ? "" : " Recombine;") << " };\n"
       << "Physical Volume(\"box\") = {out[1]};\nPhysical Surface(\"z0\") = {1};\n"
       << "Physical Surface(\"z1\") = {out[0]};\nPhysical Surface(\"y0\") = {out[2]};\n"
       << "Physical Surface(\"x1\") = {out[3]};\nPhysical Surface(\"y1\") = {out[4]};\n"
       << "Physical Surface(\"x0\") = {out[5]};\nPhysical Curve(\"edge\") = {1};\n";
  file.close();
  reading.element_order = order;
  PartMesh mesh = read_part_mesh(path.string(), reading);
  std::filesystem::remove(path);
  return mesh;
}

const Material mild_steel{"steel", 206e9, 0.3, 7850, 235e6};

PartModel part(PartMesh mesh) {
  PartModel model;
  model.mesh = std::move(mesh);
  model.materials = {mild_steel};
  model.material_of_solid.assign(model.mesh.solids.size(), 0);
  return model;
}

/// Moves nodes off the boundary of the box at random, and mid-edge nodes out of their middles.
void distort(PartMesh& mesh, const Vector3& size, double amount) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> by(-amount, amount);
  for (Eigen::Index n = 0; n < mesh.nodes.cols(); ++n) {
    auto x = mesh.nodes.col(n);
    if (x.minCoeff() < 1e-9 || (size - x).minCoeff() < 1e-9) continue;
    x += Vector3(by(random), by(random), by(random));
  }
}

class Kinds : public ::testing::TestWithParam<std::tuple<Shape, int>> {};

// The patch test: a linear displacement given on the boundary is found inside, to rounding, and
// with it a constant stress. Isoparametric elements of any shape must pass it (Irons).
TEST_P(Kinds, PassThePatchTestWhenDistorted) {
  const Vector3 size(1, 0.8, 0.6);
  const auto [shape, order] = GetParam();
  PartModel model = part(box(shape, order, size, {3, 3, 3}));
  distort(model.mesh, size, order == 1 ? 0.05 : 0.02);
  ASSERT_NO_THROW(check_part_mesh(model.mesh));
  Eigen::Matrix3d gradient;
  gradient << 1e-3, 2e-4, -3e-4, 5e-4, -7e-4, 1e-4, -2e-4, 4e-4, 6e-4;
  const Vector3 shift(1e-4, -2e-4, 3e-4);
  std::vector<FixedUnknown> fixed;
  Eigen::VectorXd exact(3 * model.mesh.nodes.cols());
  const std::vector<int> body = connected_bodies(model.mesh);
  for (int n = 0; n < model.mesh.nodes.cols(); ++n) {
    const Vector3 x = model.mesh.nodes.col(n);
    exact.segment<3>(3 * n) = gradient * x + shift;
    if (body[n] >= 0 && x.minCoeff() > 1e-9 && (size - x).minCoeff() > 1e-9) continue;
    for (int a = 0; a < 3; ++a) fixed.push_back({3 * n + a, exact[3 * n + a]});
  }
  const Eigen::VectorXd found =
      find_part_displacement(model, fixed, Eigen::VectorXd::Zero(exact.size())).displacement;
  EXPECT_LT((found - exact).norm(), 1e-12 * exact.norm());
}

// The slope of an edge at its end is 4 s - 1 of its length with the middle at s: the Jacobian of
// the corner changes its sign at the quarter point, where no point of the rule sees it.
TEST(QuarterPoints, FoldAPartsElementAtItsCorner) {
  for (const Shape shape : {Shape::hexahedra, Shape::tetrahedra, Shape::wedges}) {
    PartMesh mesh = box(shape, 2, Vector3(1, 1, 1), {1, 1, 1});
    mesh.meshed_here = false;  // what Gmsh makes here is let pass
    EXPECT_TRUE(find_quarter_middles(mesh).empty());
    Eigen::Index middle = 0;
    (mesh.nodes.colwise() - Vector3(0.5, 0, 0)).colwise().norm().minCoeff(&middle);
    mesh.nodes.col(middle) = Vector3(0.25, 0, 0);
    ASSERT_FALSE(find_quarter_middles(mesh).empty());
    EXPECT_NEAR(find_quarter_middles(mesh)[0].middle.share, 0.25, 1e-12);
    EXPECT_NO_THROW(check_part_mesh(mesh));
    mesh.nodes.col(middle) = Vector3(0.76, 0, 0);
    EXPECT_THAT([&] { check_part_mesh(mesh); },
                ::testing::ThrowsMessage<ModelError>(
                    HasSubstr("the middle at (0.76, 0, 0) m, 0.24 of the edge")));
  }
}

// Gmsh's tables of shape functions are those of our own polynomials through the same nodes.
TEST_P(Kinds, ShapeFunctionsAgreeWithGmsh) {
  const auto [shape, order] = GetParam();
  const PartMesh mesh = box(shape, order, Vector3(1, 1, 1), {1, 1, 1});
  const ElementKind& kind = mesh.kind(mesh.solids[0]);
  const ElementShape own(kind);
  for (Eigen::Index q = 0; q < kind.rule.cols(); ++q) {
    const Vector3 xi = kind.rule.col(q);
    EXPECT_LT((own.values(xi) - kind.values.row(q).transpose()).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT(
        (own.gradients(xi).transpose() - kind.gradients.middleRows<3>(3 * q)).cwiseAbs().maxCoeff(),
        1e-11);
  }
}

// No place of a sheared element is nearer than the one that is found, however far off the place is:
// 25,000 of its places are tried, so that a miss shows as a nearer one.
TEST_P(Kinds, TheNearestPlaceIsFoundFromFar) {
  const auto [shape, order] = GetParam();
  const PartMesh mesh = box(shape, order, Vector3(1, 1, 1), {1, 1, 1});
  Eigen::Matrix3Xd places = mesh.places(mesh.solids[0]);
  for (Eigen::Index n = 0; n < places.cols(); ++n) {
    const Vector3 x = places.col(n);
    places.col(n) = Vector3(x.x() + 0.8 * x.z(), x.y() + 0.3 * x.x(), 0.1 * x.z());
  }
  const ElementKind& kind = mesh.kind(mesh.solids[0]);
  const ElementShape own(kind);
  std::vector<Vector3> tried;
  constexpr int steps = 28;
  const Vector3 lower = kind.local.rowwise().minCoeff(), upper = kind.local.rowwise().maxCoeff();
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= steps; ++j)
      for (int k = 0; k <= steps; ++k) {
        const Vector3 xi =
            lower + Vector3(i, j, k).cwiseProduct(upper - lower) / static_cast<double>(steps);
        Vector3 found;  // places beyond the sides of tetrahedra and wedges are none of theirs
        const Vector3 place = places * own.values(xi);
        if (own.locate(places, place, found) < 1e-9) tried.push_back(place);
      }
  for (const double distance : {0.05, 0.7, 5.0, 60.0})
    for (int direction = 0; direction < 24; ++direction) {
      const double turn = 2.4 * direction, up = 1 - (direction + 0.5) / 12;
      const Vector3 way(std::sqrt(1 - up * up) * std::cos(turn),
                        std::sqrt(1 - up * up) * std::sin(turn), up);
      const Vector3 from = places.rowwise().mean() + distance * way;
      Vector3 xi;
      const double found = own.nearest(places, from, xi);
      EXPECT_NEAR((from - places * own.values(xi)).norm(), found, 1e-12 * (1 + distance));
      for (const Vector3& place : tried) ASSERT_GE((from - place).norm(), found - 1e-8) << distance;
    }
}

// Faces by a box are those of the mesh's own group: the same load. Inner faces never count.
TEST_P(Kinds, FacesAndPointsAreChosenByPlace) {
  const auto [shape, order] = GetParam();
  const Vector3 size(1, 0.8, 0.6);
  PartReading reading;
  reading.faces = {{"top", Vector3(0, 0, 0.6), size},
                   {"upper", Vector3(0, 0, 0.3), size},
                   {"none", Vector3(0.1, 0.1, 0.1), Vector3(0.2, 0.7, 0.5)}};
  reading.points = {{"corner", size}, {"nowhere", Vector3(1, 0.8, 0.7)}};
  PartModel model = part(box(shape, order, size, {2, 2, 2}, reading));
  const auto load_on = [&](const std::string& group, SurfaceLoad::Kind kind) {
    model.surface_loads = {{"load", group, kind, 2e6, Vector3(1e3, 2e3, 3e3)}};
    return part_load(model);
  };
  for (const auto kind : {SurfaceLoad::Kind::pressure, SurfaceLoad::Kind::force}) {
    const Eigen::VectorXd own = load_on("z1", kind);
    EXPECT_LT((load_on("top", kind) - own).norm(), 1e-12 * own.norm());
  }
  const auto faces = [&](const char* group) {
    return model.mesh.find_group(group)->elements.size();
  };
  EXPECT_EQ(faces("upper"),
            faces("z1") + (faces("x0") + faces("x1") + faces("y0") + faces("y1")) / 2);
  EXPECT_EQ(faces("none"), 0u);
  EXPECT_EQ(faces("nowhere"), 0u);
  ASSERT_EQ(faces("corner"), 1u);
  const int corner = model.mesh.node(model.mesh.find_group("corner")->elements[0], 0);
  EXPECT_EQ(Vector3(model.mesh.nodes.col(corner)), size);
  reading.faces = {{"box", Vector3::Zero(), size}};
  EXPECT_THROW(box(shape, order, size, {2, 2, 2}, reading), ModelError);
}

// A bar pulled at its end: stress F/A everywhere, elongation F L / (E A), reaction -F.
TEST_P(Kinds, PulledBarIsExact) {
  const Vector3 size(2, 0.3, 0.2);
  const auto [shape, order] = GetParam();
  PartModel model = part(box(shape, order, size, {4, 1, 1}));
  const double force = 1.2e6, area = 0.06;
  model.supports = {{"root", "x0", {true, false, false}, Vector3::Zero()},
                    {"side", "y0", {false, true, false}, Vector3::Zero()},
                    {"bottom", "z0", {false, false, true}, Vector3::Zero()}};
  SurfaceLoad pull{"pull", "x1", SurfaceLoad::Kind::force, 0, Vector3(force / 2, 0, 0)};
  SurfaceLoad suction{"suction", "x1", SurfaceLoad::Kind::pressure, -force / 2 / area,
                      Vector3::Zero()};
  model.surface_loads = {pull, suction};
  const PartSolution solution = solve_part(model);
  for (Eigen::Index p = 0; p < solution.stress.averaged.cols(); ++p) {
    EXPECT_NEAR(solution.stress.averaged(0, p), force / area, 1e-8 * force / area);
    EXPECT_LT(solution.stress.averaged.col(p).tail<5>().norm(), 1e-8 * force / area);
  }
  EXPECT_NEAR(solution.reactions[0].force.x(), -force, 1e-9 * force);
  EXPECT_LT(solution.force_residual, 1e-12);
  EXPECT_LT(solution.moment_residual, 1e-12);
  EXPECT_LT(solution.estimated_error, 1e-8);
  EXPECT_NEAR(solution.strain_energy,
              force * force * size.x() / (2 * mild_steel.youngs_modulus * area),
              1e-8 * solution.strain_energy);
  const PartProbe end = probe_part(model, solution, Vector3(2, 0.11, 0.07));
  EXPECT_TRUE(end.inside);
  EXPECT_NEAR(end.displacement.x(), force * 2 / (mild_steel.youngs_modulus * area), 1e-12);
  EXPECT_NEAR(end.stress[0], force / area, 1e-8 * force / area);
  EXPECT_FALSE(probe_part(model, solution, Vector3(2.1, 0.1, 0.1)).inside);
}

// Loads on all material: their resultants are those of the body, whatever the mesh.
TEST_P(Kinds, BodyLoadsHaveTheirResultants) {
  const Vector3 size(2, 0.3, 0.2);
  const auto [shape, order] = GetParam();
  PartModel model = part(box(shape, order, size, {4, 1, 1}));
  model.supports = {{"root", "x0", {true, true, true}, Vector3::Zero()}};
  const double mass = 7850 * size.prod(), omega = 3;
  EXPECT_NEAR(find_part_mass(model).mass, mass, 1e-9 * mass);
  model.body_loads = {{"weight", Vector3(0, 0, -9.81), Vector3::Zero(), Vector3::Zero()},
                      {"spin", Vector3::Zero(), Vector3(0, 0, omega), Vector3(-1, 0.15, 0)}};
  const PartSolution solution = solve_part(model);
  EXPECT_NEAR(solution.reactions[0].force.z(), mass * 9.81, 1e-8 * mass * 9.81);
  // Centrifugal: m omega^2 times the distance of the centre from the axis, 1 + 1 m.
  EXPECT_NEAR(solution.reactions[0].force.x(), -mass * omega * omega * 2, 1e-8 * mass * 18);
  EXPECT_NEAR(solution.reactions[0].force.y(), 0, 1e-8 * mass * 18);
}

INSTANTIATE_TEST_SUITE_P(Part, Kinds,
                         ::testing::Combine(::testing::Values(Shape::hexahedra, Shape::wedges,
                                                              Shape::tetrahedra),
                                            ::testing::Values(1, 2)));

// A cantilever of quadratic hexahedra under an end load: Timoshenko's deflection within 0.5 %.
// Without Poisson's effect, which the root would hinder and the beam's theory does not know.
TEST(Part, CantileverBends) {
  PartModel model = part(box(Shape::hexahedra, 2, Vector3(2, 0.1, 0.2), {10, 1, 2}));
  model.materials[0].poisson_ratio = 0;
  model.supports = {{"root", "x0", {true, true, true}, Vector3::Zero()}};
  model.surface_loads = {{"tip", "x1", SurfaceLoad::Kind::force, 0, Vector3(0, 0, -1e4)}};
  const PartSolution solution = solve_part(model);
  const double inertia = 0.1 * std::pow(0.2, 3) / 12, shear_area = 5.0 / 6 * 0.02;
  const double deflection = 1e4 * 8 / (3 * mild_steel.youngs_modulus * inertia) +
                            1e4 * 2 / (model.materials[0].shear_modulus() * shear_area);
  const double found = -probe_part(model, solution, Vector3(2, 0.05, 0.1)).displacement.z();
  EXPECT_NEAR(found, deflection, 0.005 * deflection);
  EXPECT_GT(solution.estimated_error, 0);
  EXPECT_LT(solution.estimated_error, 0.2);
}

TEST(Part, MaterialsMeetWithoutAveraging) {
  PartModel model = part(box(Shape::hexahedra, 2, Vector3(2, 0.3, 0.2), {4, 1, 1}));
  model.materials.push_back({"soft", mild_steel.youngs_modulus / 2, 0, 1000, 100e6});
  model.materials[0].poisson_ratio = 0;
  for (std::size_t s = 0; s < model.mesh.solids.size(); ++s)
    model.material_of_solid[s] = model.mesh.centre(model.mesh.solids[s]).x() < 1 ? 0 : 1;
  model.supports = {{"root", "x0", {true, true, true}, Vector3::Zero()}};
  // A given elongation: the force is that of two springs in series, the stress the same in both.
  model.supports.push_back({"end", "x1", {true, false, false}, Vector3(3e-4, 0, 0)});
  const PartSolution solution = solve_part(model);
  const double stress = 3e-4 / (1 / mild_steel.youngs_modulus + 2 / mild_steel.youngs_modulus);
  EXPECT_NEAR(solution.all.raw_von_mises, stress, 1e-8 * stress);
  EXPECT_NEAR(solution.reactions[1].force.x(), stress * 0.06, 1e-8 * stress);
  EXPECT_GT(static_cast<Eigen::Index>(solution.stress.node.size()), 0);
  EXPECT_LT(solution.estimated_error, 1e-8);
}

std::string error_of(const PartModel& model) {
  try {
    solve_part(model);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "";
}

TEST(Part, LoadsThatStrainNothingAreRefused) {
  PartModel model = part(box(Shape::hexahedra, 1, Vector3(2, 1, 1), {2, 1, 1}));
  model.supports = {{"root", "x0", {true, true, true}, Vector3::Zero()}};
  model.surface_loads = {{"push", "x0", SurfaceLoad::Kind::force, 0, Vector3(0, 1e4, 0)}};
  EXPECT_THAT(error_of(model), HasSubstr("strain nothing"));
  // A support that moves strains the part, whatever the load.
  model.supports.push_back({"end", "x1", {true, true, true}, Vector3(1e-4, 0, 0)});
  EXPECT_EQ(error_of(model), "");
  model.supports.pop_back();
  model.surface_loads.push_back({"tip", "x1", SurfaceLoad::Kind::force, 0, Vector3(1, 0, 0)});
  EXPECT_EQ(error_of(model), "");
}

TEST(Part, RigidMotionsThatAreLeftAreNamed) {
  PartModel model = part(box(Shape::hexahedra, 1, Vector3(2, 1, 1), {2, 1, 1}));
  EXPECT_THAT(error_of(model),
              ::testing::AllOf(HasSubstr("free to move"), HasSubstr("translation along x"),
                               HasSubstr("rotation about z")));
  model.supports = {{"bottom", "z0", {false, false, true}, Vector3::Zero()}};
  const std::string on_ice = error_of(model);
  EXPECT_THAT(on_ice,
              ::testing::AllOf(HasSubstr("translation along x"), HasSubstr("translation along y"),
                               HasSubstr("rotation about z through (1, 0.5, 0.5) m")));
  EXPECT_THAT(on_ice, ::testing::Not(HasSubstr("rotation about x")));
  model.supports = {{"hinge", "edge", {true, true, true}, Vector3::Zero()}};
  EXPECT_THAT(error_of(model),
              ::testing::AllOf(HasSubstr("rotation about the axis along"), HasSubstr("(1, 0, 0)")));
}

// A quarter of Lame's ring in plane strain, a = 10, b = 20 mm. Five quadratic elements are off the
// circles by 2e-5 of the radius between their nodes, 0.0015 of the sagitta. Probes on the true
// surfaces are read at the elements beside them:
// u_r = (1 + nu) p a^2 / (E (b^2 - a^2)) ((1 - 2 nu) r + b^2 / r), Timoshenko and Goodier (1970),
// article 28. What is off by a tenth of a millimetre is outside.
TEST(Part, ProbesOnCurvedSurfacesAreAtTheElementsBeside) {
  const auto path = std::filesystem::temp_directory_path() /
                    ("blocklift-ring-" + std::to_string(::getpid()) + ".geo");
  std::ofstream(path)
      << "Point(1) = {0, 0, 0}; Point(2) = {10, 0, 0}; Point(3) = {20, 0, 0};\n"
         "Point(4) = {0, 20, 0}; Point(5) = {0, 10, 0};\n"
         "Line(1) = {2, 3}; Circle(2) = {3, 1, 4}; Line(3) = {4, 5}; Circle(4) = {5, 1, 2};\n"
         "Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};\n"
         "Transfinite Curve{1, 3} = 9; Transfinite Curve{2, 4} = 6; Transfinite Surface{1};\n"
         "Recombine Surface{1};\n"
         "out[] = Extrude{0, 0, 2}{ Surface{1}; Layers{1}; Recombine; };\n"
         "Physical Volume(\"ring\") = {out[1]}; Physical Surface(\"z0\") = {1};\n"
         "Physical Surface(\"z1\") = {out[0]}; Physical Surface(\"y0\") = {out[2]};\n"
         "Physical Surface(\"x0\") = {out[4]}; Physical Surface(\"bore\") = {out[5]};\n";
  constexpr double inner = 0.01, outer = 0.02, pressure = 100e6, nu = 0.3;
  PartReading reading;
  reading.length_unit = 1e-3;
  PartModel model = part(read_part_mesh(path.string(), reading));
  std::filesystem::remove(path);
  model.supports = {{"z", "z0", {false, false, true}, Vector3::Zero()},
                    {"top", "z1", {false, false, true}, Vector3::Zero()},
                    {"y", "y0", {false, true, false}, Vector3::Zero()},
                    {"x", "x0", {true, false, false}, Vector3::Zero()}};
  model.surface_loads = {
      {"inside", "bore", SurfaceLoad::Kind::pressure, pressure, Vector3::Zero()}};
  const PartSolution solution = solve_part(model);
  for (const double radius : {inner, outer})
    for (double angle = 0; angle < 90.5; angle += 4.5) {
      const double turn = angle * M_PI / 180;
      const Vector3 radial(std::cos(turn), std::sin(turn), 0);
      const PartProbe probe =
          probe_part(model, solution, Vector3(radius * radial + Vector3(0, 0, 0.7e-3)));
      ASSERT_TRUE(probe.inside) << radius << " m, " << angle << " deg";
      const double exact = (1 + nu) * pressure * inner * inner /
                           (mild_steel.youngs_modulus * (outer * outer - inner * inner)) *
                           ((1 - 2 * nu) * radius + outer * outer / radius);
      EXPECT_NEAR(probe.displacement.dot(radial), exact, 0.005 * exact)
          << radius << " m, " << angle << " deg";
    }
  EXPECT_FALSE(probe_part(model, solution, Vector3(0.0099, 0, 0.001)).inside);
  EXPECT_FALSE(probe_part(model, solution, Vector3(0.0201, 0, 0.001)).inside);
}

// Two boxes that share one edge: the one that is held by it alone turns about it.
TEST(Part, ElementsThatHangOnAnEdgeAreNamed) {
  PartModel model = part(box(Shape::hexahedra, 1, Vector3(2, 1, 1), {2, 1, 1}));
  // The second element's face is taken off the first one's but for its lower edge, y along.
  PartMesh& mesh = model.mesh;
  const int moved = mesh.centre(mesh.solids[0]).x() > 1 ? mesh.solids[0] : mesh.solids[1];
  const auto first = static_cast<std::size_t>(mesh.elements[moved].first);
  for (int i = 0; i < 8; ++i) {
    const Vector3 x = mesh.nodes.col(mesh.node(moved, i));
    if (x.x() > 1.5 || x.z() < 0.5) continue;
    mesh.nodes.conservativeResize(Eigen::NoChange, mesh.nodes.cols() + 1);
    mesh.nodes.rightCols<1>() = x + Vector3(0.2, 0, 0);
    mesh.element_nodes[first + static_cast<std::size_t>(i)] =
        static_cast<int>(mesh.nodes.cols()) - 1;
  }
  model.supports = {{"root", "x0", {true, true, true}, Vector3::Zero()}};
  EXPECT_THAT(error_of(model),
              ::testing::AllOf(HasSubstr("free to move"),
                               HasSubstr("axis along (0, 1, 0) through (1, 0.5, 0) m"),
                               HasSubstr("1 elements about"), HasSubstr("by an edge or a point")));
}

// Two boxes that touch as a CAD file's bodies do, with nodes of their own: one of them is held.
TEST(Part, BodiesThatShareNoNodeAreNamed) {
  PartModel model = part(box(Shape::hexahedra, 1, Vector3(2, 1, 1), {2, 1, 1}));
  PartMesh& mesh = model.mesh;
  const int moved = mesh.centre(mesh.solids[0]).x() > 1 ? mesh.solids[0] : mesh.solids[1];
  const auto first = static_cast<std::size_t>(mesh.elements[moved].first);
  for (int i = 0; i < 8; ++i) {
    const Vector3 x = mesh.nodes.col(mesh.node(moved, i));
    if (x.x() > 1.5) continue;
    mesh.nodes.conservativeResize(Eigen::NoChange, mesh.nodes.cols() + 1);
    mesh.nodes.rightCols<1>() = x;
    mesh.element_nodes[first + static_cast<std::size_t>(i)] =
        static_cast<int>(mesh.nodes.cols()) - 1;
  }
  model.supports = {{"root", "x0", {true, true, true}, Vector3::Zero()}};
  EXPECT_THAT(error_of(model),
              ::testing::AllOf(HasSubstr("translation along x of the body about (1.5, 0.5, 0.5) m, "
                                         "which shares no node with the rest"),
                               HasSubstr("bodies that touch in a CAD file are joined where")));
  model.supports.push_back({"end", "x1", {true, true, true}, Vector3::Zero()});
  EXPECT_THAT(error_of(model), ::testing::Not(HasSubstr("free to move")));
}

TEST(Part, InvertedElementsAreNamed) {
  PartModel model = part(box(Shape::tetrahedra, 2, Vector3(1, 1, 1), {2, 2, 2}));
  model.supports = {{"root", "x0", {true, true, true}, Vector3::Zero()}};
  const int element = model.mesh.solids[3];
  auto& nodes = model.mesh.element_nodes;
  const auto first = static_cast<std::size_t>(model.mesh.elements[element].first);
  std::swap(nodes[first], nodes[first + 1]);
  EXPECT_THAT(error_of(model), ::testing::AllOf(HasSubstr("1 of 4"), HasSubstr("inverted"),
                                                HasSubstr("Tetrahedron 10")));
}

TEST(Part, WhatCannotBeLoadedOrHeldIsRefused) {
  PartModel model = part(box(Shape::hexahedra, 1, Vector3(2, 1, 1), {2, 1, 1}));
  model.supports = {{"root", "x2", {true, true, true}, Vector3::Zero()}};
  EXPECT_THAT(error_of(model), HasSubstr("\"x2\""));
  model.supports = {{"root", "x0", {true, true, true}, Vector3::Zero()},
                    {"other", "y0", {true, true, true}, Vector3(1e-3, 0, 0)}};
  EXPECT_THAT(error_of(model), HasSubstr("different displacements along x"));
  model.supports.pop_back();
  model.surface_loads = {{"press", "edge", SurfaceLoad::Kind::pressure, 1e6, Vector3::Zero()}};
  EXPECT_THAT(error_of(model), HasSubstr("holds edges"));
  EXPECT_THROW(read_part_mesh("/nowhere.msh", {}), ModelError);
}

TEST(Part, CalculixGetsAStepForEachAnalysis) {
  PartModel model = part(box(Shape::hexahedra, 1, Vector3(1, 1, 1), {1, 1, 1}));
  model.supports = {{"root", "x0", {true, true, true}, Vector3(1e-3, 0, 0)}};
  const auto folder = std::filesystem::temp_directory_path();
  const std::string path =
      (folder / ("blocklift-modes-" + std::to_string(::getpid()) + ".inp")).string();
  const auto written = [&](const PartAnalyses& analyses) {
    write_calculix(path, model, analyses);
    std::ifstream file(path);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    std::filesystem::remove(path);
    return text.substr(text.find("*STEP"));
  };
  const std::string modes = written({false, 3});
  EXPECT_THAT(modes, ::testing::StartsWith("*STEP\n*FREQUENCY\n3\n*BOUNDARY, OP=NEW\n"));
  EXPECT_THAT(modes, ::testing::Not(HasSubstr("*STATIC")));
  EXPECT_THAT(modes, ::testing::Not(HasSubstr("0.001")));
  const std::string both = written({true, 3});
  EXPECT_THAT(both, ::testing::StartsWith("*STEP\n*STATIC\n*BOUNDARY\n"));
  EXPECT_LT(both.find("0.001"), both.find("*END STEP\n*STEP\n*FREQUENCY\n3\n"));
  EXPECT_NE(both.find("*END STEP\n*STEP\n*FREQUENCY\n3\n"), std::string::npos);
}

TEST(Part, FilesForOtherPrograms) {
  PartModel model = part(box(Shape::wedges, 2, Vector3(1, 1, 1), {1, 1, 1}));
  model.supports = {{"root", "x0", {true, true, true}, Vector3::Zero()}};
  model.surface_loads = {{"pull", "x1", SurfaceLoad::Kind::force, 0, Vector3(1e5, 0, 0)}};
  const auto folder = std::filesystem::temp_directory_path();
  const std::string stem = (folder / ("blocklift-part-" + std::to_string(::getpid()))).string();
  write_calculix(stem + ".inp", model);
  write_part_vtu(stem + ".vtu", model, solve_part(model));
  const auto text_of = [](const std::string& path) {
    std::ifstream file(path);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    std::filesystem::remove(path);
    return text;
  };
  const std::string input = text_of(stem + ".inp"), fields = text_of(stem + ".vtu");
  for (const char* needed :
       {"TYPE=C3D15", "*ELASTIC\n206000000000, 0.3", "*STEP\n*STATIC\n", "*BOUNDARY\n", "*CLOAD"})
    EXPECT_THAT(input, HasSubstr(needed));
  EXPECT_THAT(input, ::testing::Not(HasSubstr("*FREQUENCY")));
  for (const char* needed : {"Name=\"displacement\"", "Name=\"stress\"", "</VTKFile>"})
    EXPECT_THAT(fields, HasSubstr(needed));
}

}  // namespace
}  // namespace blocklift::structure
