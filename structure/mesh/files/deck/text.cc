#include "structure/mesh/files/deck/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <system_error>

#include <fmt/format.h>

#include "structure/outside_files.h"

namespace blocklift::structure {

namespace {

constexpr char raised(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}
constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::optional<double> plain_real(const char* first, const char* last) {
  double value = 0;
  const auto [end, error] = std::from_chars(first, last, value);
  if (error != std::errc() || end != last || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string upper(std::string_view text) {
  std::string raised_text(text);
  for (char& c : raised_text) c = raised(c);
  return raised_text;
}

bool is_same(std::string_view a, std::string_view b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(),
                                            [](char c, char d) { return raised(c) == raised(d); });
}

std::optional<long> to_integer(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  long value = 0;
  const char* last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value);
  if (text.empty() || error != std::errc() || end != last) return std::nullopt;
  return value;
}

std::optional<double> to_real(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  if (text.empty()) return std::nullopt;
  // Words that stand for infinity and the like are no numbers here.
  const char second = text.size() > 1 ? text[1] : ' ';
  const bool begins = is_digit(text[0]) ||
                      ((text[0] == '.' || text[0] == '-') && (is_digit(second) || second == '.'));
  if (!begins) return std::nullopt;
  if (const auto value = plain_real(text.data(), text.data() + text.size())) return value;
  std::array<char, 64> number{};
  if (text.size() + 2 > number.size()) return std::nullopt;
  std::size_t length = 0;
  bool has_exponent = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = raised(text[i]);
    if (c == 'D' || c == 'E') {
      if (has_exponent) return std::nullopt;
      has_exponent = true;
      number[length++] = 'e';
      if (i + 1 < text.size() && text[i + 1] == '+') ++i;
    } else if ((c == '+' || c == '-') && i > 0 && number[length - 1] != 'e') {
      if (has_exponent) return std::nullopt;
      has_exponent = true;
      number[length++] = 'e';
      if (c == '-') number[length++] = '-';
    } else {
      number[length++] = c;
    }
  }
  return plain_real(number.data(), number.data() + length);
}

const DeckFiles::File& DeckFiles::open(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::path canonical = std::filesystem::canonical(path, error);
  if (error || !std::filesystem::is_regular_file(canonical))
    throw DeckError({fmt::format("{}: error: the file cannot be read", path.string())});
  folder_ = canonical.parent_path();
  try {
    return load(path, canonical);
  } catch (const CardError& problem) {
    throw DeckError({fmt::format("{}: error: {}", path.string(), problem.text)});
  }
}

const DeckFiles::File& DeckFiles::open_included(const std::filesystem::path& path,
                                                const File& from) {
  std::error_code error;
  std::filesystem::path wanted = path;
  if (path.is_relative()) {
    wanted = from.path.parent_path() / path;
    if (!std::filesystem::exists(wanted, error)) wanted = folder_ / path;
  }
  const std::filesystem::path canonical = std::filesystem::canonical(wanted, error);
  if (error || !std::filesystem::is_regular_file(canonical))
    throw CardError{fmt::format("the file \"{}\" to be included cannot be read", path.string())};
  if (!are_files_outside_allowed() && !leads_into(canonical, {folder_}))
    throw CardError{fmt::format(
        "\"{}\" lies outside the deck's folder; only files in it or below are included, "
        "unless --allow-outside, or {}=1 in the environment, says otherwise",
        path.string(), allow_outside_variable)};
  if (std::find(reading_.begin(), reading_.end(), canonical) != reading_.end())
    throw CardError{fmt::format("\"{}\" includes itself", path.string())};
  return load(wanted, canonical);
}

std::vector<std::filesystem::path> DeckFiles::paths() const {
  std::vector<std::filesystem::path> paths;
  for (const auto& file : files_) paths.push_back(file->path);
  return paths;
}

const DeckFiles::File& DeckFiles::load(const std::filesystem::path& path,
                                       const std::filesystem::path& canonical) {
  std::ifstream stream(canonical, std::ios::binary | std::ios::ate);
  if (!stream) throw CardError{fmt::format("the file \"{}\" cannot be read", path.string())};
  auto text = std::make_unique<std::string>();
  text->resize(static_cast<std::size_t>(stream.tellg()));
  stream.seekg(0);
  stream.read(text->data(), static_cast<std::streamsize>(text->size()));
  if (text->find('\0') != std::string::npos)
    throw CardError{fmt::format("\"{}\" is no text: it has bytes of zero", path.string())};
  // Lines of old Macintoshes end in a return alone.
  if (text->find('\n') == std::string::npos) std::replace(text->begin(), text->end(), '\r', '\n');
  auto file = std::make_unique<File>();
  file->number = log_.add_file(path.string());
  file->path = path;
  std::string_view all = *text;
  constexpr std::string_view byte_order_mark =
      "\xEF\xBB\xBF";  // of UTF-8, as Windows' editors write
  if (all.starts_with(byte_order_mark)) all.remove_prefix(byte_order_mark.size());
  file->is_ended = all.empty() || all.back() == '\n';
  for (std::size_t begin = 0; begin < all.size();) {
    std::size_t end = all.find('\n', begin);
    if (end == std::string_view::npos) end = all.size();
    std::string_view line = all.substr(begin, end - begin);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    file->lines.push_back(line);
    begin = end + 1;
  }
  reading_.push_back(canonical);
  texts_.push_back(std::move(text));
  files_.push_back(std::move(file));
  return *files_.back();
}

}  // namespace blocklift::structure
