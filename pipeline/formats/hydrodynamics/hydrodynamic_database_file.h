#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "dynamics/marine/panels/coupling_reach.h"
#include "dynamics/marine/radiation/hydrodynamic_series.h"

/// Hydrodynamic databases in HDF5, our own layout. Every dataset carries `units` and `description`;
/// numbers are doubles as they were in memory, so that what is read is what was written.
///
///   /                       attributes format, format_version, identity, origin, lowered_body
///   /water                  density, gravity, depth (infinite: deep)
///   /bodies/names           [N]
///   /frequencies, /headings [F], [H]
///   /waves_lost             where it was found out; attributes are (1: waves between bodies are
///                           lost, 0: none), and of lost ones first, second, gap, shortest
///   /states/K               one for each draught, K = 0, 1 ...; attribute draught
///     reference_points      [N, 3], and where known centres_of_buoyancy, centres_of_mass
///     displaced_volumes     [N]
///     hydrostatic_stiffness [6N, 6N], where known
///     change_from_coarser, excitation_change_from_coarser, cut_off_by_end   [6N], where known
///     infinite_added_mass   [6N, 6N]
///     added_mass, damping   [F, 6N, 6N]
///     retardation           [T, 6N, 6N], attribute time_step
///     froude_krylov/{re,im}, diffraction/{re,im}   [F, 6N, H]
///     mean_drift            [F, 6N, H], where known
///     far_field, where known: directions [D], radiated/{re,im} [F, D, 6N], scattered/{re,im}
///                           [F, D, H]
///
/// Modes, units and signs are those of dynamics::HydrodynamicDatabase.
namespace blocklift::pipeline {

/// A file of hydrodynamics cannot be used; what() names the file, what was found and what is due.
class HydrodynamicFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// How the origin begins of what another program computed.
inline constexpr std::string_view imported_from = "imported from ";

/// Between which bodies the panels on the water lose waves; none: between none.
using WavesLost = std::optional<dynamics::CouplingReach>;

/// What a file holds.
struct HydrodynamicFile {
  std::string identity;  ///< ContentHash of all that it was computed from; empty: imported
  std::string origin;    ///< for people: which program made it, from what
  dynamics::HydrodynamicSeries series;
  /// Of the mesh that it was computed on; not there where nobody asked.
  std::optional<WavesLost> waves_lost = {};
};

/// Writes a file, whole or not at all.
/// @throws HydrodynamicFileError if a database is unsound (dynamics::require_sound) or the file
///   cannot be written.
void write_hydrodynamic_file(const std::filesystem::path& path, const HydrodynamicFile& file);

/// @throws HydrodynamicFileError if the file cannot be read, is of another format or a newer
///   version, lacks something, has wrong shapes or numbers that are not finite: which dataset, what
///   was found and what is due.
HydrodynamicFile read_hydrodynamic_file(const std::filesystem::path& path);

/// A single database, its draught not told.
void write_hydrodynamic_database(const std::filesystem::path& path,
                                 const dynamics::HydrodynamicDatabase& database,
                                 const std::string& identity = {}, const std::string& origin = {});

/// The database of a file that has one.
/// @throws HydrodynamicFileError as above, or if the file holds several draughts.
dynamics::HydrodynamicDatabase read_hydrodynamic_database(const std::filesystem::path& path);

/// The identity of a file without reading the rest; none if there is no such file or it is not one
/// of ours.
std::optional<std::string> read_identity(const std::filesystem::path& path);

}  // namespace blocklift::pipeline
