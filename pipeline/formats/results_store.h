#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "pipeline/formats/atomic_file.h"

/// Reading and writing of results.h5, an HDF5 file. This knows names, numbers and units and nothing
/// of lifts; which datasets a result has is said in pipeline/formats/results/results_layout.h.
///
/// Every dataset carries the attributes `units` (in UDUNITS spelling, "1" for pure numbers and ""
/// for text) and `description`. Missing parent groups are made. Series beyond a few kilobytes are
/// chunked, shuffled and deflated. Matrices lie row by row, so that h5py shows the same indices.
///
/// HDF5 serves one thread at a time in the whole process: neither do these classes more.
namespace blocklift::pipeline {

/// What went wrong in a results file; the text names the file and the dataset.
class ResultsError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What the numbers of a dataset are.
struct Meaning {
  std::string units;        ///< "N", "m", "Pa", "s", "1" for pure numbers, "" for text
  std::string description;  ///< a sentence with frame and point where they matter
};

/// Row-major view of a matrix: what HDF5 and numpy call [rows, columns].
using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The values of a vector, as datasets are written.
template <class Scalar>
std::span<const Scalar> span_of(const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>& values) {
  return {values.data(), static_cast<std::size_t>(values.size())};
}

/// Writes a new results file. It appears under its name with finish(), whole; if that is never
/// reached, nothing appears and an older file stays as it was.
class ResultsWriter {
 public:
  /// @throws ResultsError if the file cannot be made.
  explicit ResultsWriter(const std::filesystem::path& path);
  ~ResultsWriter();
  ResultsWriter(const ResultsWriter&) = delete;
  ResultsWriter& operator=(const ResultsWriter&) = delete;

  /// Makes a group (and those above it); one that exists is left as it is.
  void make_group(std::string_view group);

  /// Attribute of a group (made where missing) or of a dataset. A second value replaces the first.
  void write_attribute(std::string_view object, std::string_view name, std::string_view value);
  void write_attribute(std::string_view object, std::string_view name, double value);

  /// Numbers in a row, [n]. @throws ResultsError if the dataset exists (true for all below).
  void write(std::string_view dataset, std::span<const double> values, const Meaning& meaning);
  void write(std::string_view dataset, std::span<const std::int32_t> values,
             const Meaning& meaning);
  /// [rows x columns]; any Eigen matrix of doubles is taken, a column-major one by a copy.
  void write_matrix(std::string_view dataset, const Eigen::Ref<const RowMajorMatrix>& values,
                    const Meaning& meaning);
  /// [n x 3]
  void write_points(std::string_view dataset, std::span<const Eigen::Vector3d> points,
                    const Meaning& meaning);
  /// [rows x columns] of indices, row by row. @throws ResultsError unless columns divides the
  /// count.
  void write_indices(std::string_view dataset, std::span<const std::int32_t> values,
                     std::size_t columns, const Meaning& meaning);
  /// Numbers of any shape, the last index running fastest. @throws ResultsError unless the shape
  /// holds as many numbers as are given.
  void write_array(std::string_view dataset, std::span<const double> values,
                   std::span<const std::size_t> shape, const Meaning& meaning);
  /// One number without an index.
  void write_number(std::string_view dataset, double value, const Meaning& meaning);
  /// Texts in a row, [n], UTF-8.
  void write_texts(std::string_view dataset, std::span<const std::string> texts,
                   std::string_view description);
  /// One text, UTF-8.
  void write_text(std::string_view dataset, std::string_view text, std::string_view description);

  /// Closes the file and renames it into place. To be called once, last.
  void finish();

 private:
  class File;
  AtomicFile target_;
  std::unique_ptr<File> file_;
};

/// Numbers with their shape: {} a single one, {n} a row, {n, m} a matrix, row by row.
template <typename Number>
struct Array {
  std::vector<std::size_t> shape;
  std::vector<Number> values;

  std::size_t rows() const { return shape.empty() ? 1 : shape[0]; }
  std::size_t columns() const { return shape.size() < 2 ? 1 : shape[1]; }
  Number operator()(std::size_t row, std::size_t column = 0) const {
    return values[row * columns() + column];
  }
};

/// Reads a results file. Every function throws ResultsError when what it asks for is not there,
/// naming the file, the path asked for and what is there instead.
class ResultsReader {
 public:
  explicit ResultsReader(const std::filesystem::path& path);
  ~ResultsReader();
  ResultsReader(const ResultsReader&) = delete;
  ResultsReader& operator=(const ResultsReader&) = delete;

  /// Whether a group or dataset of this path exists.
  /// @throws ResultsError where a group on the way is damaged.
  bool has(std::string_view object) const;
  /// Names of groups and datasets directly in a group, in the order of their making.
  std::vector<std::string> children(std::string_view group) const;

  bool has_attribute(std::string_view object, std::string_view name) const;
  std::string read_text_attribute(std::string_view object, std::string_view name) const;
  double read_number_attribute(std::string_view object, std::string_view name) const;
  /// The attributes `units` and `description` of a dataset.
  Meaning read_meaning(std::string_view dataset) const;

  /// Any numerical dataset, converted to double.
  Array<double> read(std::string_view dataset) const;
  /// Any integer dataset.
  Array<std::int32_t> read_indices(std::string_view dataset) const;
  std::vector<std::string> read_texts(std::string_view dataset) const;
  std::string read_text(std::string_view dataset) const;

 private:
  class File;
  std::unique_ptr<File> file_;
};

}  // namespace blocklift::pipeline
