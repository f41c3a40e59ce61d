#pragma once

#include <utility>
#include <vector>

#include "pipeline/files/study/study_file.h"

namespace blocklift::pipeline::test {

/// A length as a study states it, m.
inline Located<Measure> length_of(double metres) { return {{metres, {1, 0, 0, 0}}, {}}; }

/// The variable x of a law.
inline StudyVariable spread_variable(SpreadLaw law) {
  StudyVariable variable;
  variable.name = {"x", {}};
  variable.law = std::move(law);
  return variable;
}

inline StudyVariable normal_length(double mean, double deviation) {
  SpreadLaw law;
  law.mean = length_of(mean);
  law.deviation = length_of(deviation);
  return spread_variable(law);
}

inline StudyVariable uniform_length(double lowest, double highest) {
  SpreadLaw law;
  law.kind = SpreadLaw::Kind::uniform;
  law.lowest = length_of(lowest);
  law.highest = length_of(highest);
  return spread_variable(law);
}

/// A study of these variables, without a case.
inline StudyFile study_of(StudyDesign design, int members, std::vector<StudyVariable> variables) {
  StudyFile study;
  study.design = design;
  study.members = members;
  study.variables = std::move(variables);
  return study;
}

}  // namespace blocklift::pipeline::test
