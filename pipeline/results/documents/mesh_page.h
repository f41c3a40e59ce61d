#pragma once

#include <string>

#include "pipeline/files/structure/block_mesh.h"

namespace blocklift::pipeline {

/// What was found in a block's deck as a page of HTML that stands by itself: mass, centre, the
/// cards that are not used, and each finding with a drawing of where it is.
/// @returns nothing if no deck was read.
std::string mesh_page(const MeshModel& mesh, const std::string& title);

/// What its file is called, beside the report.
inline constexpr const char* mesh_page_file = "mesh.html";

}  // namespace blocklift::pipeline
