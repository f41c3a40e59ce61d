#include "pipeline/verification/dynamics/mechanism_benchmark.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "dynamics/multibody/inverse_dynamics.h"
#include "pipeline/simulation/mechanism_run.h"

namespace blocklift::pipeline {
namespace {

MechanismFile read_mechanism(const BenchmarkReference& reference) {
  ModelLibrary library = ModelLibrary::of_installation();
  Diagnostics diagnostics;
  std::optional<MechanismFile> file = read_mechanism(reference.mechanism(), library, diagnostics);
  if (!file) throw InputError(diagnostics);
  return std::move(*file);
}

const OutputSeries& find_output(const MechanismRun& run, const std::string& name) {
  std::vector<std::string> names;
  for (const OutputSeries& series : run.outputs) {
    if (series.name == name) return series;
    names.push_back(series.name);
  }
  throw std::runtime_error(
      fmt::format("the reference names an output \"{}\" that there is none of; {}", name,
                  names_hint("the outputs are", names, name)));
}

std::size_t find_column(const OutputSeries& series, const std::string& name) {
  for (std::size_t i = 0; i < series.columns.size(); ++i) {
    if (series.columns[i].name == name || (name.empty() && series.columns.size() == 1)) return i;
  }
  std::vector<std::string> names;
  for (const OutputColumn& column : series.columns) names.push_back(column.name);
  throw std::runtime_error(fmt::format("output {} has no column \"{}\"; {}", series.name, name,
                                       names_hint("its columns are", names, name)));
}

/// The sample at a time, to a millionth of the time between samples.
Eigen::Index find_sample(const Eigen::VectorXd& time, double wanted) {
  Eigen::Index sample = 0;
  const double distance = (time.array() - wanted).abs().minCoeff(&sample);
  if (distance > 1e-6 * (time[1] - time[0]))
    throw std::runtime_error(fmt::format("no sample of the run is at {} s", wanted));
  return sample;
}

double figure_of(const MechanismRun& run, const std::string& output, const std::string& column,
                 double time) {
  const OutputSeries& series = find_output(run, output);
  return series.values(find_sample(run.time(), time),
                       static_cast<Eigen::Index>(find_column(series, column)));
}

VerificationRow figure_row(const MechanismRun& run, const ReferenceFigure& figure) {
  const OutputSeries& series = find_output(run, figure.output.value);
  const std::size_t column = find_column(series, figure.column);
  const std::string& unit = series.columns[column].unit;
  if (unit != text_of(figure.value.dimension).si_unit)
    throw std::runtime_error(fmt::format("output {} is in {}, its reference is {}", series.name,
                                         unit, text_of(figure.value.dimension).noun));
  return compare(fmt::format("{} at {} s", series.column_name(column), figure.time.value), unit,
                 figure.value.value,
                 figure_of(run, figure.output.value, figure.column, figure.time.value),
                 figure.tolerance.value, figure.source);
}

VerificationRow bound_row(const MechanismRun& run, const ReferenceBound& limit) {
  const OutputSeries& series = find_output(run, limit.output.value);
  std::string unit = series.columns[0].unit;
  for (const OutputColumn& column : series.columns) {
    if (column.unit != unit) unit = "SI";
  }
  return bound(fmt::format("largest {} of the whole run", series.name), unit,
               series.values.cwiseAbs().maxCoeff(), limit.largest,
               limit.source.empty() ? "vanishes in exact arithmetic" : limit.source);
}

/// Errors at falling tolerances and the order in which they fall.
void add_convergence(MechanismFile file, const BenchmarkReference& reference,
                     std::vector<VerificationRow>& rows) {
  const ReferenceConvergence& c = *reference.convergence;
  const auto figure = std::find_if(reference.figures.begin(), reference.figures.end(),
                                   [&](const ReferenceFigure& f) {
                                     return f.output.value == c.output.value &&
                                            f.column == c.column && f.time.value == c.time.value;
                                   });
  std::vector<double> errors;
  for (const double tolerance : c.tolerances) {
    file.simulate.relative_tolerance = tolerance;
    const MechanismRun run = run_mechanism(file, {});
    VerificationRow row = figure_row(run, *figure);
    errors.push_back(row.error);
    rows.push_back(
        bound(fmt::format("error of {} at relative tolerance {:.0e}", row.quantity, tolerance),
              row.unit, row.error, c.error_over_tolerance * tolerance, row.source));
  }
  const double order = std::log(errors.front() / errors.back()) /
                       std::log(c.tolerances.front() / c.tolerances.back());
  rows.push_back(compare("order of the error in the relative tolerance", "1", 1.0, order,
                         c.order_within, "error proportional to tolerance (Soederlind 2002)"));
}

/// Largest disagreement of inverse dynamics with the joint forces that forward dynamics was given,
/// over the samples of a run, relative to all joint forces.
VerificationRow forward_against_inverse(const MechanismFile& file) {
  const BuiltMechanism built = build_mechanism(file);
  const dynamics::Mechanism& mechanism = built.system.mechanism();
  dynamics::InverseDynamicsWorkspace workspace(mechanism);
  Eigen::VectorXd found(mechanism.nv()), at_rest(mechanism.nv());
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(mechanism.nv());
  double largest = 0.0;
  dynamics::IntegrationSettings settings;
  settings.relative_tolerance = 1e-8;
  settings.sample_interval = file.sample_interval();
  settings.observe = [&](Eigen::Index, double, const dynamics::LiftWorkspace& w) {
    std::vector<dynamics::ForceVector> forces = w.loads.F_Bo_W;
    Eigen::VectorXd tau = w.loads.tau;
    if (w.loops) {
      dynamics::add_loop_forces(mechanism, w.kinematics, w.loops->loops, w.loops->lambda, forces,
                                tau);
    }
    compute_inverse_dynamics(mechanism, w.kinematics, w.v, w.vdot, forces, workspace, found);
    compute_inverse_dynamics(mechanism, w.kinematics, w.v, zero, forces, workspace, at_rest);
    const double size = tau.norm() + at_rest.norm() + (found - at_rest).norm();
    if (size > 0) largest = std::max(largest, (found - tau).norm() / size);
  };
  dynamics::integrate(built.system, built.system.q_start(), built.system.v_start(), settings);
  return bound("forward against inverse dynamics along the motion, relative", "1", largest, 1e-12,
               "each the inverse of the other");
}

std::vector<VerificationRow> compute(const BenchmarkReference& reference) {
  const MechanismFile file = read_mechanism(reference);
  std::vector<VerificationRow> rows;
  const MechanismRun run = run_mechanism(file, {});
  for (const ReferenceFigure& figure : reference.figures) rows.push_back(figure_row(run, figure));
  for (const ReferenceBound& limit : reference.bounds) rows.push_back(bound_row(run, limit));
  rows.push_back(forward_against_inverse(file));
  if (reference.convergence) add_convergence(file, reference, rows);
  return rows;
}

}  // namespace

VerificationCase mechanism_benchmark(BenchmarkReference reference) {
  const auto shared = std::make_shared<const BenchmarkReference>(std::move(reference));
  return {
      .name = shared->name(), .stage = "dynamics", .source = shared->source, .compute = [shared] {
        return compute(*shared);
      }};
}

}  // namespace blocklift::pipeline
