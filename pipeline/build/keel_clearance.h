#pragma once

#include <string>

#include "pipeline/build/build_marine.h"

namespace blocklift::pipeline {

/// A sentence for a hull at rest whose panels are wider than the water under them is deep: one
/// point a panel does not follow the flow there. The panel that is widest beside its water counts,
/// of those that look down. Empty: there is none, or the water is deep.
std::string doubt_about_keel(const std::string& name, const dynamics::Hull& hull,
                             const dynamics::Pose& X_WB, double depth);

/// Of the hulls of a problem that the panel method computes, at their deepest draughts.
std::string doubt_about_keels(const RadiationProblem& problem);

}  // namespace blocklift::pipeline
