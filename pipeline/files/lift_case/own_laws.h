#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "dynamics/simulation/steering.h"
#include "pipeline/declaration/diagnostics.h"
#include "pipeline/files/lift_case/lift_case.h"

namespace blocklift::pipeline {

/// Laws by which drives are steered, by the names of `keeps: law`: not from a file, but given by
/// the program that this one is part of.
using OwnLaws = std::map<std::string, LawMaker>;

/// Complains about laws that are given and that no move of the operation names, and about those
/// that moves name and nobody gives.
/// @param file that has the operation.
void check_laws(const OwnLaws& laws, const std::vector<given::Stage>& operation,
                const std::filesystem::path& file, Diagnostics& diagnostics);

/// The law that steers a drive, with sights of its coordinate and its rate; those of `keep.sees`
/// are still to be added, in their order.
/// @throws InputError if nobody gives it.
dynamics::OwnLaw make_own_law(const given::Keep& keep, const OwnLaws& laws);

}  // namespace blocklift::pipeline
