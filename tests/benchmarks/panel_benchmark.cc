// The panel method on a hemisphere without planes of symmetry: influence matrices, factorisations,
// reduction and a step of the march by the number of unknowns; then a whole database with and
// without symmetry. Seconds of the stages as counters. Run alone on the machine; OpenBLAS takes all
// cores.
#include <cmath>

#include <benchmark/benchmark.h>

#include "dynamics/algebra/hierarchical_matrix.h"
#include "dynamics/algebra/single_precision.h"
#include "dynamics/marine/panels/panel_shapes.h"
#include "dynamics/marine/radiation/hydrodynamic_database.h"
#include "dynamics/marine/radiation/radiation.h"

namespace {

using namespace blocklift::dynamics;

std::vector<WettedBody> make_sphere(int meridians) {
  return {{"sphere",
           make_half_ellipsoid({1, 1, 1}, {.meridians = meridians, .parallels = meridians / 3}),
           Vector3::Zero()}};
}

PanelModel make_model(int meridians, const Symmetry& symmetry) {
  const auto bodies = make_sphere(meridians);
  const SurfaceMesh surface = make_surface_mesh(
      find_water_lines(bodies), {.first_ring = 2.0 / meridians, .growth = 1.1, .radius = 45.0});
  return {bodies, surface, {1.0, 1.0}, symmetry};
}

void integrals(benchmark::State& state) {
  const PanelModel model = make_model(32, {});
  const PointColumns points(model.surface_mesh());
  std::vector<double> source(points.size()), dipole(points.size());
  const Panel& panel = model.body_mesh().panels.back();
  for (auto unused : state) {
    add_panel_potentials(panel, points, static_cast<PanelIntegral>(state.range(0)), 1.0,
                         source.data(), dipole.data());
    benchmark::DoNotOptimize(source.data());
  }
  state.counters["pairs/s"] = benchmark::Counter(static_cast<double>(points.size()),
                                                 benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(integrals)
    ->Arg(static_cast<int>(PanelIntegral::source))
    ->Arg(static_cast<int>(PanelIntegral::dipole))
    ->Arg(static_cast<int>(PanelIntegral::both))
    ->Arg(static_cast<int>(PanelIntegral::coplanar_source));

void solution(benchmark::State& state) {
  const PanelModel model = make_model(static_cast<int>(state.range(0)), {});
  for (auto unused : state) {
    const RankinePart part(model, {});
    state.counters["unknowns"] = model.body_mesh().size() + model.surface_mesh().size();
    state.counters["influence_s"] = part.timing().influence_s;
    state.counters["factorisation_s"] = part.timing().factorisation_s;
    state.counters["reduction_s"] = part.timing().reduction_s;
  }
}
BENCHMARK(solution)->Arg(24)->Arg(36)->Arg(56)->Unit(benchmark::kMillisecond)->UseRealTime();

void step(benchmark::State& state) {
  const PanelModel model = make_model(static_cast<int>(state.range(0)), {});
  const RankinePart part(model, {});
  FreeSurfaceMarch march(part, DampingZone{0.5}.damping(model.surface(), 1.0), 1.0, state.range(1));
  march.start(Eigen::MatrixXd::Random(model.surface_mesh().size(), state.range(1)), 0.05);
  for (auto unused : state) march.advance();
  state.counters["unknowns"] = model.body_mesh().size() + model.surface_mesh().size();
}
BENCHMARK(step)
    ->Args({24, 1})
    ->Args({36, 1})
    ->Args({56, 1})
    ->Args({24, 6})
    ->Args({36, 6})
    ->Args({56, 6})
    ->Unit(benchmark::kMicrosecond)
    ->UseRealTime();

/// A matrix of points on a spiral with 18 columns, whole and as a hierarchical one.
template <bool hierarchical>
void product(benchmark::State& state) {
  const Eigen::Index n = state.range(0);
  Eigen::Matrix2Xd points(2, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double along = 2.399963 * static_cast<double>(k);
    points.col(k) = 0.01 * along * Eigen::Vector2d(std::cos(along), std::sin(along));
  }
  const Eigen::MatrixXf matrix =
      Eigen::MatrixXf::NullaryExpr(n, n, [&](Eigen::Index i, Eigen::Index j) {
        return static_cast<float>(
            std::pow(0.01 + (points.col(i) - points.col(j)).squaredNorm(), -1.5));
      });
  const HierarchicalMatrix blocks(hierarchical ? matrix : Eigen::MatrixXf(), points, 1e-3);
  const Eigen::MatrixXf X = Eigen::MatrixXf::Random(n, 18);
  Eigen::MatrixXf Y(n, 18);
  HierarchicalMatrix::Workspace workspace;
  for (auto unused : state) {
    if constexpr (hierarchical) {
      blocks.multiply(X, Y, workspace);
    } else {
      multiply_symmetric(matrix, X, Y);
    }
  }
  state.counters["MB"] = 1e-6 * (hierarchical ? blocks.bytes() : 4.0 * static_cast<double>(n * n));
}
BENCHMARK(product<false>)->Arg(2500)->Arg(8616)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(product<true>)->Arg(2500)->Arg(8616)->Unit(benchmark::kMillisecond)->UseRealTime();

/// All six modes, 30 frequencies, 8 headings.
void database(benchmark::State& state) {
  const bool symmetric = state.range(0) != 0;
  const PanelModel model = make_model(48, {symmetric, symmetric});
  DatabaseSettings settings;
  for (int k = 0; k < 30; ++k) settings.frequencies.push_back(0.4 + 0.06 * k);
  for (int k = 0; k < 8; ++k) settings.headings.push_back(0.25 * M_PI * k);
  settings.duration = 40.0;
  settings.damping_strength = 0.5;
  for (auto unused : state) {
    DatabaseReport report;
    benchmark::DoNotOptimize(compute_database(model, settings, &report));
    state.counters["panels"] = report.body_panels + report.surface_panels;
    state.counters["parts"] = report.parts;
    state.counters["march_s"] = report.march_s;
    state.counters["excitation_s"] = report.excitation_s;
    state.counters["reduction_s"] = report.solution.reduction_s;
  }
}
BENCHMARK(database)->Arg(0)->Arg(1)->Unit(benchmark::kSecond)->Iterations(1)->UseRealTime();

/// The surface marched with a barge of 110 x 46 x 5 m, no symmetry: how many times faster than the
/// water.
void direct_marching(benchmark::State& state) {
  const std::vector<WettedBody> bodies{
      {"barge", make_box_hull(110, 46, 5, {24, 12, 3, 3.0}), Vector3::Zero()}};
  const SurfaceMesh surface = make_surface_mesh(
      find_water_lines(bodies), {.first_ring = 2.5, .growth = 1.1, .radius = 600.0});
  const PanelModel model(bodies, surface, {1025.0, 9.81});
  DirectRadiation::Settings settings;
  settings.damping_strength = 0.3;
  settings.waves = {RegularWave{0.628, 0.785, 0.5}};
  DirectRadiation radiation(model, settings);
  const double step = 0.8 * radiation.step_limit();
  radiation.start(step);
  Eigen::VectorXd velocity = Eigen::VectorXd::Constant(6, 0.1);
  for (auto unused : state) {
    Eigen::VectorXd force = radiation.calc_force();
    benchmark::DoNotOptimize(force.data());
    radiation.advance(velocity);
  }
  state.counters["unknowns"] = model.body_mesh().size() + model.surface_mesh().size();
  state.counters["step_s"] = step;
  state.counters["times_real_time"] = benchmark::Counter(
      step * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK(direct_marching)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Two crane barges of 110 x 46 x 5 m with a ship of 100 x 18 x 4 m between them: 18 modes.
void two_barges_and_a_ship(benchmark::State& state) {
  const PanelMesh barge = make_box_hull(110, 46, 5, {24, 12, 3, 3.0});
  const PanelMesh ship = make_box_hull(100, 18, 4, {24, 6, 3, 3.0});
  const std::vector<WettedBody> bodies{{"left", translate(barge, {0, -40, 0}), {0, -40, 0}},
                                       {"ship", ship, {0, 0, 0}},
                                       {"right", translate(barge, {0, 40, 0}), {0, 40, 0}}};
  const SurfaceMesh surface = make_surface_mesh(
      find_water_lines(bodies), {.first_ring = 1.5, .growth = 1.12, .radius = 600.0});
  const bool symmetric = state.range(0) != 0;
  const PanelModel model(bodies, surface, {1025.0, 9.81}, {symmetric, symmetric});
  DatabaseSettings settings;
  for (int k = 0; k < 30; ++k) settings.frequencies.push_back(0.3 + 0.04 * k);
  for (int k = 0; k < 8; ++k) settings.headings.push_back(0.25 * M_PI * k);
  for (auto unused : state) {
    DatabaseReport report;
    benchmark::DoNotOptimize(compute_database(model, settings, &report));
    state.counters["panels"] = report.body_panels + report.surface_panels;
    state.counters["steps"] = static_cast<double>(report.steps);
    state.counters["influence_s"] = report.solution.influence_s;
    state.counters["factorisation_s"] = report.solution.factorisation_s;
    state.counters["reduction_s"] = report.solution.reduction_s;
    state.counters["march_s"] = report.march_s;
    state.counters["excitation_s"] = report.excitation_s;
  }
}
BENCHMARK(two_barges_and_a_ship)
    ->Arg(0)
    ->Arg(1)
    ->Unit(benchmark::kSecond)
    ->Iterations(1)
    ->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
