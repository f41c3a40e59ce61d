#include "dynamics/multibody/mass_factor.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "dynamics/errors.h"

namespace blocklift::dynamics {
namespace {

// A free velocity counts as unresisted below this part of the inertia of all that it moves.
constexpr double smallest_pivot = 1e-13;

[[noreturn]] void report_singular(const Mechanism& mechanism, int k, double D) {
  const std::string name = mechanism.velocity_name(k);
  if (!std::isfinite(D)) {
    throw SimulationError("body " + name + ": the state or a mass is not finite");
  }
  throw SimulationError("body " + name +
                        ": nothing resists this motion in the present configuration (the inertia "
                        "along it is zero once the other joints give way); give the body or what "
                        "it carries mass or inertia about that axis, or drive the joint");
}

// Indices of the free velocities from `last` (an index within v) of a body to the world.
std::vector<int> path_to_world(const Mechanism& mechanism, const std::vector<int>& free_index,
                               BodyIndex body, int last) {
  std::vector<int> path;
  for (BodyIndex i = body; i != world_index;) {
    const Body& link = mechanism.body(i);
    for (int j = std::min(last, link.v_offset + link.nv() - 1); j >= link.v_offset; --j) {
      const int index = free_index[j];
      if (index >= 0) path.push_back(index);
    }
    last = mechanism.nv();
    i = link.carrier;
  }
  return path;
}

}  // namespace

MassFactor::MassFactor(const Mechanism& mechanism, const std::vector<BodyIndex>& tied) {
  std::vector<int> free_index(static_cast<std::size_t>(mechanism.nv()), -1);
  int next = 0;
  for (const int k : mechanism.free_velocities()) free_index[k] = next++;
  std::vector<int> together;
  for (const BodyIndex body : tied) {
    const std::vector<int> path = path_to_world(mechanism, free_index, body, mechanism.nv());
    together.insert(together.end(), path.begin(), path.end());
  }
  std::sort(together.begin(), together.end());
  together.erase(std::unique(together.begin(), together.end()), together.end());
  for (const int k : mechanism.free_velocities()) {
    // From k towards the world, then turned round; from the first of those tied on, all of them. An
    // elastic mode stands alone.
    std::vector<int> chain =
        mechanism.is_elastic_mode(k)
            ? std::vector<int>{free_index[k]}
            : path_to_world(mechanism, free_index, mechanism.body_of_velocity(k), k);
    const auto first_tied = std::find_if(chain.begin(), chain.end(), [&](int i) {
      return std::binary_search(together.begin(), together.end(), i);
    });
    if (first_tied != chain.end()) {
      const auto end = std::upper_bound(together.begin(), together.end(), *first_tied);
      chain.erase(first_tied, chain.end());
      chain.insert(chain.end(), std::make_reverse_iterator(end), together.rend());
    }
    depth_.push_back(chain.size() - 1);
    offset_.push_back(ancestors_.size());
    ancestors_.insert(ancestors_.end(), chain.rbegin(), chain.rend());
  }
  values_.assign(ancestors_.size(), not_a_number);
}

void MassFactor::factorise(const Mechanism& mechanism,
                           const Eigen::Ref<const Eigen::MatrixXd>& mass_matrix) {
  const std::vector<int>& free = mechanism.free_velocities();
  for (std::size_t i = 0; i < depth_.size(); ++i) {
    double* values = row(i);
    const int* chain = ancestors(i);
    for (std::size_t d = 0; d <= depth_[i]; ++d) {
      values[d] = mass_matrix(free[chain[d]], free[i]);
    }
  }
  for (std::size_t k = depth_.size(); k-- > 0;) {
    double* values = row(k);
    const int* chain = ancestors(k);
    const std::size_t depth = depth_[k];
    const double D = values[depth];
    if (!(D > smallest_pivot * mass_matrix(free[k], free[k])))
      report_singular(mechanism, free[k], D);
    const double root = std::sqrt(D);
    for (std::size_t d = 0; d < depth; ++d) values[d] /= root;
    values[depth] = root;
    for (std::size_t d = 0; d < depth; ++d) {
      double* outer = row(static_cast<std::size_t>(chain[d]));
      const double factor = values[d];
      for (std::size_t j = 0; j <= d; ++j) outer[j] -= factor * values[j];
    }
  }
}

void MassFactor::solve_transposed(VectorRef x) const {
  for (std::size_t i = depth_.size(); i-- > 0;) {
    const double* values = row(i);
    const int* chain = ancestors(i);
    const double value = x[i] /= values[depth_[i]];
    for (std::size_t d = 0; d < depth_[i]; ++d) x[chain[d]] -= values[d] * value;
  }
}

void MassFactor::solve(VectorRef x) const {
  for (std::size_t i = 0; i < depth_.size(); ++i) {
    const double* values = row(i);
    const int* chain = ancestors(i);
    double value = x[i];
    for (std::size_t d = 0; d < depth_[i]; ++d) value -= values[d] * x[chain[d]];
    x[i] = value / values[depth_[i]];
  }
}

void MassFactor::solve_rows(Eigen::Ref<Eigen::MatrixXd> rows) const {
  for (std::size_t i = depth_.size(); i-- > 0;) {
    const double* values = row(i);
    const int* chain = ancestors(i);
    auto column = rows.col(i);
    column /= values[depth_[i]];
    for (std::size_t d = 0; d < depth_[i]; ++d) rows.col(chain[d]) -= values[d] * column;
  }
}

}  // namespace blocklift::dynamics
