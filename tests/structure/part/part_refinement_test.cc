// Sizes of the next mesh from the error of the last.
#include "structure/part/part_refinement.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "structure/error.h"

namespace blocklift::structure {
namespace {

namespace fs = std::filesystem;

// An L of two squares of 1 m and a corner, 0.5 m thick, pulled apart at its arms: singular at the
// inner edge.
class LShape : public ::testing::Test {
 protected:
  LShape()
      : path_(fs::temp_directory_path() / ("blocklift-l-" + std::to_string(::getpid()) + ".geo")) {
    std::ofstream(path_) << R"(
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 2, 2, 0.5};
Box(2) = {1, 1, 0, 1, 1, 0.5};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Physical Surface("root") = Surface In BoundingBox{-0.01, 1.99, -0.01, 1.01, 2.01, 0.51};
Physical Surface("end") = Surface In BoundingBox{1.99, -0.01, -0.01, 2.01, 1.01, 0.51};
)";
  }
  ~LShape() override { fs::remove(path_); }

  PartModel read(const PartReading& reading) const {
    PartModel model;
    model.mesh = read_part_mesh(path_.string(), reading);
    model.materials = {{"steel", 206e9, 0.3, 7850, 235e6}};
    model.material_of_solid.assign(model.mesh.solids.size(), 0);
    model.supports = {{"root", "root", {true, true, true}, Vector3::Zero()}};
    model.surface_loads = {{"pull", "end", SurfaceLoad::Kind::force, 0, Vector3(0, -1e6, 0)}};
    return model;
  }

  fs::path path_;
};

// The inner edge is singular, so that the sizes come in a few rounds; then the error is that of
// elements of half the size all over with less than half as many of them.
TEST_F(LShape, SizesMeetTheAimWithFewerElementsThanHalving) {
  PartReading reading;
  reading.element_size = 1;
  reading.refinements = 1;
  const PartModel halved = read(reading);
  const double even = solve_part(halved).estimated_error;
  reading.refinements = 0;
  RefinementAim aim;
  aim.error = even;
  PartModel model = read(reading);
  ASSERT_TRUE(takes_sizes(model.mesh));
  PartSolution solution = solve_part(model);
  EXPECT_GT(solution.estimated_error, 1.3 * even);
  for (int round = 0; round < 4 && solution.estimated_error > even; ++round) {
    reading.sizes = find_sizes(model, solution, aim);
    model = read(reading);
    solution = solve_part(model);
  }
  EXPECT_LE(solution.estimated_error, even);
  EXPECT_LT(model.mesh.solids.size(), halved.mesh.solids.size() / 2);
}

TEST_F(LShape, PlacesGetSmallerElementsAroundThem) {
  PartReading reading;
  reading.element_size = 0.5;
  const PartModel model = read(reading);
  PartSolution none;
  none.squared_error = Eigen::VectorXd::Zero(model.mesh.solids.size());
  const SizeField before = find_sizes(model, none, {});
  RefinementAim aim;
  aim.places = {Vector3(1, 1, 0.25)};
  const SizeField after = find_sizes(model, none, aim);
  for (Eigen::Index i = 0; i < after.sizes.size(); ++i) {
    const double distance = (after.places.col(i) - aim.places[0]).norm();
    EXPECT_LE(after.sizes[i], reading.element_size / 2 + 0.3 * distance);
    if (distance > before.sizes.maxCoeff() / 0.3) {
      EXPECT_EQ(after.sizes[i], before.sizes[i]);
    }
  }
  EXPECT_LT(after.sizes.sum(), before.sizes.sum());
}

TEST_F(LShape, OtherMeshesTakeNoSizes) {
  PartReading reading;
  reading.element_size = 0.5;
  PartModel model = read(reading);
  model.mesh.meshed_here = false;
  EXPECT_FALSE(takes_sizes(model.mesh));
  EXPECT_THROW(find_sizes(model, PartSolution(), {}), ModelError);
}

}  // namespace
}  // namespace blocklift::structure
