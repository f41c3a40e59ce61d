#include "pipeline/files/vessel/freedom_matrix.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace blocklift::pipeline {

Format<given::FreedomMatrix> matrix_format(const MatrixDimensions& dimensions) {
  return array_of<std::array<Quantity, 6>, 6>(array_of<Quantity, 6>(quantity_of(dimensions.all())));
}

void check_matrix(const char* key, const std::optional<Located<given::FreedomMatrix>>& matrix,
                  const MatrixDimensions& dimensions, Reading& reading) {
  if (!matrix) return;
  for (std::size_t row = 0; row < 6; ++row) {
    for (std::size_t column = 0; column < 6; ++column) {
      const Quantity& entry = matrix->value[row][column];
      const Dimension due = dimensions.at(row, column);
      if (entry.dimension == due || (entry.dimension == Dimension::ratio && entry.value == 0)) {
        continue;
      }
      reading.error(matrix->mark,
                    fmt::format("row {}, column {} of {} is {}; {} is due, or 0", row + 1,
                                column + 1, key, text_of(entry.dimension).noun,
                                text_of(due).noun + " such as \"" + text_of(due).example + "\""),
                    {"rows and columns are surge, sway, heave, roll, pitch, yaw"});
      return;
    }
  }
}

void check_symmetric(const Located<given::FreedomMatrix>& stiffness, const std::string& hint,
                     Reading& reading) {
  const given::FreedomMatrix& rows = stiffness.value;
  for (std::size_t row = 0; row < 6; ++row) {
    for (std::size_t column = 0; column < row; ++column) {
      const double below = rows[row][column].value, above = rows[column][row].value;
      if (std::abs(below - above) <= 1e-6 * std::max(std::abs(below), std::abs(above))) continue;
      reading.error(
          stiffness.mark,
          fmt::format("the stiffness is not symmetric: {:.6g} in row {}, column {}, and {:.6g} in "
                      "row {}, column {} (SI)",
                      below, row + 1, column + 1, above, column + 1, row + 1),
          {hint});
      return;
    }
  }
}

Eigen::Matrix<double, 6, 6> values_of(const given::FreedomMatrix& matrix) {
  Eigen::Matrix<double, 6, 6> values;
  for (std::size_t row = 0; row < 6; ++row) {
    for (std::size_t column = 0; column < 6; ++column) {
      values(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) =
          matrix[row][column].value;
    }
  }
  return values;
}

}  // namespace blocklift::pipeline
