#pragma once

#include <string>

#include "pipeline/part/deck_assessment.h"

namespace blocklift::pipeline {

/// "1.5, 0, 2": a place, m.
std::string place_text(const structure::Vector3& place);

/// Tables of a deck's own load cases: stress and displacement, forces, groups of the case with the
/// largest stress, and what is not in them.
void print_deck_cases(const DeckAssessment& assessment);

}  // namespace blocklift::pipeline
