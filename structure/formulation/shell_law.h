#pragma once

namespace blocklift::structure {

/// How many times the drilling stiffness of other plates (shell_stiffness_law) facets of curved
/// plating have.
double drilling_of_facets(int degree);

}  // namespace blocklift::structure
