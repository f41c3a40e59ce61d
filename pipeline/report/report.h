#pragma once

#include <filesystem>

namespace blocklift::pipeline {

/// Makes report.html in a result folder from its results.h5 and summary.json alone.
///
/// The page is one self-contained file of at most about 10 MB that opens offline: verdict, drawing
/// of the lift, tension histories, load tables, stress pictures, checks, accuracy, assumptions.
/// Series are thinned so that every maximum survives. Parts that the results do not have (no
/// dynamics, no structure) are left out of the page. What the two files hold:
/// pipeline/formats/results/results_layout.h.
///
/// @return the path of the report.
/// @throws ResultsError if one of the two files is missing, unreadable or at odds with itself.
std::filesystem::path write_report(const std::filesystem::path& folder);

}  // namespace blocklift::pipeline
