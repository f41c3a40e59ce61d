#pragma once

#include <array>
#include <string>

#include "dynamics/marine/waves/wave_spectrum.h"
#include "pipeline/files/environment/marine_parts.h"

namespace blocklift::pipeline {

/// Of the significant height that a sea is asked for: what is kept without a word, and what at
/// least.
inline constexpr double kept_without_doubt = 0.98, kept_at_least = 0.90;
/// Panels of a hull that the shortest wave of an irregular sea needs, and the wave in the middle of
/// its energy.
inline constexpr double panels_in_shortest_wave = 3.0, panels_in_middle_wave = 8.0;

/// For which radiation is computed unless the file or an irregular sea asks for others, rad/s.
inline constexpr std::array<double, 2> usual_radiation = {0.3, 1.2};

/// The frequencies of a sea, and those for which its vessels' radiation is computed.
struct SeaBand {
  bool irregular = false;             ///< a spectrum or a record; else regular waves, or none
  std::array<double, 2> sea{};        ///< of an irregular sea's components, rad/s
  std::array<double, 2> radiation{};  ///< that are computed, rad/s
  int frequencies = 0;                ///< of diffraction, evenly over `radiation`
  double height = 0;                  ///< significant height that is asked for, m
  double kept = 1;                    ///< share of `height` within `sea`
  /// The same as a share of what lies between the ends that the file gives itself.
  double kept_of_given = 1;
  double middle = 0;   ///< half of the energy has lower frequencies, rad/s
  std::string cut_by;  ///< what ends the sea where it loses most
  std::string hint;    ///< how to keep more
};

/// Spectra and records are taken from all but 0.1 % of their energy at the low end to all but 0.4 %
/// at the high one, or the ends that the file gives under radiation or of a record. Cut off is what
/// a database that is named does not have, and waves shorter than three panels of a hull, unless
/// the file gives the highest frequency. Where radiation is computed and nothing is given,
/// usual_radiation is left if it keeps 98 % of the significant height; if not, the ends that fall
/// short go on as far as the sea asks for, down to 0.1 rad/s, and the frequencies between them keep
/// their distance.
/// @throws dynamics::ModelError if the spectrum or record cannot be.
SeaBand find_sea_band(const MarineParts& parts, double gravity);
/// make_sea with its waves, where the band is known: to find it vessels may have to be floated.
dynamics::Sea make_sea(const MarineParts& parts, double gravity, const SeaBand& band);

/// What the sea is made of, with its significant height; empty if it is not irregular. The parts
/// are sound.
std::string describe_sea(const MarineParts& parts, double gravity);
/// What an irregular sea loses, if that is more than passes without a word. The parts are sound.
std::string doubt_about_sea(const MarineParts& parts, double gravity);

/// Complains about a sea of which too little is kept.
/// @return Is it sound?
bool check_sea_band(const SeaBand& band, const Mark& mark, Diagnostics& diagnostics);

dynamics::Water water_of(const given::Sea& sea, double gravity);
/// Height of the calm water in the vessel's frame, m: by its deepest draught, its draught or its
/// own weight. The vessel has its model.
/// @throws dynamics::ModelError if it does not float.
double water_level_of(const given::Vessel& vessel, const dynamics::Water& water);
/// @throws dynamics::ModelError if it cannot be.
dynamics::WaveSpectrum make_spectrum(const given::Spectrum& spectrum);
/// The record that was read, with all its frequencies and without a ramp.
dynamics::WaveRecord make_record(const given::WaveRecord& record);

}  // namespace blocklift::pipeline
