#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/declaration/format.h"

namespace blocklift::pipeline {

/// A column of an output of the mechanism at one time of its run.
struct ReferenceFigure {
  static constexpr double nan = std::numeric_limits<double>::quiet_NaN();

  Located<std::string> output;
  std::string column;    ///< "x"; empty where the output has one column only
  Located<double> time;  ///< s; one of the run's samples
  Quantity value;        ///< SI
  Quantity tolerance;    ///< of the dimension of the value
  std::string source;    ///< empty: that of the whole benchmark
};

/// All columns of an output stay small over the whole run: a residual, an imbalance of energy.
struct ReferenceBound {
  Located<std::string> output;
  double largest = ReferenceFigure::nan;  ///< SI
  std::string source;
};

/// The error of a figure follows the tolerance that the integration is given.
struct ReferenceConvergence {
  Located<std::string> output;
  std::string column;
  Located<double> time;            ///< s; a value of the reference is at this output and time
  std::vector<double> tolerances;  ///< relative tolerances, falling
  double error_over_tolerance = ReferenceFigure::nan;  ///< largest that is allowed at each
  double order_within = ReferenceFigure::nan;          ///< allowed difference of the order from 1
};

/// What a benchmark's mechanism must give: the file reference.yaml beside its mechanism.yaml.
struct BenchmarkReference {
  std::string kind;
  std::string title;
  std::string source;
  std::vector<ReferenceFigure> figures;
  std::vector<ReferenceBound> bounds;
  std::optional<ReferenceConvergence> convergence;
  std::filesystem::path file;
  Mark place;

  std::string name() const { return file.parent_path().filename().string(); }
  std::filesystem::path mechanism() const { return file.parent_path() / "mechanism.yaml"; }
};

/// The format of a reference, with its checks: dimensions of tolerances, falling lists, and that
/// what is said to converge has a reference.
Format<BenchmarkReference> benchmark_reference_format();

/// Reads a reference; complaints go to `diagnostics`, none is returned if there are any.
std::optional<BenchmarkReference> read_benchmark_reference(const std::filesystem::path& file,
                                                           Diagnostics& diagnostics);

}  // namespace blocklift::pipeline
