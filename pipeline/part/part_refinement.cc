#include "pipeline/part/part_refinement.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "pipeline/lift/stopwatch.h"
#include "structure/error.h"
#include "structure/part/part_refinement.h"
#include "structure/stress_tensor.h"

namespace blocklift::pipeline {

namespace {

/// A stress that shall be accurate.
struct Checked {
  std::string name;
  Vector3 place = Vector3::Zero();
  double error = 0;  ///< of the von Mises stress, as a share
};

double share(double error, double stress) { return stress > 0 ? error / stress : 0; }

std::vector<Checked> checked_stresses(const PartAssessment& assessment) {
  std::vector<Checked> all;
  if (!assessment.file.checked_stress) return all;
  const structure::PartSolution& solution = assessment.solution;
  const auto& names = assessment.file.checked_stress->probes;
  if (names.empty())
    all.push_back({"the largest stress", solution.all.point,
                   share(solution.all.von_mises_error, solution.all.von_mises)});
  for (const given::PartProbe& probe : assessment.file.probes) {
    const bool is_checked = std::any_of(names.begin(), names.end(), [&](const auto& name) {
      return name.value == probe.name.value;
    });
    if (!is_checked) continue;
    const structure::PartProbe there = structure::probe_part(assessment.model, solution, *probe.at);
    all.push_back({"the stress at probe " + probe.name.value, *probe.at,
                   share(there.von_mises_error, structure::von_mises(there.stress))});
  }
  return all;
}

/// The largest error among them. @pre there are some.
const Checked& worst_of(const std::vector<Checked>& checked) {
  return *std::max_element(checked.begin(), checked.end(),
                           [](const Checked& a, const Checked& b) { return a.error < b.error; });
}

RefinementStep step_of(const PartAssessment& assessment, const std::vector<Checked>& checked) {
  const structure::PartSolution& solution = assessment.solution;
  return {assessment.file.mesh.element_order,
          assessment.model.mesh.solids.size(),
          static_cast<int>(3 * assessment.model.mesh.nodes.cols()),
          solution.estimated_error,
          solution.all.von_mises,
          solution.all.von_mises_error,
          checked.empty() ? 0 : worst_of(checked).error};
}

/// Finds the next mesh and whether it is needed.
class Refiner {
 public:
  explicit Refiner(PartAssessment& assessment) : assessment_(assessment) {}

  const std::optional<structure::SizeField>& sizes() const { return sizes_; }

  bool is_accurate(const std::vector<Checked>& checked) const {
    return is_field_accurate() && std::none_of(checked.begin(), checked.end(),
                                               [&](const auto& one) { return !is_accurate(one); });
  }

  /// Quadratic elements first, then smaller ones.
  void refine(const std::vector<Checked>& checked) {
    given::PartMesh& mesh = assessment_.file.mesh;
    const std::size_t elements = assessment_.model.mesh.solids.size();
    // Sides with a fixed number of elements take no sizes: then there are hardly more than before.
    const bool takes_no_sizes = sizes_ && elements < elements_before_ + elements_before_ / 50;
    elements_before_ = elements;
    if (mesh.element_order < 2) {
      mesh.element_order = 2;
      return;
    }
    if (takes_no_sizes || is_uniform_ || !structure::takes_sizes(assessment_.model.mesh)) {
      is_uniform_ = true;
      ++mesh.refinements;
      return;
    }
    structure::RefinementAim aim;
    if (!is_field_accurate()) aim.error = assessment_.file.accuracy;
    for (const Checked& one : checked)
      if (!is_accurate(one)) aim.places.push_back(one.place);
    sizes_ = structure::find_sizes(assessment_.model, assessment_.solution, aim);
  }

 private:
  bool is_field_accurate() const {
    const std::optional<double>& accuracy = assessment_.file.accuracy;
    return !accuracy || assessment_.solution.estimated_error <= *accuracy;
  }
  bool is_accurate(const Checked& one) const {
    return one.error <= assessment_.file.checked_stress->accuracy;
  }

  PartAssessment& assessment_;
  std::optional<structure::SizeField> sizes_;
  std::size_t elements_before_ = 0;
  bool is_uniform_ = false;
};

/// What is not accurate yet, for a message.
std::string shortfall(const PartAssessment& assessment, const std::vector<Checked>& checked) {
  const RefinementStep& last = assessment.refinement.back();
  const std::optional<double>& accuracy = assessment.file.accuracy;
  if (accuracy && last.estimated_error > *accuracy)
    return fmt::format(
        "the accuracy of {:.3g} % is not reached: {} elements have an error of {:.3g} %",
        100 * *accuracy, last.elements, 100 * last.estimated_error);
  return fmt::format(
      "the accuracy of {:.3g} % is not reached: {} has an error of {:.3g} % with {} elements",
      100 * assessment.file.checked_stress->accuracy, worst_of(checked).name,
      100 * last.checked_error, last.elements);
}

}  // namespace

void solve_to_accuracy(PartAssessment& assessment, Diagnostics& diagnostics) {
  constexpr std::size_t most_steps = 8;
  Stopwatch watch;
  Refiner refiner(assessment);
  std::vector<Checked> checked;
  for (;;) {
    try {
      watch.lap();
      assessment.model = make_part_model(assessment.file, diagnostics, refiner.sizes());
      if (diagnostics.has_errors()) throw InputError(diagnostics);
      assessment.mesh_s = watch.lap();
      if (assessment.file.loads.empty()) return;
      assessment.solution = structure::solve_part(assessment.model, assessment.file.solver);
    } catch (const structure::ModelError& error) {
      std::string message = error.what();
      if (!assessment.refinement.empty()) message += "; " + shortfall(assessment, checked);
      diagnostics.error(assessment.file.mesh.mark(), message);
      throw InputError(diagnostics);
    }
    checked = checked_stresses(assessment);
    assessment.refinement.push_back(step_of(assessment, checked));
    if (refiner.is_accurate(checked)) return;
    if (assessment.refinement.size() == most_steps) {
      const Vector3& worst = assessment.solution.worst_point;
      diagnostics.error(
          assessment.file.mesh.mark(),
          fmt::format("{}, most of the field's at ({:.4g}, {:.4g}, {:.4g}) m",
                      shortfall(assessment, checked), worst.x(), worst.y(), worst.z()),
          {"make the mesh finer there, round off a sharp corner, or ask for less"});
      throw InputError(diagnostics);
    }
    refiner.refine(checked);
  }
}

}  // namespace blocklift::pipeline
