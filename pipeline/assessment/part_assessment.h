#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/input/part_file.h"
#include "structure/parallel/part_team.h"
#include "structure/response/part_solution.h"

namespace blocklift::pipeline {

/// Probe of a part's file with what is found there.
struct ProbeResult {
  std::string name;
  bool is_line = false;
  std::vector<structure::PartProbe> points;
};

/// A part with its solution.
struct PartAssessment {
  PartFile file;
  structure::PartModel model;
  structure::PartMass mass;
  structure::PartSolution solution;
  std::vector<ProbeResult> probes;
  double mesh_s = 0;  ///< wall-clock time of reading or making the mesh
};

/// Reads the mesh and puts the model together.
/// @returns the model, or after complaints an empty one: files that cannot be read, groups that the
///   mesh does not have or that hold no element, solids of no material or of two, a size that makes
///   a wrong unit of length likely.
structure::PartModel make_part_model(const PartFile& file, Diagnostics& diagnostics);

/// Runs a part. @throws InputError if the model cannot be made or solved: inverted elements, rigid
///   motions that the supports leave, probes outside the part, memory that does not suffice.
/// @param team the processes that solve it together; null: this one alone.
PartAssessment assess_part(PartFile file, structure::PartTeam* team = nullptr);

/// The figure of a probe that a reference speaks of, Pa or m.
double figure_of(const PartAssessment& assessment, const PartReference& reference);

/// Writes summary.json, results.h5, part.vtu (or part.pvtu and the pieces of a team) and, if asked
/// for, part.inp (CalculiX) into a folder; all of them appear when all are written.
void write_part_results(const PartAssessment& assessment, const std::filesystem::path& folder,
                        bool calculix, const structure::PartTeam* team = nullptr);

}  // namespace blocklift::pipeline
