#include "structure/stress/membrane_strains.h"

#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "structure/formulation/gauss_line.h"

namespace blocklift::structure {

namespace {

/// Takes (11, 22, 2 x 12) along axes to those along axes of which they have the components a and b.
Eigen::Matrix3d turn_by(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  Eigen::Matrix3d turn;
  turn << a[0] * a[0], a[1] * a[1], a[0] * a[1],  //
      b[0] * b[0], b[1] * b[1], b[0] * b[1],      //
      2 * a[0] * b[0], 2 * a[1] * b[1], a[0] * b[1] + a[1] * b[0];
  return turn;
}

}  // namespace

/// Where strains of a kind of cells are found.
struct MembraneStrains::Sampling {
  Sampling(const Space& space, int count)
      : places(gauss_places(count)), strains(space, square_rule(count).topRows<2>()) {}
  /// Polynomials through the points, xi fastest.
  Eigen::VectorXd shares_at(const Eigen::Vector2d& xi) const {
    const std::vector<double> x = lagrange_at(places, xi.x()), y = lagrange_at(places, xi.y());
    const auto count = static_cast<Eigen::Index>(places.size());
    return (Eigen::Map<const Eigen::VectorXd>(x.data(), count) *
            Eigen::Map<const Eigen::RowVectorXd>(y.data(), count))
        .reshaped();
  }

  std::vector<double> places;
  ShellOperator strains;
};

/// What is known of a cell.
struct MembraneStrains::Known {
  const Sampling* sampling = nullptr;
  Vector3 along = Vector3::Zero();  ///< the cell's direction, as ShellOperator has it
  Eigen::Matrix3Xd normals;
  std::vector<Eigen::MatrixXd> strains;  ///< 3 x m a point
};

MembraneStrains::MembraneStrains(const Space& space, const ByRows& motions)
    : space_(space), motions_(motions) {}

MembraneStrains::~MembraneStrains() = default;

const MembraneStrains::Known& MembraneStrains::know(int cell) {
  std::unique_ptr<const Known>& place = known_[cell];
  if (place) return *place;
  auto found = std::make_unique<Known>();
  Known& known = *found;
  const int degree = space_.degree();
  const bool is_triangle =
      degree > 1 && space_.mesh().shells[space_.shells()[cell].shell].is_triangle();
  std::unique_ptr<Sampling>& sampling = is_triangle ? of_triangles_ : of_squares_;
  if (!sampling) sampling = std::make_unique<Sampling>(space_, is_triangle ? degree : degree + 1);
  known.sampling = sampling.get();
  known.along = space_.place(cell, {1, 0.5}) - space_.place(cell, {0, 0.5});
  Eigen::MatrixXd local(6 * space_.nodes_per_shell(), motions_.cols());
  for (int i = 0; i < space_.nodes_per_shell(); ++i)
    local.middleRows<6>(6 * i) =
        motions_.middleRows<6>(6 * static_cast<Eigen::Index>(space_.shell_nodes(cell)[i]));
  sampling->strains.reinit(cell);
  const std::vector<ShellPoint>& points = sampling->strains.points();
  known.normals.resize(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t q = 0; q < points.size(); ++q) {
    known.normals.col(static_cast<Eigen::Index>(q)) = points[q].normal;
    known.strains.emplace_back(points[q].strain.middleRows<3>(membrane_11) * local);
  }
  place = std::move(found);
  return *place;
}

Eigen::MatrixXd MembraneStrains::at(int cell, const Eigen::Vector2d& xi, const Vector3& e_1,
                                    double side) {
  const Known& known = know(cell);
  const Eigen::VectorXd shares = known.sampling->shares_at(xi);
  Eigen::MatrixXd strain = Eigen::MatrixXd::Zero(3, motions_.cols());
  for (std::size_t q = 0; q < known.strains.size(); ++q) strain += shares[q] * known.strains[q];
  const Vector3 normal = (known.normals * shares).normalized();
  const auto on_surface = [&](const Vector3& way) -> Vector3 {
    return (way - normal * normal.dot(way)).normalized();
  };
  const Vector3 own_1 = on_surface(known.along), own_2 = normal.cross(own_1),
                wanted_1 = on_surface(e_1), wanted_2 = side * normal.cross(wanted_1);
  const Eigen::Matrix3d turn = turn_by({wanted_1.dot(own_1), wanted_1.dot(own_2)},
                                       {wanted_2.dot(own_1), wanted_2.dot(own_2)});
  return turn * strain;
}

}  // namespace blocklift::structure
