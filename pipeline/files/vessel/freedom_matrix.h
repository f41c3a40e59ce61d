#pragma once

#include <array>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "pipeline/declaration/table.h"

namespace blocklift::pipeline {

namespace given {

/// Rows of a matrix of six freedoms as a file has them: surge, sway, heave, roll, pitch, yaw.
using FreedomMatrix = std::array<std::array<Quantity, 6>, 6>;

}  // namespace given

/// What stands in a matrix where a displacement or a turn makes a force or a moment.
struct MatrixDimensions {
  Dimension straight, mixed, turning;

  std::vector<Dimension> all() const { return {straight, mixed, turning, Dimension::ratio}; }
  Dimension at(std::size_t row, std::size_t column) const {
    if (row < 3 && column < 3) return straight;
    return row < 3 || column < 3 ? mixed : turning;
  }
};
inline constexpr MatrixDimensions stiffness_dimensions{Dimension::stiffness, Dimension::force,
                                                       Dimension::rotational_stiffness};
inline constexpr MatrixDimensions damping_dimensions{Dimension::damping, Dimension::impulse,
                                                     Dimension::rotational_damping};

Format<given::FreedomMatrix> matrix_format(const MatrixDimensions& dimensions);

/// Complains about the first entry of another dimension than is due at its place; 0 needs none.
void check_matrix(const char* key, const std::optional<Located<given::FreedomMatrix>>& matrix,
                  const MatrixDimensions& dimensions, Reading& reading);

/// Complains about the first pair of entries of a stiffness that are not alike.
/// @param hint what the user may do.
void check_symmetric(const Located<given::FreedomMatrix>& stiffness, const std::string& hint,
                     Reading& reading);

/// The values in the order of the file, SI.
Eigen::Matrix<double, 6, 6> values_of(const given::FreedomMatrix& matrix);

}  // namespace blocklift::pipeline
