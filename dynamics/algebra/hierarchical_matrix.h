#pragma once

#include <memory>
#include <vector>

#include <Eigen/Dense>

namespace blocklift::dynamics {

/// A large symmetric matrix whose entries tell what points of a plane have to do with each other,
/// and change the less from point to point the further these are apart. Blocks of groups that lie
/// apart are held as products of thin matrices, in single precision: memory and time of a product
/// grow little faster than the number of points. By hmat-oss, which finds the thin matrices by
/// adaptive cross approximation (Bebendorf and Rjasanow, 2003). It works on one thread alone:
/// therefore the points are first divided into a few groups, and each pair of groups has a matrix
/// of its own.
class HierarchicalMatrix {
 public:
  /// What a product is made in: for each group the columns in the library's order.
  struct Workspace {
    std::vector<Eigen::MatrixXf> x, y;
  };

  HierarchicalMatrix() = default;
  /// @param matrix symmetric, not kept. @param points a column for each row.
  /// @param accuracy of each thin block, relative to the block's own norm.
  /// @throws SimulationError if the library refuses a block.
  HierarchicalMatrix(const Eigen::MatrixXf& matrix, const Eigen::Matrix2Xd& points,
                     double accuracy);

  /// Memory of what is held, bytes.
  double bytes() const;

  /// Y = A X. Several threads; the figures do not depend on their number.
  void multiply(const Eigen::MatrixXf& X, Eigen::MatrixXf& Y, Workspace& workspace) const;

 private:
  struct Groups;
  std::shared_ptr<const Groups> groups_;  ///< null: no rows
};

}  // namespace blocklift::dynamics
