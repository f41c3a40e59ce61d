#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/files/structure/part_file.h"
#include "pipeline/part/part_padeye.h"
#include "structure/elasticity/natural_modes.h"
#include "structure/mesh/files/part_reader.h"
#include "structure/part/part_solution.h"
#include "structure/practice/hot_spot.h"

namespace blocklift::pipeline {

/// Probe of a part's file with what is found there.
struct ProbeResult {
  std::string name;
  bool is_line = false;
  std::vector<structure::PartProbe> points;
};

/// Structural stress at a weld toe.
struct HotSpotResult {
  std::string name;
  structure::HotSpot spot;
  structure::Stress structural = structure::Stress::Zero();  ///< Pa
  structure::HotSpotStress stress;
};

/// One mesh on the way to the accuracy that is asked for.
struct RefinementStep {
  int element_order = 2;
  std::size_t elements = 0;
  int unknowns = 0;
  double estimated_error = 0;  ///< in the energy norm, as a share of it
  double von_mises = 0;        ///< largest averaged, Pa
  double von_mises_error = 0;  ///< of that, Pa
  double checked_error = 0;    ///< largest of the checked stresses, as a share of each
};

/// A part with its solution.
struct PartAssessment {
  PartFile file;
  structure::PartModel model;
  structure::PartMass mass;
  structure::PartSolution solution;  ///< empty without loads
  std::optional<structure::NaturalModes> modes;
  std::optional<PartPadeye> padeye;        ///< of a padeye under load
  std::vector<RefinementStep> refinement;  ///< the last is the mesh of the solution
  std::vector<ProbeResult> probes;
  std::vector<HotSpotResult> hot_spots;
  double mesh_s = 0;   ///< wall-clock time of reading or making the mesh
  double modes_s = 0;  ///< of finding the modes
};

/// Reads the mesh and puts the model together.
/// @returns the model, or after complaints an empty one: files that cannot be read, groups that the
///   mesh does not have or that hold no element, solids of no material or of two, a size that makes
///   a wrong unit of length likely, boxes without faces and places without a node, bodies to be
///   joined that lie farther apart.
/// @param sizes of the elements, where the file is a geometry.
structure::PartModel make_part_model(const PartFile& file, Diagnostics& diagnostics,
                                     const std::optional<structure::SizeField>& sizes = {});

/// Where two bodies of a part face each other, in words, and by what they are joined.
std::string describe(const structure::PartMeeting& meeting);

/// What is probably not meant: bodies that face each other closely and are not joined, a sentence
/// each without a full stop.
std::vector<std::string> list_doubts(const structure::PartModel& model);

/// Runs a part. @throws InputError if the model cannot be made or solved: inverted elements, rigid
///   motions that the supports leave, probes outside the part, memory that does not suffice, an
///   accuracy that is not reached (the message says how near it came and where the error is).
PartAssessment assess_part(PartFile file);

/// The figure that a reference speaks of, Pa, m or Hz.
double figure_of(const PartAssessment& assessment, const PartReference& reference);

/// What a figure is called: "yy at D", "mode 7".
std::string name_of(const PartReference& reference);

/// Writes summary.json, results.h5, part.vtu, modes.vtu (if there are modes) and, if asked for,
/// part.inp (CalculiX) into a folder; all of them appear when all are written.
void write_part_results(const PartAssessment& assessment, const std::filesystem::path& folder,
                        bool calculix);

}  // namespace blocklift::pipeline
