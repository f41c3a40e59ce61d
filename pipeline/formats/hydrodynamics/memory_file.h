#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/marine/radiation/memory_state_space.h"

/// Memories of the water that were fitted before, in HDF5, for the cache: what they are is said by
/// their identity alone.
///
///   /               attributes format, format_version, identity
///   /memories/K     K = 0, 1 ..., attributes states and error
///     decay, turn   [n], diagonal of A and what stands right of it, 1/s
///     input         B, [n, 6N]
///     output        C, [6N, n]
namespace blocklift::pipeline {

/// Writes a file, whole or not at all.
/// @throws ResultsError if it cannot be written.
void write_memories(const std::filesystem::path& path,
                    const std::vector<dynamics::MemoryStateSpace>& memories,
                    const std::string& identity);

/// The memories of a file; none if there is no such file, it is damaged, or has another identity.
std::optional<std::vector<dynamics::MemoryStateSpace>> read_memories(
    const std::filesystem::path& path, const std::string& identity);

}  // namespace blocklift::pipeline
