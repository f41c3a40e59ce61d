#pragma once

#include <filesystem>
#include <string>

#include "pipeline/declaration/diagnostics.h"

namespace blocklift::pipeline {

struct Document;

/// What an input file is, by what it begins with.
enum class FileKind {
  lift_case,
  mechanism,
  robot,
  crane,
  block,
  rope,
  part,
  vessel,
  vessels,
  standard,
  rigging,
  study
};

/// The file that a folder stands for: its case.yaml, else the first that it holds of
/// mechanism.yaml, part.yaml, study.yaml, block.yaml, crane.yaml, vessel.yaml and vessels.yaml. Of
/// a file, and of a folder without any of them, the path itself.
std::filesystem::path input_file(const std::filesystem::path& path);

/// What an input is called: the folder's name where the file is one that a folder stands for, else
/// the file's without its ending.
std::string name_of_input(const std::filesystem::path& path);

/// The kind of a file, or of the file that a folder stands for: a robot description is XML or ends
/// in .urdf, a mechanism has the key `mechanism`, a part the key `part`, a study the key `study`, a
/// model says its kind. Everything else, unreadable files included, counts as a lift case, whose
/// reader says what is wrong.
FileKind kind_of_file(const std::filesystem::path& path);

/// Complains about a file that does not say what it is though its keys tell: a `kind` that is not
/// known, or the keys of a block or a part without `kind: block` or `part`. One message then stands
/// for the many that the keys of a lift case would give.
/// @returns whether it complained; false, too, of a file that cannot be read or has keys of a lift
/// case.
bool complain_about_untold_kind(const std::filesystem::path& path, Diagnostics& diagnostics);
/// The same of a file that was read already.
bool complain_about_untold_kind(const Document& document, Diagnostics& diagnostics);

}  // namespace blocklift::pipeline
