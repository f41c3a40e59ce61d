#pragma once

#include <span>
#include <string>

namespace blocklift::structure {

/// Base64 (RFC 4648) of bytes: of the arrays in VTK's files and in the report's page.
std::string base64(std::span<const unsigned char> bytes);

}  // namespace blocklift::structure
