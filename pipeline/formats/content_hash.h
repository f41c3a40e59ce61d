#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace blocklift::pipeline {

/// Fingerprint of what a computation depends on, to know its result again: two hashes of 64 bits by
/// the method of Fowler, Noll and Vo (FNV-1a), the second of the bytes turned over. The same
/// content in the same order gives the same text on every machine; it is no protection against
/// forgery.
class ContentHash {
 public:
  /// Numbers by their bits; 0 and -0 are the same.
  void add(double number);
  void add(std::span<const double> numbers);
  void add(std::int64_t number);
  /// Text with its length, so that "ab", "c" and "a", "bc" differ.
  void add(std::string_view text);

  /// 32 hexadecimal digits.
  std::string digits() const;

 private:
  void add_bytes(std::uint64_t bytes);

  std::uint64_t first_ = 0xcbf29ce484222325;
  std::uint64_t second_ = 0x84222325cbf29ce4;
};

}  // namespace blocklift::pipeline
