#include "structure/part/part_solution.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "structure/elasticity/part_unknowns.h"
#include "structure/elasticity/rigid_freedom.h"
#include "structure/error.h"
#include "structure/mesh/element_shape.h"
#include "structure/stopwatch.h"
#include "structure/stress_tensor.h"
#include "structure/system/iteration.h"
#include "structure/system/natural_modes.h"
#include "structure/system/shared_factor.h"

namespace blocklift::structure {

namespace {

void require_supported(const PartModel& model, const std::vector<FixedUnknown>& fixed) {
  const RigidFreedom freedom = find_rigid_freedom(model, fixed);
  const std::vector<std::string>& motions = freedom.motions;
  if (motions.empty()) return;
  constexpr std::size_t most_named = 12;
  std::string text = "the supports leave the part free to move:";
  for (std::size_t i = 0; i < std::min(motions.size(), most_named); ++i)
    text += "\n    " + motions[i];
  if (motions.size() > most_named) text += "\n    ...";
  if (freedom.bodies > 1)
    text +=
        "\n    bodies that touch in a CAD file are joined where they are one body there, or cut "
        "one "
        "another into common faces, as BooleanFragments of Gmsh does; other bodies that touch are "
        "joined by join: {within: 1 mm}";
  throw ModelError(text);
}

// A load that goes straight into the supports, where nothing else moves them, strains nothing.
void require_straining(const Eigen::VectorXd& load, const std::vector<FixedUnknown>& fixed) {
  Eigen::VectorXd free = load;
  bool is_moved = false;
  for (const FixedUnknown& unknown : fixed) {
    free[unknown.unknown] = 0;
    is_moved = is_moved || unknown.value != 0;
  }
  constexpr double rounding = 1e-12;
  if (is_moved || load.isZero(0) || free.norm() > rounding * load.norm()) return;
  throw ModelError(
      "the loads act on supported nodes alone, along the axes that are held: they go straight into "
      "the supports and strain nothing");
}

// The averages as recover_part_stress; of_solids: what each solid says at its nodes.
PartStress recover(const SolidSet& solids, const Eigen::VectorXd& displacement,
                   std::vector<StressColumns>& of_solids) {
  PartStress stress{find_nodal_points(solids), {}};
  std::vector<int> shares(stress.node.size(), 0);
  for (const int point : stress.point_of) ++shares[point];
  stress.averaged.setZero(6, static_cast<Eigen::Index>(stress.node.size()));
  for (int solid = 0; solid < solids.count(); ++solid) {
    of_solids.push_back(
        stresses_of(solids, solid, solids.kind(solid).gradients_at_nodes, displacement));
    for (Eigen::Index i = 0; i < of_solids[solid].cols(); ++i) {
      const int point = stress.point_of[stress.first_of[solid] + static_cast<int>(i)];
      stress.averaged.col(point) += of_solids[solid].col(i) / shares[point];
    }
  }
  return stress;
}

// Of columns at the points of a stress, those at the nodes of a solid.
StressColumns at_nodes_of(int solid, int nodes, const PartStress& stress,
                          const StressColumns& at_points) {
  StressColumns result(6, nodes);
  for (int i = 0; i < nodes; ++i)
    result.col(i) = at_points.col(stress.point_of[stress.first_of[solid] + i]);
  return result;
}

PartGroupResult largest_of(const PartModel& model, const PartSolution& solution,
                           const std::vector<StressColumns>& of_solids, const SolidError& error,
                           std::string name, const std::vector<int>& solids) {
  PartGroupResult result;
  result.group = std::move(name);
  for (const int solid : solids) {
    const int element = model.mesh.solids[solid];
    for (int i = 0; i < model.mesh.kind(element).nodes; ++i) {
      const int node = model.mesh.node(element, i);
      const double averaged = von_mises(solution.stress.averaged.col(
          solution.stress.point_of[solution.stress.first_of[solid] + i]));
      if (averaged > result.von_mises) {
        result.von_mises = averaged;
        result.point = model.mesh.nodes.col(node);
      }
      const double raw = von_mises(of_solids[solid].col(i));
      if (raw > result.raw_von_mises) {
        result.raw_von_mises = raw;
        result.raw_point = model.mesh.nodes.col(node);
      }
      result.displacement =
          std::max(result.displacement, solution.displacement.segment<3>(3 * node).norm());
    }
  }
  result.estimated_error = error.relative(solids);
  for (const int solid : solids)
    for (int i = 0; i < model.mesh.kind(model.mesh.solids[solid]).nodes; ++i) {
      const int point = solution.stress.point_of[solution.stress.first_of[solid] + i];
      if (von_mises(solution.stress.averaged.col(point)) == result.von_mises)
        result.von_mises_error =
            std::max(result.von_mises_error,
                     von_mises(of_solids[solid].col(i) - error.recovered.col(point)));
    }
  return result;
}

// Each volume of the geometry is a group besides those that the file names (see read_part_mesh).
bool is_of_geometry(const PartGroup& group) {
  constexpr std::string_view noun = "volume ";
  return group.name.starts_with(noun) &&
         group.name.find_first_not_of("0123456789", noun.size()) == std::string::npos;
}

void find_maxima(const PartModel& model, const SolidSet& set,
                 const std::vector<StressColumns>& of_solids, PartSolution& solution) {
  SolidError error = estimate_solid_error(set, solution.stress, solution.displacement);
  solution.strain_energy = error.squared_norm.sum() / 2;
  std::map<int, int> solid_of_element;
  std::vector<int> all;
  for (int solid = 0; solid < static_cast<int>(model.mesh.solids.size()); ++solid) {
    solid_of_element[model.mesh.solids[solid]] = solid;
    all.push_back(solid);
  }
  solution.all = largest_of(model, solution, of_solids, error, "all", all);
  solution.estimated_error = solution.all.estimated_error;
  Eigen::Index worst = 0;
  error.squared_error.maxCoeff(&worst);
  solution.worst_point = model.mesh.centre(model.mesh.solids[worst]);
  std::set<std::vector<int>> listed;
  for (const PartGroup& group : model.mesh.groups) {
    if (group.dimension != 3) continue;
    std::vector<int> solids;
    for (const int element : group.elements) solids.push_back(solid_of_element.at(element));
    std::vector<int> sorted = solids;
    std::sort(sorted.begin(), sorted.end());
    const bool is_first = listed.insert(std::move(sorted)).second;
    if (!is_first && is_of_geometry(group)) continue;
    solution.groups.push_back(largest_of(model, solution, of_solids, error, group.name, solids));
  }
  solution.squared_error = std::move(error.squared_error);
  solution.recovered = std::move(error.recovered);
}

void find_balance(const PartModel& model, const Eigen::VectorXd& load,
                  const std::vector<FixedUnknown>& fixed, const std::vector<int>& support_of,
                  const Eigen::VectorXd& forces, PartSolution& solution) {
  solution.applied = resultant(model.mesh.nodes, load);
  solution.reactions.assign(model.supports.size(), {});
  double force_sum = 0, moment_sum = 0;
  const auto add_magnitude = [&](const Vector3& place, const Vector3& force) {
    force_sum += force.norm();
    moment_sum += place.norm() * force.norm();
  };
  for (Eigen::Index node = 0; node < model.mesh.nodes.cols(); ++node)
    add_magnitude(model.mesh.nodes.col(node), load.segment<3>(3 * node));
  solution.load_magnitude = force_sum;
  Vector3 force = solution.applied.force, moment = solution.applied.moment;
  for (std::size_t i = 0; i < support_of.size(); ++i) {  // idle nodes come after and bear nothing
    const Vector3 place = model.mesh.nodes.col(fixed[i].unknown / 3);
    const Vector3 reaction = forces[i] * Vector3::Unit(fixed[i].unknown % 3);
    Wrench& of_support = solution.reactions[support_of[i]];
    of_support.force += reaction;
    of_support.moment += place.cross(reaction);
    force += reaction;
    moment += place.cross(reaction);
    add_magnitude(place, reaction);
  }
  solution.force_residual = force_sum > 0 ? force.norm() / force_sum : 0;
  solution.moment_residual = moment_sum > 0 ? moment.norm() / moment_sum : 0;
}

/// The solution by unknowns: its displacement and reactions are those of `held`.
PartDisplacement solve_directly(const PartModel& model, const PartUnknowns& unknowns,
                                const std::vector<FixedUnknown>& held,
                                const Eigen::VectorXd& forces) {
  PartDisplacement solved;
  SolverAccount& account = solved.account;
  account.name = "Cholesky factorisation";
  Stopwatch watch;
  SparseLower stiffness = assemble_part_stiffness(model, unknowns);
  account.assembly_s = watch.lap();
  ConstrainedSystem system(std::move(stiffness), held);
  account.factor_bytes = system.factor_bytes();
  system.factorise();
  account.factorisation_s = watch.lap();
  solved.displacement = system.solve(forces);
  solved.reactions = system.reactions(solved.displacement, forces);
  account.solve_s = watch.lap();
  return solved;
}

/// The same by iteration.
PartDisplacement iterate(const PartModel& model, const PartUnknowns& unknowns,
                         const std::vector<FixedUnknown>& held, const Eigen::VectorXd& forces,
                         double tolerance) {
  PartDisplacement solved;
  SolverAccount& account = solved.account;
  account.name = "conjugate gradients with algebraic multigrid";
  Stopwatch watch;
  const SparseLower stiffness = assemble_part_stiffness(model, unknowns);
  account.assembly_s = watch.lap();
  constexpr int rigid = 6;  // the first of the trial shapes
  Iterated found = solve_by_iteration(
      stiffness, held, forces,
      unknowns.to_unknowns(trial_shapes(model.mesh.nodes, 3).leftCols<rigid>()), tolerance);
  account.solve_s = watch.lap();
  account.iterations = found.iterations;
  solved.displacement = std::move(found.displacements);
  solved.reactions = std::move(found.reactions);
  return solved;
}

/// A place in a solid.
struct SolidPlace {
  int solid = 0;
  Eigen::VectorXd values;  ///< of the shape functions of its nodes there
};

/// How far the middles of an element's edges lie off their chords at most, m.
double largest_sagitta(const ElementKind& kind, const Eigen::Matrix3Xd& places) {
  double largest = 0;
  for (int middle = kind.corners; middle < kind.nodes; ++middle)
    for (int a = 0; a < kind.corners; ++a)
      for (int b = 0; b < a; ++b) {
        if (!kind.local.col(middle).isApprox((kind.local.col(a) + kind.local.col(b)) / 2)) continue;
        // Across the chord: at a crack's tip middles lie on it, but nearer to one end.
        const Vector3 along = (places.col(b) - places.col(a)).normalized();
        const Vector3 off = places.col(middle) - (places.col(a) + places.col(b)) / 2;
        largest = std::max(largest, (off - off.dot(along) * along).norm());
      }
  return largest;
}

/// The solid that holds a place, or the nearest one where it is on the true surface of a curved
/// part, which meshes meet with their nodes alone: between them quadratic sides are off a circle by
/// 0.04 of their sagitta where they span 90 degrees, and by less where less.
std::optional<SolidPlace> place_in_solids(const PartMesh& mesh, const Vector3& point) {
  constexpr double reach = 0.1;                         // of the sagitta
  constexpr double rounding = 1e-6, box_slack = 0.1;    // of an element's length
  std::map<int, std::unique_ptr<ElementShape>> shapes;  // by kind
  std::optional<SolidPlace> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (int solid = 0; solid < static_cast<int>(mesh.solids.size()); ++solid) {
    const int element = mesh.solids[solid];
    const Eigen::Matrix3Xd places = mesh.places(element);
    // Curved sides may stand out of the box of the nodes a little.
    const Vector3 lower = places.rowwise().minCoeff(), upper = places.rowwise().maxCoeff();
    const double length = (upper - lower).maxCoeff();
    const Vector3 slack = Vector3::Constant(box_slack * length);
    if ((point - lower + slack).minCoeff() < 0 || (upper + slack - point).minCoeff() < 0) continue;
    auto& shape = shapes[mesh.elements[element].kind];
    if (!shape) shape = std::make_unique<ElementShape>(mesh.kind(element));
    Vector3 xi;
    const double distance = shape->locate(places, point, xi);
    if (distance >= least) continue;
    if (distance > rounding * length &&
        distance > reach * largest_sagitta(mesh.kind(element), places))
      continue;
    least = distance;
    nearest = {solid, shape->values(xi)};
    if (distance <= rounding * length) break;
  }
  return nearest;
}

}  // namespace

PartStress recover_part_stress(const PartModel& model, const Eigen::VectorXd& displacement) {
  std::vector<StressColumns> of_solids;
  return recover(solids_of(model), displacement, of_solids);
}

PartDisplacement find_part_displacement(const PartModel& model,
                                        const std::vector<FixedUnknown>& fixed,
                                        const Eigen::VectorXd& load, const SolverChoice& choice) {
  const PartUnknowns unknowns(model.mesh, model.joints.ties);
  const std::vector<FixedUnknown> held = unknowns.to_unknowns(fixed);
  const Eigen::VectorXd forces = unknowns.forces_on_unknowns(load);
  PartDisplacement solved;
  bool is_solved = false;
  try {
    if (choice.method != SolverMethod::iterative) {
      solved = solve_directly(model, unknowns, held, forces);
      is_solved = true;
    }
  } catch (const NotEnoughMemory&) {
    if (choice.method == SolverMethod::direct) throw;
  }
  if (!is_solved) solved = iterate(model, unknowns, held, forces, choice.tolerance);
  if (const FactorTeam* team = FactorTeam::present())
    solved.account.processes = team->group().size();
  PartDisplacement result;
  result.account = std::move(solved.account);
  result.displacement = unknowns.to_freedoms(solved.displacement);
  result.reactions.setZero(fixed.size());
  Eigen::Index next = 0;
  for (std::size_t i = 0; i < fixed.size(); ++i) {
    if (unknowns.of(fixed[i].unknown) >= 0)
      result.reactions[i] = solved.reactions[next++];
    else
      result.displacement[fixed[i].unknown] = fixed[i].value;
  }
  return result;
}

PartSolution solve_part(const PartModel& model, const SolverChoice& choice) {
  check_part_mesh(model.mesh);
  std::vector<int> support_of;
  std::vector<FixedUnknown> fixed = part_supports(model, support_of);
  require_supported(model, fixed);
  fixed = with_idle_nodes(model, std::move(fixed));
  PartSolution solution;
  const Eigen::VectorXd load = part_load(model);
  require_straining(load, fixed);
  PartDisplacement solved = find_part_displacement(model, fixed, load, choice);
  solution.displacement = std::move(solved.displacement);
  solution.solver = std::move(solved.account);
  find_balance(model, load, fixed, support_of, solved.reactions, solution);
  Stopwatch watch;
  std::vector<StressColumns> of_solids;
  const SolidSet set = solids_of(model);
  solution.stress = recover(set, solution.displacement, of_solids);
  find_maxima(model, set, of_solids, solution);
  solution.recovery_s = watch.lap();
  return solution;
}

PartProbe probe_part(const PartModel& model, const PartSolution& solution, const Vector3& point) {
  PartProbe probe;
  probe.point = point;
  const std::optional<SolidPlace> place = place_in_solids(model.mesh, point);
  if (!place) return probe;
  probe.inside = true;
  const auto nodes = static_cast<int>(place->values.size());
  const PartStress& stress = solution.stress;
  probe.stress = at_nodes_of(place->solid, nodes, stress, stress.averaged) * place->values;
  probe.von_mises_error = von_mises(
      at_nodes_of(place->solid, nodes, stress, solution.recovered) * place->values - probe.stress);
  const int element = model.mesh.solids[place->solid];
  for (int i = 0; i < nodes; ++i)
    probe.displacement +=
        place->values[i] * solution.displacement.segment<3>(3 * model.mesh.node(element, i));
  return probe;
}

}  // namespace blocklift::structure
