#include "structure/stress/squares.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include <Eigen/Dense>

#include "parallel/threads.h"
#include "structure/formulation/shell.h"
#include "structure/large_pages.h"
#include "structure/mesh/fields/shell_edges.h"
#include "structure/response/cell_finder.h"
#include "structure/stress/bilinear_shear.h"
#include "structure/stress/membrane_strains.h"
#include "structure/stress/square_outline.h"
#include "structure/stress_tensor.h"

namespace blocklift::structure {

namespace {

using square_outline::contour;
using square_outline::ContourPoint;
using square_outline::normal_of;
using square_outline::side_points;
using square_outline::side_weights;
using square_outline::start_of;

/// What a cell brings to the integrals over a square's outline: those of its shape functions times
/// the outward normal along e_1 and e_2, m.
struct CellShare {
  int cell = 0;
  Eigen::Matrix2Xd weights;  ///< a column a node
};

void find_shares(const Space& space, const FieldWalker& walker, const CellFinder& cells,
                 const Square& square, std::vector<CellShare>& shares) {
  shares.clear();
  for (const ContourPoint& point : contour(square)) {
    const auto found = walker.find(point.place, start_of(square));
    // Without one of its points the sum over the outline is no strain.
    if (!found) throw std::logic_error("a square of the checked stress leaves its field of plates");
    const CellPlace place = cells.find(*found);
    auto share = std::find_if(shares.begin(), shares.end(), [&](const CellShare& candidate) {
      return candidate.cell == place.cell;
    });
    if (share == shares.end())
      share =
          shares.insert(share, {place.cell, Eigen::Matrix2Xd::Zero(2, space.nodes_per_shell())});
    share->weights += point.normal * space.shell_values(place.xi).transpose();
  }
}

/// Calls visit(place in its cell, place in its shell, share of the square's area) for those of the
/// Gauss points within a square below which there is plating. @returns are there all of them?
template <typename Visit>
bool visit_inner_points(const FieldWalker& walker, const CellFinder& cells, const Square& square,
                        const Visit& visit) {
  const double half = square.size / 2;
  bool are_all = true;
  for (std::size_t i = 0; i < side_points.size(); ++i)
    for (std::size_t j = 0; j < side_points.size(); ++j) {
      const Vector3 place = square.centre_B + (square.size * side_points[i] - half) * square.e_1 +
                            (square.size * side_points[j] - half) * square.e_2;
      if (const auto found = walker.find(place, start_of(square)))
        visit(cells.find(*found), *found, side_weights[i] * side_weights[j]);
      else
        are_all = false;
    }
  return are_all;
}

/// Calls visit(place in its cell, share of the square's area) for Gauss points within a square.
template <typename Visit>
void for_each_inner_point(const FieldWalker& walker, const CellFinder& cells, const Square& square,
                          const Visit& visit) {
  const auto without_shell = [&](const CellPlace& at, const ShellPlace&, double weight) {
    visit(at, weight);
  };
  if (!visit_inner_points(walker, cells, square, without_shell))
    throw std::logic_error("a square of the checked stress leaves its field of plates");
}

/// Integrals over a square's area of its strain where it is plane and of its curvature (11, 22, 2 x
/// 12, a column a motion), found from the motion along its outline.
void integrate_outline(const Space& space, const std::vector<CellShare>& shares,
                       const Square& square, const MembraneStrains::ByRows& by_rows,
                       Eigen::MatrixXd& strain, Eigen::MatrixXd& curvature) {
  static thread_local std::array<Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::RowMajor>, 2>
      across;
  for (Eigen::Index k = 0; k < 2; ++k) {
    across[k].setZero(6, by_rows.cols());
    for (const CellShare& share : shares) {
      const int* nodes = space.shell_nodes(share.cell);
      for (int i = 0; i < space.nodes_per_shell(); ++i)
        across[k] +=
            share.weights(k, i) * by_rows.middleRows<6>(6 * static_cast<Eigen::Index>(nodes[i]));
    }
  }
  const auto sum = [&](Eigen::MatrixXd& sums, const Vector3& along_1, const Vector3& along_2,
                       Eigen::Index row) {
    sums.row(0) = along_1.transpose() * across[0].middleRows<3>(row);
    sums.row(1) = along_2.transpose() * across[1].middleRows<3>(row);
    sums.row(2) = along_1.transpose() * across[1].middleRows<3>(row) +
                  along_2.transpose() * across[0].middleRows<3>(row);
  };
  sum(strain, square.e_1, square.e_2, 0);
  // e . (theta x n) = theta . (n x e)
  const Vector3 normal = square.e_1.cross(square.e_2);
  sum(curvature, normal.cross(square.e_1), normal.cross(square.e_2), 3);
}

/// The shear that cells of degree 1 do not bear. What is known of the last cell serves the next
/// point: squares of one cell follow one another.
class ExcessShear {
 public:
  explicit ExcessShear(const Space& space) : space_(space) {}

  /// Takes it from a square's strain (integrals of 11, 22, 2 x 12 over its area, a column a
  /// motion).
  void take_from(Eigen::MatrixXd& strain, const FieldWalker& walker, const CellFinder& cells,
                 const Square& square, const MembraneStrains::ByRows& by_rows) {
    Eigen::RowVectorXd sum(strain.cols());
    for_each_inner_point(walker, cells, square, [&](const CellPlace& at, double weight) {
      const auto excess = shear_of(at.cell).excess_at(at.xi, square.e_1, square.e_2);
      sum.setZero();
      for (int node = 0; node < 4; ++node)
        sum +=
            excess.by_nodes.col(node).transpose() *
            by_rows.middleRows<3>(6 * static_cast<Eigen::Index>(space_.shell_nodes(at.cell)[node]));
      const double area = weight * square.size * square.size;
      strain -= area * excess.turned * sum;
    });
  }

 private:
  const BilinearShear& shear_of(int cell) {
    if (cell != cell_) shear_.emplace(space_, cell);
    cell_ = cell;
    return *shear_;
  }

  const Space& space_;
  int cell_ = -1;
  std::optional<BilinearShear> shear_;  ///< of the cell
};

/// Mean membrane forces and moments that hold a square where nothing moves, along its axes and
/// about its normal: 6 x cases.
Eigen::MatrixXd held_forces(const CellHeat& heat, const Space& space, const FieldWalker& walker,
                            const CellFinder& cells, const Square& square, double thickness) {
  const Vector3 normal = square.e_1.cross(square.e_2);
  Eigen::MatrixXd mean = Eigen::MatrixXd::Zero(6, heat.cases());
  for_each_inner_point(walker, cells, square, [&](const CellPlace& at, double weight) {
    const int shell = space.shells()[at.cell].shell;
    const double side = normal_of(space.mesh(), {shell, {0.5, 0.5}}).dot(normal) < 0 ? -1 : 1;
    const Eigen::MatrixXd here =
        weight * heat.shell_forces(at.cell, at.xi, square.e_1, square.e_2, thickness);
    mean.topRows<3>() += here.topRows<3>();
    mean.bottomRows<3>() += side * here.bottomRows<3>();
  });
  return mean;
}

/// Do the cells below a square lie in its plane, as far as their bending can tell?
///
/// Where a cell of degree 2 bends, its rise over the plane makes a membrane strain of its
/// displacements of about the strain of bending times rise over thickness.
bool is_plane(const Space& space, const std::vector<CellShare>& shares, const Square& square,
              double thickness) {
  const double rise = 1e-3 * thickness;
  const Vector3 normal = square.e_1.cross(square.e_2);
  return std::all_of(shares.begin(), shares.end(), [&](const CellShare& share) {
    const int* nodes = space.shell_nodes(share.cell);
    return std::all_of(nodes, nodes + space.nodes_per_shell(), [&](int node) {
      const Vector3 off = space.nodes().col(node) - square.centre_B;
      return std::abs(off.dot(normal)) <= rise;
    });
  });
}

/// Integrals over a square's area of the membrane strain that the stiffness has, 3 x m.
/// @returns nothing where there is no plating below the square's inner points.
std::optional<Eigen::MatrixXd> integrate_membrane(const Mesh& mesh, const FieldWalker& walker,
                                                  const CellFinder& cells, const Square& square,
                                                  MembraneStrains& strains) {
  const Vector3 normal = square.e_1.cross(square.e_2);
  std::optional<Eigen::MatrixXd> strain;
  double weights = 0;
  visit_inner_points(
      walker, cells, square, [&](const CellPlace& at, const ShellPlace& place, double weight) {
        const double side = normal_of(mesh, place).dot(normal) < 0 ? -1 : 1;
        const Eigen::MatrixXd here = weight * strains.at(at.cell, at.xi, square.e_1, side);
        strain = strain ? *strain + here : here;
        weights += weight;
      });
  // A hole within the square has the strain of the rest.
  if (strain) *strain *= square.size * square.size / weights;
  return strain;
}

/// Where the thickness varies a square has that of its middle, m.
double thickness_of(const Mesh& mesh, const FieldWalker& walker, const Square& square) {
  const Shell& shell = mesh.shells[square.shell];
  if (shell.taper >= 0)
    if (const auto middle = walker.find(square.centre_B, start_of(square)))
      return thickness_at(mesh, mesh.shells[middle->shell], middle->xi);
  return mesh.section_of(shell).thickness;
}

}  // namespace

CheckedStress::CheckedStress(const ElasticModel& model,
                             const Eigen::Ref<const Eigen::MatrixXd>& motions, double size,
                             int threads, const CellHeat* heat) {
  const PlateFields fields = find_fields(model.mesh());
  const FieldWalker walker(model.mesh(), fields);
  squares_ = place_squares(model.mesh(), fields, walker, size);
  evaluate(model, walker, motions, threads, heat);
}

CheckedStress::CheckedStress(const ElasticModel& model,
                             const Eigen::Ref<const Eigen::MatrixXd>& motions,
                             std::vector<Square> squares, int threads)
    : squares_(std::move(squares)) {
  const PlateFields fields = find_fields(model.mesh());
  evaluate(model, FieldWalker(model.mesh(), fields), motions, threads, nullptr);
}

void CheckedStress::evaluate(const ElasticModel& model, const FieldWalker& walker,
                             const Eigen::Ref<const Eigen::MatrixXd>& motions, int threads,
                             const CellHeat* heat) {
  const Space& space = model.space();
  const CellFinder cells(space);
  // A node's six freedoms of all motions lie together.
  auto by_rows = make_large<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      motions.rows(), motions.cols());
  parallel::in_batches(static_cast<int>(motions.rows()), 4096, threads, [&](int first, int count) {
    by_rows.middleRows(first, count) = motions.middleRows(first, count);
  });
  const Eigen::Index columns = motions.cols();
  components_.setZero(3 * static_cast<Eigen::Index>(squares_.size()), columns);
  bending_ = components_;
  parallel::in_batches(static_cast<int>(squares_.size()), 64, threads, [&](int first, int count) {
    std::vector<CellShare> shares;
    Eigen::MatrixXd strain(3, columns), curvature(3, columns);
    MembraneStrains of_stiffness(space, by_rows);
    ExcessShear excess(space);
    for (int s = first; s < first + count; ++s) {
      const Square& square = squares_[s];
      const Shell& shell = model.mesh().shells[square.shell];
      // The section's offset is along the shell's own normal.
      const double side =
          normal_of(model.mesh(), start_of(square)).dot(square.e_1.cross(square.e_2)) < 0 ? -1 : 1;
      const double t = thickness_of(model.mesh(), walker, square);
      find_shares(space, walker, cells, square, shares);
      integrate_outline(space, shares, square, by_rows, strain, curvature);
      std::optional<Eigen::MatrixXd> tied;
      if (!is_plane(space, shares, square, t))
        tied = integrate_membrane(model.mesh(), walker, cells, square, of_stiffness);
      if (tied) {
        strain = *tied;
      } else {
        if (space.degree() == 1) excess.take_from(strain, walker, cells, square, by_rows);
        strain += side * model.mesh().section_of(shell).offset * curvature;
      }
      const double area = square.size * square.size;
      const auto law = shell_stiffness_law(model.mesh(), shell, square.e_1, square.e_2, t);
      const Eigen::Matrix3d membrane = law.block<3, 3>(membrane_11, membrane_11),
                            coupling = side * law.block<3, 3>(membrane_11, curvature_11),
                            bending = law.block<3, 3>(curvature_11, curvature_11);
      components_.middleRows<3>(3 * s) = (membrane * strain + coupling * curvature) / (area * t);
      bending_.middleRows<3>(3 * s) =
          (coupling * strain + bending * curvature) * (6 / (area * t * t));
      if (heat == nullptr) continue;
      const Eigen::MatrixXd held = held_forces(*heat, space, walker, cells, square, t);
      components_.middleRows<3>(3 * s) -= held.topRows<3>() / t;
      bending_.middleRows<3>(3 * s) -= held.bottomRows<3>() * (6 / (t * t));
    }
  });
}

Eigen::VectorXd CheckedStress::von_mises(const Eigen::VectorXd& factors) const {
  const Eigen::VectorXd stress = components_ * factors;
  Eigen::VectorXd result(static_cast<Eigen::Index>(squares_.size()));
  for (Eigen::Index s = 0; s < result.size(); ++s) {
    const double a = stress[3 * s], b = stress[3 * s + 1], c = stress[3 * s + 2];
    result[s] = std::sqrt(a * a - a * b + b * b + 3 * c * c);
  }
  return result;
}

}  // namespace blocklift::structure
