// Databases in other units, or by another convention, than their format says.
#include "pipeline/formats/hydrodynamics/convention_check.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace blocklift::pipeline {
namespace {

using dynamics::HydrodynamicDatabase;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using Force = std::complex<double>;

constexpr double half_turn = std::numbers::pi;

/// A column of 2 m radius that stands on the bottom of 10 m of water, which surges and sways.
/// Waves' force by MacCamy and Fuchs (1954), F = 4 rho g tanh(kh)/(k^2 H1'(kR)); damping of what
/// radiates from it by the wave maker's theory (Havelock 1929), two closed forms that do not know
/// of each other; added mass that of two dimensions, rho pi R^2 h, as it is in long waves.
HydrodynamicDatabase column(int headings = 12) {
  constexpr double R = 2, h = 10;
  HydrodynamicDatabase database;
  database.water.depth = h;
  database.body_names = {"column"};
  database.reference_points = {{0, 0, 0}};
  database.displaced_volumes = {0};
  const double rho = database.water.density, g = database.water.gravity;
  for (int n = 0; n < headings; ++n) database.headings.push_back(2 * half_turn * n / headings);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(6, 6);
  A(0, 0) = A(1, 1) = rho * half_turn * R * R * h;
  database.infinite_added_mass = A;
  for (int n = 0; n < 18; ++n) {
    const double w = 0.3 + 0.1 * n, k = calc_wave_number(w, database.water), x = k * R;
    // The Hankel function of waves that go out as exp(i w t): J - i Y.
    const Force H(std::cyl_bessel_j(0, x) - std::cyl_bessel_j(1, x) / x,
                  -(std::cyl_neumann(0, x) - std::cyl_neumann(1, x) / x));
    const Force X = 4 * rho * g * std::tanh(k * h) / (k * k * H);
    const double depth =
        std::pow(std::sinh(k * h) / k, 2) / (0.5 * h * (1 + std::sinh(2 * k * h) / (2 * k * h)));
    Eigen::MatrixXd B = Eigen::MatrixXd::Zero(6, 6);
    B(0, 0) = B(1, 1) = 2 * rho * w * depth / (k * k * std::norm(H));
    Eigen::MatrixXcd F = Eigen::MatrixXcd::Zero(6, headings);
    for (int b = 0; b < headings; ++b) {
      F(0, b) = X * std::cos(database.headings[static_cast<std::size_t>(b)]);
      F(1, b) = X * std::sin(database.headings[static_cast<std::size_t>(b)]);
    }
    database.frequencies.push_back(w);
    database.added_mass.push_back(A);
    database.damping.push_back(B);
    database.diffraction.push_back(F);
    database.froude_krylov.emplace_back(Eigen::MatrixXcd::Zero(6, headings));
  }
  return database;
}

/// The frequencies are others than those that damping was multiplied by.
void take_for(HydrodynamicDatabase& database, double (*other)(double)) {
  for (std::size_t k = 0; k < database.frequencies.size(); ++k) {
    const double w = other(database.frequencies[k]);
    database.damping[k] *= w / database.frequencies[k];
    database.frequencies[k] = w;
  }
  if (database.frequencies.front() < database.frequencies.back()) return;
  std::reverse(database.frequencies.begin(), database.frequencies.end());
  std::reverse(database.damping.begin(), database.damping.end());
  std::reverse(database.diffraction.begin(), database.diffraction.end());
}

TEST(Conventions, OfARightDatabaseNothingIsDoubted) {
  for (const int headings : {6, 8, 12, 72})
    EXPECT_THAT(doubts_about_conventions(column(headings)), IsEmpty());
  HydrodynamicDatabase database = column();
  database.headings.clear();
  EXPECT_THAT(doubts_about_conventions(database), IsEmpty());
}

TEST(Conventions, ExcitationOfAnotherScale) {
  HydrodynamicDatabase database = column();
  for (Eigen::MatrixXcd& X : database.diffraction) X *= 2;
  EXPECT_THAT(
      doubts_about_conventions(database),
      ElementsAre("damping and excitation contradict each other: the damping of column surge is "
                  "0.25 times what its excitation by waves from all around says (Haskind's "
                  "relation; the median of 13 frequencies); it would be so if the excitation were "
                  "2 times the right one (for twice the wave's amplitude), or the lengths by which "
                  "the file is scaled 4 times the right ones"));
  for (Eigen::MatrixXcd& X : database.diffraction) X /= 2 * 1025.0 * 9.80665;
  EXPECT_THAT(doubts_about_conventions(database),
              ElementsAre(AllOf(HasSubstr("9.95e-05 times the right one (still over rho g)"),
                                Not(HasSubstr("lengths")))));
  // A fifth is within what panels and irregular frequencies do.
  database = column();
  for (Eigen::MatrixXd& B : database.damping) B *= 1.2;
  EXPECT_THAT(doubts_about_conventions(database), IsEmpty());
}

// Headings from 0 to 180 degrees, or to 90, go round by the planes of symmetry.
TEST(Conventions, PlanesOfSymmetryGiveTheOtherHeadings) {
  for (const int kept : {7, 4}) {
    HydrodynamicDatabase database = column();
    database.headings.resize(static_cast<std::size_t>(kept));
    for (auto* forces : {&database.froude_krylov, &database.diffraction})
      for (Eigen::MatrixXcd& X : *forces) X = Eigen::MatrixXcd(X.leftCols(kept));
    EXPECT_THAT(doubts_about_conventions(database), IsEmpty());
    for (Eigen::MatrixXcd& X : database.diffraction) X *= 2;
    EXPECT_THAT(doubts_about_conventions(database),
                ElementsAre(HasSubstr("is 0.25 times what its excitation")));
    // A body that waves along x push sideways has no such plane, and nothing is known.
    for (Eigen::MatrixXcd& X : database.diffraction) X(1, 0) = 0.5 * X(0, 0);
    if (kept == 7) {
      EXPECT_THAT(doubts_about_conventions(database), IsEmpty());
    }
  }
}

TEST(Conventions, FrequenciesThatAreNone) {
  HydrodynamicDatabase database = column();
  for (std::size_t k = 0; k < database.frequencies.size(); ++k)
    database.damping[k] /= database.frequencies[k];
  // The median of 16 frequencies lies half way between the eighth and the ninth.
  EXPECT_THAT(doubts_about_conventions(database),
              ElementsAre(AllOf(HasSubstr("is 0.801 times what"),
                                HasSubstr("16 frequencies); it would be so if the damping were not "
                                          "multiplied by the frequency"))));
  database = column();
  for (std::size_t k = 0; k < database.frequencies.size(); ++k)
    database.damping[k] *= database.frequencies[k];
  EXPECT_THAT(doubts_about_conventions(database),
              ElementsAre(HasSubstr("if the damping were multiplied by the frequency twice")));
  database = column();
  take_for(database, [](double w) { return 2 * half_turn / w; });
  EXPECT_THAT(doubts_about_conventions(database),
              ElementsAre(HasSubstr("if periods were taken for frequencies in rad/s, or these for "
                                    "periods")));
  database = column();
  take_for(database, [](double w) { return w / (2 * half_turn); });
  EXPECT_THAT(doubts_about_conventions(database),
              ElementsAre(HasSubstr("if the frequencies were in Hz, and not in rad/s")));
}

// Headings that do not go round leave heave in long waves, which is buoyancy's.
TEST(Conventions, PeriodsShowInHeave) {
  HydrodynamicDatabase database = column(2);
  database.hydrostatic_stiffness = Eigen::MatrixXd::Zero(6, 6);
  database.hydrostatic_stiffness(2, 2) = 1e5;
  for (std::size_t k = 0; k < database.frequencies.size(); ++k) {
    const double wave_number = calc_wave_number(database.frequencies[k], database.water);
    database.diffraction[k].row(2).setConstant(1e5 * std::exp(-4 * wave_number));
  }
  EXPECT_THAT(doubts_about_conventions(database), IsEmpty());
  take_for(database, [](double w) { return 2 * half_turn / w; });
  EXPECT_THAT(doubts_about_conventions(database),
              ElementsAre("the excitation of column heave is 0.20 of its stiffness at the lowest "
                          "frequency and 0.88 at the highest, where long waves have all of it; it "
                          "would be so if periods were taken for frequencies, or these for "
                          "periods"));
}

TEST(Conventions, PhasesOfAnotherTimeFactor) {
  HydrodynamicDatabase database = column();
  for (Eigen::MatrixXcd& X : database.diffraction) X = Eigen::MatrixXcd(X.conjugate());
  EXPECT_THAT(doubts_about_conventions(database),
              ElementsAre("in long waves the excitation of column does not go with the water that "
                          "moves there (agreement -0.88, where 1 is due); it would if the phases "
                          "were conjugated (time as exp(-i w t), where the format has exp(i w t)) "
                          "(then 0.94)"));
  database = column();
  for (double& heading : database.headings) heading -= half_turn;
  // Surge and sway alone do not tell waves that come from there from forces of the other sign.
  EXPECT_THAT(doubts_about_conventions(database),
              ElementsAre(AllOf(HasSubstr("if the headings were those from which the waves come"),
                                HasSubstr("or if the forces had the opposite sign"),
                                Not(HasSubstr("conjugated")))));
}

// A file of diagonals alone: nothing else about it tells.
TEST(Conventions, DiagonalsAlone) {
  for (const bool in_waves : {true, false}) {
    HydrodynamicDatabase database = column();
    if (!in_waves) database.headings.clear();
    for (Eigen::MatrixXd& A : database.added_mass) A(4, 4) = 10 * A(0, 0);
    EXPECT_THAT(doubts_about_conventions(database),
                ElementsAre(AllOf(HasSubstr("column has added mass in surge and pitch, and at no "
                                            "frequency anything that couples them"),
                                  Not(HasSubstr("sway")))));
    for (Eigen::MatrixXd& A : database.added_mass) A(3, 3) = A(4, 4);
    EXPECT_THAT(doubts_about_conventions(database),
                ElementsAre(HasSubstr("in surge and pitch, and in sway and roll, and at no")));
    for (const auto& [i, j] : {std::pair{0, 4}, {3, 1}}) database.damping[5](i, j) = 1e-5;
    EXPECT_THAT(doubts_about_conventions(database), ElementsAre(HasSubstr("couples them")))
        << "rounding";
    for (const auto& [i, j] : {std::pair{0, 4}, {3, 1}})
      database.damping[5](i, j) = database.added_mass[5](0, 0);
    EXPECT_THAT(doubts_about_conventions(database), IsEmpty());
  }
}

TEST(Conventions, HeadingsInAnotherUnit) {
  HydrodynamicDatabase database = column();
  for (double& heading : database.headings) heading *= half_turn / 180;
  EXPECT_THAT(doubts_about_conventions(database),
              ElementsAre(HasSubstr("if the headings were in radians, and were read as degrees "
                                    "(then 0.94)")));
  database = column();
  for (double& heading : database.headings) heading *= 180 / half_turn;
  EXPECT_THAT(doubts_about_conventions(database),
              ElementsAre(HasSubstr("if the headings were in degrees, and were read as radians")));
  // Without long waves the figures themselves tell.
  database = column();
  for (double& heading : database.headings) heading *= half_turn / 180;
  database.infinite_added_mass.resize(0, 0);
  EXPECT_THAT(doubts_about_conventions(database),
              ElementsAre("its 12 headings lie between 0 and 5.76 degrees, as if the headings were "
                          "in radians, and were read as degrees"));
}

}  // namespace
}  // namespace blocklift::pipeline
