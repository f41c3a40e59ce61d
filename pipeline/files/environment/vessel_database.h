#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/files/environment/marine_parts.h"

namespace blocklift::pipeline {

/// Reads the databases that vessels name, each file once, and finds the vessels' bodies in them.
/// Complains about files that cannot be used and bodies that they do not hold.
void load_vessel_databases(std::vector<given::Vessel>& vessels, const std::filesystem::path& beside,
                           Diagnostics& diagnostics);

/// Complains about databases that cannot stand for the water of these vessels: some vessels with
/// and some without, several files, bodies of a file that no vessel is or two are, vessels that are
/// lowered or make no waves, water of another density, depth or gravity (m/s2), and in waves
/// headings that do not go all around. Complains about lids beside a database, or without waves.
void check_vessel_databases(const MarineParts& parts, double gravity, Diagnostics& diagnostics);

/// What is doubtful of the database that vessels name, in sentences: that its memory does not give
/// back its added mass and damping (doubt_about_memory), and that its figures contradict each other
/// (doubts_about_conventions).
std::vector<std::string> doubts_about_database(const std::vector<given::Vessel>& vessels);

}  // namespace blocklift::pipeline
