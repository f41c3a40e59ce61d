#include "structure/envelope/load_history.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "algebra/decompositions.h"
#include "structure/error.h"
#include "structure/index.h"

namespace blocklift::structure {

LoadHistory::LoadHistory(const Eigen::MatrixXd& factors, const Eigen::VectorXd& weights)
    : instants_(static_cast<int>(factors.cols())) {
  if (factors.cols() == 0) throw ModelError("a history of loads has no instant");
  for (Eigen::Index t = 0; t < factors.cols(); ++t)
    if (!factors.col(t).allFinite())
      throw ModelError("loads at instant " + std::to_string(t) + " are not numbers");
  const Eigen::VectorXd inverse =
      weights.unaryExpr([](double weight) { return weight > 0 ? 1 / weight : 0.0; });
  const Eigen::MatrixXd weighed = weights.asDiagonal() * factors;
  // Orthogonal directions, the largest first. How exact they are does not matter, only that they
  // are orthogonal: the coordinates are products with them, and complete.
  const Eigen::MatrixXd gram = weighed * weighed.transpose();
  const Eigen::MatrixXd directions =
      algebra::symmetric_eigensystem(gram).vectors.rowwise().reverse();
  const Eigen::MatrixXd coordinates = directions.transpose() * weighed;
  const Eigen::VectorXd reach = coordinates.cwiseAbs().rowwise().maxCoeff();
  const double negligible = static_cast<double>(reach.size()) *
                            std::numeric_limits<double>::epsilon() *
                            weighed.colwise().norm().maxCoeff();
  std::vector<Eigen::Index> kept;
  for (Eigen::Index k = 0; k < reach.size(); ++k)
    if (reach[k] > negligible) kept.push_back(k);
  if (kept.empty()) kept.push_back(0);  // all loads are zero
  reach_ = reach(kept);
  modes_ = inverse.asDiagonal() * directions(Eigen::all, kept);

  std::vector<int> order(at(factors.cols()));
  std::iota(order.begin(), order.end(), 0);
  const Eigen::MatrixXd kept_coordinates = coordinates(kept, Eigen::all);
  divide(kept_coordinates, order, 0, instants_);
  store(kept_coordinates, order);
}

// Halves a range across its widest direction until a cluster holds it. As long as more than a pack
// is left, between two packs.
void LoadHistory::divide(const Eigen::MatrixXd& coordinates, std::vector<int>& order, int first,
                         int count) {
  const auto begin = order.begin() + first;
  if (count <= cluster_size) {
    std::sort(begin, begin + count);
    first_member_.push_back(first + count);
    return;
  }
  Eigen::VectorXd lower = coordinates.col(*begin), upper = lower;
  for (auto instant = begin; instant != begin + count; ++instant) {
    lower = lower.cwiseMin(coordinates.col(*instant));
    upper = upper.cwiseMax(coordinates.col(*instant));
  }
  Eigen::Index widest = 0;
  (upper - lower).maxCoeff(&widest);
  const int whole = count > pack * cluster_size ? pack * cluster_size : cluster_size;
  const int half = (count / whole + 1) / 2 * whole;
  std::nth_element(begin, begin + half, begin + count,
                   [&](int a, int b) { return coordinates(widest, a) < coordinates(widest, b); });
  divide(coordinates, order, first, half);
  divide(coordinates, order, first + half, count - half);
}

void LoadHistory::store_box(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, int box,
                            LoadBoxes& boxes) const {
  for (int k = 0; k < rank(); ++k) {
    const std::size_t entry = at((box / pack * rank() + k) * pack + box % pack);
    boxes.centres[entry] = static_cast<float>((lower[k] + upper[k]) / 2);
    boxes.half_widths[entry] =
        static_cast<float>((upper[k] - lower[k]) / 2 * (1 + 1e-6) + 2e-7 * reach_[k]);
  }
}

void LoadHistory::store(const Eigen::MatrixXd& coordinates, const std::vector<int>& order) {
  const Eigen::Index rank = coordinates.rows();
  const auto sized = [&](int packs_of_boxes) {
    const std::vector<float> zeros(at(packs_of_boxes) * at(rank * pack));
    return LoadBoxes{zeros, zeros};
  };
  boxes_of_clusters_ = sized(packs());
  boxes_of_packs_ = sized((packs() + pack - 1) / pack);
  members_.resize(rank * clusters() * cluster_size);
  coarse_members_.resize(members_.size());
  middles_.resize(rank * clusters());
  member_instants_.resize(at(clusters()) * cluster_size);
  Eigen::VectorXd lower_of_pack, upper_of_pack;
  for (int cluster = 0; cluster < clusters(); ++cluster) {
    const int first = first_member_[cluster], last = first_member_[at(cluster) + 1] - 1;
    Eigen::VectorXd lower = coordinates.col(order[first]), upper = lower;
    for (int i = 0; i < cluster_size; ++i) {
      const int instant = order[std::min(first + i, last)];
      member_instants_[at(cluster) * cluster_size + at(i)] = instant;
      const auto place = coordinates.col(instant);
      lower = lower.cwiseMin(place);
      upper = upper.cwiseMax(place);
      for (Eigen::Index k = 0; k < rank; ++k) {
        const std::size_t entry = start(cluster) + at(k * cluster_size + i);
        members_[entry] = place[k];
      }
    }
    for (Eigen::Index k = 0; k < rank; ++k) {
      const double middle = (lower[k] + upper[k]) / 2;
      middles_[cluster * rank + k] = middle;
      for (int i = 0; i < cluster_size; ++i) {
        const std::size_t member = start(cluster) + at(k * cluster_size + i);
        coarse_members_[member] = static_cast<float>(members_[member] - middle);
      }
    }
    store_box(lower, upper, cluster, boxes_of_clusters_);
    const bool is_first = cluster % pack == 0;
    lower_of_pack = is_first ? lower : lower_of_pack.cwiseMin(lower).eval();
    upper_of_pack = is_first ? upper : upper_of_pack.cwiseMax(upper).eval();
    store_box(lower_of_pack, upper_of_pack, cluster / pack, boxes_of_packs_);
  }
}

}  // namespace blocklift::structure
