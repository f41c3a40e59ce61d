#pragma once

#include "dynamics/marine/radiation/hydrodynamic_database.h"

namespace blocklift::pipeline {

/// A database of made-up numbers that fill all digits: two bodies, three frequencies, two headings,
/// forty samples of decaying retardation functions. Symmetric, finite, without physics.
dynamics::HydrodynamicDatabase make_sample_database();

}  // namespace blocklift::pipeline
