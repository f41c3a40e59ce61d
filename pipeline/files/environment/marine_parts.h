#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/marine/waves/sea.h"
#include "pipeline/declaration/table.h"
#include "pipeline/files/environment/linear_buoyancy.h"
#include "pipeline/files/vessel/hull_places.h"
#include "pipeline/files/vessel/hydrodynamic_settings.h"
#include "pipeline/files/vessel/vessel_model.h"
#include "pipeline/mechanism/mechanism_parts.h"

namespace blocklift::dynamics {
struct HydrodynamicDatabase;
}

namespace blocklift::pipeline {

namespace given {

/// A regular wave: by its frequency or its period.
struct RegularWave {
  double amplitude = std::numeric_limits<double>::quiet_NaN();  ///< m
  std::optional<Located<double>> frequency;                     ///< rad/s
  std::optional<Located<double>> period;                        ///< s
  double heading = 0;                                           ///< direction of travel, rad
  double phase = 0;                                             ///< rad

  double omega() const;  ///< rad/s; NaN if neither is given
};

}  // namespace given

enum class SpectrumShape { jonswap, pierson_moskowitz, issc, table };

namespace given {

/// An irregular sea.
struct Spectrum {
  SpectrumShape shape = SpectrumShape::jonswap;
  std::optional<Located<double>> significant_height;                   ///< m
  std::optional<Located<double>> peak_period;                          ///< s
  std::optional<Located<double>> mean_period;                          ///< s
  std::optional<Located<double>> peakedness;                           ///< gamma of JONSWAP
  std::optional<Located<std::vector<std::array<Quantity, 2>>>> table;  ///< rad/s, m2 s/rad
  double heading = 0;                                                  ///< direction of travel, rad
  std::optional<double> spreading;                                     ///< exponent n of cos^n
  int components = 0;
  int seed = 1;
  Mark place;
};

/// A measured elevation.
struct WaveRecord {
  Located<std::string> file;                                    ///< CSV: time in s, elevation in m
  double heading = 0;                                           ///< direction of travel, rad
  std::vector<double> elevation;                                ///< after the file has been read, m
  double time_step = std::numeric_limits<double>::quiet_NaN();  ///< s
  double start_time = 0;                                        ///< s
  std::optional<double> lowest, highest;  ///< frequencies that are kept, rad/s
};

/// Waves: regular ones, a spectrum, or a record.
struct Waves {
  std::optional<std::vector<RegularWave>> regular;
  std::optional<Spectrum> spectrum;
  std::optional<WaveRecord> record;
  double ramp = 0;  ///< s
  Mark place;
};

}  // namespace given

enum class CurrentProfile { uniform, tidal, wind_driven };

namespace given {

struct Current {
  double speed = 0;    ///< m/s
  double towards = 0;  ///< rad
  CurrentProfile profile = CurrentProfile::uniform;
  Mark place;
};

}  // namespace given

/// For what the radiation of floating bodies is computed.
struct RadiationSettings {
  std::optional<double> lowest, highest;  ///< frequencies, rad/s; none: by find_sea_band
  int frequencies = 0;                    ///< from the lowest to the highest
  Located<dynamics::PanelMethod> method{dynamics::PanelMethod::marched_surface, {}};
  /// Where water in gaps and moonpools is damped.
  std::optional<Located<std::vector<LidModel>>> lids;
  Mark place;
};

namespace given {

/// The water and what moves it.
struct Sea {
  double density = std::numeric_limits<double>::quiet_NaN();  ///< kg/m^3
  std::optional<double> depth;                                ///< m; none: deep
  std::optional<Waves> waves;
  std::optional<Current> current;
  RadiationSettings radiation;
  Mark place;
};

/// Damping of a vessel's six motions.
struct Damping {
  double surge = 0, sway = 0, heave = 0;  ///< N s/m, or N s2/m2
  double roll = 0, pitch = 0, yaw = 0;    ///< N m s, or N m s2

  /// roll, pitch, yaw, surge, sway, heave.
  Eigen::Matrix<double, 6, 1> vector() const;
};

/// A slender member in the water.
struct Member {
  Vector3 from = Vector3::Zero(), to = Vector3::Zero();  ///< in the vessel's frame, m
  double diameter = 0;                                   ///< m
  double drag_coefficient = 0;
};

/// Spring and damper of six freedoms that hold a vessel at its place.
struct Restraint {
  std::optional<Located<FreedomMatrix>> stiffness, damping;
  std::optional<Vector3> about;  ///< in the vessel's frame, m; none: its centre of mass
  bool symmetric = true;

  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  /// (moment; force) by (turn; displacement), SI; zero if it is not given.
  static Matrix6 matrix(const std::optional<Located<FreedomMatrix>>& given);
};

/// Drag of the current by coefficients over the heading.
struct CurrentLoad {
  double area = std::numeric_limits<double>::quiet_NaN();    ///< m2
  double length = std::numeric_limits<double>::quiet_NaN();  ///< of the yawing moment, m
  /// Angle of the relative flow (rad), C_X, C_Y, C_N.
  Located<std::vector<std::array<Quantity, 4>>> coefficients;
  std::optional<Vector3> about;  ///< in the vessel's frame, m; none: half way down its draught
  Mark place;
};

}  // namespace given

enum class DriftMethod { none, newman };

enum class RadiationMethod { none, database, direct };

namespace given {

/// A vessel afloat.
struct Vessel {
  Located<std::string> name;
  Located<std::string> model_name;
  std::shared_ptr<const pipeline::Vessel> model;  ///< after the look-up; null if it failed
  std::array<double, 2> position{};               ///< of its frame's origin, level, m
  double heading = 0;                             ///< of its x axis from the world's, rad
  std::optional<Located<double>> draught;         ///< of its frame's origin, m
  Located<RadiationMethod> radiation{RadiationMethod::database, {}};
  /// Of one that is lowered or lifted: from its lowest point, ascending, m.
  std::optional<Located<std::vector<double>>> draughts;
  std::optional<Located<std::string>> database;       ///< file beside the case
  std::optional<Located<std::string>> database_body;  ///< its name in the file
  /// After the look-up, and which of its bodies it is; null: computed by the panel method.
  std::shared_ptr<const dynamics::HydrodynamicDatabase> hydrodynamics;
  int hydrodynamic_body = 0;
  Located<DriftMethod> drift{DriftMethod::none, {}};
  std::string database_content;  ///< fingerprint of the file
  Damping damping, quadratic_damping;
  std::optional<CurrentLoad> current_load;
  std::optional<Restraint> restraint;
  std::optional<LinearBuoyancy> linear_buoyancy;  ///< none: of the hull as it lies
  std::vector<Member> members;
};

/// A heavy line from an anchor.
struct Mooring {
  Located<std::string> name;
  PointModel anchor;
  PointModel fairlead;
  Located<double> length;                                             ///< unstretched, m
  double submerged_mass = std::numeric_limits<double>::quiet_NaN();   ///< kg/m
  double axial_stiffness = std::numeric_limits<double>::quiet_NaN();  ///< N
  bool on_seabed = true;
  std::optional<double> breaking_load;  ///< N
};

/// A light straight line, of a winch that stands or of one that holds a tension.
struct Tugger {
  Located<std::string> name;
  PointModel from;
  PointModel to;
  std::optional<Located<double>> length;   ///< unstretched, m; none where a tension is held
  std::optional<double> stiffness;         ///< N/m; none where a tension is held
  std::optional<Located<double>> tension;  ///< that is held, N; none: the winch stands
  double damping = 0;                      ///< N s/m
  std::optional<double> breaking_load;     ///< N
};

}  // namespace given

/// What floats, in what, and how it is held; part of lift cases and of mechanism files. SI units.
struct MarineParts {
  std::optional<given::Sea> sea;
  std::vector<given::Vessel> vessels;
  std::vector<given::Mooring> moorings;
  std::vector<given::Tugger> tuggers;
  /// A load that makes waves while it is lowered into the water; null: there is none.
  std::shared_ptr<const Vessel> lowered_load;
  double deepest_draught_of_load = 0;  ///< from its lowest point, m

  const given::Vessel* find_vessel(const std::string& name) const;
};

Format<given::Sea> sea_format();
Format<given::Damping> vessel_damping_format();
Format<given::Damping> vessel_quadratic_damping_format();
Format<given::Vessel> vessel_in_case_format();
Format<given::Mooring> mooring_format();
Format<given::Tugger> tugger_format();

/// Declares the keys of the marine parts in the table of a case or mechanism.
template <class T>
void add_marine_keys(Table<T>& table) {
  table.optional("sea", &T::sea, sea_format(), "the water in which vessels float; none if left out")
      .optional("vessels", &T::vessels, named_tables(vessel_in_case_format()),
                "floating bodies, by name")
      .optional("moorings", &T::moorings, named_tables(mooring_format()),
                "heavy lines from anchors, by name")
      .optional("tuggers", &T::tuggers, named_tables(tugger_format()),
                "light straight lines of winches that stand, or hold a tension, by name");
}

class ModelLibrary;

/// Reads the vessels' models and databases and the record of the waves.
void load_marine_models(MarineParts& parts, const std::filesystem::path& beside,
                        ModelLibrary& library, Diagnostics& diagnostics);

/// Complains about vessels without a sea, seas that cannot be (waves that break, or are too short
/// for a hull's panels), vessels that do not float at their draught, and lines to bodies that do
/// not exist.
/// @param bodies names of all bodies besides the vessels; "world" exists always.
void check_marine_parts(const MarineParts& parts, double gravity,
                        const std::vector<std::string>& bodies, Diagnostics& diagnostics);

/// Complains about draughts (m, ascending, from the hull's lowest point) that the hull of `who`
/// does not reach, or too many of them.
void check_draughts(const std::string& who, const Located<std::vector<double>>& draughts,
                    const Vessel& vessel, Diagnostics& diagnostics);

/// The vessels' hulls where they lie at the start, upright, at their draught or by their own
/// weight. The parts are sound.
std::vector<PlacedHull> place_hulls(const MarineParts& parts);

/// The sea of the file, which has one; its waves at rest if `at_rest`. The parts are sound.
/// @throws dynamics::ModelError if they are not.
dynamics::Sea make_sea(const MarineParts& parts, double gravity, bool at_rest = false);

}  // namespace blocklift::pipeline
