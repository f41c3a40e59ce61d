#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

/// Division of a shell's unit square for pictures.
namespace blocklift::structure {

/// The (parts + 1)^2 points that divide the unit square's sides evenly, xi fastest.
inline Eigen::Matrix2Xd divided_square(int parts) {
  Eigen::Matrix2Xd points(2, (parts + 1) * (parts + 1));
  for (int j = 0; j <= parts; ++j)
    for (int i = 0; i <= parts; ++i)
      points.col(j * (parts + 1) + i) << static_cast<double>(i) / parts,
          static_cast<double>(j) / parts;
  return points;
}

/// Corners of the squares between them, running round, as places in divided_square().
inline std::vector<std::array<int, 4>> squares_of_division(int parts) {
  std::vector<std::array<int, 4>> squares;
  for (int j = 0; j < parts; ++j)
    for (int i = 0; i < parts; ++i) {
      const int first = j * (parts + 1) + i, above = first + parts + 1;
      squares.push_back({first, first + 1, above + 1, above});
    }
  return squares;
}

}  // namespace blocklift::structure
