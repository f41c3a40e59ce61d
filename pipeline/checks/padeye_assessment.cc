#include "pipeline/checks/padeye_assessment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "parallel/threads.h"
#include "pipeline/lift/stopwatch.h"
#include "structure/error.h"
#include "structure/mesh/fields/plate_finder.h"
#include "structure/stress/block_field.h"

namespace blocklift::pipeline {

namespace {

using structure::LoadCase;
using structure::UnitResponses;
using structure::Vector3;

/// Gravity less the acceleration of the block at a point, m/s^2, in B (see
/// structure::InertiaField).
Vector3 gravity_less_acceleration(const structure::InertiaField& field, const Vector3& p) {
  const auto& w = field.angular_velocity_products;
  Eigen::Matrix3d products;
  products << w[0], w[3], w[5], w[3], w[1], w[4], w[5], w[4], w[2];
  return -(field.acceleration_less_gravity + field.angular_acceleration.cross(p) + products * p -
           products.trace() * p);
}

/// A lug's padeye with what drives it.
class PadeyeRun {
 public:
  PadeyeRun(const LiftCase& lift_case, const LugModel& lug, int lug_index,
            const PadeyeDesign& design, const UnitResponses& responses)
      : responses_(responses), lug_(lug_index), is_solid_(lug.is_solid.value) {
    const BlockModel& block = *lift_case.load.model;
    std::vector<std::string> faults;
    result_.lug = lug.name.value;
    result_.padeye = design.name.value;
    result_.placed = *place_padeye(design, block, lug, faults);  // whole: checked when it was read
    result_.consequence_factor = lift_case.checks.lug_consequence_factor;
    structure::PadeyeFormulaInput& input = result_.input;
    const structure::Mesh& mesh = responses.model().mesh();
    const int region = mesh.lifting_points[lug_index].region;
    input.geometry = result_.placed.geometry;
    input.material =
        mesh.materials[lug.on_mesh ? find_ground(mesh) : mesh.group_of_region(region).material];
    input.cheek_weld = design.cheek_weld;
    input.base_weld = design.base_weld;
    input.doubler = design.doubler;
    input.jaw = design.jaw;
    input.tensile_strength = design.tensile_strength;
    input.design_factor = design.design_factor;
    input.side_load = lift_case.checks.lug_side_load;
  }

  PadeyeAssessment& result() { return result_; }
  int lug() const { return lug_; }

  Vector3 force_P(const Vector3& force_B) const {
    return result_.placed.R_BP.transpose() * force_B;
  }

  /// Takes a formula's result where it is worse than what has been found.
  void consider(const Vector3& force, std::optional<double> time) {
    const auto found =
        structure::padeye_strength(result_.input, result_.consequence_factor * force);
    if (result_.formulas.empty())
      for (const structure::PadeyeFormula& formula : found)
        result_.formulas.push_back({formula, true, time});
    for (std::size_t i = 0; i < found.size(); ++i)
      if (!(found[i].utilisation <= result_.formulas[i].formula.utilisation))
        result_.formulas[i] = {found[i], true, time};
  }

  void add_rules() {
    for (const structure::PadeyeFormula& rule : structure::padeye_rules(result_.input))
      result_.formulas.push_back({rule, false, std::nullopt});
  }

  void solve(std::shared_ptr<const structure::PadeyeModel> model,
             const std::vector<PadeyeInstant>& instants) {
    result_.model = std::move(model);
    find_base();
    double worst = -1;
    for (const PadeyeInstant& instant : instants) {
      PadeyeState state{instant.name, instant.time, force_P(instant.load.lug_forces_B[lug_]), {}};
      state.result = result_.model->solve(load_of(instant.load, state.force_P));
      const double stress = std::max(state.result.main_plate.checked_von_mises.value,
                                     state.result.cheeks.checked_von_mises.value);
      if (stress > worst) {
        worst = stress;
        result_.governing = result_.states.size();
      }
      result_.states.push_back(std::move(state));
    }
  }

 private:
  // Displacements of the cut for each unit response, in B.
  void find_base() {
    const auto& nodes = result_.model->base_nodes();
    Eigen::Matrix3Xd places(3, static_cast<Eigen::Index>(nodes.size()));
    for (std::size_t i = 0; i < nodes.size(); ++i)
      places.col(i) = result_.placed.p_BP +
                      result_.placed.R_BP * result_.model->part().mesh.nodes.col(nodes[i]);
    // Of a lug of solids no plate has its thickness: they stand on a line of plating by rigid arms.
    const Vector3 axis = result_.placed.R_BP.col(2);
    Eigen::Matrix3Xd feet = places;
    for (Eigen::Index i = 0; is_solid_ && i < feet.cols(); ++i)
      feet.col(i) -= axis.dot(feet.col(i) - result_.placed.p_BP) * axis;
    // Across the lug's own thickness: the pad or a deck may meet it there.
    Vector3 across = axis;
    if (is_on_mesh_ && !goes_on_below(feet)) across = result_.placed.R_BP.col(1);
    base_ = structure::displacements_of_arms(responses_.model(), responses_.displacements(), feet,
                                             places, across);
  }

  // The material of the plate below the pin, as a place in Mesh::materials.
  int find_ground(const structure::Mesh& mesh) {
    is_on_mesh_ = true;
    const Vector3 below =
        result_.placed.p_BP - result_.placed.geometry.height * result_.placed.R_BP.col(1);
    const auto plate = structure::PlateFinder(mesh).find(below);
    if (!plate)
      throw structure::ModelError("the padeye of lug " + result_.lug + " stands on no plate");
    return mesh.section_of(mesh.shells[plate->shell]).material;
  }

  // Does a plate in the padeye's own plane hold the whole base? Else it stands on a deck.
  bool goes_on_below(const Eigen::Matrix3Xd& places) const {
    constexpr double in_plane = 0.99;
    const structure::PlateFinder plates(responses_.model().mesh());
    const Vector3 axis = result_.placed.R_BP.col(2);
    for (Eigen::Index i = 0; i < places.cols(); ++i) {
      const auto plate = plates.find(places.col(i), axis);
      if (!plate || std::abs(plate->normal.dot(axis)) < in_plane) return false;
    }
    return true;
  }

  structure::PadeyeLoad load_of(const LoadCase& load_case, const Vector3& force) const {
    const Eigen::Matrix3d R_PB = result_.placed.R_BP.transpose();
    structure::PadeyeLoad load;
    load.force = force;
    load.gravity_less_acceleration =
        R_PB * gravity_less_acceleration(load_case.field, result_.placed.p_BP);
    load.base_displacement = base_ * responses_.coefficients(load_case);
    for (Eigen::Index i = 0; i < load.base_displacement.size(); i += 3)
      load.base_displacement.segment<3>(i) = R_PB * load.base_displacement.segment<3>(i);
    return load;
  }

  const UnitResponses& responses_;
  int lug_;
  bool is_solid_ = false;
  bool is_on_mesh_ = false;
  Eigen::MatrixXd base_;
  PadeyeAssessment result_;
};

/// Sub-models by their measures and material: one factorisation for all padeyes that are alike.
class Models {
 public:
  /// Takes note of a padeye. @returns its model's number.
  int add(const structure::PadeyeFormulaInput& input, int divisions) {
    const structure::PadeyeGeometry& g = input.geometry;
    const Key key{g.radius,       g.thickness,       g.hole_diameter,
                  g.cheek_radius, g.cheek_thickness, g.height,
                  g.base_left,    g.base_right,      static_cast<double>(divisions)};
    const auto [place, is_new] = numbers_.emplace(std::pair{input.material.name, rounded(key)},
                                                  static_cast<int>(wanted_.size()));
    if (is_new) wanted_.push_back({g, input.material, divisions});
    return place->second;
  }

  /// The models, by their numbers.
  std::vector<std::shared_ptr<const structure::PadeyeModel>> make() const {
    std::vector<std::shared_ptr<const structure::PadeyeModel>> models(wanted_.size());
    parallel::for_each(static_cast<int>(wanted_.size()), 0, [&](int i) {
      const auto number = static_cast<std::size_t>(i);
      const Wanted& one = wanted_[number];
      models[number] =
          std::make_shared<structure::PadeyeModel>(one.geometry, one.material, one.divisions);
    });
    return models;
  }

 private:
  using Key = std::array<double, 9>;
  struct Wanted {
    structure::PadeyeGeometry geometry;
    structure::Material material;
    int divisions;
  };
  // To a tenth of a micrometre: sums of the file's lengths differ by rounding.
  static Key rounded(Key key) {
    for (double& value : key) value = std::round(value * 1e7) / 1e7;
    return key;
  }
  std::map<std::pair<std::string, Key>, int> numbers_;
  std::vector<Wanted> wanted_;
};

/// All lugs that are padeyes and that a rope pulls at.
std::vector<PadeyeRun> make_runs(const LiftCase& lift_case, const UnitResponses& responses) {
  std::vector<PadeyeRun> runs;
  const auto& lugs = responses.model().mesh().lifting_points;
  const BlockModel& block = *lift_case.load.model;
  for (std::size_t i = 0; i < lugs.size(); ++i) {
    const LugModel* lug = block.find_lug(lugs[i].name);
    const PadeyeDesign* design = lug ? block.find_padeye(*lug) : nullptr;
    if (design) runs.emplace_back(lift_case, *lug, static_cast<int>(i), *design, responses);
  }
  return runs;
}

int divisions_of(const LiftCase& lift_case, const std::string& design) {
  return find_by_name(lift_case.load.model->padeyes, design)->divisions;
}

/// What is looked for in the history of one lug.
struct Candidate {
  double value = -1;
  const BlockHistory* history = nullptr;
  Eigen::Index sample = 0;
  std::string name;

  void take(double other, const BlockHistory& of, Eigen::Index at, const std::string& called) {
    if (other <= value) return;
    *this = {other, &of, at, called};
  }
};

/// The instants of a lug that finite elements look at; formulae at all instants on the way.
std::vector<PadeyeInstant> find_instants(PadeyeRun& run, const BlockAttachment& attachment,
                                         const BlockHistory& static_history,
                                         const BlockHistory& dynamic_history,
                                         const structure::MassProperties& mass) {
  std::array<Candidate, 4> candidates;
  auto& [at_rest, in_motion, sideways, at_base] = candidates;
  for (const BlockHistory* history : {&static_history, &dynamic_history}) {
    const bool moving = history == &dynamic_history;
    for (Eigen::Index sample = 0; sample < history->sample_count(); ++sample) {
      const std::vector<Vector3> forces = rope_forces(history->motion, sample, attachment);
      Vector3 sum = Vector3::Zero();
      for (std::size_t r = 0; r < forces.size(); ++r)
        if (attachment.ropes[r].lug == run.lug()) sum += forces[r];
      const Vector3 force = run.force_P(sum);
      run.consider(force, history->motion.time(sample));
      (moving ? in_motion : at_rest)
          .take(force.norm(), *history, sample,
                moving ? "largest dynamic load" : "largest static load");
      sideways.take(std::abs(force.z()), *history, sample, "largest force along the pin");
      const double bent = std::abs(force.x()) + std::abs(force.z());
      at_base.take(bent, *history, sample, "largest bending of the base");
    }
  }
  std::vector<PadeyeInstant> instants;
  for (const Candidate& c : candidates) {
    if (!c.history) continue;
    instants.push_back({c.name, c.history->motion.time(c.sample),
                        map_instant(*c.history, c.sample, attachment, mass)});
  }
  return instants;
}

/// Names of the ropes that end at a lug; one from the lug to itself once.
std::string ropes_at(int lug, const BlockAttachment& attachment, const dynamics::History& history) {
  std::string names;
  int last = -1;
  for (const LugRope& end : attachment.ropes) {
    if (end.lug != lug || end.rope == last) continue;
    last = end.rope;
    const auto rope = static_cast<std::size_t>(end.rope);
    names += (names.empty() ? "" : ", ") + history.ropes[rope].name;
  }
  return names;
}

/// @param find_instants_of the instants of a padeye that finite elements look at, formulae
///   considered on the way; none where nothing pulls at it.
template <typename Find>
PadeyesAssessment assess_at(const LiftCase& lift_case, const UnitResponses& responses,
                            const Find& find_instants_of) {
  Stopwatch watch;
  struct Pulled {
    PadeyeRun run;
    std::vector<PadeyeInstant> instants;
    std::size_t model;
  };
  std::vector<Pulled> all;
  Models wanted;
  for (PadeyeRun& run : make_runs(lift_case, responses)) {
    std::vector<PadeyeInstant> instants = find_instants_of(run);
    if (instants.empty()) continue;
    run.add_rules();
    const int model = wanted.add(run.result().input, divisions_of(lift_case, run.result().padeye));
    all.push_back({std::move(run), std::move(instants), static_cast<std::size_t>(model)});
  }
  const auto models = wanted.make();
  parallel::for_each(static_cast<int>(all.size()), 0, [&](int i) {
    Pulled& one = all[i];
    one.run.solve(models[one.model], one.instants);
  });
  PadeyesAssessment result;
  for (Pulled& one : all) result.padeyes.push_back(std::move(one.run.result()));
  result.evaluation_s = watch.lap();
  return result;
}

}  // namespace

const PadeyeFormulaAtWorst& PadeyeAssessment::worst_formula() const {
  const auto rank = [](const PadeyeFormulaAtWorst& one) {
    const bool is_rule_kept = !one.has_force && one.formula.utilisation <= 1;
    return is_rule_kept ? 0 : one.formula.utilisation;
  };
  return *std::max_element(formulas.begin(), formulas.end(),
                           [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
}

PadeyesAssessment assess_padeyes(const LiftCase& lift_case, const UnitResponses& responses,
                                 const BlockAttachment& attachment,
                                 const BlockHistory& static_history,
                                 const BlockHistory& dynamic_history) {
  return assess_at(lift_case, responses, [&](PadeyeRun& run) -> std::vector<PadeyeInstant> {
    run.result().rope = ropes_at(run.lug(), attachment, dynamic_history.motion);
    if (run.result().rope.empty()) return {};
    return find_instants(run, attachment, static_history, dynamic_history,
                         responses.model().mass_properties());
  });
}

PadeyesAssessment assess_padeyes(const LiftCase& lift_case, const UnitResponses& responses,
                                 const BlockAssessment& block) {
  return assess_at(lift_case, responses, [&](PadeyeRun& run) {
    std::vector<PadeyeInstant> instants;
    for (const BlockState* state :
         {&block.simultaneous.static_state, &block.simultaneous.dynamic_state}) {
      const Vector3& force = state->load.lug_forces_B[run.lug()];
      if (!(force.norm() > 0)) continue;
      run.consider(run.force_P(force), std::nullopt);
      instants.push_back({state->load.name, std::nullopt, state->load});
    }
    return instants;
  });
}

namespace {

/// How far a rope pulls out of the padeye's plane, where formulae of the plane alone say too
/// little; empty up to 5 degrees.
std::string out_of_plane_note(const PadeyeAssessment& padeye) {
  constexpr double degree = std::numbers::pi / 180, little = 5 * degree;
  const auto angle = [](const PadeyeState& state) {
    const double size = state.force_P.norm();
    return size > 0 ? std::asin(std::min(1.0, std::abs(state.force_P.z()) / size)) : 0.0;
  };
  double most = 0;
  for (const PadeyeState& state : padeye.states) most = std::max(most, angle(state));
  if (!(most > little)) return {};
  return fmt::format(
      "; pulled up to {:.0f} degrees out of its plane, {:.0f} % of the force along the pin: ASME "
      "BTH-1 and DNV 2.7-3 are for pulls in the plane",
      most / degree, 100 * std::sin(most));
}

}  // namespace

std::vector<Check> check_padeyes(const LiftCase& lift_case, const PadeyesAssessment& padeyes) {
  std::vector<Check> checks;
  for (const PadeyeAssessment& padeye : padeyes.padeyes) {
    const PadeyeFormulaAtWorst& worst = padeye.worst_formula();
    Check formula = check_at_most(fmt::format("lug {}: {}", padeye.lug, worst.formula.name),
                                  worst.formula.demand, worst.formula.limit, worst.formula.unit);
    formula.utilisation = worst.formula.utilisation;
    formula.pass = worst.formula.utilisation <= 1;
    formula.time = worst.time;
    formula.note = fmt::format("the worst of {} hand formulae; {}", padeye.formulas.size(),
                               worst.formula.source);
    formula.note += out_of_plane_note(padeye);
    checks.push_back(std::move(formula));

    const PadeyeState& state = padeye.governing_state();
    const structure::Extreme& main = state.result.main_plate.checked_von_mises;
    const structure::Extreme& cheek = state.result.cheeks.checked_von_mises;
    const structure::Extreme& larger = cheek.value > main.value ? cheek : main;
    Check stress =
        check_at_most(fmt::format("lug {}: checked von Mises in the padeye against yield / {:g}",
                                  padeye.lug, lift_case.checks.yield_factor),
                      padeye.consequence_factor * larger.value,
                      padeye.input.material.yield_stress / lift_case.checks.yield_factor, "Pa");
    stress.time = state.time;
    stress.note = fmt::format("{}, {}; consequence factor {:g}", larger.part, state.name,
                              padeye.consequence_factor);
    stress.is_by_mesh = true;  // the block's displacement along the base drives the padeye
    checks.push_back(std::move(stress));
  }
  return checks;
}

}  // namespace blocklift::pipeline
