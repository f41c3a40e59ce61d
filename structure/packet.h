#pragma once

#include <cstddef>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace blocklift::structure {

/// Values one after another, to be sent to another process of the same program; they are taken in
/// the order in which they were put.
class Packet {
 public:
  Packet() = default;
  explicit Packet(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {}
  const std::vector<std::byte>& bytes() const { return bytes_; }

  template <typename Plain>
  void put(const Plain& value) {
    static_assert(std::is_trivially_copyable_v<Plain>);
    append(&value, sizeof(Plain));
  }
  template <typename Plain>
  void put(const std::vector<Plain>& values) {
    put_array(values.data(), values.size());
  }
  void put(const std::string& text) { put_array(text.data(), text.size()); }
  template <typename Number, int rows, int columns>
  void put(const Eigen::Matrix<Number, rows, columns>& matrix) {
    put(matrix.rows());
    put_array(matrix.data(), static_cast<std::size_t>(matrix.size()));
  }

  template <typename Plain>
  void take(Plain& value) {
    static_assert(std::is_trivially_copyable_v<Plain>);
    extract(&value, sizeof(Plain));
  }
  template <typename Plain>
  void take(std::vector<Plain>& values) {
    values.resize(take_count());
    extract(values.data(), values.size() * sizeof(Plain));
  }
  void take(std::string& text) {
    text.resize(take_count());
    extract(text.data(), text.size());
  }
  template <typename Number, int rows, int columns>
  void take(Eigen::Matrix<Number, rows, columns>& matrix) {
    Eigen::Index height = 0;
    take(height);
    const auto size = static_cast<Eigen::Index>(take_count());
    // Without rows: a vector keeps its one column.
    matrix.resize(height, height > 0 ? size / height : matrix.cols());
    extract(matrix.data(), static_cast<std::size_t>(size) * sizeof(Number));
  }

  /// How many there are, and the values themselves.
  template <typename Plain>
  void put_array(const Plain* values, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<Plain>);
    put(count);
    append(values, count * sizeof(Plain));
  }
  /// The same in two steps: between them there is place to be made for so many.
  std::size_t take_count() {
    std::size_t count = 0;
    take(count);
    return count;
  }
  template <typename Plain>
  void take_values(Plain* values, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<Plain>);
    extract(values, count * sizeof(Plain));
  }
  /// Makes place for so many bytes more, so that they are put without moving what is there.
  void reserve(std::size_t size) { bytes_.reserve(bytes_.size() + size); }

 private:
  void append(const void* data, std::size_t size);
  void extract(void* data, std::size_t size);

  std::vector<std::byte> bytes_;
  std::size_t taken_ = 0;
};

}  // namespace blocklift::structure
