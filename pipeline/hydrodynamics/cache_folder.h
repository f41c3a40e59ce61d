#pragma once

#include <filesystem>

namespace blocklift::pipeline {

/// Where computed databases are kept unless a run says otherwise: the folder that BLOCKLIFT_CACHE
/// names, or `blocklift` in the one of XDG_CACHE_HOME, or `.cache/blocklift` in the user's home.
/// Empty if none of these is set, or BLOCKLIFT_CACHE is empty.
///
/// Whoever computes databases is given such a folder; an empty one is no_cache.
std::filesystem::path cache_folder();

/// The folder of a run that takes nothing from the cache and puts nothing there.
inline std::filesystem::path no_cache() { return {}; }

}  // namespace blocklift::pipeline
