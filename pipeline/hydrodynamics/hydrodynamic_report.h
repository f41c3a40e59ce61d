#pragma once

#include <string>
#include <vector>

#include "dynamics/marine/radiation/distant_groups.h"
#include "pipeline/formats/hydrodynamics/hydrodynamic_database_file.h"

namespace blocklift::pipeline {

/// A database for people: tables of its main figures as text, all of its curves as a page.
///
/// `masses` are the bodies' mass matrices, 6N x 6N about the reference points, one for each
/// draught: with them the responses of the free bodies are shown; empty: without.
std::string hydrodynamic_table(const HydrodynamicFile& file,
                               const std::vector<Eigen::MatrixXd>& masses);

/// A sentence for a database whose panels are too coarse to be relied on: the mode whose radiation
/// force changes most from panels of twice the size, where that is more than a tenth; else empty.
std::string doubt_about_panels(const dynamics::HydrodynamicDatabase& database);

/// The same of the mode on which the force of waves changes most, as a share of its largest, where
/// that is more than a tenth. A force that is the small rest of two, as roll's may be, is coarse
/// where that of radiation is not.
std::string doubt_about_excitation(const dynamics::HydrodynamicDatabase& database);

/// A sentence for a database whose impulse runs end before the water is at rest: the mode of whose
/// radiation force their end cuts off most, where that is more than a twentieth; else empty.
std::string doubt_about_runs(const dynamics::HydrodynamicDatabase& database);

/// Half a sentence for a hull that floats as it is meshed, and whose mass (kg) is not that of the
/// water it displaces by more than a twentieth; else empty. Moorings may make it so.
std::string doubt_about_mass(const std::string& name, double displaced, double mass);

/// What bodies far apart are coupled by: one sentence, for people; empty for a single group.
std::string note_on_groups(const dynamics::PanelModel& model,
                           const std::vector<dynamics::BodyGroup>& groups);

/// A sentence for bodies of one group so far apart that the waves of a frequency (rad/s) are lost
/// between them on the surface's mesh; else empty.
std::string doubt_about_coupling(const dynamics::PanelModel& model,
                                 const std::vector<dynamics::BodyGroup>& groups,
                                 double highest_frequency);

/// A page of HTML that needs nothing else: added mass, damping, retardation functions, excitation
/// and response of each body and mode.
std::string hydrodynamic_page(const HydrodynamicFile& file, const std::string& title,
                              const std::vector<Eigen::MatrixXd>& masses);

}  // namespace blocklift::pipeline
