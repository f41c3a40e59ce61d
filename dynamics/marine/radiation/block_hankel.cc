#include "dynamics/marine/radiation/block_hankel.h"

#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <numeric>
#include <random>
#include <type_traits>

#include "dynamics/algebra/dense_algebra.h"
#include "parallel/threads.h"

namespace blocklift::dynamics {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Columns that go through a product together.
constexpr Index columns_at_once = 16;

/// Columns of the random subspace beyond those that are asked for, and products with the matrix
/// that turn it: eigenvalues close to the last one asked for mix otherwise.
constexpr Index more_columns = 20;
constexpr int iterations = 2;

std::mutex& planner() {
  static std::mutex mutex;  // FFTW plans in one thread at a time, and transforms in many
  return mutex;
}

/// Transforms of all modes' series at once: a matrix (modes x length) to (modes x frequencies) and
/// back, without dividing by the length.
class Transforms {
 public:
  Transforms(Index modes, Index length) : real_(modes, length), complex_(modes, length / 2 + 1) {
    const int n = static_cast<int>(length), m = static_cast<int>(modes);
    auto* spectrum = reinterpret_cast<fftw_complex*>(complex_.data());
    const std::lock_guard lock(planner());
    forward_.reset(fftw_plan_many_dft_r2c(1, &n, m, real_.data(), nullptr, m, 1, spectrum, nullptr,
                                          m, 1, FFTW_ESTIMATE));
    backward_.reset(fftw_plan_many_dft_c2r(1, &n, m, spectrum, nullptr, m, 1, real_.data(), nullptr,
                                           m, 1, FFTW_ESTIMATE));
  }

  MatrixXd& real() { return real_; }
  MatrixXcd& spectrum() { return complex_; }
  void forward() { fftw_execute(forward_.get()); }
  void backward() { fftw_execute(backward_.get()); }

 private:
  struct Destroy {
    void operator()(fftw_plan plan) const {
      const std::lock_guard lock(planner());
      fftw_destroy_plan(plan);
    }
  };
  using Plan = std::unique_ptr<std::remove_pointer_t<fftw_plan>, Destroy>;

  MatrixXd real_;
  MatrixXcd complex_;
  Plan forward_, backward_;
};

/// The least length from `least` on that has no other prime factors than 2, 3 and 5.
Index quick_length(Index least) {
  for (Index length = least;; ++length) {
    Index rest = length;
    for (const Index prime : {2, 3, 5}) {
      while (rest % prime == 0) rest /= prime;
    }
    if (rest == 1) return length;
  }
}

MatrixXd random_columns(Index rows, Index columns) {
  std::mt19937_64 engine(1);
  MatrixXd random(rows, columns);
  for (double& value : random.reshaped()) {
    value = static_cast<double>(engine() >> 11) * 0x1p-53 - 0.5;
  }
  return random;
}

}  // namespace

BlockHankel::BlockHankel(const std::vector<MatrixXd>& K)
    : samples_(static_cast<Index>(K.size())),
      modes_(K[0].rows()),
      length_(quick_length(2 * samples_)),
      transform_(static_cast<std::size_t>(length_ / 2 + 1), MatrixXcd(modes_, modes_)) {
  Transforms transforms(modes_, length_);
  for (Index column = 0; column < modes_; ++column) {
    transforms.real().setZero();
    for (Index k = 0; k < samples_; ++k) transforms.real().col(k) = K[k].col(column);
    transforms.forward();
    for (Index f = 0; f < length_ / 2 + 1; ++f) {
      transform_[f].col(column) = transforms.spectrum().col(f) / static_cast<double>(length_);
    }
  }
}

MatrixXd BlockHankel::multiply(const MatrixXd& columns, Index shift) const {
  MatrixXd product(columns.rows(), columns.cols());
  const Index batches = (columns.cols() + columns_at_once - 1) / columns_at_once;
  const Index frequencies = length_ / 2 + 1;
  parallel::for_each(static_cast<int>(batches), 0, [&](int batch) {
    const Index first = batch * columns_at_once;
    const Index count = std::min(columns_at_once, columns.cols() - first);
    Transforms transforms(modes_, length_);
    // Of one column each, side by side at a frequency.
    MatrixXcd spectra(modes_, count * frequencies);
    for (Index c = 0; c < count; ++c) {
      transforms.real().setZero();
      // The block X_j stands at -j: the convolution's term at i is the sum of K_(i+j) X_j.
      const auto blocks = columns.col(first + c).reshaped(modes_, samples_);
      transforms.real().col(0) = blocks.col(0);
      transforms.real().rightCols(samples_ - 1) =
          blocks.rightCols(samples_ - 1).rowwise().reverse();
      transforms.forward();
      for (Index f = 0; f < frequencies; ++f) {
        spectra.col(f * count + c) = transforms.spectrum().col(f);
      }
    }
    MatrixXcd turned(modes_, count);
    for (Index f = 0; f < frequencies; ++f) {
      auto at = spectra.middleCols(f * count, count);
      turned.noalias() = transform_[f] * at;
      at = turned;
    }
    for (Index c = 0; c < count; ++c) {
      for (Index f = 0; f < frequencies; ++f) {
        transforms.spectrum().col(f) = spectra.col(f * count + c);
      }
      transforms.backward();
      auto blocks = product.col(first + c).reshaped(modes_, samples_);
      blocks.setZero();
      blocks.leftCols(samples_ - shift) = transforms.real().middleCols(shift, samples_ - shift);
    }
  });
  return product;
}

LeadingEigenpairs find_leading_eigenpairs(const BlockHankel& hankel, Index count) {
  const Index size = hankel.size();
  count = std::min(count, size);
  MatrixXd basis;
  if (count + more_columns >= size) {
    basis = MatrixXd::Identity(size, size);
  } else {
    basis = hankel.multiply(random_columns(size, count + more_columns), 0);
    orthonormalise(basis);
    for (int k = 0; k < iterations; ++k) {
      basis = hankel.multiply(basis, 0);
      orthonormalise(basis);
    }
  }
  MatrixXd turned = basis.transpose() * hankel.multiply(basis, 0);
  const VectorXd values = decompose_symmetric(turned);
  std::vector<Index> order(static_cast<std::size_t>(values.size()));
  std::iota(order.begin(), order.end(), Index{0});
  std::sort(order.begin(), order.end(),
            [&](Index a, Index b) { return std::abs(values[a]) > std::abs(values[b]); });
  order.resize(static_cast<std::size_t>(count));
  const MatrixXd leading = turned(Eigen::all, order);
  LeadingEigenpairs pairs{values(order), MatrixXd(size, count)};
  multiply(1.0, basis, leading, 0.0, pairs.vectors);
  return pairs;
}

}  // namespace blocklift::dynamics
