// Forward dynamics, kinematics included: one evaluation of the accelerations from q, v and tau,
// beside Simbody, MuJoCo, DART and Orocos KDL where they are installed. Chains of 10 to 100
// revolute joints and a floating base with five arms of six. All must give the same accelerations
// before anything is timed. Each evaluation is of another state than the one before, so that none
// can live on what it has kept.
#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>

#include "tests/benchmarks/peers/models.h"
#include "tests/benchmarks/peers/modules.h"
#include "tests/benchmarks/peers/ratio_report.h"

namespace blocklift::peers {

namespace {

constexpr unsigned state_count = 4;

// Largest difference over the largest acceleration.
double difference(const Accelerations& a, const Accelerations& b) {
  double largest = 0, scale = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, std::abs(a[i] - b[i]));
    scale = std::max(scale, std::abs(a[i]));
  }
  return a.size() == b.size() && std::isfinite(largest) ? largest / scale : INFINITY;
}

struct Contest {
  std::vector<const PeerModule*> modules = load_modules();
  std::vector<std::unique_ptr<TreeDynamics>> entrants;

  /// Registers a model with every library that can compute it. False if accelerations differ.
  bool add(const TreeModel& model) {
    std::vector<TreeState> states;
    for (unsigned number = 1; number <= state_count; ++number) {
      states.push_back(some_state(model, number));
    }
    std::array<Accelerations, state_count> ours;
    for (const PeerModule* module : modules) {
      std::unique_ptr<TreeDynamics> tree = module->make_tree(model);
      if (!tree) continue;
      tree->set_states(states);
      for (std::size_t i = 0; i < state_count; ++i) {
        tree->evaluate(i);
        if (module == modules.front()) ours[i] = tree->accelerations();
        const double off = difference(ours[i], tree->accelerations());
        if (off > 1e-9) {
          std::cerr << "error: " << model.name << ": the accelerations of " << module->name
                    << " differ from ours by " << off << " of the largest\n";
          return false;
        }
      }
      TreeDynamics* entrant = entrants.emplace_back(std::move(tree)).get();
      benchmark::RegisterBenchmark((model.name + "/" + module->name).c_str(),
                                   [entrant](benchmark::State& loop) {
                                     std::size_t which = 0;
                                     for (auto _ : loop) {
                                       entrant->evaluate(which);
                                       which = (which + 1) % state_count;
                                       benchmark::ClobberMemory();
                                     }
                                   })
          ->Unit(benchmark::kMicrosecond);
    }
    return true;
  }
};

}  // namespace

int run(int argc, char** argv) {
  Contest contest;
  std::cerr << describe(contest.modules);
  for (const int count : {10, 20, 50, 100}) {
    if (!contest.add(chain(count))) return 1;
  }
  if (!contest.add(floating_tree())) return 1;
  std::vector<std::string> names;
  for (const PeerModule* module : contest.modules) names.emplace_back(module->name);
  RatioReport report(names, "one evaluation, us");
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
