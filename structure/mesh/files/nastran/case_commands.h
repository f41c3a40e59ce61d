#pragma once

#include <string>
#include <string_view>

namespace blocklift::structure {

/// Is this a command of case control, whole or by its first four letters or more?
/// Commands of MSC, Siemens and Altair (OptiStruct), as their reference guides list them.
bool is_case_command(std::string_view name);

/// The command that names loads, supports or subcases and that a mistyped name most probably
/// means; empty if none is near.
std::string meant_case_command(std::string_view name);

}  // namespace blocklift::structure
