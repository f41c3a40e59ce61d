#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace blocklift::pipeline {

/// Reads a file in a child process first, with limits of time and memory by the file's size: HDF5
/// runs in circles or beyond its memory where a file's own tables are damaged. Errors that the
/// reading throws are left to who reads the file then.
/// @returns how the reading died, "came to no end ..."; none if the file can be read here.
std::optional<std::string> death_of_reading(const std::filesystem::path& file,
                                            const std::function<void()>& read);

/// Told what is read next, so that it can be named if reading dies there.
using PlaceOfReading = std::function<void(const std::string& place)>;

/// The same for reading that says itself what is wrong with the file.
/// @returns what `read` returns; how it died, and at which place, if it did.
std::vector<std::string> complaints_of_reading(
    const std::filesystem::path& file,
    const std::function<std::vector<std::string>(const PlaceOfReading&)>& read);

}  // namespace blocklift::pipeline
