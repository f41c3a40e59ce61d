// Stiffeners, pads and lugs on plates by their corners, beside the same on a plate in an axis'
// plane.
#include <cmath>
#include <string>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/build/describe_block.h"
#include "pipeline/files/library/model_library.h"
#include "structure/error.h"
#include "structure/mesh/mass_properties.h"
#include "structure/mesh/plates/shell_generator.h"
#include "structure/response/flexibility.h"
#include "tests/pipeline/lug_stresses.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

using ::testing::HasSubstr;

struct ObliqueBlock {
  std::shared_ptr<const BlockModel> block;
  std::string complaints;
};

ObliqueBlock oblique_block(const std::string& text) {
  const test::TemporaryFolder folder;
  folder.write("block.yaml",
               "kind: block\nmaterials: {S: {youngs_modulus: 206 GPa, poisson_ratio: 0.3, density: "
               "7850 kg/m^3, yield_stress: 355 MPa}}\n" +
                   text);
  ModelLibrary library({});
  Diagnostics diagnostics;
  ObliqueBlock result;
  result.block = library.read_block("block.yaml", diagnostics);
  result.complaints = diagnostics.to_text();
  return result;
}

structure::Mesh oblique_mesh(const std::string& text, double largest_element) {
  const ObliqueBlock result = oblique_block(text);
  EXPECT_EQ(result.complaints, "");
  return structure::generate_shell_mesh(describe_block(*result.block, "block", largest_element));
}

/// Where the plate's frame lies.
const Eigen::Matrix3d tilt =
    (Eigen::AngleAxisd(0.7, Vector3::UnitZ()) * Eigen::AngleAxisd(0.5, Vector3::UnitX()))
        .toRotationMatrix();
const Vector3 corner(1, -2, 3);  // m

std::string point_of(double u, double v) {
  const Vector3 place = corner + tilt * Vector3(u, v, 0);
  return fmt::format("[{:.15g} m, {:.15g} m, {:.15g} m]", place.x(), place.y(), place.z());
}

const std::string row =
    "spacing: 0.7 m, side: negative, profile: {angle_bar: [200 mm, 10 mm, 100 mm, 16 mm]}}}\n";

/// A deck with a hole, rows of angles, a lug that stands on its pad over a stiffener, and one that
/// lies in its pad and juts out from the deck.
const std::string laid =
    "plates:\n  deck: {normal: z, at: 0 m, x: [0 m, 4 m], y: [0 m, 2 m], thickness: 12 mm, "
    "stiffeners: {along: x, " +
    row +
    "openings:\n  hole: {plate: deck, x: [2.8 m, 3.2 m], y: [0.5 m, 0.9 m]}\n"
    "pads:\n"
    "  pad: {plate: deck, normal: z, at: 0 m, x: [0.5 m, 1.1 m], y: [0.5 m, 1.5 m], thickness: 30 "
    "mm}\n"
    "  end: {plate: deck, normal: z, at: 0 m, x: [3.6 m, 4 m], y: [0.8 m, 1.2 m], thickness: 30 "
    "mm}\n"
    "padeyes:\n  eye: {radius: 120 mm, thickness: 30 mm, hole: 60 mm, pin: 57 mm}\n"
    "lugs:\n"
    "  L1: {pad: pad, normal: y, at: 1 m, x: [0.6 m, 1 m], z: [0 m, 0.3 m], thickness: 40 mm, "
    "pin: [0.8 m, 1 m, 0.2 m]}\n"
    "  L2: {pad: end, normal: z, at: 0 m, x: [3.7 m, 4.3 m], y: [0.85 m, 1.15 m], thickness: 40 "
    "mm, pin: [4.15 m, 1 m, 0 m], padeye: eye}\n";

std::string oblique() {
  return "plates:\n  deck: {corners: [" + point_of(0, 0) + ", " + point_of(4, 0) + ", " +
         point_of(4, 2) + ", " + point_of(0, 2) + "], thickness: 12 mm, stiffeners: {along: u, " +
         row + "openings:\n  hole: {plate: deck, corners: [" + point_of(2.8, 0.5) + ", " +
         point_of(3.2, 0.5) + ", " + point_of(3.2, 0.9) + ", " + point_of(2.8, 0.9) +
         "]}\n"
         "pads:\n"
         "  pad: {plate: deck, u: [0.5 m, 1.1 m], v: [0.5 m, 1.5 m], thickness: 30 mm}\n"
         "  end: {plate: deck, u: [3.6 m, 4 m], v: [0.8 m, 1.2 m], thickness: 30 mm}\n"
         "padeyes:\n  eye: {radius: 120 mm, thickness: 30 mm, hole: 60 mm, pin: 57 mm}\n"
         "lugs:\n"
         "  L1: {pad: pad, normal: v, at: 1 m, u: [0.6 m, 1 m], n: [0 m, 0.3 m], thickness: 40 mm, "
         "pin: [0.8 m, 1 m, 0.2 m]}\n"
         "  L2: {pad: end, normal: n, at: 0 m, u: [3.7 m, 4.3 m], v: [0.85 m, 1.15 m], thickness: "
         "40 mm, pin: [4.15 m, 1 m, 0 m], padeye: eye}\n";
}

/// The mesh as it is seen from the plate's frame.
structure::Mesh laid_flat(structure::Mesh mesh) {
  for (Vector3& vertex : mesh.vertices) vertex = tilt.transpose() * (vertex - corner);
  for (structure::Beam& beam : mesh.beams) {
    beam.axis_2 = tilt.transpose() * beam.axis_2;
    for (Vector3& offset : beam.offset) offset = tilt.transpose() * offset;
  }
  for (structure::LiftingPoint& lug : mesh.lifting_points)
    lug.p_BPin = tilt.transpose() * (lug.p_BPin - corner);
  return mesh;
}

// Areas, thicknesses, lengths and offsets are right where mass, centre and moments of inertia are.
TEST(ObliqueParts, WeighWhatTheyDoInAnAxisPlane) {
  const structure::Mesh found = laid_flat(oblique_mesh(oblique(), 0.3));
  const structure::Mesh expected = oblique_mesh(laid, 0.3);
  const auto all = structure::mass_properties(found), wanted = structure::mass_properties(expected);
  EXPECT_NEAR(all.mass, wanted.mass, 1e-9 * wanted.mass);
  EXPECT_LT((all.centre - wanted.centre).norm(), 1e-9);
  EXPECT_LT((all.inertia - wanted.inertia).norm(), 1e-9 * wanted.inertia.norm());
  const auto groups = structure::mass_by_group(found), as_laid = structure::mass_by_group(expected);
  ASSERT_EQ(found.groups.size(), expected.groups.size());
  for (std::size_t g = 0; g < expected.groups.size(); ++g)
    for (std::size_t f = 0; f < found.groups.size(); ++f)
      if (found.groups[f].name == expected.groups[g].name) {
        EXPECT_NEAR(groups[f].mass, as_laid[g].mass, 1e-9 * wanted.mass) << found.groups[f].name;
      }
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_LT((found.lifting_points[i].p_BPin - expected.lifting_points[i].p_BPin).norm(), 1e-12);
  // All of a row runs one way, so that flanges point one way.
  for (const structure::Beam& beam : found.beams)
    EXPECT_GT((found.vertices[beam.vertices[1]] - found.vertices[beam.vertices[0]]).x(), 0);
}

// Stresses under the forces that are turned with the plate, on one mesh and on its turned image.
TEST(ObliqueParts, BearWhatTheyDoInAnAxisPlane) {
  const structure::Mesh mesh = oblique_mesh(oblique(), 0.3);
  const structure::ElasticModel turned(mesh, {2, {}}), flat(laid_flat(mesh), {2, {}});
  const Eigen::MatrixXd found = test::lug_stresses(turned), as_laid = test::lug_stresses(flat);
  ASSERT_EQ(found.rows(), as_laid.rows());
  Eigen::MatrixXd expected(as_laid.rows(), as_laid.cols());
  for (Eigen::Index lug = 0; lug < 2; ++lug)
    expected.middleCols<3>(3 * lug) = as_laid.middleCols<3>(3 * lug) * tilt.transpose();
  EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-8 * expected.cwiseAbs().maxCoeff());
}

// The mesh of the plate that lies in the axis plane is another one.
TEST(ObliqueParts, GiveWayAsTheyDoInAnAxisPlane) {
  const auto compliance = [](const structure::Mesh& mesh) {
    const structure::ElasticModel model(mesh, {3, {}});
    return structure::find_lug_flexibility(structure::UnitResponses(model), 0).compliance;
  };
  const Eigen::MatrixXd found = compliance(oblique_mesh(oblique(), 0.15)),
                        as_laid = compliance(oblique_mesh(laid, 0.15));
  Eigen::MatrixXd expected(6, 6);
  for (Eigen::Index i = 0; i < 2; ++i)
    for (Eigen::Index j = 0; j < 2; ++j)
      expected.block<3, 3>(3 * i, 3 * j) =
          tilt * as_laid.block<3, 3>(3 * i, 3 * j) * tilt.transpose();
  EXPECT_LT((found - expected).norm(), 0.02 * expected.norm());
}

TEST(ObliqueParts, APadeyeStandsInTheFrameOfItsPlate) {
  const ObliqueBlock read = oblique_block(oblique());
  ASSERT_EQ(read.complaints, "");
  const LugModel& lug = *read.block->find_lug("L2");
  std::vector<std::string> faults;
  const auto placed = place_padeye(*read.block->find_padeye(lug), *read.block, lug, faults);
  ASSERT_TRUE(placed);
  EXPECT_TRUE(faults.empty());
  EXPECT_LT((placed->p_BP - (corner + tilt * Vector3(4.15, 1, 0))).norm(), 1e-12);
  EXPECT_LT((placed->R_BP.col(1) - tilt.col(0)).norm(), 1e-12);  // out of the deck
  EXPECT_LT((placed->R_BP.col(2) - tilt.col(2)).norm(), 1e-12);  // along the pin
  EXPECT_NEAR(placed->geometry.height, 0.15, 1e-12);
}

// Two sloping halves of a roof, one the image of the other.
TEST(ObliqueParts, AreMirroredWithTheirPlate) {
  const std::string half =
      "plates:\n  roof: {corners: [[0 m, 0 m, 2 m], [0 m, 3 m, 1 m], [4 m, 3 m, 1 m], [4 m, 0 m, 2 "
      "m]], thickness: 10 mm, stiffeners: {along: v, first: 0.3 m, " +
      row +
      "pads:\n  pad: {plate: roof, u: [1 m, 1.6 m], v: [1 m, 2 m], thickness: 30 mm}\n"
      "lugs:\n  L: {pad: pad, normal: v, at: 1.5 m, u: [1.1 m, 1.5 m], n: [0 m, 0.3 m], thickness: "
      "40 mm, pin: [1.3 m, 1.5 m, 0.2 m]}\n";
  const auto one_side = structure::mass_properties(oblique_mesh(half, 0.4));
  const structure::Mesh mesh = oblique_mesh(half + "mirror:\n  - {normal: y, at: 0 m}\n", 0.4);
  const auto whole = structure::mass_properties(mesh);
  EXPECT_NEAR(whole.mass, 2 * one_side.mass, 1e-9 * whole.mass);
  EXPECT_NEAR(whole.centre.y(), 0, 1e-9);
  EXPECT_NEAR(whole.centre.z(), one_side.centre.z(), 1e-9);
  EXPECT_NEAR(whole.inertia(0, 1), 0, 1e-9 * whole.inertia.norm());
  EXPECT_NEAR(whole.inertia(1, 2), 0, 1e-9 * whole.inertia.norm());
  ASSERT_EQ(mesh.lifting_points.size(), 2U);
  const Vector3 pin = mesh.lifting_points[0].p_BPin;
  EXPECT_LT((mesh.lifting_points[1].p_BPin - Vector3(pin.x(), -pin.y(), pin.z())).norm(), 1e-12);
}

std::string replaced(std::string text, const std::string& old_text, const std::string& new_text) {
  return text.replace(text.find(old_text), old_text.size(), new_text);
}

TEST(ObliqueParts, SaysWhatIsWrong) {
  const std::string good = oblique();
  const auto complaints = [&](const std::string& old_text, const std::string& new_text) {
    return oblique_block(replaced(good, old_text, new_text)).complaints;
  };
  EXPECT_THAT(
      complaints("u: [0.5 m, 1.1 m], v: [0.5 m, 1.5 m]", "u: [0.5 m, 1.1 m], v: [0.5 m, 2.5 m]"),
      HasSubstr("pad pad reaches to u = 0.5 m, v = 2.5 m, beyond its plate deck"));
  EXPECT_THAT(complaints("u: [0.5 m, 1.1 m], v: [0.5 m, 1.5 m]",
                         "normal: z, at: 0 m, x: [0.5 m, 1.1 m], y: [0.5 m, 1.5 m]"),
              AllOf(HasSubstr("give u and v in the plate's own frame"),
                    HasSubstr("lug L1 is given in the frame of its plate, its pad pad in that of "
                              "the block")));
  EXPECT_THAT(complaints("pin: [0.8 m, 1 m, 0.2 m]", "pin: [0.8 m, 1 m, 0.4 m]"),
              HasSubstr("the pin of lug L1 is at n = 0.4 m, outside the lug plate, which reaches "
                        "from 0 m to 0.3 m"));
  EXPECT_THAT(complaints("n: [0 m, 0.3 m], ", ""), HasSubstr("lug L1 lacks the key \"n\""));
  EXPECT_THAT(complaints("along: u", "along: x"), HasSubstr("it must be one of u, v"));
  EXPECT_THAT(oblique_block(replaced(laid, "normal: z, at: 0 m, x: [0.5 m, 1.1 m], y:",
                                     "u: [0.5 m, 1.1 m], v:"))
                  .complaints,
              HasSubstr("pad pad is on plate deck, which is normal to an axis"));
  EXPECT_THAT(oblique_block(good + "repeat:\n  - {parts: [pad], count: 1, step: [1 m, 0 m, 0 m]}\n")
                  .complaints,
              HasSubstr("pad pad would be copied without deck, in whose frame it is"));
  // What the mesh alone shows.
  const auto fault = [&](const std::string& old_text, const std::string& new_text) {
    const ObliqueBlock read = oblique_block(replaced(good, old_text, new_text));
    EXPECT_EQ(read.complaints, "");
    try {
      structure::generate_shell_mesh(describe_block(*read.block, "block", 0.5));
    } catch (const structure::ModelError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(fault("u: [0.5 m, 1.1 m], v: [0.5 m, 1.5 m]", "u: [0.5 m, 3.1 m], v: [0.6 m, 1.5 m]"),
              HasSubstr("pad \"pad\" reaches beyond its plate \"deck\" or over an opening"));
  EXPECT_THAT(fault("normal: v, at: 1 m",
                    "normal: v, at: 1.8 m, u: [0.6 m, 1 m], n: [0 m, 0.3 m], "
                    "thickness: 40 mm, pin: [0.8 m, 1.8 m, 0.2 m]}\n"
                    "  L3: {pad: pad, normal: v, at: 1 m"),
              HasSubstr("lug \"L1\" does not touch its pad \"pad\""));
}

}  // namespace
}  // namespace blocklift::pipeline
