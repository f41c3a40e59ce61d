#pragma once

#include <string>
#include <vector>

#include "pipeline/checks/assessment.h"

namespace blocklift::pipeline {

/// The block with the loads that govern it, as a file for another solver.
struct LoadCaseFile {
  std::string name;     ///< of the file, beside the report
  std::string text;     ///< empty: it cannot be written
  std::string refusal;  ///< why not
};

/// Names of the files that load_case_files may make.
inline constexpr const char* abaqus_load_cases = "load-cases.inp";
inline constexpr const char* nastran_load_cases = "load-cases.bdf";
inline constexpr const char* load_case_displacements = "load-cases.csv";

/// The instants of the largest checked stress at rest and in motion (of a load table both of its
/// sets) as an Abaqus and as a Nastran deck: see structure::load_case_deck. In the units of the
/// deck that the block came from, else in mm, t and N. A table has the displacements that the
/// solver is to find at the corners of elements.
/// @returns nothing where no block's stress was asked.
std::vector<LoadCaseFile> load_case_files(const Assessment& assessment);

}  // namespace blocklift::pipeline
