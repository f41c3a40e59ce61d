#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/checks/checks.h"
#include "pipeline/files/lift_case/lift_case.h"
#include "pipeline/lift/history_assessment.h"
#include "structure/part/padeye_model.h"
#include "structure/practice/padeye_formulas.h"

namespace blocklift::pipeline {

/// An instant of the lift at which a padeye is looked at.
struct PadeyeInstant {
  std::string name;            ///< "largest dynamic load"
  std::optional<double> time;  ///< s
  structure::LoadCase load;
};

/// The same with what the finite elements make of it, without the consequence factor.
struct PadeyeState {
  std::string name;
  std::optional<double> time;                               ///< s
  structure::Vector3 force_P = structure::Vector3::Zero();  ///< of the pin on the padeye, N
  structure::PadeyeResult result;
};

/// A formula at the instant of its largest utilisation.
struct PadeyeFormulaAtWorst {
  structure::PadeyeFormula formula;
  bool has_force = true;       ///< false: a rule of measures
  std::optional<double> time;  ///< s; none for rules of measures
};

/// A padeye of the block over the whole lift.
struct PadeyeAssessment {
  std::string lug;
  std::string rope;    ///< all that end at it: "R1, R3"; empty: none, under a load table
  std::string padeye;  ///< name of its design
  PlacedPadeye placed;
  structure::PadeyeFormulaInput input;
  double consequence_factor = 1;
  std::vector<PadeyeFormulaAtWorst> formulas;  ///< strength at its worst instants, then rules
  std::vector<PadeyeState> states;
  std::size_t governing = 0;  ///< state of the largest checked stress over yield
  std::shared_ptr<const structure::PadeyeModel> model;

  /// The one of the largest utilisation; rules of measures count where they are broken.
  const PadeyeFormulaAtWorst& worst_formula() const;
  const PadeyeState& governing_state() const { return states[governing]; }
};

/// All padeyes that ropes pull at.
struct PadeyesAssessment {
  std::vector<PadeyeAssessment> padeyes;
  double evaluation_s = 0;  ///< wall-clock time
};

/// Looks at every padeye of the block: hand formulae at all instants of both histories; finite
/// elements at the largest static and dynamic load, the largest force along the pin, and the
/// instant of the base's largest utilisation. Padeyes of one design, width and height share one
/// factorisation.
PadeyesAssessment assess_padeyes(const LiftCase& lift_case,
                                 const structure::UnitResponses& responses,
                                 const BlockAttachment& attachment,
                                 const BlockHistory& static_history,
                                 const BlockHistory& dynamic_history);

/// The same for the two states of a load table.
PadeyesAssessment assess_padeyes(const LiftCase& lift_case,
                                 const structure::UnitResponses& responses,
                                 const BlockAssessment& block);

/// Two lines a padeye: its worst hand formula, and its checked stress against yield, both with the
/// consequence factor.
std::vector<Check> check_padeyes(const LiftCase& lift_case, const PadeyesAssessment& padeyes);

}  // namespace blocklift::pipeline
