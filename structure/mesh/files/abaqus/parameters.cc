#include "structure/mesh/files/abaqus/parameters.h"

#include <algorithm>
#include <map>
#include <string>

#include <fmt/format.h>

#include "structure/nearest_name.h"

namespace blocklift::structure {

namespace {

/// Parameters that are read, or refused where they are met, and those that change nothing here.
struct KnownParameters {
  std::vector<std::string> read, without_effect;
};

const KnownParameters* parameters_of(const std::string& keyword) {
  static const KnownParameters of_loads{{"OP", "AMPLITUDE", "TIME DELAY", "FOLLOWER", "INPUT"},
                                        {"REGION TYPE", "CONSTANT RESULTANT"}};
  static const KnownParameters of_shells{
      {"ELSET", "MATERIAL", "COMPOSITE", "OFFSET", "ORIENTATION", "NODAL THICKNESS",
       "SHELL THICKNESS", "DENSITY", "SYMMETRIC", "BENDING ONLY", "MEMBRANE ONLY"},
      {"CONTROLS", "SECTION INTEGRATION", "POISSON", "TEMPERATURE", "THICKNESS MODULUS", "LAYUP"}};
  static const KnownParameters of_couplings{
      {"REF NODE", "SURFACE", "ORIENTATION", "INFLUENCE RADIUS"}, {"CONSTRAINT NAME"}};
  static const std::map<std::string, KnownParameters> all{
      {"NODE", {{"NSET", "SYSTEM", "INPUT"}, {}}},
      {"ELEMENT", {{"TYPE", "ELSET", "INPUT"}, {"SOLID ELEMENT NUMBERING"}}},
      {"NSET", {{"NSET", "GENERATE", "ELSET", "INSTANCE", "INPUT"}, {"INTERNAL", "UNSORTED"}}},
      {"ELSET", {{"ELSET", "GENERATE", "INSTANCE", "INPUT"}, {"INTERNAL", "UNSORTED"}}},
      {"SURFACE",
       {{"NAME", "TYPE", "INPUT"},
        {"INTERNAL", "TRIM", "FILLET RADIUS", "MAX RATIO", "NO OFFSET", "NO THICK", "SCALE THICK",
         "REGION TYPE", "PROPERTY"}}},
      {"EQUATION", {{"INPUT"}, {}}},
      {"MPC", {{"INPUT"}, {}}},
      {"BOUNDARY", {{"TYPE", "FIXED", "OP", "AMPLITUDE", "TIME DELAY", "INPUT"}, {"REGION TYPE"}}},
      {"TEMPERATURE", {{"OP", "AMPLITUDE", "USER", "FILE", "INPUT"}, {}}},
      {"CLOAD", of_loads},
      {"DLOAD", of_loads},
      {"DSLOAD", of_loads},
      {"SHELL SECTION", of_shells},
      {"SHELL GENERAL SECTION", of_shells},
      {"SOLID SECTION", {{"ELSET", "MATERIAL", "ORIENTATION", "COMPOSITE"}, {"CONTROLS", "LAYUP"}}},
      {"NODAL THICKNESS", {{"INPUT"}, {}}},
      {"MATERIAL", {{"NAME"}, {"RTOL", "SRATE FACTOR", "STRAIN RATE REGULARIZATION"}}},
      {"EXPANSION", {{"TYPE", "USER", "INPUT"}, {"ZERO", "DEPENDENCIES"}}},
      {"ELASTIC", {{"TYPE", "INPUT"}, {"DEPENDENCIES", "MODULI"}}},
      {"DENSITY", {{"INPUT"}, {"DEPENDENCIES"}}},
      {"MASS", {{"ELSET"}, {"ALPHA", "COMPOSITE"}}},
      {"ROTARY INERTIA", {{"ELSET", "ORIENTATION"}, {"ALPHA", "COMPOSITE"}}},
      {"NONSTRUCTURAL MASS", {{"ELSET", "UNITS", "DISTRIBUTION"}, {}}},
      {"COUPLING", of_couplings},
      {"KINEMATIC COUPLING", {{"REF NODE", "ORIENTATION"}, {}}},
      {"DISTRIBUTING", {{"COUPLING", "WEIGHTING METHOD"}, {}}},
      {"RIGID BODY",
       {{"REF NODE", "ROT NODE", "ELSET", "NSET", "TIE NSET", "PIN NSET", "ANALYTICAL SURFACE"},
        {"ISOTHERMAL"}}}};
  const auto found = all.find(keyword);
  return found == all.end() ? nullptr : &found->second;
}

bool is_among(const std::vector<std::string>& names, const std::string& name) {
  return std::any_of(names.begin(), names.end(), [&](const std::string& known) {
    return without_blanks(known) == without_blanks(name);
  });
}

}  // namespace

void remark_on_unread_parameters(const std::vector<AbaqusBlock>& blocks, DeckLog& log) {
  for (const AbaqusBlock& block : blocks) {
    const KnownParameters* known = parameters_of(block.name);
    if (known == nullptr) continue;
    for (const AbaqusBlock::Parameter& parameter : block.parameters) {
      if (is_among(known->read, parameter.name) || is_among(known->without_effect, parameter.name))
        continue;
      const std::string meant = nearest_name(parameter.name, known->read);
      log.remark(block.line,
                 fmt::format("*{}: the parameter {} is not read{}", block.name, parameter.name,
                             meant.empty() ? "" : fmt::format(" (did you mean {}?)", meant)));
    }
  }
}

}  // namespace blocklift::structure
