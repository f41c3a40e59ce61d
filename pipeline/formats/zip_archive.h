#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace blocklift::pipeline {

/// Files in one, as programs for documents and archives read them (ZIP, PKWARE APPNOTE 6.3: local
/// headers, central directory). Nothing is compressed and every file has the same date, so that the
/// same content gives the same bytes.
class ZipArchive {
 public:
  /// @param name with slashes, no two alike. @throws std::length_error beyond 4 GB in all, or
  ///   65,535
  /// files.
  void add(const std::string& name, std::string_view content);
  /// The whole archive.
  std::string finish() const;

 private:
  std::string files_;      ///< local headers with contents
  std::string directory_;  ///< central directory
  std::uint16_t count_ = 0;
};

/// CRC-32 of ISO 3309, as ZIP has it: of "123456789" 0xCBF43926.
std::uint32_t crc_32(std::string_view content);

}  // namespace blocklift::pipeline
