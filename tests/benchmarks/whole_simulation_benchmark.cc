// Whole simulations at equal accuracy: the 860 t block hoisted on six ropes for 120 s to 1e-6 m,
// and Andrews' squeezer over 0.03 s to 1e-8 rad, beside the libraries that simulate them (Simbody,
// Runge-Kutta-Merson). What counts is the error reached, not the tolerance asked: each takes the
// loosest of its tolerances, from 1e-3 to 1e-14 by factors of the fourth root of 10, that reaches
// the error as the next tighter one does. Set-up of the model is part of neither time.
#include <algorithm>
#include <cmath>
#include <iostream>

#include "tests/benchmarks/peers/modules.h"
#include "tests/benchmarks/peers/ratio_report.h"

namespace blocklift::peers {

namespace {

using Simulate = SimulationRun (*)(double accuracy);

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = a.size() == b.size() ? 0 : INFINITY;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    const double off = std::abs(a[i] - b[i]);
    largest = std::isfinite(off) ? std::max(largest, off) : INFINITY;
  }
  return largest;
}

// The loosest tolerance that reaches the error, as the next tighter one does; 0 if none does.
double loosest_tolerance(Simulate simulate, const std::vector<double>& reference, double error) {
  double kept = 0;
  for (int step = 0; step <= 44; ++step) {
    const double tolerance = 1e-3 * std::pow(10.0, -0.25 * step);
    double reached = INFINITY;
    try {
      reached = largest_difference(simulate(tolerance).values, reference);
    } catch (const std::exception&) {
      // too loose to integrate at all
    }
    if (reached > error) {
      kept = 0;
    } else if (kept > 0) {
      return kept;
    } else {
      kept = tolerance;
    }
  }
  return 0;
}

// False if a library does not reach the error.
bool add(const std::string& model, const PeerModule& module, Simulate simulate,
         const std::vector<double>& reference, double error) {
  if (!simulate) return true;
  const double tolerance = loosest_tolerance(simulate, reference, error);
  if (tolerance == 0) {
    std::cerr << "error: " << model << ": " << module.name << " does not come within " << error
              << " of the reference\n";
    return false;
  }
  const SimulationRun run = simulate(tolerance);
  std::cerr << model << ", " << module.name << ": tolerance " << tolerance << ", error "
            << largest_difference(run.values, reference) << ", " << run.steps << " steps, "
            << run.evaluations << " evaluations\n";
  benchmark::RegisterBenchmark((model + "/" + module.name).c_str(), [simulate, tolerance](
                                                                        benchmark::State& loop) {
    for (auto _ : loop) {
      benchmark::DoNotOptimize(simulate(tolerance));
    }
  })->Unit(benchmark::kMillisecond);
  return true;
}

}  // namespace

int run(int argc, char** argv) {
  const std::vector<const PeerModule*> modules = load_modules();
  std::cerr << describe(modules);
  // The block's reference: the tightest run of another library, if there is one; ours must agree.
  const PeerModule* tightest = modules.front();
  for (const PeerModule* module : modules) {
    if (module->simulate_block_on_six_ropes) tightest = module;
  }
  const std::vector<double> block = tightest->simulate_block_on_six_ropes(1e-12).values;
  const double apart =
      largest_difference(block, modules.front()->simulate_block_on_six_ropes(1e-10).values);
  std::cerr << "block on six ropes: tight runs are " << apart << " m apart\n";
  if (apart > 1e-7) return 1;
  const std::vector<double> squeezer(std::begin(Andrews::reference), std::end(Andrews::reference));
  std::vector<std::string> names;
  for (const PeerModule* module : modules) {
    if (!add("block on six ropes", *module, module->simulate_block_on_six_ropes, block, 1e-6) ||
        !add("Andrews' squeezer", *module, module->simulate_andrews, squeezer, 1e-8)) {
      return 1;
    }
    if (module->simulate_andrews) names.emplace_back(module->name);
  }
  RatioReport report(names, "one simulation, ms");
  return run_side_by_side(argc, argv, report);
}

}  // namespace blocklift::peers

int main(int argc, char** argv) {
  try {
    return blocklift::peers::run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << "\n";
    return 1;
  }
}
