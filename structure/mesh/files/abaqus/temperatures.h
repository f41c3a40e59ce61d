#pragma once

#include <map>
#include <string>

#include "structure/mesh/files/abaqus/model.h"

namespace blocklift::structure {

/// Temperatures as far as steps go.
struct AbaqusTemperatures {
  /// By vertex: the temperature, its slopes along a shell's normal or a beam's n2 and along a
  /// beam's n1, K/m.
  std::map<int, Vector3> at_nodes;
  std::string obstacle;  ///< TemperatureField's
};

/// *INITIAL CONDITIONS, TYPE = TEMPERATURE; notes those of other types.
AbaqusTemperatures read_initial_temperatures(AbaqusModel& model);

/// Adds what a *TEMPERATURE or a block of initial ones says.
/// @throws CardError for nodes that do not exist and what is no number.
void add_temperatures(AbaqusModel& model, const AbaqusScope& scope, const AbaqusBlock& block,
                      AbaqusTemperatures& temperatures);

/// What the temperatures have risen by at all vertices: nodes that no step gives one keep the
/// initial one, which is 0 where none is given.
TemperatureField rise_of(const AbaqusModel& model, const AbaqusTemperatures& now,
                         const AbaqusTemperatures& initial, const std::string& name);

/// Is there anything that rises, or may rise?
bool acts(const TemperatureField& field);

}  // namespace blocklift::structure
