#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <vector>

#include <Eigen/Core>

namespace blocklift::dynamics {

/// An interval divided evenly into patches, each with its Chebyshev points.
struct Patches {
  static constexpr int points_in_each = 8;

  double from = 0.0, to = 1.0;
  int count = 1;

  double width() const { return (to - from) / count; }
  /// All points, ascending from patch to patch; none lies at an end of a patch.
  std::vector<double> points() const;
  /// The patch that holds x, and where x lies in it, from -1 to 1. Beyond the ends those of the
  /// patch there.
  [[gnu::always_inline]] inline int locate(double x, double& place) const {
    const double scaled = (x - from) / (to - from) * count;
    const int patch = std::clamp(static_cast<int>(scaled), 0, count - 1);
    place = 2.0 * (scaled - patch) - 1.0;
    return patch;
  }
};

/// A smooth function of one variable by a polynomial of degree 7 on each patch.
class PatchedCurve {
 public:
  PatchedCurve() = default;
  PatchedCurve(const Patches& patches, const std::function<double(double)>& function);

  /// Value and slope.
  [[gnu::always_inline]] inline std::array<double, 2> at(double x) const {
    double u = 0.0;
    const double* const c = &coefficients_[Patches::points_in_each * patches_.locate(x, u)];
    double value = c[Patches::points_in_each - 1], slope = 0.0;
    for (int i = Patches::points_in_each - 2; i >= 0; --i) {
      slope = slope * u + value;
      value = value * u + c[i];
    }
    return {value, slope * 2.0 / patches_.width()};
  }

 private:
  Patches patches_;
  std::vector<double> coefficients_;
};

/// A smooth function of two variables by a polynomial of degree 7 in each on each patch.
class PatchedSurface {
 public:
  PatchedSurface() = default;
  /// @param values at the points of x (rows) and y (columns).
  PatchedSurface(const Patches& x, const Patches& y, const Eigen::MatrixXd& values);

  struct Value {
    double value, along_x, along_y;
  };
  [[gnu::always_inline]] inline Value at(double x, double y) const {
    constexpr int n = Patches::points_in_each;
    double u = 0.0, v = 0.0;
    const int patch = x_.locate(x, u) * y_.count + y_.locate(y, v);
    const double* const c = &coefficients_[n * n * patch];
    std::array<double, n> row, slopes;
    for (int j = 0; j < n; ++j) {
      row[j] = c[n * (n - 1) + j];
      slopes[j] = 0.0;
    }
    for (int i = n - 2; i >= 0; --i) {
      for (int j = 0; j < n; ++j) {
        slopes[j] = slopes[j] * u + row[j];
        row[j] = row[j] * u + c[n * i + j];
      }
    }
    double value = row[n - 1], along_u = slopes[n - 1], along_v = 0.0;
    for (int j = n - 2; j >= 0; --j) {
      along_v = along_v * v + value;
      value = value * v + row[j];
      along_u = along_u * v + slopes[j];
    }
    return {value, along_u * 2.0 / x_.width(), along_v * 2.0 / y_.width()};
  }

 private:
  Patches x_, y_;
  std::vector<double> coefficients_;  ///< of u^i v^j, patch after patch
};

}  // namespace blocklift::dynamics
