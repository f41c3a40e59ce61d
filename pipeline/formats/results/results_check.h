#pragma once

#include <string>
#include <vector>

#include "pipeline/formats/read_apart.h"
#include "pipeline/formats/results_store.h"

namespace blocklift::pipeline {

/// Reads all of a results.h5 that reports, comparisons and measurements take, and holds it against
/// results_layout.h: what belongs together is there, of the right kind and of fitting shape, what
/// must be known is no nan, texts are UTF-8. Damaged files crash HDF5: to be done in a child
/// process (read_apart.h).
/// @param next told of each dataset before it is read.
/// @returns what is wrong, each a sentence that names the dataset, what is there and what is due:
///   "/dynamic/ropes/R1/tension" has shape 3 x 2; 58 is due. At most twenty.
std::vector<std::string> complaints_about_results(const ResultsReader& results,
                                                  const PlaceOfReading& next);

}  // namespace blocklift::pipeline
