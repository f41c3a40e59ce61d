#pragma once

#include <string>

namespace blocklift::structure {

/// Refuses a file that Gmsh would run as a script (.geo, and whatever has no format that it knows)
/// if a statement of it may read or write other files, start programs or make statements out of
/// text. A geometry needs none of them. Nothing is refused where files outside are allowed.
/// @throws ModelError with the line and the word.
void require_closed_script(const std::string& path);

}  // namespace blocklift::structure
