#pragma once

#include <string>
#include <vector>

#include "pipeline/files/study/study_file.h"
#include "pipeline/study/members/members.h"

namespace blocklift::pipeline {

/// A limit of a figure in the unit that the figure has in the summary.
/// @throws InputError at the limit's place if it is of another dimension.
double limit_of(const Located<Measure>& limit, const std::string& figure, const std::string& unit);

/// Unit of a figure as the first member that did not fail tells it; without one, as far as the
/// figure's name does.
std::string unit_of(const std::vector<Member>& members, const std::string& figure);

/// Looks at the limits of a study: of a search, and of the sea states that a lift bears.
/// @param members that tell the units of figures; without any, those are looked at whose names do.
/// @throws InputError for the first that is of another dimension than its figure.
void check_figure_limits(const StudyFile& study, const std::vector<Member>& members = {});

}  // namespace blocklift::pipeline
