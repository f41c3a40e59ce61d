#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "structure/mesh/files/abaqus/model.h"

namespace blocklift::structure {

/// Kinds of loads that are known, for messages: of *DLOAD, and of *DSLOAD.
inline constexpr std::string_view known_element_loads =
    "P, HP, TRVEC, TRSHR, BX, BY, BZ, EDNOR1, EDSHR1, EDTRA1, EDLD1 ... of shells, P1, HP1, "
    "TRVEC1, "
    "TRSHR1 ... and BX, BY, BZ of solids, PX, PY, PZ, P1, P2, BX, BY, BZ of beams, GRAV and "
    "CENTRIF";
inline constexpr std::string_view known_surface_loads =
    "P, HP, TRVEC and TRSHR on faces, EDNOR, EDSHR, EDTRA and EDLD on edges of shells";

/// What a line of *DLOAD puts on an element, in a set with this load alone; none where the kind is
/// not known for the element.
///
/// P, HP (zero at one level, its magnitude at another; along z), TRVEC (along a vector) and TRSHR
/// (along its part in the surface) are per area; BX, BY, BZ per volume; PX, PY, PZ, P1, P2 per
/// length of a beam; per length of a shell's edge EDNOR inwards, EDSHR along it, EDTRA against the
/// normal, EDLD along a vector. Source: Abaqus Analysis User's Guide, distributed loads; directions
/// of edge loads: 3DEXPERIENCE, about shell edge loads.
/// @param fields element or set, kind, magnitude, and what the kind needs.
/// @throws CardError for fields that are wrong, and for what cannot be said: tractions along a
///   surface that is not flat, and HP beyond the level where it is zero.
std::optional<LoadSet> abaqus_element_load(const AbaqusModel& model,
                                           const AbaqusDeckElement& element,
                                           const std::string& kind,
                                           const std::vector<std::string_view>& fields);

/// The same of a line of *DSLOAD and a face of its surface (S1 ..., SPOS, SNEG, E1 ...); a pressure
/// is against the surface. @throws CardError also for kinds that the face does not know.
LoadSet abaqus_surface_load(const AbaqusModel& model, const AbaqusDeckElement& element,
                            const std::string& face, const std::string& kind,
                            const std::vector<std::string_view>& fields);

}  // namespace blocklift::structure
