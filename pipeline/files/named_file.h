#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/declaration/diagnostics.h"

namespace blocklift::pipeline {

/// The folders that BLOCKLIFT_MODELS names (separated by colons) or, without it, `models` beside
/// or above the executable, of the installation, and of the source tree.
std::vector<std::filesystem::path> model_path();

/// Lets models be sought beside that program, for a process of another one (Python's).
/// @param program its executable file; to be given before any input is read.
void take_models_of(const std::filesystem::path& program);

/// Whether what is named leads into one of the homes or the folders of models, ".." and symbolic
/// links followed. Links inside a folder of models are the installation's own, and are trusted.
/// @param name from `folder` on.
/// @param homes folders in which files may be named: of the file that names it, of the case.
bool is_within(const std::filesystem::path& name, const std::filesystem::path& folder,
               const std::vector<std::filesystem::path>& homes,
               const std::vector<std::filesystem::path>& models);

/// Complains at the place of the name: it leads outside, and how that is allowed.
void complain_about_outside(const Located<std::string>& name, Diagnostics& diagnostics);

/// The path of a file that an input file names, counted from that file's folder.
///
/// Input may come from others: what it names has to lie in the folder of the file itself, in
/// another of its homes, or in a folder of models. Absolute paths, "..", and symbolic links are
/// followed before this is judged.
/// @param homes further folders in which it may lie: of the case that names the file.
/// @returns nothing, after a complaint, for a path that leads elsewhere, whether there is a file or
/// not.
std::optional<std::filesystem::path> path_of_named_file(
    const Located<std::string>& name, const std::filesystem::path& folder, Diagnostics& diagnostics,
    std::vector<std::filesystem::path> homes = {});

}  // namespace blocklift::pipeline
