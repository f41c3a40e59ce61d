// The block as pictures show it and as ParaView reads it.
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "structure/error.h"
#include "structure/mesh/plates/shell_generator.h"
#include "structure/output/surface.h"
#include "structure/output/vtu.h"
#include "structure/response/unit_responses.h"
#include "structure/stress/shell_stress.h"
#include "tests/structure/hull_block.h"

namespace blocklift::structure {
namespace {

/// The small block with a flat bar under its bottom, once for all tests of it.
class SmallBlock : public ::testing::Test {
 protected:
  static Mesh mesh() {
    Mesh mesh = generate_shell_mesh(test::small_block());
    BeamSection bar;
    bar.area = 0.01 * 0.1;
    bar.second_moment_2 = 0.1 * std::pow(0.01, 3) / 12;
    bar.second_moment_3 = 0.01 * std::pow(0.1, 3) / 12;
    bar.torsion = 0.1 * std::pow(0.01, 3) / 3;
    bar.shear_area_2 = bar.shear_area_3 = 5.0 / 6 * bar.area;
    bar.stress_points = {{0.05, 0}, {-0.05, 0}};
    mesh.beam_sections = {bar};
    mesh.groups.push_back({"bars", 0});
    mesh.regions.push_back({"bars", static_cast<int>(mesh.groups.size()) - 1, false});
    // Along one edge of every shell of the bottom.
    for (const Shell& shell : mesh.shells) {
      if (mesh.group_of_region(shell.region).name != "bottom") continue;
      Beam beam;
      beam.vertices = {shell.vertices[0], shell.vertices[1]};
      beam.offset = {Vector3(0, 0, 0.06), Vector3(0, 0, 0.06)};
      beam.region = static_cast<int>(mesh.regions.size()) - 1;
      mesh.beams.push_back(beam);
    }
    return mesh;
  }
  static void SetUpTestSuite() {
    model_ = new ElasticModel(mesh(), {3, {}});
    responses_ = new UnitResponses(*model_);
  }
  static void TearDownTestSuite() {
    delete responses_;
    delete model_;
  }

  /// Forces at the four lugs that the block's acceleration balances.
  static LoadCase lift(double sway) {
    LoadCase load_case{"lift & sway", {}, {}};
    Wrench pull;
    for (const LiftingPoint& lug : model_->mesh().lifting_points) {
      const Vector3 force(sway * 500.0 * lug.p_BPin.x(), -800 * sway,
                          19000 + 1000.0 * lug.p_BPin.y());
      load_case.lug_forces_B.push_back(force);
      pull.force += force;
      pull.moment += lug.p_BPin.cross(force);
    }
    load_case.field = balancing_field(model_->mass_properties(), pull);
    return load_case;
  }

  static int beam_quads(const Surface& surface) {
    const auto& names = surface.group_names();
    const auto bars =
        static_cast<int>(std::find(names.begin(), names.end(), "bars") - names.begin());
    return static_cast<int>(
        std::count(surface.quad_groups().begin(), surface.quad_groups().end(), bars));
  }

  static ElasticModel* model_;
  static UnitResponses* responses_;
};
ElasticModel* SmallBlock::model_ = nullptr;
UnitResponses* SmallBlock::responses_ = nullptr;

TEST_F(SmallBlock, SurfaceCoversPlatesAndBeams) {
  const Surface surface(*model_);
  ASSERT_EQ(surface.quad_groups().size(), surface.quads().size());
  std::map<std::string, double> area;
  for (std::size_t q = 0; q < surface.quads().size(); ++q) {
    const auto x = [&](std::size_t i) { return surface.points()[surface.quads()[q][i]]; };
    area[surface.group_names()[surface.quad_groups()[q]]] +=
        0.5 * (x(2) - x(0)).cross(x(3) - x(1)).norm();
  }
  EXPECT_NEAR(area["bottom"], 4 * 3, 1e-9);
  EXPECT_NEAR(area["frames"], 3 * 3 * 2, 1e-9);
  EXPECT_NEAR(area["pad_L1"] + area["pad_L2"] + area["pad_L3"] + area["pad_L4"] + area["sides"],
              2 * 4 * 2, 1e-9);
  EXPECT_NEAR(area["L1"], 0.8 * 0.4, 1e-9);
  double bars = 0;
  for (const Beam& beam : model_->mesh().beams)
    bars += 0.1 *
            (model_->mesh().vertices[beam.vertices[1]] - model_->mesh().vertices[beam.vertices[0]])
                .norm();
  EXPECT_NEAR(area["bars"], bars, 1e-9);
  EXPECT_EQ(beam_quads(surface), 3 * static_cast<int>(model_->mesh().beams.size()));
  // Cubic cells in threes, where the points are not too many; points are shared within a plate.
  EXPECT_EQ(surface.quads().size(),
            9 * model_->space().shells().size() + 3 * model_->mesh().beams.size());
  EXPECT_LT(surface.points().size(), 14 * model_->space().shells().size());
  const Surface coarse(*model_, 300);
  EXPECT_EQ(coarse.quads().size(), model_->space().shells().size() + model_->mesh().beams.size());
}

TEST_F(SmallBlock, SurfaceCarriesTheMotionOfItsNodes) {
  const Surface surface(*model_);
  const LoadCase load_case = lift(1);
  const SurfaceField field = surface.evaluate(*responses_, {load_case})[0];
  ASSERT_EQ(field.von_mises.size(), surface.points().size());
  const Eigen::Matrix3Xd exact = responses_->elastic_displacement(load_case);
  int seen = 0;
  for (std::size_t p = 0; p < surface.points().size(); ++p) {
    Eigen::Index node = 0;
    const double distance =
        (model_->space().nodes().colwise() - surface.points()[p]).colwise().norm().minCoeff(&node);
    if (distance > 1e-9) continue;  // between nodes
    ++seen;
    EXPECT_LT((field.displacement[p] - exact.col(node)).norm(), 1e-9 * exact.norm());
  }
  EXPECT_GT(seen, static_cast<int>(model_->space().shells().size()));
}

// The envelope over instants is at each point the largest of the cells there: not below the mean of
// any instant, and the same within cells, where there is one.
TEST_F(SmallBlock, EnvelopeIsTheLargestOfAllInstants) {
  const Surface surface(*model_);
  std::vector<double> largest(surface.points().size(), 0);
  Eigen::MatrixXd factors(responses_->count(), 5);
  for (int k = 0; k < 5; ++k) {
    const LoadCase load_case = lift(2 * std::sin(k));
    factors.col(k) = responses_->coefficients(load_case);
    const SurfaceField field = surface.evaluate(*responses_, {load_case})[0];
    for (std::size_t p = 0; p < largest.size(); ++p)
      largest[p] = std::max(largest[p], field.von_mises[p]);
  }
  const LoadHistory history(factors, Eigen::VectorXd::Ones(factors.rows()));
  const std::vector<double> envelope = surface.envelopes(*responses_, {history})[0];
  ASSERT_EQ(envelope.size(), largest.size());
  const double scale = *std::max_element(envelope.begin(), envelope.end());
  int same = 0;
  for (std::size_t p = 0; p < largest.size(); ++p) {
    EXPECT_GE(envelope[p], largest[p] - 1e-9 * scale);
    if (std::abs(envelope[p] - largest[p]) < 1e-9 * scale) ++same;
  }
  // Of a cubic cell's points four lie inside.
  EXPECT_GE(same, 4 * static_cast<int>(model_->space().shells().size()));
}

TEST_F(SmallBlock, VtuFileHoldsAllPointsAndCells) {
  const auto path = std::filesystem::temp_directory_path() /
                    ("blocklift-pictures-" + std::to_string(::getpid()) + ".vtu");
  write_vtu(path.string(), *responses_, lift(1));
  std::ifstream file(path);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  std::filesystem::remove(path);
  const std::size_t shells = model_->space().shells().size(),
                    beams = model_->space().beams().size();
  const std::string piece = "NumberOfPoints=\"" + std::to_string(16 * shells + 4 * beams) +
                            "\" NumberOfCells=\"" + std::to_string(9 * shells + 3 * beams) + "\"";
  for (const std::string& needed :
       {piece, std::string("Name=\"displacement\""), std::string("Name=\"von_mises\""),
        std::string("Name=\"von_mises_top\""), std::string("Name=\"von_mises_bottom\""),
        std::string("Name=\"von_mises_membrane\""), std::string("Name=\"thickness\""),
        std::string("Name=\"group_names\""), std::string("Name=\"plate_names\""),
        std::string("</VTKFile>")})
    EXPECT_NE(text.find(needed), std::string::npos) << needed;
  EXPECT_THROW(write_vtu("/nowhere/at/all.vtu", *responses_, lift(1)), ModelError);
}

}  // namespace
}  // namespace blocklift::structure
