#pragma once

#include <string>
#include <vector>

#include "pipeline/declaration/key_change.h"

namespace blocklift::pipeline {

/// The changes that `--set` of a command, or a script, asks for, each as parse_key_change takes it.
/// Complaints about a change have its text as their place: "--set block:mass=9 t".
/// @throws InputError with all that is no change.
std::vector<KeyChange> read_asked_changes(const std::vector<std::string>& texts);

/// @param path a file that has no keys of its own, or one whose keys nothing changes.
/// @throws InputError if changes of it are asked for.
void refuse_asked_changes(const std::string& path, const std::vector<std::string>& texts);

}  // namespace blocklift::pipeline
