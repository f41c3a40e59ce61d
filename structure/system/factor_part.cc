#include "structure/system/factor_part.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "algebra/products.h"

namespace blocklift::structure {

namespace {

/// Lower triangle of L L'.
Eigen::MatrixXd square_of(const Eigen::MatrixXd& lower) {
  const auto size = static_cast<int>(lower.cols());
  Eigen::MatrixXd square = Eigen::MatrixXd::Zero(size, size);
  constexpr int block = 256;
  for (int first = 0; first < size; first += block) {
    const int columns = std::min(block, size - first), rows = size - first;
    algebra::add_row_products(lower.block(first, first, rows, columns),
                              square.bottomRightCorner(rows, rows));
  }
  return square;
}

}  // namespace

void PartOfMatrix::put_into(Packet& packet) const {
  const auto columns = static_cast<std::size_t>(matrix.cols());
  const auto entries = static_cast<std::size_t>(matrix.nonZeros());
  packet.reserve((columns + 4) * sizeof(long) + entries * (sizeof(long) + sizeof(double)) +
                 sizeof(inner));
  packet.put(inner);
  packet.put_array(matrix.outerIndexPtr(), columns + 1);
  packet.put_array(matrix.innerIndexPtr(), entries);
  packet.put_array(matrix.valuePtr(), entries);
}

PartOfMatrix PartOfMatrix::from(Packet& packet) {
  PartOfMatrix part;
  packet.take(part.inner);
  const std::size_t starts = packet.take_count();
  const long size = static_cast<long>(starts) - 1;
  part.matrix.resize(size, size);
  packet.take_values(part.matrix.outerIndexPtr(), starts);
  const std::size_t entries = packet.take_count();
  part.matrix.resizeNonZeros(static_cast<long>(entries));
  packet.take_values(part.matrix.innerIndexPtr(), entries);
  const std::size_t values = packet.take_count();
  if (values != entries) throw std::logic_error("a packet has more or fewer values than entries");
  packet.take_values(part.matrix.valuePtr(), values);
  return part;
}

FactorPart::FactorPart(PartOfMatrix part) {
  part_.inner = part.inner;
  part_.matrix.swap(part.matrix);
  if (part_.inner > 0) factor_ = std::make_unique<CholeskyFactor>(part_.matrix);
}

double FactorPart::bytes() const {
  const double boundary = part_.boundary();
  return (factor_ ? factor_->bytes() : 0) + 3 * 8 * boundary * boundary;
}

Eigen::MatrixXd FactorPart::eliminate() {
  if (!factor_) return {};
  SparseLower& matrix = part_.matrix;
  const Eigen::VectorXd held = matrix.diagonal();
  for (long column = part_.inner; column < matrix.cols(); ++column)
    matrix.valuePtr()[matrix.outerIndexPtr()[column]] *= 2;  // the diagonal comes first
  factor_->factorise(matrix, held);
  corner_ = factor_->corner(part_.inner);
  Eigen::MatrixXd added = square_of(corner_);
  for (long column = part_.inner; column < matrix.cols(); ++column)
    for (SparseLower::InnerIterator entry(matrix, column); entry; ++entry)
      added(entry.row() - part_.inner, column - part_.inner) -= entry.value();
  SparseLower(matrix.rows(), matrix.cols()).swap(matrix);  // only its size is asked for yet
  return added;
}

Eigen::MatrixXd FactorPart::forward(const Eigen::MatrixXd& loads) {
  if (!factor_) return {};
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(part_.matrix.cols(), loads.cols());
  all.topRows(part_.inner) = loads;
  reduced_ = factor_->solve_lower(std::move(all));
  return corner_.triangularView<Eigen::Lower>() * reduced_.bottomRows(part_.boundary());
}

Eigen::MatrixXd FactorPart::backward(const Eigen::MatrixXd& boundary) const {
  if (!factor_) return {};
  Eigen::MatrixXd all = reduced_;
  if (part_.boundary() > 0)
    all.bottomRows(part_.boundary()) =
        corner_.triangularView<Eigen::Lower>().transpose() * boundary;
  return factor_->solve_upper(std::move(all)).topRows(part_.inner);
}

}  // namespace blocklift::structure
