#pragma once

#include <complex>
#include <cstdint>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <Eigen/Core>

namespace blocklift::pipeline {

/// Bytes of values that a later run of the same program on the same machine takes up again, bit for
/// bit. Writer and reader are given the same values in the same order:
///
///     template <class Values, class Part>
///     void pass(Values& values, Part& part) { values(part.name, part.time, part.positions); }
///
/// is one function for both. Values are numbers, enumerations, texts, matrices, what has a `pass`
/// in this namespace, and vectors and optionals of these.
class KeptValuesWriter {
 public:
  static constexpr bool reads = false;

  template <class... Value>
  void operator()(const Value&... values) {
    (pass_value(*this, values), ...);
  }
  void bytes(const void* from, std::size_t count) {
    text_.append(static_cast<const char*>(from), count);
  }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

class KeptValuesReader {
 public:
  static constexpr bool reads = true;

  /// The bytes must outlive this object.
  explicit KeptValuesReader(std::string_view bytes) : rest_(bytes) {}

  /// @throws std::runtime_error if the bytes end before.
  template <class... Value>
  void operator()(Value&... values) {
    (pass_value(*this, values), ...);
  }
  void bytes(void* to, std::size_t count) {
    const void* from = in_place(count);
    if (count > 0) std::memcpy(to, from, count);
  }
  /// The next bytes where they are, not copied.
  const void* in_place(std::size_t count) {
    if (count > rest_.size()) throw std::runtime_error("kept values end early");
    const void* begin = rest_.data();
    rest_.remove_prefix(count);
    return begin;
  }
  /// A number of things, of which each takes a byte at least.
  std::size_t count() {
    std::uint64_t number = 0;
    bytes(&number, sizeof number);
    if (number > rest_.size()) throw std::runtime_error("kept values end early");
    return static_cast<std::size_t>(number);
  }

 private:
  std::string_view rest_;
};

namespace kept {

template <class T>
struct IsVector : std::false_type {};
template <class T>
struct IsVector<std::vector<T>> : std::true_type {};
template <class T>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {};
template <class T>
struct IsComplex : std::false_type {};
template <class T>
struct IsComplex<std::complex<T>> : std::true_type {};

template <class T>
constexpr bool is_plain = std::is_arithmetic_v<T> || std::is_enum_v<T> || IsComplex<T>::value;
template <class T>
constexpr bool is_matrix = std::is_base_of_v<Eigen::PlainObjectBase<T>, T>;

template <class Values, class Container>
void pass_count(Values& values, Container& container) {
  if constexpr (Values::reads) {
    container.resize(values.count());
  } else {
    const std::uint64_t count = container.size();
    values.bytes(&count, sizeof count);
  }
}

template <class Values, class Matrix>
void pass_matrix(Values& values, Matrix& matrix) {
  std::int64_t rows = matrix.rows(), columns = matrix.cols();
  values.bytes(&rows, sizeof rows);
  values.bytes(&columns, sizeof columns);
  if constexpr (Values::reads) matrix.resize(rows, columns);
  values.bytes(matrix.data(), sizeof(*matrix.data()) * static_cast<std::size_t>(matrix.size()));
}

template <class Values, class Optional>
void pass_optional(Values& values, Optional& optional) {
  bool is_there = optional.has_value();
  values.bytes(&is_there, sizeof is_there);
  if constexpr (Values::reads) {
    optional.reset();
    if (is_there) optional.emplace();
  }
  if (is_there) values(*optional);
}

}  // namespace kept

/// One value, by its kind.
template <class Values, class Value>
void pass_value(Values& values, Value& value) {
  using Plain = std::remove_const_t<Value>;
  if constexpr (kept::is_plain<Plain>) {
    values.bytes(&value, sizeof value);
  } else if constexpr (std::is_same_v<Plain, std::string>) {
    kept::pass_count(values, value);
    values.bytes(value.data(), value.size());
  } else if constexpr (kept::IsVector<Plain>::value) {
    kept::pass_count(values, value);
    for (auto& element : value) values(element);
  } else if constexpr (kept::IsOptional<Plain>::value) {
    kept::pass_optional(values, value);
  } else if constexpr (std::is_class_v<Plain> && kept::is_matrix<Plain>) {
    kept::pass_matrix(values, value);
  } else {
    pass(values, value);
  }
}

}  // namespace blocklift::pipeline
