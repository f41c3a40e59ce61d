// Hydrodynamics of a box between two draughts, as a body that is lowered feels it, against those
// computed at the draught itself.
#include <algorithm>
#include <cstdio>
#include <numbers>

#include <gtest/gtest.h>

#include "dynamics/marine/loads/draught_shares.h"
#include "dynamics/marine/panels/panel_shapes.h"
#include "dynamics/marine/radiation/hydrodynamic_database.h"

namespace blocklift::dynamics {
namespace {

const Water water{1025.0, 9.81};

/// A box of 20 x 8 m at a draught (m), by panels that go with it, so that their error changes
/// smoothly as well.
HydrodynamicDatabase at_draught(double draught) {
  std::vector<WettedBody> bodies{
      {"box", make_box_hull(20, 8, draught, {12, 6, 2, 2.0}), Vector3::Zero()}};
  const Symmetry symmetry = find_symmetry(bodies);
  const auto lines = find_water_lines(bodies);
  const double shortest = 2 * std::numbers::pi / calc_wave_number(1.6, water);
  const double longest = 2 * std::numbers::pi / calc_wave_number(0.7, water);
  const auto surface = make_surface_mesh(lines, surface_settings(lines, shortest, longest));
  DatabaseSettings settings;
  settings.frequencies = {0.7, 1.0, 1.3, 1.6};
  settings.headings = {0.0, std::numbers::pi / 4, std::numbers::pi / 2};
  return compute_database(PanelModel(std::move(bodies), surface, water, symmetry), settings);
}

/// Largest errors over frequencies, modes and headings: of added mass and damping over the roots of
/// what both modes have on the diagonal at most, of the excitation over the mode's largest.
struct Errors {
  double added_mass = 0, damping = 0, excitation = 0;
};

double largest_share(const std::vector<Eigen::MatrixXd>& found,
                     const std::vector<Eigen::MatrixXd>& exact) {
  Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(exact[0].rows());
  for (const auto& matrix : exact) diagonal = diagonal.cwiseMax(matrix.diagonal());
  const Eigen::VectorXd inverse = diagonal.cwiseSqrt().cwiseInverse();
  double largest = 0;
  for (std::size_t f = 0; f < exact.size(); ++f) {
    const Eigen::MatrixXd error =
        inverse.asDiagonal() * (found[f] - exact[f]) * inverse.asDiagonal();
    largest = std::max(largest, error.cwiseAbs().maxCoeff());
  }
  return largest;
}

/// At 1.5 m, between draughts half a step above and below it.
Errors between(double step, const HydrodynamicDatabase& exact) {
  const HydrodynamicDatabase above = at_draught(1.5 - 0.5 * step),
                             below = at_draught(1.5 + 0.5 * step);
  const DraughtShares shares =
      DraughtInterpolation({0.0, 1.5 - 0.5 * step, 1.5 + 0.5 * step}).calc_shares(1.5);
  const double a = shares.weight[1], b = shares.weight[2];
  std::vector<Eigen::MatrixXd> added_mass, damping, exact_mass{exact.infinite_added_mass};
  added_mass.emplace_back(a * above.infinite_added_mass + b * below.infinite_added_mass);
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(6), error = largest;
  for (std::size_t f = 0; f < exact.frequencies.size(); ++f) {
    added_mass.emplace_back(a * above.added_mass[f] + b * below.added_mass[f]);
    exact_mass.push_back(exact.added_mass[f]);
    damping.emplace_back(a * above.damping[f] + b * below.damping[f]);
    const Eigen::MatrixXcd X = exact.excitation(f);
    const Eigen::MatrixXcd found = a * above.excitation(f) + b * below.excitation(f);
    largest = largest.cwiseMax(X.cwiseAbs().rowwise().maxCoeff());
    error = error.cwiseMax((found - X).cwiseAbs().rowwise().maxCoeff());
  }
  return {largest_share(added_mass, exact_mass), largest_share(damping, exact.damping),
          error.cwiseQuotient(largest).maxCoeff()};
}

// Linear between draughts: the error falls with the square of their step.
TEST(DraughtInterpolation, ConvergesToTheDatabaseOfTheDraughtItself) {
  const HydrodynamicDatabase exact = at_draught(1.5);
  const Errors coarse = between(1.0, exact), fine = between(0.5, exact);
  std::printf(
      "steps of 1 and 0.5 m: added mass %.4f %.4f, damping %.4f %.4f, excitation %.4f %.4f\n",
      coarse.added_mass, fine.added_mass, coarse.damping, fine.damping, coarse.excitation,
      fine.excitation);
  EXPECT_LT(fine.added_mass, 0.3 * coarse.added_mass);
  EXPECT_LT(fine.damping, 0.3 * coarse.damping);
  EXPECT_LT(fine.excitation, 0.3 * coarse.excitation);
  // Half a metre between draughts of about 1.5 m: 2.4, 8.2 and 2.6 %, the worst mode at the worst
  // frequency.
  EXPECT_LT(fine.added_mass, 0.03);
  EXPECT_LT(fine.damping, 0.1);
  EXPECT_LT(fine.excitation, 0.03);
}

}  // namespace
}  // namespace blocklift::dynamics
