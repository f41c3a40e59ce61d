#pragma once

#include <string>
#include <vector>

#include "pipeline/files/lift_case/lift_case.h"

// Names that a case knows, for checks and their hints.
namespace blocklift::pipeline {

/// "hull-860t" of "blocks/hull-860t".
std::string short_name(const std::string& model_name);

/// "C1" of "C1.main".
std::string before_dot(const std::string& name);

/// The hoists of a crane whose model could be read, and its bodies where asked: "C1.main".
std::vector<std::string> parts_of(const given::Crane& crane, bool with_bodies);

/// Ropes, and hoists whose tackles count as ropes; nothing if a crane could not be read.
std::vector<std::string> names_of_ropes(const LiftCase& lift_case);

}  // namespace blocklift::pipeline
