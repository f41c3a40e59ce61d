#pragma once

#include <optional>
#include <string>
#include <vector>

namespace blocklift::pipeline {

/// What `blocklift hydro` was asked for.
struct HydroOptions {
  std::optional<std::string> vessel;         ///< file of a vessel or of several
  std::optional<std::string> import;         ///< file of another program, or a database to export
  std::optional<std::string> export_format;  ///< bemio, wamit
  std::optional<std::string> output;
  std::optional<double> memory_limit;  ///< GB
  bool anew = false;                   ///< nothing is taken that was computed before
  std::optional<double> wamit_length;  ///< WAMIT's ULEN, of what is read and written, m; none: 1 m
  /// WAMIT's XBODY of each body, that its files do not tell: x,y[,z[,heading]], m, degrees
  std::vector<std::string> bodies_at;
  double water_density = 1025.0;      ///< that WAMIT's files do not tell, kg/m3
  double gravity = 9.80665;           ///< that these files do not tell, m/s2
  std::optional<double> water_depth;  ///< that these files do not tell, m; none: deep
};

/// Computes, imports or exports a hydrodynamic database. @returns an exit code.
/// @throws InputError if a file cannot be used.
int hydro(const HydroOptions& options);

}  // namespace blocklift::pipeline
