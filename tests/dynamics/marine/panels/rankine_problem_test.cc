#include "dynamics/marine/panels/rankine_problem.h"

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/marine/panels/coupling_reach.h"
#include "dynamics/marine/panels/panel_shapes.h"
#include "dynamics/marine/radiation/frequency_domain.h"
#include "dynamics/marine/radiation/hydrodynamic_database.h"
#include "dynamics/marine/radiation/radiation.h"

namespace blocklift::dynamics {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double half_sphere = 2.0 / 3.0 * std::numbers::pi;

PanelModel make_sphere_model(const Symmetry& symmetry, int meridians = 12, int parallels = 4,
                             double depth = std::numeric_limits<double>::infinity(),
                             double growth = 1.25) {
  const std::vector<WettedBody> bodies{
      {"sphere", make_half_ellipsoid({1, 1, 1}, {.meridians = meridians, .parallels = parallels}),
       Vector3::Zero()}};
  const SurfaceMesh surface = make_surface_mesh(
      find_water_lines(bodies), {.first_ring = 0.2, .growth = growth, .radius = 25});
  return {bodies, surface, {1.0, 1.0, depth}, symmetry};
}

DatabaseSettings short_settings() {
  DatabaseSettings settings;
  settings.frequencies = {0.6, 1.0, 1.4};
  settings.headings = {0.0, 0.7};
  settings.duration = 20.0;
  return settings;
}

// Lamb, art. 92: the added mass of a sphere is half the displaced mass. The surface is so far away
// (1000 radii) that its image changes it by 3/8 (a/2h)^3 = 5e-11. Second order in the panel size.
TEST(RankineProblem, DeepSphereWithoutASurface) {
  std::vector<double> error;
  for (const int n : {8, 16}) {
    const PanelMesh sphere =
        make_ellipsoid({1, 1, 1}, {0, 0, -1000}, {.meridians = 2 * n, .parallels = n / 2});
    const PanelModel model({{"sphere", sphere, {0, 0, -1000}}}, {}, {1, 1});
    const RankinePart part(model, {});
    const Eigen::MatrixXd& A = part.infinite_frequency_volume();
    error.push_back(A(2, 2) / (2.0 * half_sphere) - 0.5);
    EXPECT_NEAR(A(0, 0), A(1, 1), 1e-9);
    for (std::size_t m = 0; m < part.modes().size(); ++m) {  // a sphere turns freely
      const auto k = static_cast<Eigen::Index>(m);
      if (part.modes()[m] >= roll) {
        EXPECT_LT(A(k, k), 1e-3);
      }
    }
  }
  EXPECT_LT(std::abs(error[1]), 0.01 * 0.5);
  EXPECT_GT(std::abs(error[0] / error[1]), 2.5);
}

// The planes of symmetry change the order of the sums, and nothing else.
TEST(RankineProblem, SymmetryDoesNotChangeTheResult) {
  const PanelModel whole = make_sphere_model({}), quarter = make_sphere_model({true, true});
  EXPECT_EQ(4 * quarter.body_mesh().size(), whole.body_mesh().size());
  DatabaseSettings settings = short_settings();
  settings.time_step = 0.1;
  const HydrodynamicDatabase a = compute_database(whole, settings),
                             b = compute_database(quarter, settings);
  EXPECT_LT((a.infinite_added_mass - b.infinite_added_mass).norm(),
            1e-9 * a.infinite_added_mass.norm());
  for (std::size_t k = 0; k < settings.frequencies.size(); ++k) {
    // The march keeps its operator in single precision.
    EXPECT_LT((a.added_mass[k] - b.added_mass[k]).norm(), 1e-5 * a.added_mass[k].norm());
    EXPECT_LT((a.damping[k] - b.damping[k]).norm(), 1e-5 * a.added_mass[k].norm());
    EXPECT_LT((a.excitation(k) - b.excitation(k)).norm(), 1e-5 * a.excitation(k).norm());
  }
}

TEST(RankineProblem, OperatorIsSymmetricAndPositive) {
  const PanelModel model = make_sphere_model({true, true});
  for (const Parity& parity : model.parities()) {
    const RankinePart part(model, parity);
    const Eigen::MatrixXd M = part.surface_operator().cast<double>();
    EXPECT_EQ((M - M.transpose()).norm(), 0.0);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(M, Eigen::EigenvaluesOnly);
    EXPECT_GT(eigen.eigenvalues()[0], 0.0);
    // The step limit is that of the largest eigenvalue, found by power iteration.
    const FreeSurfaceMarch march(part, {Eigen::VectorXd::Zero(M.rows())}, 1.0, 1);
    const double exact = 2.0 / std::sqrt(eigen.eigenvalues()[M.rows() - 1]);
    EXPECT_LE(march.step_limit(), exact);
    EXPECT_GT(march.step_limit(), 0.97 * exact);
  }
}

// Of so many panels the march holds its operator as a hierarchical matrix: beside steps with the
// whole one, in double precision.
TEST(RankineProblem, ManyPanelsAreMarchedAsByTheWholeOperator) {
  const PanelModel model =
      make_sphere_model({}, 72, 4, std::numeric_limits<double>::infinity(), 1.05);
  ASSERT_GT(model.surface_mesh().size(), 2500);
  const RankinePart part(model, {});
  const SurfaceDamping damping{DampingZone{0.5}.rates(model.surface())};
  const Eigen::VectorXd& rates = damping.rates;
  Eigen::MatrixXd M = part.surface_operator().cast<double>();
  M.diagonal() += rates.cwiseAbs2();
  FreeSurfaceMarch march(part, damping, 1.0, part.surface_columns().cols());
  const double step = 0.9 * march.step_limit();
  march.start(part.surface_columns(), step);
  Eigen::MatrixXd elevation = part.surface_columns(), potential = 0.5 * step * elevation;
  const Eigen::VectorXd after = (1.0 + step * rates.array()).inverse();
  const Eigen::VectorXd kept = after.cwiseProduct((1.0 - step * rates.array()).matrix());
  for (int k = 0; k < 100; ++k) {
    march.advance();
    potential -= step * elevation;
    elevation = kept.asDiagonal() * elevation + step * (after.asDiagonal() * (M * potential));
  }
  EXPECT_LT((march.elevation() - elevation).norm(), 1e-4 * elevation.norm());
}

// The march in time and the dense system in frequency hold the same matrices: they differ by the
// end of the run and the damping zone's share in the time step alone.
TEST(RankineProblem, TimeAndFrequencyDomainAgree) {
  const PanelModel model = make_sphere_model({true, true});
  DatabaseSettings settings = short_settings();
  settings.duration = 200.0;
  settings.time_step = 0.2;
  settings.damping_strength = 2.0;
  const HydrodynamicDatabase database = compute_database(model, settings);
  RankineSettings rankine;
  rankine.keep_factors = true;
  const RankinePart part(model, {1, 1}, rankine);
  const FrequencyDomain direct(model, part,
                               DampingZone{2.0}.damping(model.surface(), model.water().gravity));
  for (std::size_t k = 0; k < settings.frequencies.size(); ++k) {
    Eigen::MatrixXd A, B;
    const double w = settings.frequencies[k];
    direct.calc_radiation(w, A, B);
    ASSERT_EQ(part.modes()[0], heave);
    EXPECT_NEAR(database.added_mass[k](heave, heave), A(0, 0), 0.004 * A(0, 0));
    EXPECT_NEAR(database.damping[k](heave, heave), B(0, 0), 0.004 * w * A(0, 0));
  }
}

TEST(DampingLid, HoldsOnItsRectangleAndKeepsItsSymmetry) {
  const PanelModel model = make_sphere_model({true, true});
  DampingZone zone{0.0, {{{2, -1}, {4, 1}, 0.3}, {{-4, -1}, {-2, 1}, 0.3}}};
  const Eigen::VectorXd rates = zone.rates(model.surface());
  const auto& panels = model.surface_mesh().panels;
  for (Eigen::Index k = 0; k < rates.size(); ++k) {
    const Vector3& p = panels[k].centroid;
    const bool inside = p.x() > 2 && p.x() < 4 && p.y() < 1;
    EXPECT_EQ(rates[k], inside ? 0.3 : 0.0);
  }
  EXPECT_GT(rates.maxCoeff(), 0.0);
  EXPECT_EQ(keep_symmetry({true, true}, zone.lids), (Symmetry{true, true}));
  zone.lids.pop_back();
  EXPECT_EQ(keep_symmetry({true, true}, zone.lids), (Symmetry{false, true}));
  EXPECT_EQ(keep_symmetry({true, true}, {}), (Symmetry{true, true}));
}

// The surface marched beside a sphere that heaves, under a lid all around it, answers as the
// retardation functions computed under the same lid, and otherwise than without.
TEST(DampingLid, ActsAlikeInTheDatabaseAndBesideTheBodies) {
  constexpr double step = 0.05;
  const PanelModel model = make_sphere_model({true, true});
  const DampingLid lid{{-3, -3}, {3, 3}, 0.6};
  const auto last_force = [&](const std::vector<DampingLid>& lids) {
    DirectRadiation::Settings settings;
    settings.damping_strength = 0.5;
    settings.lids = lids;
    DirectRadiation direct(model, settings);
    direct.start(step);
    Eigen::VectorXd velocity = Eigen::VectorXd::Zero(6);
    for (int k = 0; k < 120; ++k) {
      velocity[heave] = std::sin(0.8 * step * (k + 0.5));
      direct.advance(velocity);
    }
    return direct.calc_force()[heave];
  };
  DatabaseSettings settings = short_settings();
  settings.time_step = step;
  settings.damping_strength = 0.5;
  settings.lids = {lid};
  const HydrodynamicDatabase database = compute_database(model, settings);
  double sum = 0.0;
  for (int k = 0; k < 120; ++k) {
    const auto lag = static_cast<std::size_t>(119 - k);
    const double K = 0.5 * (database.retardation[lag](heave, heave) +
                            database.retardation[lag + 1](heave, heave));
    sum -= step * K * std::sin(0.8 * step * (k + 0.5));
  }
  const double under_lid = last_force({lid});
  EXPECT_NEAR(under_lid, sum, 0.01 * std::abs(sum));
  EXPECT_GT(std::abs(last_force({}) - under_lid), 0.1 * std::abs(sum));
}

TEST(RankineProblem, RefusesWhatDoesNotFitIntoMemory) {
  const PanelModel model = make_sphere_model({});
  RankineSettings settings;
  settings.memory_limit = 1e5;
  EXPECT_THAT([&] { RankinePart(model, {}, settings); },
              ThrowsMessage<SimulationError>(HasSubstr("GB may be used")));
  // Two square matrices of the surface in single precision are most of it.
  EXPECT_NEAR(rankine_part_bytes(1000, 10000, false), 8.0 * (1e8 + 4e7 + 2e6), 1.0);
}

TEST(RankineProblem, MemoryCountsTheCoarserSolution) {
  const PanelModel model = make_sphere_model({});
  DatabaseSettings settings = short_settings();
  const double without = database_bytes(model, settings);
  settings.with_coarser = true;
  const double with = database_bytes(model, settings);
  const int coarser_bodies = cluster_panels(model.body_mesh()).count;
  EXPECT_GT(with, without + rankine_part_bytes(coarser_bodies, 0, false));
  EXPECT_LT(with, 2.0 * without);
}

/// A box of 40 x 16 m that draws 4 m, in even panels.
PanelModel make_even_box(int length, int breadth, int draught, double depth) {
  const std::vector<WettedBody> bodies{
      {"box",
       make_box_hull(40.0, 16.0, 4.0,
                     {.length = length, .breadth = breadth, .draught = draught, .grading = 1.0}),
       Vector3::Zero()}};
  const auto lines = find_water_lines(bodies);
  return {bodies,
          make_surface_mesh(lines, surface_settings(lines, 30.0, 60.0)),
          {1000.0, 9.80665, depth},
          {true, true}};
}

// Besides the coarser matrices those rows that have their equations at the middles of flat
// clusters, with the finer panels still: a quarter of the bodies' here.
TEST(RankineProblem, MemoryCountsTheEquationsAtMiddles) {
  for (const double depth : {std::numeric_limits<double>::infinity(), 8.0}) {
    const PanelModel model = make_even_box(20, 8, 2, depth);
    DatabaseSettings settings = short_settings();
    settings.headings.clear();
    const double without = database_bytes(model, settings);
    settings.with_coarser = true;
    const double with = database_bytes(model, settings);
    const PanelClusters clusters = cluster_panels(model.body_mesh());
    const auto rows =
        static_cast<double>(find_flat_clusters(model.body_mesh(), clusters).clusters.size());
    const double bodies = model.body_mesh().size(), surface = model.surface_mesh().size();
    EXPECT_EQ(rows, bodies / 4);
    const bool deep = is_deep(model.water());
    // The surface's clusters are at least a quarter of its panels.
    const int fewest = model.surface_mesh().size() / 4;
    const double coarser = rankine_part_bytes(clusters.count, fewest, !deep) +
                           FreeSurfaceMarch::operator_bytes(fewest);
    EXPECT_GT(with - without, coarser + 8.0 * rows * (2.0 * bodies + (deep ? 1.0 : 2.0) * surface));
  }
}

// Panels of 2 m taken together are what panels of 4 m are: at infinite frequency the added mass of
// heave, surge and pitch changes as much, to a quarter. With equations in the mean over the
// clusters heave changed by half of that. So it is where the bottom's image is nearer than a panel
// is wide.
class ClustersOfABox : public ::testing::TestWithParam<double> {};

TEST_P(ClustersOfABox, AreAMeshOfTwiceTheSize) {
  const PanelModel fine = make_even_box(20, 8, 2, GetParam());
  const PanelModel coarse = make_even_box(10, 4, 1, GetParam());
  RankineSettings settings;
  settings.coarser = std::make_shared<const CoarserPanels>(
      make_coarser_panels(fine.body_mesh(), fine.surface_mesh()));
  EXPECT_EQ(settings.coarser->bodies.count, coarse.body_mesh().size());
  EXPECT_EQ(settings.coarser->flat.clusters.size(),
            static_cast<std::size_t>(coarse.body_mesh().size()));
  for (const Parity& parity : {Parity{1, 1}, Parity{-1, 1}}) {
    const RankinePart part(fine, parity, settings), of_coarse(coarse, parity);
    const Eigen::VectorXd mass = part.infinite_frequency_volume().diagonal();
    const Eigen::VectorXd changed = part.coarser()->infinite_frequency_volume().diagonal() - mass;
    const Eigen::VectorXd expected = of_coarse.infinite_frequency_volume().diagonal() - mass;
    for (Eigen::Index m = 0; m < mass.size(); ++m) {
      EXPECT_GT(expected[m], 0.03 * mass[m]) << m;
      EXPECT_NEAR(changed[m], expected[m], 0.25 * expected[m]) << m;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Depths, ClustersOfABox,
                         ::testing::Values(std::numeric_limits<double>::infinity(), 4.05));

// Four panels in each cluster: the change is the error at first order, with caution. Of three
// and of none it is more, and not known.
TEST(PanelClusters, ErrorIsTheChangeAtFirstOrder) {
  const Eigen::VectorXd change = Eigen::VectorXd::Constant(6, 0.1);
  const PanelClusters fours{{0, 0, 0, 0, 1, 1, 1, 1}, 2}, threes{{0, 0, 0, 1, 1, 1}, 2};
  EXPECT_NEAR(error_of_panels(change, fours)[0], caution_with_panels * 0.1, 1e-12);
  EXPECT_NEAR(error_of_panels(change, threes)[5],
              caution_with_panels * 0.1 / (std::sqrt(3.0) - 1.0), 1e-12);
  EXPECT_TRUE(std::isinf(error_of_panels(change, {{0, 1, 2}, 3})[0]));
}

// On a curved hull the middle of a cluster lies within it: equations stay in the mean there.
TEST(PanelClusters, OfASphereAreNotFlat) {
  const PanelModel sphere = make_sphere_model({true, true});
  const FlatClusters flat =
      find_flat_clusters(sphere.body_mesh(), cluster_panels(sphere.body_mesh()));
  EXPECT_TRUE(flat.clusters.empty());
}

/// A cylinder of radius 1 m and draught 0.5 m, its surface meshed for 1 to 4 rad/s.
PanelModel make_cylinder_model(int meridians) {
  const Water water{1.0, 9.80665};
  const std::vector<WettedBody> bodies{{"cylinder",
                                        make_vertical_cylinder(1.0, 0.5, true,
                                                               {.meridians = meridians,
                                                                .parallels = meridians / 4,
                                                                .grading = 5.0,
                                                                .graded_edge = true}),
                                        Vector3::Zero()}};
  const auto lines = find_water_lines(bodies);
  const auto length = [&](double w) { return 2.0 * std::numbers::pi / calc_wave_number(w, water); };
  const SurfaceMesh surface =
      make_surface_mesh(lines, surface_settings(lines, length(4.0), length(1.0)));
  return {bodies, surface, water, {true, true}};
}

// Surge by matched eigenfunctions; 784 panels in all come within 4 % of it, where a first ring of a
// fifteenth of the shortest wave, 0.26 m, would leave 9 % however fine the hull is.
TEST(HydrodynamicDatabase, SurgeOfATruncatedCylinderFollowsItsPanels) {
  DatabaseSettings settings;
  settings.frequencies = {1.4, 3.0, 4.0};
  settings.with_coarser = true;
  settings.duration = 20.0;
  const PanelModel model = make_cylinder_model(16);
  const HydrodynamicDatabase database = compute_database(model, settings);
  const std::vector<double> A = {.72495, .88176, .43641}, B = {.012839, 1.43016, 2.70330};
  double worst = 0.0;
  for (std::size_t k = 0; k < A.size(); ++k) {
    const double w = settings.frequencies[k];
    const double size = std::hypot(w * A[k], B[k]);
    const double error = std::hypot(w * (database.added_mass[k](surge, surge) - A[k]),
                                    database.damping[k](surge, surge) - B[k]) /
                         size;
    EXPECT_LT(error, 0.04) << w;
    worst = std::max(worst, error);
  }
  // What coarser panels change bounds the error, and is of its size.
  const Eigen::VectorXd& change = database.change_from_coarser;
  ASSERT_EQ(change.size(), 6);
  EXPECT_GT(change[surge], worst);
  EXPECT_LT(change[surge], 10.0 * worst);
  EXPECT_NEAR(change[sway], change[surge], 1e-3);
  EXPECT_EQ(change[yaw], 0.0);  // a round body does not move the water
}

// Panels between bodies are wider the farther they lie apart; beyond 16 radii waves of six radii
// (1 rad/s) are lost.
TEST(CouplingReach, ShrinksWithTheDistance) {
  const PanelMesh sphere = make_half_ellipsoid({1, 1, 1}, {.meridians = 24, .parallels = 6});
  const auto reach_at = [&](double distance) {
    const std::vector<WettedBody> bodies{{"left", translate(sphere, {-distance / 2, 0, 0}), {}},
                                         {"right", translate(sphere, {distance / 2, 0, 0}), {}}};
    const auto lines = find_water_lines(bodies);
    const SurfaceMesh surface = make_surface_mesh(lines, surface_settings(lines, 3.0, 10.0));
    const PanelModel model(bodies, surface, {1.0, 1.0}, {true, true});
    return find_coupling_reach(model).value();
  };
  const CouplingReach near = reach_at(4.0), far = reach_at(16.0);
  EXPECT_NEAR(near.gap, 2.0, 0.05);
  EXPECT_NEAR(far.gap, 14.0, 0.05);
  EXPECT_LT(near.shortest, 2.0 * std::numbers::pi);
  EXPECT_GT(far.shortest, 2.0 * std::numbers::pi);
  EXPECT_FALSE(find_coupling_reach(make_sphere_model({true, true})));
}

TEST(HydrodynamicDatabase, RefusesFrequenciesOutOfOrder) {
  const PanelModel model = make_sphere_model({true, true});
  DatabaseSettings settings = short_settings();
  settings.frequencies = {1.0, 0.5};
  EXPECT_THAT([&] { compute_database(model, settings); },
              ThrowsMessage<ModelError>(HasSubstr("must be positive and ascend")));
}

TEST(HydrodynamicDatabase, RefusesWavesTooShortForThePanels) {
  const PanelModel model = make_sphere_model({true, true});
  DatabaseSettings settings = short_settings();
  settings.frequencies = {0.6, 5.0};  // a wave of 2 pi/25 m
  EXPECT_THAT([&] { compute_database(model, settings); },
              ThrowsMessage<ModelError>(AllOf(HasSubstr("waves are 0.251327 m long"),
                                              HasSubstr("at least three must go into a wave"))));
}

}  // namespace
}  // namespace blocklift::dynamics
