#include "structure/mesh/hex_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "structure/error.h"

namespace blocklift::structure {

const std::array<std::array<int, 4>, 6> cell_faces = {
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};

namespace {

struct FaceRecord {
  std::array<int, 4> key;  // vertices in ascending order
  int cell;
  int face;
};

std::vector<FaceRecord> sorted_faces(const HexMesh& mesh) {
  std::vector<FaceRecord> faces;
  faces.reserve(mesh.cells.size() * 6);
  for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
    for (std::size_t face = 0; face < 6; ++face) {
      FaceRecord record{{}, static_cast<int>(cell), static_cast<int>(face)};
      for (std::size_t i = 0; i < 4; ++i)
        record.key[i] = mesh.cells[cell][static_cast<std::size_t>(cell_faces[face][i])];
      std::sort(record.key.begin(), record.key.end());
      faces.push_back(record);
    }
  std::sort(faces.begin(), faces.end(),
            [](const FaceRecord& a, const FaceRecord& b) { return a.key < b.key; });
  return faces;
}

// Calls visit(first, last) for each run of records that are one geometric face.
void for_each_face(const std::vector<FaceRecord>& faces,
                   const std::function<void(std::size_t, std::size_t)>& visit) {
  for (std::size_t first = 0; first < faces.size();) {
    std::size_t last = first + 1;
    while (last < faces.size() && faces[last].key == faces[first].key) ++last;
    if (last - first > 2)
      throw ModelError("mesh is not conforming: " + std::to_string(last - first) +
                       " cells share the face of cell " + std::to_string(faces[first].cell) +
                       "; two are allowed");
    visit(first, last);
    first = last;
  }
}

}  // namespace

std::vector<std::array<int, 2>> boundary_faces(const HexMesh& mesh) {
  const auto faces = sorted_faces(mesh);
  std::vector<std::array<int, 2>> boundary;
  for_each_face(faces, [&](std::size_t first, std::size_t last) {
    if (last - first == 1) boundary.push_back({faces[first].cell, faces[first].face});
  });
  std::sort(boundary.begin(), boundary.end());
  return boundary;
}

std::vector<int> connected_parts(const HexMesh& mesh) {
  std::vector<int> parent(mesh.cells.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int cell) {
    while (parent[static_cast<std::size_t>(cell)] != cell) {
      auto& up = parent[static_cast<std::size_t>(cell)];
      up = parent[static_cast<std::size_t>(up)];
      cell = up;
    }
    return cell;
  };
  const auto faces = sorted_faces(mesh);
  for_each_face(faces, [&](std::size_t first, std::size_t last) {
    if (last - first == 2)
      parent[static_cast<std::size_t>(root(faces[first].cell))] = root(faces[last - 1].cell);
  });
  std::vector<int> number(mesh.cells.size(), -1), part(mesh.cells.size());
  int parts = 0;
  for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell) {
    int& of_root = number[static_cast<std::size_t>(root(static_cast<int>(cell)))];
    if (of_root < 0) of_root = parts++;
    part[cell] = of_root;
  }
  return part;
}

namespace {

// The three quadratic Lagrange polynomials through 0, 1/2, 1, and their slopes.
struct Parabolas {
  explicit Parabolas(double t)
      : value{(1 - t) * (1 - 2 * t), 4 * t * (1 - t), t * (2 * t - 1)},
        slope{4 * t - 3, 4 - 8 * t, 4 * t - 1} {}
  std::array<double, 3> value;
  std::array<double, 3> slope;
};

}  // namespace

Vector3 position(const HexMesh& mesh, int cell, const Vector3& xi) {
  Vector3 place = Vector3::Zero();
  if (!mesh.curved_cells.empty()) {
    const Parabolas x(xi.x()), y(xi.y()), z(xi.z());
    for (std::size_t p = 0; p < 27; ++p)
      place += x.value[p % 3] * y.value[p / 3 % 3] * z.value[p / 9] *
               mesh.curved_cells[static_cast<std::size_t>(cell)][p];
    return place;
  }
  const auto& corners = mesh.cells[static_cast<std::size_t>(cell)];
  for (unsigned v = 0; v < 8; ++v) {
    double weight = 1;
    for (unsigned b = 0; b < 3; ++b) weight *= (v >> b) & 1U ? xi[b] : 1 - xi[b];
    place += weight * mesh.vertices[static_cast<std::size_t>(corners[v])];
  }
  return place;
}

Eigen::Matrix3d jacobian(const HexMesh& mesh, int cell, const Vector3& xi) {
  Eigen::Matrix3d result = Eigen::Matrix3d::Zero();
  if (!mesh.curved_cells.empty()) {
    const Parabolas x(xi.x()), y(xi.y()), z(xi.z());
    for (std::size_t p = 0; p < 27; ++p) {
      const std::size_t i = p % 3, j = p / 3 % 3, k = p / 9;
      result += mesh.curved_cells[static_cast<std::size_t>(cell)][p] *
                Eigen::RowVector3d(x.slope[i] * y.value[j] * z.value[k],
                                   x.value[i] * y.slope[j] * z.value[k],
                                   x.value[i] * y.value[j] * z.slope[k]);
    }
    return result;
  }
  const auto& corners = mesh.cells[static_cast<std::size_t>(cell)];
  for (unsigned v = 0; v < 8; ++v) {
    const Vector3& x = mesh.vertices[static_cast<std::size_t>(corners[v])];
    for (unsigned a = 0; a < 3; ++a) {
      double slope = (v >> a) & 1U ? 1 : -1;
      for (unsigned b = 0; b < 3; ++b)
        if (b != a) slope *= (v >> b) & 1U ? xi[b] : 1 - xi[b];
      result.col(a) += slope * x;
    }
  }
  return result;
}

double volume(const HexMesh& mesh) {
  const double offset = std::sqrt(0.15);
  const double place[3] = {0.5 - offset, 0.5, 0.5 + offset};
  const double weight[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  double total = 0;
  for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
    for (std::size_t p = 0; p < 27; ++p) {
      const std::size_t i = p % 3, j = p / 3 % 3, k = p / 9;
      total += weight[i] * weight[j] * weight[k] *
               jacobian(mesh, static_cast<int>(cell), Vector3(place[i], place[j], place[k]))
                   .determinant();
    }
  return total;
}

}  // namespace blocklift::structure
