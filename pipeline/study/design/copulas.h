#pragma once

#include <openturns/OTDistribution.hxx>

#include "pipeline/files/study/study_file.h"

namespace blocklift::pipeline {

/// Joins the values of a study's correlations, which were drawn independently of one another. Each
/// keeps its law, and a Latin hypercube its strata.
/// @param laws of the variables. @param sample a member a row.
void join_values(const StudyFile& study,
                 const OT::ComposedDistribution::DistributionCollection& laws, OT::Sample& sample);

}  // namespace blocklift::pipeline
