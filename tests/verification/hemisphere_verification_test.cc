// A floating hemisphere in deep and finite water: Hulme (1982), The wave forces acting on a floating
// hemisphere undergoing forced periodic oscillations, J. Fluid Mech. 121; WAMIT's figures in 50 m.
#include <cmath>
#include <cstdio>
#include <numbers>

#include <gtest/gtest.h>

#include "dynamics/marine/floating_motion.h"
#include "dynamics/marine/frequency_domain.h"
#include "dynamics/marine/incident_wave.h"
#include "dynamics/marine/panel_shapes.h"

namespace blocklift::dynamics {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double infinite = std::numeric_limits<double>::infinity();

/// Division of the hemisphere and of the surface around it, in radii.
struct Division {
  int meridians, parallels;
  double first_ring;
  double growth = 1.1;
  double outer_radius = 45.0;
};

struct Sphere {
  std::vector<WettedBody> bodies;
  PanelModel model;
  int unknowns;  ///< of the whole surface, without symmetry
};

Sphere make_sphere(double radius, const Division& division, const Water& water, double low = 0.0) {
  std::vector<WettedBody> bodies{
      {"sphere",
       make_half_ellipsoid(Vector3::Constant(radius),
                           {.meridians = division.meridians, .parallels = division.parallels}),
       Vector3(0, 0, low)}};
  const SurfaceMesh surface =
      make_surface_mesh(find_water_lines(bodies), {.first_ring = division.first_ring * radius,
                                                   .growth = division.growth,
                                                   .radius = division.outer_radius * radius});
  PanelModel model(bodies, surface, water, find_symmetry(bodies));
  const int unknowns = bodies[0].hull.size() + surface.mesh.size();
  return {bodies, std::move(model), unknowns};
}

/// A and B over the displaced mass (and frequency), and the reference.
struct Row {
  double ka, heave_A, heave_B, surge_A, surge_B;
};
// Heave: Hulme's table. Surge: multipole expansion about the centre, converged to the digits given.
constexpr std::array<Row, 6> hulme = {{{0.2, .7938, .2793, .5515, .0082},
                                       {0.5, .5861, .3391, .6439, .0987},
                                       {1.0, .4284, .2484, .5740, .3535},
                                       {2.0, .3884, .1031, .2493, .3424},
                                       {3.0, .4111, .0452, .1720, .2237},
                                       {5.0, .4471, .0116, .1679, .1073}}};

HydrodynamicDatabase compute_unit_database(const PanelModel& model) {
  DatabaseSettings settings;
  for (const Row& row : hulme) settings.frequencies.push_back(std::sqrt(row.ka));
  settings.headings = {0.0, pi / 3};
  settings.duration = 40.0;
  settings.damping_strength = 0.5;
  return compute_database(model, settings);
}

/// Largest error over all of the table, each relative to the larger of its own value and a tenth of
/// the added mass (the damping dies out where nobody feels it).
double largest_error(const HydrodynamicDatabase& database, bool print) {
  const double mass = 2.0 / 3.0 * pi;
  double largest = 0.0;
  const auto compare = [&](double ka, const char* what, double found, double exact, double scale) {
    const double error = (found - exact) / std::max(std::abs(exact), 0.1 * scale);
    if (print)
      std::printf("  ka %.1f %s %.4f (%.4f) %+.2f %%\n", ka, what, found, exact, 100 * error);
    largest = std::max(largest, std::abs(error));
  };
  for (std::size_t k = 0; k < hulme.size(); ++k) {
    const Row& row = hulme[k];
    const Eigen::MatrixXd &A = database.added_mass[k], &B = database.damping[k];
    const double w = database.frequencies[k];
    compare(row.ka, "heave A", A(heave, heave) / mass, row.heave_A, row.heave_A);
    compare(row.ka, "heave B", B(heave, heave) / mass / w, row.heave_B, row.heave_A);
    compare(row.ka, "surge A", A(surge, surge) / mass, row.surge_A, row.surge_A);
    compare(row.ka, "surge B", B(surge, surge) / mass / w, row.surge_B, row.surge_A);
  }
  return largest;
}

// Two per cent with the stated number of panels, and less with more of them.
TEST(Hemisphere, AddedMassAndDampingOverFrequency) {
  const std::array<Division, 4> divisions = {
      {{24, 8, 0.09}, {32, 12, 0.06}, {48, 18, 0.04}, {64, 24, 0.03, 1.08}}};
  std::vector<double> errors;
  for (const Division& division : divisions) {
    const Sphere sphere = make_sphere(1.0, division, {1.0, 1.0});
    const HydrodynamicDatabase database = compute_unit_database(sphere.model);
    errors.push_back(largest_error(database, &division == &divisions[2]));
    std::printf("%d unknowns: largest error %.2f %%, A_inf heave %.4f (0.5), surge %.4f (0.2732)\n",
                sphere.unknowns, 100 * errors.back(),
                database.infinite_added_mass(heave, heave) / (2.0 / 3.0 * pi),
                database.infinite_added_mass(surge, surge) / (2.0 / 3.0 * pi));
  }
  EXPECT_LT(errors[2], 0.02);
  EXPECT_LT(errors[2], 0.6 * errors[0]);
  EXPECT_LT(errors[3], 0.8 * errors[2]);
}

// Integral of K: B at the frequency zero, which is none. Ogilvie: A and B at any frequency from K.
TEST(Hemisphere, OgilviesRelations) {
  const Sphere sphere = make_sphere(1.0, {32, 12, 0.06}, {1.0, 1.0});
  const HydrodynamicDatabase database = compute_unit_database(sphere.model);
  for (const int mode : {surge, heave}) {
    double integral = 0.0, peak = 0.0;
    for (std::size_t n = 0; n < database.retardation.size(); ++n) {
      const double K = database.retardation[n](mode, mode);
      integral += (n == 0 ? 0.5 : 1.0) * database.time_step * K;
      peak = std::max(peak, std::abs(K));
    }
    EXPECT_LT(std::abs(integral), 3e-3 * peak);
  }
  for (std::size_t k = 0; k < hulme.size(); ++k) {
    Eigen::MatrixXd A, B;
    calc_added_mass_and_damping(database, database.frequencies[k], A, B);
    // The march shifts a frequency w by w (w dt)^2/24: a quarter of a per cent at the highest one.
    for (const int mode : {surge, heave}) {
      const double scale = A(mode, mode);
      EXPECT_NEAR(A(mode, mode), database.added_mass[k](mode, mode), 0.01 * scale);
      EXPECT_NEAR(B(mode, mode), database.damping[k](mode, mode),
                  0.01 * scale * database.frequencies[k]);
    }
  }
}

// Newman (1977), eq. 6.173: the power that damping takes is that of the waves far away, whose
// amplitude follows from the excitation: B = k/(8 pi rho g V_g) int |X|^2 d theta. For heave of a round
// body |X| is the same from all sides, for surge it goes with cos theta.
TEST(Hemisphere, EnergyGoesIntoTheFarField) {
  const Sphere sphere = make_sphere(1.0, {48, 18, 0.04}, {1.0, 1.0});
  const HydrodynamicDatabase database = compute_unit_database(sphere.model);
  for (std::size_t k = 0; k < hulme.size(); ++k) {
    const double w = database.frequencies[k], k_wave = w * w, group_velocity = 0.5 / w;
    const double factor = k_wave / (8.0 * pi * group_velocity);
    const Eigen::MatrixXcd X = database.excitation(k);
    const double heave_B = factor * 2.0 * pi * std::norm(X(heave, 0));
    const double surge_B = factor * pi * std::norm(X(surge, 0));
    const double scale = 0.02 * w * database.added_mass[k](heave, heave);
    EXPECT_NEAR(heave_B, database.damping[k](heave, heave), scale) << "ka " << hulme[k].ka;
    EXPECT_NEAR(surge_B, database.damping[k](surge, surge),
                0.02 * database.damping[k](surge, surge) + 0.1 * scale)
        << "ka " << hulme[k].ka;
    // The body is round: from 60 degrees the surge is half, the heave the same.
    EXPECT_NEAR(std::abs(X(heave, 1)), std::abs(X(heave, 0)), 1e-3 * std::abs(X(heave, 0)));
    EXPECT_NEAR(std::abs(X(surge, 1)), 0.5 * std::abs(X(surge, 0)), 1e-3 * std::abs(X(surge, 0)));
  }
}

// Diffraction by a system of its own against Haskind's relation from the radiation potentials, with
// the same matrices and the same damping zone; steady waves want rings that widen slowly.
TEST(Hemisphere, HaskindsRelation) {
  const Sphere sphere = make_sphere(1.0, {24, 8, 0.08, 1.06, 30.0}, {1.0, 1.0});
  DatabaseSettings settings;
  settings.frequencies = {0.7, 1.0, 1.4};
  settings.headings = {0.4};
  settings.duration = 60.0;
  settings.damping_strength = 0.8;
  const HydrodynamicDatabase database = compute_database(sphere.model, settings);
  RankineSettings rankine;
  rankine.keep_factors = true;
  for (const Parity parity : {Parity{1, 1}, Parity{-1, 1}}) {
    const RankinePart part(sphere.model, parity, rankine);
    const FrequencyDomain direct(sphere.model, part,
                                 DampingZone{0.8}.rates(sphere.model.surface()));
    const int mode = parity.x > 0 ? heave : surge;
    ASSERT_EQ(part.modes()[0], mode);
    for (std::size_t k = 0; k < settings.frequencies.size(); ++k) {
      const IncidentWave wave(sphere.model.water(), settings.frequencies[k], 0.4);
      const Eigen::VectorXcd opposed = sphere.model.part_of(
          parity, [&](const Vector3& p, const Vector3& n) -> std::complex<double> {
            return -(wave.velocity(p).transpose() * n)(0);
          });
      const std::complex<double> force = direct.calc_force(settings.frequencies[k], opposed)[0];
      const std::complex<double> haskind = database.diffraction[k](mode, 0);
      EXPECT_LT(std::abs(force - haskind), 0.02 * std::abs(database.excitation(k)(mode, 0)))
          << "w " << settings.frequencies[k] << " mode " << mode;
    }
  }
}

// WAMIT, hemisphere of 5 m radius in 50 m of water; coefficients over the displaced mass.
TEST(Hemisphere, FiniteDepthAgainstWamit) {
  struct Wamit {
    double period, A33, B33, A11, B11;
  };
  constexpr std::array<Wamit, 3> table = {{{6.0, .5574, .3329, .6546, .1289},
                                           {5.0, .4690, .2892, .6412, .2677},
                                           {4.0, .4006, .1997, .4614, .4027}}};
  const Water water{1000.0, 9.80665, 50.0};
  const Sphere sphere = make_sphere(5.0, {48, 18, 0.04}, water);
  DatabaseSettings settings;
  for (const Wamit& row : table) settings.frequencies.push_back(2.0 * pi / row.period);
  settings.duration = 30.0;
  settings.damping_strength = 0.5 * std::sqrt(9.80665 / 5.0);
  const HydrodynamicDatabase database = compute_database(sphere.model, settings);
  const double mass = 1000.0 * 2.0 / 3.0 * pi * 125.0;
  for (std::size_t k = 0; k < table.size(); ++k) {
    const Wamit& row = table[k];
    const Eigen::MatrixXd A = database.added_mass[k] / mass;
    const Eigen::MatrixXd B = database.damping[k] / (mass * database.frequencies[k]);
    std::printf("T %.0f s: A33 %.4f (%.4f) B33 %.4f (%.4f) A11 %.4f (%.4f) B11 %.4f (%.4f)\n",
                row.period, A(heave, heave), row.A33, B(heave, heave), row.B33, A(surge, surge),
                row.A11, B(surge, surge), row.B11);
    EXPECT_NEAR(A(heave, heave), row.A33, 0.02 * row.A33);
    EXPECT_NEAR(B(heave, heave), row.B33, 0.02 * row.B33);
    EXPECT_NEAR(A(surge, surge), row.A11, 0.02 * row.A11);
    EXPECT_NEAR(B(surge, surge), row.B11, 0.02 * row.B11);
  }
  EXPECT_NEAR(database.infinite_added_mass(heave, heave) / mass, .5006, 0.02 * .5006);
  EXPECT_NEAR(database.infinite_added_mass(surge, surge) / mass, .2742, 0.02 * .2742);
}

/// IEA OES Task 10: sphere of 5 m radius, half immersed, 261.8 t, released 1 m up.
LinearFloatation task_10() {
  LinearFloatation sphere;
  sphere.mass = Eigen::MatrixXd::Zero(6, 6);
  sphere.mass.diagonal() << 261.8e3, 261.8e3, 261.8e3, 1.690e6, 1.690e6, 2.606e6;
  sphere.stiffness = Eigen::MatrixXd::Zero(6, 6);
  sphere.stiffness(heave, heave) = 7.695e5;
  sphere.start = Eigen::VectorXd::Zero(6);
  sphere.start[heave] = 1.0;
  return sphere;
}

// Wendt et al. (2019), Ocean Energy Systems wave energy modelling task: five codes' extrema span
// periods of 4.37 to 4.45 s and a second crest of 0.632 to 0.651 m. Exact linear theory (multipole
// solution): 2.214 s -.8670 m, 4.421 s .6347 m, 6.602 s -.4645 m, 8.776 s .3462 m.
TEST(FreeDecay, Task10SphereDirectlyAndWithTheDatabase) {
  const std::array<Extremum, 4> exact = {
      {{2.214, -.8670}, {4.421, .6347}, {6.602, -.4645}, {8.776, .3462}}};
  const Water water{1000.0, 9.81};
  const LinearFloatation bodies = task_10();
  std::vector<double> difference;
  for (const Division& division : {Division{24, 8, 0.09}, Division{40, 14, 0.05}}) {
    const Sphere sphere = make_sphere(5.0, division, water, -2.0);
    DirectRadiation::Settings direct;
    direct.damping_strength = 0.35;
    DirectRadiation radiation(sphere.model, direct);
    const FloatingMotion marched = march_directly(bodies, radiation, 0.05, 10.0);
    DatabaseSettings settings;
    settings.frequencies = {0.5, 1.0, 1.5, 2.0, 2.5};
    settings.damping_strength = 0.35;
    settings.duration = 30.0;
    settings.time_step = 0.05;
    const HydrodynamicDatabase database = compute_database(sphere.model, settings);
    const FloatingMotion convolved = march_with_database(bodies, database, 0.05, 10.0);
    const auto a = find_extrema(marched, heave), b = find_extrema(convolved, heave);
    ASSERT_GE(a.size(), 4U);
    ASSERT_GE(b.size(), 4U);
    double worst = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
      std::printf("%d unknowns: %.3f s %.4f m directly, %.3f s %.4f m by convolution\n",
                  sphere.unknowns, a[k].time, a[k].value, b[k].time, b[k].value);
      worst = std::max(
          {worst, std::abs(a[k].value - exact[k].value), std::abs(b[k].value - exact[k].value)});
      // Both ways, one discretisation: they differ by the time step alone.
      EXPECT_NEAR(a[k].value, b[k].value, 1e-3);
      EXPECT_NEAR(a[k].time, b[k].time, 5e-3);
    }
    EXPECT_GT(a[1].time, 4.37);
    EXPECT_LT(a[1].time, 4.45);
    EXPECT_GT(a[1].value, 0.632);
    EXPECT_LT(a[1].value, 0.651);
    difference.push_back(worst);
  }
  EXPECT_LT(difference[1], 2e-3);
  EXPECT_LT(difference[1], difference[0]);
}

// The same motion, whatever the step of the simulation is.
TEST(FreeDecay, ConvolutionDoesNotDependOnTheStep) {
  const Sphere sphere = make_sphere(5.0, {24, 8, 0.09}, {1000.0, 9.81}, -2.0);
  DatabaseSettings settings;
  settings.frequencies = {0.5, 2.5};
  settings.damping_strength = 0.35;
  settings.duration = 30.0;
  settings.time_step = 0.05;
  const HydrodynamicDatabase database = compute_database(sphere.model, settings);
  const LinearFloatation bodies = task_10();
  const double reference = march_with_database(bodies, database, 0.01, 8.0).position.back()[heave];
  double last = 0.0;
  for (const double step : {0.4, 0.2, 0.1, 0.05}) {
    const double error = std::abs(
        march_with_database(bodies, database, step, 8.0).position.back()[heave] - reference);
    std::printf("step %.2f s: difference %.1e m\n", step, error);
    if (last > 0.0) {
      EXPECT_LT(error, 0.35 * last);
    }
    last = error;
  }
  EXPECT_LT(last, 1e-4);
}

// A state space in place of the convolution: the same decay to the tolerance of the fit.
TEST(FreeDecay, StateSpaceAgreesWithTheConvolution) {
  const Sphere sphere = make_sphere(5.0, {32, 12, 0.06}, {1000.0, 9.81}, -2.0);
  DatabaseSettings settings;
  settings.frequencies = {0.5, 2.5};
  settings.damping_strength = 0.35;
  settings.duration = 30.0;
  const HydrodynamicDatabase database = compute_database(sphere.model, settings);
  const MemoryStateSpace memory(database, 0.01);
  std::printf("%d states for 6 modes, error %.2e\n", memory.state_count(), memory.error());
  const LinearFloatation bodies = task_10();
  const FloatingMotion convolved = march_with_database(bodies, database, 0.05, 10.0);
  const FloatingMotion fitted =
      march_with_state_space(bodies, database.infinite_added_mass, memory, 0.05, 10.0);
  for (std::size_t k = 0; k < fitted.position.size(); ++k) {
    EXPECT_NEAR(fitted.position[k][heave], convolved.position[k][heave], 0.01);
  }
  // 24 a mode, where the convolution keeps some hundred samples of each: what makes it worth while.
  EXPECT_LT(memory.state_count(), 200);
}

// A regular wave on the moored sphere: direct march and database, after the start has died out.
TEST(RegularWave, DirectMarchAndDatabaseAgree) {
  LinearFloatation bodies = task_10();
  bodies.start.setZero();
  bodies.stiffness(surge, surge) = 4e5;
  bodies.stiffness(pitch, pitch) = 8e6;
  const RegularWave wave{1.2, 0.0, 1.0};
  std::vector<double> difference;
  for (const Division& division : {Division{16, 6, 0.15}, Division{32, 12, 0.06}}) {
    const Sphere sphere = make_sphere(5.0, division, {1000.0, 9.81}, -2.0);
    DirectRadiation::Settings direct;
    direct.damping_strength = 0.5;
    direct.wave = wave;
    DirectRadiation radiation(sphere.model, direct);
    const FloatingMotion marched = march_directly(bodies, radiation, 0.05, 60.0);
    DatabaseSettings settings;
    settings.frequencies = {0.8, 1.2, 2.5};
    settings.headings = {0.0};
    settings.damping_strength = 0.5;
    settings.duration = 40.0;
    const HydrodynamicDatabase database = compute_database(sphere.model, settings);
    const FloatingMotion convolved = march_with_database(bodies, database, 0.05, 60.0, wave);
    double amplitude = 0.0, worst = 0.0;
    for (std::size_t k = 900; k < marched.position.size(); ++k) {
      amplitude = std::max(amplitude, std::abs(marched.position[k][heave]));
      worst = std::max(worst, std::abs(marched.position[k][heave] - convolved.position[k][heave]));
    }
    std::printf("%d unknowns: heave %.4f m, difference %.4f m\n", sphere.unknowns, amplitude,
                worst);
    difference.push_back(worst / amplitude);
  }
  EXPECT_LT(difference[1], 0.01);
  EXPECT_LT(difference[1], difference[0]);
}

}  // namespace
}  // namespace blocklift::dynamics
