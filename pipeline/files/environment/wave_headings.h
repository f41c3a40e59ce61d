#pragma once

#include <string>

#include "pipeline/files/environment/marine_parts.h"

namespace blocklift::pipeline {

/// A sentence for waves that travel between two headings of a database that vessels name, where
/// these lie more than 15 degrees apart: the excitation between them is interpolated. Waves along a
/// heading of the database are not doubted, however far its others lie. Empty: nothing to say.
std::string doubt_about_headings(const MarineParts& parts);

}  // namespace blocklift::pipeline
