#include "structure/load_cases/deck_solution.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "structure/accuracy/block_error.h"
#include "structure/error.h"
#include "structure/load_cases/deck_heat.h"
#include "structure/load_cases/deck_loads.h"
#include "structure/load_cases/deck_supports.h"
#include "structure/load_cases/holding_equations.h"
#include "structure/mesh/spring_motion.h"
#include "structure/response/loose_block.h"
#include "structure/space/freedom_text.h"
#include "structure/space/links.h"
#include "structure/stopwatch.h"
#include "structure/system/assembly.h"
#include "structure/system/held_sums.h"
#include "structure/system/matter.h"

namespace blocklift::structure {

namespace {

/// Load cases that the same sets of supports hold.
using CasesOfSupports = std::map<std::vector<int>, std::vector<int>>;

std::vector<Support> supports_of(const Deck& deck, const std::vector<int>& sets) {
  std::vector<Support> supports;
  for (const int set : sets) {
    const auto& of_set = deck.support_sets[set].supports;
    supports.insert(supports.end(), of_set.begin(), of_set.end());
  }
  const std::vector<Support> of_equations = supports_of_equations(deck);
  supports.insert(supports.end(), of_equations.begin(), of_equations.end());
  return supports;
}

/// Says where what the supports leave free moves most.
[[noreturn]] void refuse_loose(const Space& space, const DeckLoadCase& load_case, int freedom) {
  throw ModelError(fmt::format(
      "the supports of {} leave a part free to move, and nothing resists; most of all "
      "it moves {}{}",
      name_of(load_case), describe_freedom(space, freedom), hint_at_torsion(space.mesh())));
}

/// The same where a factorisation failed: how it moves is found first.
[[noreturn]] void refuse_loose(const Space& space, const DeckLoadCase& load_case,
                               std::vector<HeldSum> sums, int unknown, int threads) {
  for (HeldSum& sum : sums) sum.value = 0;
  const auto factorise = [&](const SparseLower& stiffness) -> SolveEquations {
    auto system = std::make_shared<HeldSystem>(stiffness, sums);
    system->factorise();
    return [system](const Eigen::MatrixXd& loads) { return system->solve(loads); };
  };
  const Eigen::VectorXd motion = find_free_motion(space, factorise, threads);
  refuse_loose(space, load_case,
               motion.size() > 0 ? most_moved_freedom(space, motion) : freedom_of(space, unknown));
}

/// Rounding may leave a mechanism some stiffness, and what loads it moves then by any distance.
/// Loads have not done twice the strain energy then, as they have where the equations are solved
/// (Clapeyron's theorem). What moves no further than each load would move its own unknown, all
/// others held, is rounding where supports take the loads at once.
/// @param energy of what the loads do, J.
void check_energy(double energy, const Eigen::VectorXd& diagonal, const Eigen::VectorXd& acting,
                  const Eigen::VectorXd& by_loads, const std::function<void()>& refuse) {
  constexpr double most = 1e-3;  // rounding leaves 1e-4 where the condition is 1e12
  const double work = acting.dot(by_loads), twice = 2 * energy;
  const double least =
      (diagonal.array() > 0).select(acting.array().square() / diagonal.array(), 0.0).sum();
  if (std::abs(work - twice) > most * std::max(std::abs(work), least)) refuse();
}

/// The place on the line between a direction's holders at which their shares balance.
Vector3 place_between(const Mesh& mesh, const HeldDirection& held) {
  Vector3 place = Vector3::Zero();
  for (const auto& [vertex, share] : held.holders)
    if (vertex >= 0) place += share * mesh.vertices[vertex];
  return place;
}

/// Reactions by the deck's vertices from forces along held directions.
std::vector<SupportReaction> reactions_at(const Space& space,
                                          const std::vector<HeldDirection>& directions,
                                          const Eigen::Ref<const Eigen::VectorXd>& forces) {
  std::map<int, SupportReaction> of_vertex;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const HeldDirection& held = directions[i];
    for (const auto& [vertex, share] : held.holders) {
      if (vertex < 0) continue;
      SupportReaction& reaction = of_vertex[vertex];
      reaction.vertex = vertex;
      const Vector3 vector = share * forces[i] * held.axis;
      if (held.is_rotation) {
        reaction.moment += vector;
        continue;
      }
      reaction.force += vector;
      // What lies beside the line between its holders turns about them.
      const Vector3 arm = space.nodes().col(held.node) - place_between(space.mesh(), held);
      reaction.moment += arm.cross(vector);
    }
  }
  std::vector<SupportReaction> reactions;
  for (const auto& [vertex, reaction] : of_vertex) reactions.push_back(reaction);
  return reactions;
}

/// What springs to the ground do to their vertices.
std::vector<SupportReaction> forces_of_ground(const Space& space, const Eigen::VectorXd& motion) {
  std::vector<SupportReaction> forces;
  for (const Spring& spring : space.mesh().springs)
    for (std::size_t end = 0; end < 2; ++end) {
      if (spring.vertices[end] < 0 || spring.vertices[1 - end] >= 0) continue;
      const int vertex = spring.vertices[end];
      const Eigen::Matrix<double, 6, 1> factors = spring_motion(spring, end);
      const double force =
          -spring.stiffness * factors.dot(motion.segment<6>(6L * space.node_of_vertex(vertex)));
      forces.push_back({vertex, force * factors.head<3>(), force * factors.tail<3>()});
    }
  return forces;
}

double size_of(const Space& space) {
  return (space.nodes().rowwise().maxCoeff() - space.nodes().rowwise().minCoeff()).norm();
}

/// Where moments alone load the deck its forces are rounding, and the other way round: each is held
/// against the larger of both, with the deck's size as the arm.
/// Loads count beside the reactions: of loads that are in balance by themselves (a strip pulled at
/// both ends, heat that nothing holds) the reactions are rounding.
/// @param rounding_force as of require_balance, N
void sum_up(const Space& space, const Eigen::VectorXd& load, double rounding_force,
            DeckCaseSolution& solution) {
  solution.applied = resultant(space, load);
  double forces = rounding_force, moments = 0;
  for (Eigen::Index row = 0; row < load.size(); row += 6) {
    forces += load.segment<3>(row).norm();
    moments += load.segment<3>(row + 3).norm();
  }
  const auto add = [&](const SupportReaction& reaction) {
    const Vector3& place = space.mesh().vertices[reaction.vertex];
    const Vector3 moment = place.cross(reaction.force) + reaction.moment;
    solution.supported.force += reaction.force;
    solution.supported.moment += moment;
    forces += reaction.force.norm();
    moments += moment.norm();
  };
  for (const SupportReaction& reaction : solution.reactions) add(reaction);
  for (const SupportReaction& reaction : forces_of_ground(space, solution.motion)) add(reaction);
  const auto share = [](const Vector3& left, double of) { return of > 0 ? left.norm() / of : 0; };
  const double size = size_of(space);
  solution.force_residual = share(solution.applied.force + solution.supported.force,
                                  std::max(forces, size > 0 ? moments / size : 0));
  solution.moment_residual =
      share(solution.applied.moment + solution.supported.moment, std::max(moments, forces * size));
}

/// The support that holds a freedom of a node along the world's axes; nullptr if none does.
const HeldDirection* holder_of(const std::vector<HeldDirection>& directions, int freedom) {
  const auto found =
      std::find_if(directions.begin(), directions.end(), [&](const HeldDirection& held) {
        return held.node == freedom / 6 && held.is_rotation == (freedom % 6 >= 3) &&
               std::abs(held.axis[freedom % 3]) > 1 - 1e-9;
      });
  return found != directions.end() ? &*found : nullptr;
}

[[noreturn]] void refuse_lost_load(const Space& space, const Space::LoosePart& part,
                                   const DeckLoadCase& load_case) {
  std::vector<int> node_of_vertex;
  for (std::size_t v = 0; v < space.mesh().vertices.size(); ++v)
    node_of_vertex.push_back(space.node_of_vertex(static_cast<int>(v)));
  const auto name = [&](int node) {
    return describe_node(space.mesh(), node_of_vertex, space.nodes(), node);
  };
  const int from = part.freedom / 6, to = part.of / 6;
  throw ModelError(fmt::format(
      "{}: a {} acts at {}{}: no element resists the {} {} there, so that it would be lost",
      name_of(load_case), part.freedom % 6 < 3 ? "force" : "moment", name(from),
      from == to ? "" : fmt::format(", which a link passes on to {}", name(to)),
      part.of % 6 < 3 ? "displacement along" : "rotation about",
      static_cast<char>('x' + part.of % 3)));
}

/// Loads on freedoms without stiffness (a rotation of a solid's node, a node that nothing is joined
/// to): supports take those that act on what they hold, and others would be lost.
std::vector<SupportReaction> reactions_of_loose_parts(const Space& space,
                                                      const std::vector<HeldDirection>& directions,
                                                      const Eigen::Ref<const Eigen::VectorXd>& load,
                                                      const DeckLoadCase& load_case) {
  constexpr double rounding = 1e-9;
  const double least = rounding * load.cwiseAbs().maxCoeff();
  std::vector<SupportReaction> reactions;
  for (const Space::LoosePart& part : space.loose_parts()) {
    const double lost = part.weight * load[part.freedom];
    if (std::abs(lost) <= least) continue;
    const HeldDirection* held = part.freedom == part.of ? holder_of(directions, part.of) : nullptr;
    if (held == nullptr) refuse_lost_load(space, part, load_case);
    SupportReaction& reaction = reactions.emplace_back();
    reaction.vertex = held->holders[0].first;
    (held->is_rotation ? reaction.moment : reaction.force)[part.of % 3] = -lost;
  }
  return reactions;
}

/// Adds a reaction to that of its vertex.
void add(std::vector<SupportReaction>& reactions, const SupportReaction& one) {
  const auto known =
      std::find_if(reactions.begin(), reactions.end(),
                   [&](const SupportReaction& reaction) { return reaction.vertex == one.vertex; });
  if (known == reactions.end()) {
    reactions.push_back(one);
    return;
  }
  known->force += one.force;
  known->moment += one.moment;
}

/// What is stiffened by nothing but a stiffness that keeps it at rest (assemble_stiffness) takes
/// loads away from the supports. Loads may balance one another: what is missing is held against all
/// forces and moments there are, with the deck's size as the arm.
/// @param rounding_force what the rounding of motions that supports enforce exerts, N: where they
/// move the whole as a rigid body there is nothing else.
void require_balance(const Space& space, const Eigen::Ref<const Eigen::VectorXd>& load,
                     double rounding_force, const DeckCaseSolution& solution,
                     const DeckLoadCase& load_case) {
  constexpr double most = 1e-3;  // rounding leaves 1e-6 where plates are thin
  double forces = rounding_force, moments = 0;
  for (Eigen::Index row = 0; row < load.size(); row += 6) {
    forces += load.segment<3>(row).norm();
    moments += load.segment<3>(row + 3).norm();
  }
  for (const SupportReaction& reaction : solution.reactions) {
    forces += reaction.force.norm();
    moments += reaction.moment.norm();
  }
  const double size = size_of(space);
  const double missing = std::max(size * (solution.applied.force + solution.supported.force).norm(),
                                  (solution.applied.moment + solution.supported.moment).norm());
  // About the origin, which may be far from the deck.
  const double farthest = space.nodes().colwise().norm().maxCoeff();
  if (!(missing > most * (std::max(size, farthest) * forces + moments))) return;
  throw ModelError(fmt::format(
      "{}: of its loads {:.3g} N and {:.3g} N m about the origin do not arrive at the supports: "
      "they act where no element bears them, such as a moment at a joint of rods, of released bars "
      "or about bars without a torsion constant, by themselves or through a link",
      name_of(load_case), (solution.applied.force + solution.supported.force).norm(),
      (solution.applied.moment + solution.supported.moment).norm()));
}

/// Solves the cases that some supports hold.
void solve_supported(const ElasticModel& model, const Deck& deck, const std::vector<int>& sets,
                     const std::vector<int>& cases, int threads, DeckSolution& result) {
  const Space& space = model.space();
  const std::vector<HeldDirection> directions =
      find_held_directions(space, supports_of(deck, sets), own_middles(deck));
  std::vector<HeldSum> sums = as_sums(space, directions);
  const std::vector<HeldSum> of_equations = sums_of_equations(space, deck);
  sums.insert(sums.end(), of_equations.begin(), of_equations.end());
  Stopwatch watch;
  Eigen::VectorXd diagonal;
  // Handed over as it is made: sparse matrices are copied where they are moved.
  const auto assemble = [&] {
    SparseLower stiffness = assemble_stiffness(space, threads);
    diagonal = stiffness.diagonal();
    result.times.assembly += watch.lap();
    return stiffness;
  };
  HeldSystem system(assemble(), sums);
  try {
    system.factorise();
  } catch (const LooseUnknown& loose) {
    if (sums.empty()) {  // springs to the ground, which do not hold it alone
      for (const int load_case : cases) result.skipped.push_back({load_case, false});
      return;
    }
    refuse_loose(space, deck.load_cases[cases.front()], sums, loose.unknown, threads);
  }
  result.times.factorisation += watch.lap();
  Eigen::MatrixXd loads(model.freedoms(), static_cast<Eigen::Index>(cases.size()));
  for (std::size_t c = 0; c < cases.size(); ++c)
    loads.col(static_cast<Eigen::Index>(c)) = load_of(model, deck, deck.load_cases[cases[c]]);
  const std::optional<CellHeat> heat = heat_of(model, deck, cases);
  const Eigen::MatrixXd of_heat =
      heat ? heat->loads() : Eigen::MatrixXd(0, static_cast<Eigen::Index>(cases.size()));
  Eigen::RowVectorXd held_energy = Eigen::RowVectorXd::Zero(loads.cols());
  if (heat) {
    loads += of_heat;
    held_energy = heat->held_energy();
  }
  std::vector<std::vector<SupportReaction>> of_loose_parts;
  for (std::size_t c = 0; c < cases.size(); ++c)
    of_loose_parts.push_back(reactions_of_loose_parts(
        space, directions, loads.col(static_cast<Eigen::Index>(c)), deck.load_cases[cases[c]]));
  const Eigen::MatrixXd acting = space.reduce(loads);
  result.times.assembly += watch.lap();
  const Eigen::MatrixXd unknowns = system.solve(acting);
  const Eigen::VectorXd unloaded = system.solve(Eigen::VectorXd::Zero(acting.rows()));
  const bool is_moved = !unloaded.isZero(0);
  constexpr double rounding = 1e-9;  // of what an unknown's enforced motion alone would exert
  const double rounding_force = rounding * unloaded.cwiseAbs().cwiseProduct(diagonal).maxCoeff();
  const Eigen::MatrixXd forces = system.reactions(unknowns, acting);
  const Eigen::MatrixXd motions = space.expand(unknowns);
  for (std::size_t c = 0; c < cases.size(); ++c) {
    const auto column = static_cast<Eigen::Index>(c);
    DeckCaseSolution& solution = result.cases.emplace_back();
    solution.load_case = cases[c];
    solution.motion = motions.col(column);
    solution.reactions = reactions_at(space, directions, forces.col(column));
    for (const SupportReaction& reaction : of_loose_parts[c]) add(solution.reactions, reaction);
    for (const SupportReaction& reaction : reactions_of_equations(
             deck, forces.col(column).tail(static_cast<Eigen::Index>(of_equations.size()))))
      add(solution.reactions, reaction);
    const double energy = system.energy(unknowns.col(column));
    solution.strain_energy = energy;
    if (heat)
      solution.strain_energy += held_energy[column] - of_heat.col(column).dot(solution.motion);
    const Eigen::VectorXd by_loads = unknowns.col(column) - unloaded;
    check_energy(is_moved ? system.energy(by_loads) : energy, diagonal, acting.col(column),
                 by_loads, [&] {
                   refuse_loose(space, deck.load_cases[cases[c]],
                                most_moved_freedom(space, solution.motion));
                 });
    sum_up(space, loads.col(column), rounding_force, solution);
    require_balance(space, loads.col(column), rounding_force, solution, deck.load_cases[cases[c]]);
  }
  result.times.solve += watch.lap();
}

CasesOfSupports sort_cases(const Deck& deck, DeckSolution& result) {
  CasesOfSupports sorted;
  for (std::size_t c = 0; c < deck.load_cases.size(); ++c) {
    const DeckLoadCase& load_case = deck.load_cases[c];
    std::vector<int> sets = load_case.supports;
    std::sort(sets.begin(), sets.end());
    const std::vector<Support> supports = supports_of(deck, sets);
    const bool is_moved = std::any_of(supports.begin(), supports.end(), [](const Support& one) {
      return std::any_of(one.value.begin(), one.value.end(), [](double v) { return v != 0; });
    });
    const bool is_grounded = std::any_of(
        deck.mesh.springs.begin(), deck.mesh.springs.end(),
        [](const Spring& spring) { return spring.vertices[0] < 0 || spring.vertices[1] < 0; });
    if (supports.empty() && !is_grounded && deck.holding_equations.empty())
      result.skipped.push_back({static_cast<int>(c), false});
    else if (load_case.loads.empty() && load_case.temperatures < 0 && !is_moved)
      result.skipped.push_back({static_cast<int>(c), true});
    else
      sorted[sets].push_back(static_cast<int>(c));
  }
  return sorted;
}

/// Where nothing holds what is hot its stress is rounding, of which no error can be told. Layers
/// that hold one another, and bars, store energy beside that.
/// @param held_energy what it would store if nothing moved, J.
bool expands_freely(const BlockError& error, double held_energy) {
  constexpr double rounding = 1e-7;
  return held_energy > 0 && error.squared_norm / 2 < rounding * held_energy;
}

void find_idle_supports(const ElasticModel& model, const Deck& deck, DeckSolution& result) {
  std::set<int> idle;
  for (const SupportSet& set : deck.support_sets)
    for (const Support& support : set.supports)
      if (model.space().node_of_vertex(support.vertex) < 0) idle.insert(support.vertex);
  result.idle_supports.assign(idle.begin(), idle.end());
}

}  // namespace

std::string name_of(const DeckLoadCase& load_case) {
  return load_case.title.empty() ? fmt::format("case {}", load_case.label)
                                 : fmt::format("case {} ({})", load_case.label, load_case.title);
}

int own_degree(const Deck& deck) { return deck.mesh.curved_shells.empty() ? 1 : 2; }

DeckSolution solve_deck(const ElasticModel& model, const Deck& deck, int threads) {
  DeckSolution result;
  for (const auto& [sets, cases] : sort_cases(deck, result))
    solve_supported(model, deck, sets, cases, threads, result);
  std::sort(result.cases.begin(), result.cases.end(),
            [](const auto& a, const auto& b) { return a.load_case < b.load_case; });
  std::sort(result.skipped.begin(), result.skipped.end(),
            [](const auto& a, const auto& b) { return a.load_case < b.load_case; });
  find_idle_supports(model, deck, result);
  if (result.cases.empty()) return result;
  Stopwatch watch;
  const auto count = static_cast<Eigen::Index>(result.cases.size());
  Eigen::MatrixXd motions(model.freedoms(), count);
  for (Eigen::Index c = 0; c < count; ++c) motions.col(c) = result.cases[c].motion;
  std::vector<int> load_cases;
  for (const DeckCaseSolution& one : result.cases) load_cases.push_back(one.load_case);
  const std::optional<CellHeat> heat = heat_of(model, deck, load_cases);
  const CellHeat* const hot = heat ? &*heat : nullptr;
  const Eigen::RowVectorXd held_energy = heat ? heat->held_energy() : Eigen::RowVectorXd();
  const std::vector<BlockError> errors = estimate_block_errors(model, motions, threads, hot);
  std::vector<LoadCaseResult> stresses =
      MotionStress(model, motions, {}, hot)
          .evaluate(Eigen::MatrixXd::Identity(count, count), motions);
  for (std::size_t c = 0; c < stresses.size(); ++c) {
    stresses[c].name = name_of(deck.load_cases[result.cases[c].load_case]);
    result.cases[c].stress = std::move(stresses[c]);
    result.cases[c].estimated_error = errors[c].relative;
    if (hot != nullptr && expands_freely(errors[c], held_energy[c]))
      result.cases[c].estimated_error = 0;
  }
  result.times.recovery = watch.lap();
  return result;
}

}  // namespace blocklift::structure
