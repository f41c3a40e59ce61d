#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

struct XXH3_state_s;

namespace blocklift::pipeline {

/// Fingerprint of what a computation depends on, to know its result again: XXH3 of 128 bits. The
/// same content in the same order gives the same text on every machine; it is no protection against
/// forgery.
class ContentHash {
 public:
  ContentHash();

  /// Numbers by their bits; 0 and -0 are the same.
  void add(double number);
  void add(std::span<const double> numbers);
  void add(std::int64_t number);
  /// Text with its length, so that "ab", "c" and "a", "bc" differ.
  void add(std::string_view text);

  /// 32 hexadecimal digits.
  std::string digits() const;

 private:
  struct Free {
    void operator()(XXH3_state_s* state) const;
  };
  std::unique_ptr<XXH3_state_s, Free> state_;
};

/// Fingerprint of the bytes of files in their order, not of their names.
/// @throws std::runtime_error with the file's name and the system's reason.
std::string hash_of_files(const std::vector<std::filesystem::path>& files);

}  // namespace blocklift::pipeline
