// The doctor, on meshes that have one thing wrong each.

#include "structure/mesh/diagnosis/diagnosis.h"

#include <array>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "structure/error.h"
#include "structure/mesh/beams/sections.h"
#include "structure/mesh/shell_shape.h"

namespace blocklift::structure {
namespace {

using ::testing::ElementsAre;

/// Plate in the plane of x and y, cells of 1 m, shells numbered from 1.
Mesh plate(int along, int across) {
  Mesh mesh;
  mesh.materials.push_back({"steel", 206e9, 0.3, 7850, 355e6});
  mesh.shell_sections.push_back({.thickness = 0.01});
  mesh.groups.push_back({"plate", 0});
  mesh.regions.push_back({.name = "plate"});
  for (int j = 0; j <= across; ++j)
    for (int i = 0; i <= along; ++i) mesh.vertices.emplace_back(i, j, 0);
  for (int j = 0; j < across; ++j)
    for (int i = 0; i < along; ++i) {
      const int v = j * (along + 1) + i;
      Shell shell;
      shell.vertices = {v, v + 1, v + along + 1, v + along + 2};
      shell.label = static_cast<long>(mesh.shells.size()) + 1;
      mesh.shells.push_back(shell);
    }
  return mesh;
}

int count(const Diagnosis& diagnosis, const std::string& kind) {
  const Finding* finding = diagnosis.find(kind);
  return finding == nullptr ? 0 : finding->count;
}

Beam beam(int from, int to, const Vector3& axis_2 = Vector3::UnitZ()) {
  Beam one;
  one.vertices = {from, to};
  one.axis_2 = axis_2;
  one.label = 100;
  return one;
}

// Corners in turn: 1, 2, 4, 3. The last but one moves from the outer side of the line between its
// neighbours to the inner one.
TEST(FoldedShells, HaveACornerThatPointsInwards) {
  Mesh mesh = plate(1, 1);
  const auto folded = [&] { return is_folded(mesh, mesh.shells[0]); };
  EXPECT_FALSE(folded());
  mesh.vertices[3] = {0.5, 0.5, 0};  // on the line
  EXPECT_FALSE(folded());
  mesh.vertices[3] = {0.4, 0.4, 0};
  EXPECT_TRUE(folded());
  // A plate that is folded about its diagonal is warped, and bulges all the same.
  mesh.vertices[3] = {0.5, 0.5, 0.7};
  EXPECT_FALSE(folded());
  // Triangles have one corner twice.
  mesh.shells[0].vertices = {0, 1, 2, 2};
  EXPECT_FALSE(folded());
}

TEST(Diagnosis, ASoundPlate) {
  const Diagnosis diagnosis = diagnose(plate(4, 3));
  EXPECT_NEAR(diagnosis.mass.mass, 12 * 0.01 * 7850, 1e-9);
  EXPECT_NEAR((diagnosis.mass.centre - Vector3(2, 1.5, 0)).norm(), 0, 1e-12);
  // Inertia of a rectangle about its centre: m (a^2 + b^2) / 12.
  EXPECT_NEAR(diagnosis.mass.inertia(2, 2), diagnosis.mass.mass * 25 / 12, 1e-9);
  EXPECT_EQ(diagnosis.parts, 1);
  EXPECT_EQ(diagnosis.free_edges, 14);
  EXPECT_DOUBLE_EQ(diagnosis.free_edge_length, 14);
  EXPECT_NEAR(diagnosis.plate_area, 12, 1e-12);
  EXPECT_EQ(diagnosis.findings.size(), 1U);
  EXPECT_EQ(diagnosis.findings[0].kind, "free edges");
  EXPECT_EQ(diagnosis.findings[0].places.size(), 14U);
}

TEST(Diagnosis, UnconnectedParts) {
  Mesh mesh = plate(2, 2);
  const Mesh other = plate(1, 1);
  for (Shell shell : other.shells) {
    for (int& v : shell.vertices) v += 9;
    shell.label = 77;
    mesh.shells.push_back(shell);
  }
  for (const Vector3& v : other.vertices) mesh.vertices.push_back(v + Vector3(10, 0, 0));
  const Diagnosis diagnosis = diagnose(mesh);
  EXPECT_EQ(diagnosis.parts, 2);
  EXPECT_THAT(diagnosis.find("unconnected parts")->labels, ElementsAre(77));
  EXPECT_EQ(diagnosis.find("unconnected parts")->severity, Severity::error);
  // A rigid link joins them.
  mesh.rigid_links.push_back({.master = 0, .slaves = {9}});
  EXPECT_EQ(diagnose(mesh).parts, 1);
}

// Two plates end to end, 20 mm apart and half a cell aside, as meshes that were to be tied are.
TEST(Diagnosis, PartsThatTouchAreToldWithPlaceAndGap) {
  const auto plates_apart = [](double gap) {
    Mesh mesh = plate(2, 2);
    const Mesh other = plate(1, 2);
    for (Shell shell : other.shells) {
      for (int& v : shell.vertices) v += 9;
      mesh.shells.push_back(shell);
    }
    for (const Vector3& v : other.vertices) mesh.vertices.push_back(v + Vector3(2 + gap, 0.5, 0));
    return mesh;
  };
  Mesh mesh = plates_apart(0.02);
  const Diagnosis diagnosis = diagnose(mesh);
  ASSERT_EQ(count(diagnosis, "parts that touch"), 1);
  const Finding& finding = *diagnosis.find("parts that touch");
  EXPECT_EQ(finding.severity, Severity::warning);
  EXPECT_THAT(finding.text, ::testing::HasSubstr("the nearest across 20 mm at (2"));
  // Two ends of either lie beside the other, the fourth of six stands out.
  EXPECT_THAT(finding.text, ::testing::HasSubstr("where 4 vertices lie beside the other part"));
  EXPECT_EQ(count(diagnose(plates_apart(0.1)), "parts that touch"), 0);
  mesh.rigid_links.push_back({.master = 2, .slaves = {9}});
  EXPECT_EQ(count(diagnose(mesh), "parts that touch"), 0);
}

TEST(Diagnosis, MiddlesOfQuadraticShellsBelongToThem) {
  Mesh mesh = plate(1, 1);
  Eigen::Matrix3Xd points(3, 9);
  for (int i = 0; i < 9; ++i) points.col(i) = Vector3(0.5 * (i % 3), 0.5 * (i / 3), 0);
  mesh.curved_shells.push_back(points);
  mesh.shells[0].curvature = 0;
  for (const int i : {1, 3, 5, 7}) mesh.vertices.push_back(points.col(i));
  EXPECT_EQ(count(diagnose(mesh), "unused vertices"), 0);
  mesh.vertices.emplace_back(0.3, 0.3, 0);
  EXPECT_EQ(count(diagnose(mesh), "unused vertices"), 1);
}

// The slope of the edge at its end is (4 s - 1) of its length where the middle is at s of it.
TEST(Diagnosis, MiddlesAtQuarterPointsAreNamedWithTheirPlace) {
  const auto found = [](double share) {
    Mesh mesh = plate(1, 1);
    Eigen::Matrix3Xd points(3, 9);
    for (int i = 0; i < 9; ++i) points.col(i) = Vector3(0.5 * (i % 3), 0.5 * (i / 3), 0);
    points(0, 7) = 1 - share;
    mesh.curved_shells.push_back(points);
    mesh.shells[0].curvature = 0;
    const Diagnosis diagnosis = diagnose(mesh);
    const Finding* finding = diagnosis.find("middles at quarter points");
    return finding == nullptr ? Finding() : *finding;
  };
  const Finding at_quarter = found(0.25);
  EXPECT_EQ(at_quarter.severity, Severity::warning);
  EXPECT_THAT(at_quarter.labels, ElementsAre(1));
  EXPECT_THAT(at_quarter.text, ::testing::HasSubstr("at (0.75, 1, 0) m, 0.25 of the edge"));
  EXPECT_EQ(found(0.27).count, 1);
  EXPECT_EQ(found(0.28).count, 0);
  EXPECT_EQ(found(0.5).count, 0);
}

// A vertex that is tied to a shell in the place of the shell's corner is joined to it.
TEST(Diagnosis, VerticesTiedToAShellAreJoinedToItsCorners) {
  Mesh mesh = plate(2, 1);
  mesh.vertices.push_back(mesh.vertices[1]);
  mesh.vertices.push_back(mesh.vertices[4]);
  mesh.shells[1].vertices[0] = 6;
  mesh.shells[1].vertices[2] = 7;
  EXPECT_EQ(count(diagnose(mesh), "duplicated vertices"), 2);
  mesh.surface_points.push_back({6, 0, {1, 0}});
  mesh.surface_points.push_back({7, 0, {1, 1}});
  EXPECT_EQ(count(diagnose(mesh), "duplicated vertices"), 0);
}

TEST(Diagnosis, DuplicatedVerticesAndCells) {
  Mesh mesh = plate(2, 1);
  // The second shell gets vertices of its own along the seam.
  mesh.vertices.push_back(mesh.vertices[1]);
  mesh.vertices.push_back(mesh.vertices[4] + Vector3(1e-8, 0, 0));
  mesh.shells[1].vertices[0] = 6;
  mesh.shells[1].vertices[2] = 7;
  Diagnosis diagnosis = diagnose(mesh);
  EXPECT_THAT(diagnosis.find("duplicated vertices")->labels, ::testing::UnorderedElementsAre(7, 8));
  EXPECT_EQ(diagnosis.parts, 2);
  // Springs between them on purpose.
  for (const auto& [a, b] : {std::pair(1, 6), std::pair(4, 7)}) {
    Spring spring;
    spring.vertices = {a, b};
    spring.stiffness = 1;
    mesh.springs.push_back(spring);
  }
  EXPECT_EQ(count(diagnose(mesh), "duplicated vertices"), 0);
  Mesh twice = plate(2, 1);
  twice.shells.push_back(twice.shells[0]);
  std::swap(twice.shells.back().vertices[0], twice.shells.back().vertices[1]);
  EXPECT_EQ(count(diagnose(twice), "duplicated shells"), 1);
}

TEST(Diagnosis, ThicknessAndDensity) {
  Mesh mesh = plate(2, 2);
  mesh.shells[3].section = -1;
  mesh.materials[0].density = 0;
  const Diagnosis diagnosis = diagnose(mesh);
  EXPECT_THAT(diagnosis.find("shells without thickness")->labels, ElementsAre(4));
  EXPECT_EQ(count(diagnosis, "materials without density"), 1);
  EXPECT_EQ(diagnosis.mass.mass, 0);
}

TEST(Diagnosis, Shapes) {
  Mesh mesh = plate(3, 1);
  mesh.vertices[0].z() = 1;                // warps the first
  mesh.vertices[2] = Vector3(1.02, 0, 0);  // the second slender and skewed
  mesh.vertices[6] = Vector3(1.02, 1, 0);
  mesh.vertices[3] = mesh.vertices[7] = Vector3(9, 1, 0);
  const Diagnosis diagnosis = diagnose(mesh);
  EXPECT_THAT(diagnosis.find("warped shells")->labels, ElementsAre(1));
  EXPECT_THAT(diagnosis.find("slender shells")->labels, ElementsAre(2));
  Mesh flat = plate(1, 1);
  flat.vertices[2] = Vector3(0.3, 0, 0);
  flat.vertices[3] = Vector3(0.6, 0, 0);
  EXPECT_EQ(count(diagnose(flat), "shells without area"), 1);
  EXPECT_EQ(count(diagnose(flat), "folded shells"), 0);
  Mesh bow_tie = plate(1, 1);
  std::swap(bow_tie.shells[0].vertices[2], bow_tie.shells[0].vertices[3]);
  EXPECT_EQ(count(diagnose(bow_tie), "folded shells"), 1);
}

TEST(Diagnosis, NormalsThatDisagree) {
  Mesh mesh = plate(3, 1);
  std::swap(mesh.shells[1].vertices[0], mesh.shells[1].vertices[2]);
  std::swap(mesh.shells[1].vertices[1], mesh.shells[1].vertices[3]);
  EXPECT_EQ(count(diagnose(mesh), "opposed normals"), 2);
  // A web that meets the plate where two of its shells do: no pair alone.
  Mesh tee = plate(2, 1);
  tee.vertices.emplace_back(1, 0, 1);
  tee.vertices.emplace_back(1, 1, 1);
  Shell web;
  web.vertices = {1, 6, 4, 7};
  tee.shells.push_back(web);
  EXPECT_EQ(count(diagnose(tee), "opposed normals"), 0);
  // A knuckle of 90 degrees says nothing.
  Mesh knuckle = plate(1, 1);
  knuckle.vertices.emplace_back(1, 0, 1);
  knuckle.vertices.emplace_back(1, 1, 1);
  for (const std::array<int, 4>& order : {std::array{1, 4, 3, 5}, std::array{4, 1, 5, 3}}) {
    Shell up;
    up.vertices = order;
    knuckle.shells.resize(1);
    knuckle.shells.push_back(up);
    EXPECT_EQ(count(diagnose(knuckle), "opposed normals"), 0);
  }
}

TEST(Diagnosis, Mechanisms) {
  Mesh mesh = plate(1, 1);
  BeamSection section;
  section.area = 0.01;
  section.second_moment_2 = section.second_moment_3 = section.torsion = 1e-6;
  mesh.beam_sections.push_back(section);
  mesh.vertices.emplace_back(0, 0, 1);
  mesh.vertices.emplace_back(0, 0, 2);
  // A post of two beams, hinged where they meet.
  mesh.beams = {beam(0, 4, Vector3::UnitX()), beam(4, 5, Vector3::UnitX())};
  EXPECT_EQ(count(diagnose(mesh), "vertices free to turn"), 0);
  mesh.beams[0].release[1] = {false, false, false, false, true, false};
  EXPECT_EQ(count(diagnose(mesh), "vertices free to turn"), 0);
  mesh.beams[1].release[0] = {false, false, false, false, true, false};
  EXPECT_EQ(count(diagnose(mesh), "vertices free to turn"), 1);
  // The shear of a section by figures is an estimate, that of a pipe is known.
  EXPECT_EQ(count(diagnose(mesh), "beams by figures"), 2);
  EXPECT_EQ(diagnose(mesh).find("beams by figures")->severity, Severity::note);
  mesh.beam_sections[0] = pipe(0.05, 0.04).section;
  EXPECT_EQ(count(diagnose(mesh), "beams by figures"), 0);
  // Three rods hold a point, two do not.
  Mesh truss = plate(1, 1);
  truss.beam_sections.push_back(section);
  truss.vertices.emplace_back(0.3, 0.3, 1);
  truss.vertex_labels = {1, 2, 3, 4, 55};
  truss.beams = {beam(0, 4), beam(1, 4), beam(2, 4)};
  for (Beam& rod : truss.beams) rod.is_rod = true;
  EXPECT_EQ(count(diagnose(truss), "vertices free to move"), 0);
  truss.beams.pop_back();
  const Diagnosis loose = diagnose(truss);
  EXPECT_THAT(loose.find("vertices free to move")->labels, ElementsAre(55));
  truss.beams.push_back(beam(2, 4));
  truss.beams[2].release = {BeamRelease{false, false, false, true, false, false},
                            BeamRelease{false, false, false, true, false, false}};
  EXPECT_EQ(count(diagnose(truss), "beams free to spin"), 1);
}

TEST(Diagnosis, SpringsToTheGroundAndMassesOfNothing) {
  Mesh mesh = plate(1, 1);
  Spring spring;
  spring.vertices = {0, -1};
  spring.stiffness = 1;
  spring.label = 9;
  mesh.springs.push_back(spring);
  mesh.vertices.emplace_back(5, 5, 5);
  PointMass mass;
  mass.vertex = 4;
  mass.mass = 10;
  mesh.masses.push_back(mass);
  const Diagnosis diagnosis = diagnose(mesh);
  EXPECT_EQ(count(diagnosis, "springs to the ground"), 1);
  EXPECT_EQ(count(diagnosis, "masses of nothing"), 1);
}

}  // namespace
}  // namespace blocklift::structure
