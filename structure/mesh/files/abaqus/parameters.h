#pragma once

#include <vector>

#include "structure/mesh/files/abaqus/keywords.h"

namespace blocklift::structure {

/// Says at their lines which parameters of keywords are not read, and what may have been meant.
/// Only of keywords whose parameters are listed here: those of nodes, elements, sets, sections,
/// materials, masses, links, supports and loads.
void remark_on_unread_parameters(const std::vector<AbaqusBlock>& blocks, DeckLog& log);

}  // namespace blocklift::structure
