#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace blocklift::structure {

/// Boxes in the space of a history's coordinates, of which each holds some instants.
///
/// Midpoints and half widths in single precision, the half widths rounded up so that a box holds
/// its instants. `LoadHistory::pack` boxes lie beside one another: entry (pack * rank + k) *
/// LoadHistory::pack + place in the pack; what the last pack has too many is zero.
struct LoadBoxes {
  std::vector<float> centres, half_widths;
};

/// Loads at many instants as factors of unit responses, made ready for the search of extremes.
///
/// The factors f_t (m numbers an instant, in the units of the unit loads) are turned into
/// coordinates y_t in an orthogonal basis, f_t = modes y_t, after each factor is weighed by how
/// much its unit response matters, so that all coordinates have the unit of the response.
/// Directions in which no instant goes further than 1e-15 of the largest are left out: in a history
/// of balanced loads the six plain accelerations, for example. No other direction is, so that
/// nothing is approximated.
///
/// Instants that lie near one another are put into clusters of `cluster_size`, each with the box
/// that holds it: the loads of a lift come back to nearly the same values again and again. `pack`
/// clusters that lie near one another have a box of their own, which passes all of them over.
class LoadHistory {
 public:
  static constexpr int cluster_size = 32;
  /// So many clusters, and so many packs of them, are looked at together.
  static constexpr int pack = 16;

  /// @param factors m x instants.
  /// @param weights m: a typical magnitude of each unit response (such as its root mean square);
  ///   a factor of weight zero has no response and is not looked at.
  /// @throws ModelError if there is no instant or a factor is not a number.
  LoadHistory(const Eigen::MatrixXd& factors, const Eigen::VectorXd& weights);

  int instants() const { return instants_; }
  int rank() const { return static_cast<int>(modes_.cols()); }
  int clusters() const { return static_cast<int>(first_member_.size()) - 1; }
  int packs() const { return (clusters() + pack - 1) / pack; }
  /// m x rank: responses to the coordinates are the unit responses times this.
  const Eigen::MatrixXd& modes() const { return modes_; }

  /// Largest magnitude of each coordinate over all instants.
  const Eigen::VectorXd& reach() const { return reach_; }

  const LoadBoxes& boxes_of_clusters() const { return boxes_of_clusters_; }
  const LoadBoxes& boxes_of_packs() const { return boxes_of_packs_; }
  /// Coordinates of a cluster's members: entry k * cluster_size + member, repetitions at the end.
  const double* members(int cluster) const { return members_.data() + start(cluster); }
  /// The middle of a cluster's box, by coordinates.
  const double* middle(int cluster) const {
    return middles_.data() + static_cast<std::ptrdiff_t>(cluster) * rank();
  }
  /// The members' coordinates from the middle, in single precision: as members().
  const float* coarse_members(int cluster) const { return coarse_members_.data() + start(cluster); }
  /// The instant of each member, cluster_size a cluster.
  const int* member_instants(int cluster) const {
    return member_instants_.data() + static_cast<std::size_t>(cluster) * cluster_size;
  }

 private:
  void divide(const Eigen::MatrixXd& coordinates, std::vector<int>& order, int first, int count);
  std::size_t start(int cluster) const {
    return static_cast<std::size_t>(cluster) * static_cast<std::size_t>(rank() * cluster_size);
  }
  void store(const Eigen::MatrixXd& coordinates, const std::vector<int>& order);
  void store_box(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, int box,
                 LoadBoxes& boxes) const;

  int instants_ = 0;
  Eigen::MatrixXd modes_;
  std::vector<int> first_member_{0};
  Eigen::VectorXd reach_;
  LoadBoxes boxes_of_clusters_, boxes_of_packs_;
  std::vector<float> coarse_members_;
  std::vector<double> members_, middles_;
  std::vector<int> member_instants_;
};

}  // namespace blocklift::structure
