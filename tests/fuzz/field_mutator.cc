// Changes decks and tables of numbers by their lines and fields. Half of the changes are the
// fuzzer's own, of bytes.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <string_view>
#include <vector>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t largest);

namespace {

using Random = std::minstd_rand;

std::size_t below(Random& random, std::size_t count) {
  return count == 0 ? 0 : static_cast<std::size_t>(random()) % count;
}

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
    lines.emplace_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  return lines;
}

/// Where a field of a line begins, and its length: fields are parted by commas, blanks and "=".
std::pair<std::size_t, std::size_t> some_field(const std::string& line, Random& random) {
  constexpr const char* between = ", \t\n=";
  std::vector<std::pair<std::size_t, std::size_t>> fields;
  for (std::size_t at = line.find_first_not_of(between); at != std::string::npos;) {
    const std::size_t end = std::min(line.find_first_of(between, at), line.size());
    fields.emplace_back(at, end - at);
    at = line.find_first_not_of(between, end);
  }
  return fields.empty() ? std::pair<std::size_t, std::size_t>{0, 0}
                        : fields[below(random, fields.size())];
}

constexpr std::array<const char*, 24> extremes = {"0",
                                                  "-1",
                                                  "1",
                                                  "2",
                                                  "2147483647",
                                                  "2147483648",
                                                  "-2147483648",
                                                  "1e300",
                                                  "-1e300",
                                                  "1e-300",
                                                  "nan",
                                                  "inf",
                                                  "-inf",
                                                  "1.5-3",
                                                  "",
                                                  "9223372036854775807",
                                                  "4294967296",
                                                  "1e9",
                                                  "0.0",
                                                  "3.7e38",
                                                  "*",
                                                  "$",
                                                  "GENERATE",
                                                  "THRU"};

void change(std::vector<std::string>& lines, Random& random) {
  if (lines.empty()) lines.emplace_back("\n");
  const std::size_t at = below(random, lines.size()), other = below(random, lines.size());
  std::string& line = lines[at];
  const auto [begin, length] = some_field(line, random);
  switch (below(random, 7)) {
    case 0:
      lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(at));
      return;
    case 1: {
      const std::string repeated = line;
      lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(other), repeated);
      return;
    }
    case 2:
      std::swap(lines[at], lines[other]);
      return;
    case 3: {
      // A field of another line in this one's place.
      const auto [from, count] = some_field(lines[other], random);
      const std::string field = lines[other].substr(from, count);
      line.replace(begin, length, field);
      return;
    }
    case 4:
      line.erase(begin, length);
      return;
    default:
      line.replace(begin, length, extremes[below(random, extremes.size())]);
  }
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t largest, unsigned int seed) {
  Random random(seed);
  if (below(random, 2) == 0) return LLVMFuzzerMutate(data, size, largest);
  std::vector<std::string> lines = lines_of({reinterpret_cast<const char*>(data), size});
  for (std::size_t i = 0; i <= below(random, 3); ++i) change(lines, random);
  std::string text;
  for (const std::string& line : lines) text += line;
  const std::size_t length = std::min(text.size(), largest);
  std::memcpy(data, text.data(), length);
  return length;
}
