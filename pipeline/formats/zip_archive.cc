#include "pipeline/formats/zip_archive.h"

#include <array>
#include <limits>
#include <stdexcept>

namespace blocklift::pipeline {
namespace {

constexpr std::uint32_t local_header = 0x04034b50;
constexpr std::uint32_t directory_header = 0x02014b50;
constexpr std::uint32_t end_of_directory = 0x06054b50;
constexpr std::uint16_t version_needed = 20;
constexpr std::uint16_t names_are_utf_8 = 1U << 11U;
/// 1 January 1980, the first day that the format knows.
constexpr std::uint16_t date = (1U << 5U) | 1U;

/// Little-endian numbers at the end of a text.
void put(std::string& text, std::uint32_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) text += static_cast<char>((value >> (8 * i)) & 0xffU);
}

/// What local header and directory have in common.
void put_entry(std::string& text, const std::string& name, std::string_view content,
               std::uint32_t crc) {
  const auto size = static_cast<std::uint32_t>(content.size());
  put(text, version_needed, 2);
  put(text, names_are_utf_8, 2);
  put(text, 0, 2);  // stored as it is
  put(text, 0, 2);  // midnight
  put(text, date, 2);
  put(text, crc, 4);
  put(text, size, 4);
  put(text, size, 4);
  put(text, static_cast<std::uint32_t>(name.size()), 2);
  put(text, 0, 2);  // no extra field
}

std::array<std::uint32_t, 256> crc_table() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t i = 0; i < table.size(); ++i) {
    std::uint32_t value = i;
    for (int bit = 0; bit < 8; ++bit)
      value = (value & 1U) != 0 ? (value >> 1U) ^ 0xEDB88320U : value >> 1U;
    table[i] = value;
  }
  return table;
}

}  // namespace

std::uint32_t crc_32(std::string_view content) {
  static const std::array<std::uint32_t, 256> table = crc_table();
  std::uint32_t crc = 0xffffffffU;
  for (const char c : content)
    crc = table[(crc ^ static_cast<unsigned char>(c)) & 0xffU] ^ (crc >> 8U);
  return crc ^ 0xffffffffU;
}

void ZipArchive::add(const std::string& name, std::string_view content) {
  constexpr std::size_t most = std::numeric_limits<std::uint32_t>::max();
  if (count_ == std::numeric_limits<std::uint16_t>::max() || name.size() > 0xffffU ||
      files_.size() + directory_.size() + content.size() + 2 * name.size() + 200 > most)
    throw std::length_error("a ZIP archive cannot hold " + name + " as well");
  const auto offset = static_cast<std::uint32_t>(files_.size());
  const std::uint32_t crc = crc_32(content);
  put(files_, local_header, 4);
  put_entry(files_, name, content, crc);
  files_ += name;
  files_ += content;
  put(directory_, directory_header, 4);
  put(directory_, version_needed, 2);
  put_entry(directory_, name, content, crc);
  put(directory_, 0, 2);  // no comment
  put(directory_, 0, 2);  // on the first disk
  put(directory_, 0, 2);  // no attributes
  put(directory_, 0, 4);
  put(directory_, offset, 4);
  directory_ += name;
  ++count_;
}

std::string ZipArchive::finish() const {
  std::string archive = files_ + directory_;
  put(archive, end_of_directory, 4);
  put(archive, 0, 2);  // one disk
  put(archive, 0, 2);
  put(archive, count_, 2);
  put(archive, count_, 2);
  put(archive, static_cast<std::uint32_t>(directory_.size()), 4);
  put(archive, static_cast<std::uint32_t>(files_.size()), 4);
  put(archive, 0, 2);  // no comment
  return archive;
}

}  // namespace blocklift::pipeline
