#include "pipeline/study/members/study_blocks.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "parallel/blas_threads.h"
#include "pipeline/coupling/block_flexibility.h"
#include "pipeline/coupling/block_loads.h"
#include "pipeline/coupling/edge_loads.h"
#include "pipeline/declaration/diagnostics.h"
#include "pipeline/formats/atomic_file.h"
#include "pipeline/formats/content_hash.h"
#include "pipeline/formats/mapped_file.h"
#include "pipeline/lift/block_assessment.h"
#include "pipeline/lift/block_preparation.h"
#include "pipeline/lift/history_assessment.h"
#include "pipeline/lift/kept_stages.h"
#include "pipeline/results/files/lift_scene.h"
#include "pipeline/study/design/block_variables.h"
#include "structure/accuracy/accuracy.h"
#include "structure/system/mass_distribution.h"

namespace blocklift::pipeline {

double LargestChecked::increase_percent() const { return percent_above(in_motion, at_rest); }

/// A block that serves several members: its lugs, where its mass is, and, where they were asked
/// for, its unit stresses. Its elements with their load vectors take most of the memory; they stay
/// where members move by the block's stiffness.
struct StudyBlocks::Kept {
  std::string key;
  std::vector<structure::LiftingPoint> lugs;
  structure::MassDistribution matter;
  std::unique_ptr<structure::ElasticModel> model;       ///< null: no member asked for it
  std::unique_ptr<structure::UnitResponses> responses;  ///< null: nor for these
  std::optional<structure::StressBasis> basis;
  std::optional<structure::RefinedBlock> refined;  ///< that the basis is of, where it is needed
};

namespace {

namespace fs = std::filesystem;
using structure::MassProperties;
using structure::Vector3;

constexpr std::size_t most_kept = 3;  // of blocks that members take in turn

std::unique_ptr<structure::ElasticModel> model_of(const LiftCase& lift_case) {
  Diagnostics diagnostics;
  auto model = make_block_model(*lift_case.load.model, lift_case.load.model_name.value,
                                lift_case.structure, diagnostics);
  if (!model) throw InputError(diagnostics);
  return model;
}

bool runs_over_edges(const LiftCase& lift_case) {
  return std::ranges::any_of(lift_case.ropes,
                             [](const given::Rope& rope) { return !rope.edges.empty(); });
}

template <class Value>
std::optional<Value> stated(const std::optional<Located<Value>>& located) {
  return located ? std::optional<Value>(located->value) : std::nullopt;
}

/// @throws InputError if the stated mass is less than that of the plates.
MassProperties mass_of(const structure::MassDistribution& matter, const BlockModel& block) {
  MassProperties mass = matter.with(block.mass ? &block.mass->value : nullptr,
                                    block.centre_of_mass ? &block.centre_of_mass->value : nullptr);
  Diagnostics diagnostics;
  if (!check_stated_mass(block, mass, diagnostics)) throw InputError(diagnostics);
  return mass;
}

bool gives_way(const LiftCase& lift_case) {
  return lift_case.dynamics.flexibility != Flexibility::rigid;
}

/// Holds a load case against the balance that a free body keeps.
void require_balance(const structure::LoadCase& load_case, const MassProperties& mass,
                     const BlockAttachment& attachment) {
  const structure::InertiaField& field = load_case.field;
  const auto& w = field.angular_velocity_products;
  Eigen::Matrix3d products;
  products << w[0], w[3], w[5], w[3], w[1], w[4], w[5], w[4], w[2];
  const Vector3& centre = mass.centre_of_mass_B;
  Vector3 force =
      -mass.mass * (field.acceleration_less_gravity + field.angular_acceleration.cross(centre) +
                    products * centre - products.trace() * centre);
  // omega x (I omega) as the products of omega have it.
  const Eigen::Matrix3d spin = mass.inertia_BBcm_B * products;
  Vector3 moment =
      -mass.inertia_BBcm_B * field.angular_acceleration -
      Vector3(spin(2, 1) - spin(1, 2), spin(0, 2) - spin(2, 0), spin(1, 0) - spin(0, 1));
  double load = mass.mass * std::max(field.acceleration_less_gravity.norm(), 9.80665), pull = 0;
  for (std::size_t lug = 0; lug < attachment.lugs.size(); ++lug) {
    const Vector3& at_lug = load_case.lug_forces_B[lug];
    force += at_lug;
    moment += (attachment.lugs[lug].p_BPin - centre).cross(at_lug);
    pull += at_lug.norm();
  }
  if (load_case.added.size() > 0) {
    const Eigen::Matrix<double, 6, 1> added = attachment.added_resultants * load_case.added;
    force += added.head<3>();
    moment += added.tail<3>() - centre.cross(Vector3(added.head<3>()));
  }
  load = std::max(load, pull);
  const double gyration = std::sqrt(mass.inertia_BBcm_B.trace() / (2 * mass.mass));
  if (force.norm() < largest_balance_residual * load &&
      moment.norm() < largest_balance_residual * load * gyration)
    return;
  throw std::runtime_error(fmt::format(
      "the loads on the block are not in balance: force residual {:.1e}, moment "
      "residual {:.1e} (allowed {:.0e})",
      force.norm() / load, moment.norm() / (load * gyration), largest_balance_residual));
}

/// Largest checked stress of one history: value, time and place.
void find_largest(const structure::StressBasis& basis, const BlockAttachment& attachment,
                  const BlockHistory& history, const MassProperties& mass, double& stress,
                  double& time, Vector3& place) {
  const structure::StressOfBlock block(basis, mass, attachment.lugs.size());
  Eigen::MatrixXd factors(block.unit_loads(), history.sample_count());
  for (Eigen::Index sample = 0; sample < history.sample_count(); ++sample) {
    const structure::LoadCase load_case = map_instant(history, sample, attachment, mass);
    require_balance(load_case, mass, attachment);
    factors.col(sample) = block.factors(load_case);
  }
  const structure::LargestValue largest = find_largest_checked(block, factors, 1);
  if (largest.point < 0) throw std::runtime_error("the block has no plating");
  stress = largest.value;
  time = history.motion.time[largest.instant];
  place = basis.squares()[largest.point].centre_B;
}

}  // namespace

StudyBlocks::StudyBlocks(const StudyFile& study, fs::path folder, Progress progress)
    : study_(study),
      cases_(study),
      folder_(std::move(folder)),
      progress_(std::move(progress)),
      changing_(
          find_block_variables(study, read_lift_case(study.case_path()).load.model_name.value)) {}

StudyBlocks::~StudyBlocks() = default;

std::string StudyBlocks::key_of(const Eigen::VectorXd& values) const {
  return block_key(study_, changing_, values);
}

fs::path StudyBlocks::file_of(const std::string& key) const {
  ContentHash hash;
  hash.add(std::string_view(key));
  return folder_ / ("unit-stress-" + hash.digits());
}

StudyBlocks::Kept& StudyBlocks::kept(const LiftCase& lift_case, const Eigen::VectorXd& values) {
  std::string key = key_of(values);
  const auto found =
      std::find_if(kept_.begin(), kept_.end(), [&](const auto& one) { return one->key == key; });
  if (found != kept_.end()) {
    std::rotate(found, found + 1, kept_.end());
    return *kept_.back();
  }
  if (kept_.size() == most_kept) kept_.erase(kept_.begin());
  auto model = model_of(lift_case);
  structure::MassDistribution matter{structure::Matter(model->space())};
  auto lugs = model->mesh().lifting_points;
  if (!gives_way(lift_case)) model.reset();
  kept_.push_back(std::make_unique<Kept>(
      Kept{std::move(key), std::move(lugs), std::move(matter), std::move(model), {}, {}, {}}));
  return *kept_.back();
}

KnownBlock StudyBlocks::of(const LiftCase& lift_case, const Eigen::VectorXd& values) {
  Kept& block = kept(lift_case, values);
  const BlockModel& as_lifted = *lift_case.load.model;
  KnownBlock known{load_mass(mass_of(block.matter, as_lifted)), block.lugs, {}};
  if (!gives_way(lift_case)) return known;
  const parallel::OneBlasThread whatever_the_threads;
  if (!block.model) block.model = model_of(lift_case);
  if (!block.responses) block.responses = make_unit_responses(*block.model, as_lifted);
  const auto model =
      block.model->with_mass(stated(as_lifted.mass), stated(as_lifted.centre_of_mass));
  known.flexibility =
      make_flexibility(structure::UnitResponses(*model, *block.responses), lift_case.dynamics);
  return known;
}

structure::RefinedBlock StudyBlocks::refine(const Eigen::VectorXd& values) {
  const LiftCase lift_case = cases_.of(values, &changing_);
  auto model = model_of(lift_case);
  const parallel::OneBlasThread whatever_the_threads;
  auto responses = make_unit_responses(*model, *lift_case.load.model);
  std::optional<LoadFlexibility> flexibility;
  if (gives_way(lift_case)) flexibility = make_flexibility(*responses, lift_case.dynamics);
  const LiftRun run = run_lift(lift_case,
                               prepare_lift(lift_case, load_mass(model->mass_properties()),
                                            progress_, flexibility ? &*flexibility : nullptr),
                               progress_, RunExtent::block_loads());
  const auto factors = [&](const structure::ElasticModel& of, structure::UnitResponses& of_mesh) {
    BlockLoads loads(run.model, run.static_history, run.dynamic_history(),
                     of.mesh().lifting_points);
    if (const auto edges =
            find_edge_basis(of, run.model, run.static_history, run.dynamic_history())) {
      of_mesh.add_loads(edges->loads);
      loads.add(*edges, edges->ropes);
    }
    return structure::LoadFactors{factors_of(of_mesh, loads.attachment, loads.at_rest),
                                  factors_of(of_mesh, loads.attachment, loads.in_motion)};
  };
  structure::RefinedBlock refined = structure::refine_checked_stress(
      std::move(model), std::move(responses), factors,
      {lift_case.structure.accuracy, lift_case.structure.most_unknowns});
  if (refined.model->space().shells().empty())
    throw std::runtime_error(
        "the block has no plates, over which the stress would be checked: run: assess finds the "
        "stress of its bars and solids");
  return refined;
}

structure::StressBasis StudyBlocks::basis_of(const structure::RefinedBlock& block) {
  const parallel::OneBlasThread whatever_the_threads;
  // Another member's stress may be largest elsewhere: all squares are looked at.
  return structure::make_stress_basis(
      *block.responses,
      structure::CheckedStress(*block.model, block.responses->displacements().leftCols<1>(),
                               structure::AccuracyGoal().square_size, 1)
          .squares(),
      1);
}

void StudyBlocks::find_basis(Kept& block, bool over_edges, const Eigen::VectorXd& values) {
  if (block.basis) return;
  if (over_edges) {
    block.refined = refine(values);
    block.basis = basis_of(*block.refined);
    return;
  }
  const fs::path file = file_of(block.key);
  std::error_code ignored;
  if (!fs::exists(file, ignored)) write_file(file, bytes_of_stress_basis(basis_of(refine(values))));
  block.basis = stress_basis_in(std::make_shared<const MappedFile>(file));
}

LargestChecked StudyBlocks::find_stress(const LiftCase& lift_case, const LiftRun& run,
                                        const Eigen::VectorXd& values) {
  Kept& block = kept(lift_case, values);
  find_basis(block, runs_over_edges(lift_case), values);
  const MassProperties mass = mass_of(block.matter, *lift_case.load.model);
  BlockLoads loads(run.model, run.static_history, run.dynamic_history(), block.lugs);
  const structure::StressBasis* basis = &*block.basis;
  std::optional<structure::StressBasis> with_edges;
  if (block.refined) {
    const parallel::OneBlasThread whatever_the_threads;
    if (const auto edges = find_edge_basis(*block.refined->model, run.model, run.static_history,
                                           run.dynamic_history())) {
      with_edges = *basis;
      structure::add_loads(*block.refined->responses, edges->loads, *with_edges, 1);
      loads.add(*edges, edges->ropes);
      basis = &*with_edges;
    }
  }
  LargestChecked largest;
  find_largest(*basis, loads.attachment, loads.at_rest, mass, largest.at_rest, largest.time_at_rest,
               largest.place_at_rest);
  find_largest(*basis, loads.attachment, loads.in_motion, mass, largest.in_motion,
               largest.time_in_motion, largest.place_in_motion);
  return largest;
}

void StudyBlocks::prepare(const Eigen::MatrixXd& design, int process, int processes) {
  std::set<std::string> seen;
  for (Eigen::Index member = 0; member < design.rows(); ++member) {
    const Eigen::VectorXd values = design.row(member);
    const std::string key = key_of(values);
    if (!seen.insert(key).second || static_cast<int>(seen.size() - 1) % processes != process)
      continue;
    std::error_code ignored;
    if (fs::exists(file_of(key), ignored) || runs_over_edges(cases_.of(values))) continue;
    write_file(file_of(key), bytes_of_stress_basis(basis_of(refine(values))));
  }
}

}  // namespace blocklift::pipeline
