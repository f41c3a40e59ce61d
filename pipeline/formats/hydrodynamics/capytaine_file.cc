#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string_view>

#include <fmt/format.h>

#include "dynamics/errors.h"
#include "dynamics/marine/radiation/retardation_from_damping.h"
#include "pipeline/formats/hydrodynamics/foreign_hydrodynamics.h"
#include "pipeline/formats/hydrodynamics/mirrored_headings.h"
#include "pipeline/formats/hydrodynamics/netcdf_file.h"
#include "pipeline/formats/hydrodynamics/radiation_check.h"
#include "pipeline/formats/read_apart.h"

namespace blocklift::pipeline {
namespace {

using dynamics::HydrodynamicDatabase;
using dynamics::modes_per_body;
using dynamics::Vector3;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Variable = NetcdfVariable;

class CapytaineFile {
 public:
  explicit CapytaineFile(const std::filesystem::path& path, const std::vector<WamitBody>& told = {})
      : path_(path), file_(path), told_(told) {}

  bool tells_rotation_centres() const {
    return file_.has("rotation_center") || file_.has("center_of_mass");
  }

  HydrodynamicDatabase read() {
    database_.water = {scalar("rho"), scalar("g"), scalar("water_depth")};
    require_rest();
    read_frequencies();
    read_modes();
    read_bodies();
    const auto modes = database_.mode_count();
    database_.added_mass.assign(database_.frequencies.size(), MatrixXd::Zero(modes, modes));
    database_.damping = database_.added_mass;
    read_radiation();
    read_forces();
    if (file_.has("hydrostatic_stiffness")) read_stiffness();
    add_retardation(database_);
    if (database_.infinite_added_mass.size() == 0) add_infinite_added_mass(database_);
    require_sound(database_);
    return std::move(database_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw HydrodynamicFileError(path_.string() + ": " + what);
  }

  Variable variable(const std::string& name) const {
    Variable result = file_.read(name);
    if (result.dimensions.size() != result.array.shape.size()) {
      fail("\"" + name + "\" has dimensions without names");
    }
    return result;
  }

  /// A variable whose dimensions, but for those of one place, are the named ones.
  Variable variable(const std::string& name, const std::map<std::string, std::size_t>& due) const {
    Variable result = variable(name);
    std::string wrong;
    for (std::size_t d = 0; d < result.dimensions.size(); ++d) {
      const auto named = due.find(result.dimensions[d]);
      const std::size_t extent = named == due.end() ? 1 : named->second;
      if (result.array.shape[d] != extent) {
        wrong += fmt::format(" {} = {} where {} is due", result.dimensions[d],
                             result.array.shape[d], extent);
      }
    }
    for (const auto& [dimension, extent] : due) {
      if (extent > 1 && std::find(result.dimensions.begin(), result.dimensions.end(), dimension) ==
                            result.dimensions.end()) {
        wrong += " lacks the dimension " + dimension;
      }
    }
    if (!wrong.empty()) fail("\"" + name + "\":" + wrong);
    return result;
  }

  double scalar(const std::string& name) const {
    const Array<double> array = file_.read(name).array;
    if (array.values.size() != 1) {
      fail(fmt::format("\"{}\" has {} values; a file of one water depth and density is due", name,
                       array.values.size()));
    }
    return array.values[0];
  }

  /// Under way the waves are met at another frequency, and the forces are other ones.
  void require_rest() const {
    if (!file_.has("forward_speed")) return;
    for (const double speed : file_.read("forward_speed").array.values) {
      if (speed != 0.0)
        fail(fmt::format("\"forward_speed\" is {:.6g} m/s; a body without speed is due", speed));
    }
  }

  /// Angular frequencies; of a file that leaves them out they follow from what it has instead.
  Variable angular_frequencies() const {
    constexpr double two_pi = 2.0 * std::numbers::pi;
    if (file_.has("omega")) return variable("omega");
    for (const char* const name : {"period", "freq"}) {
      if (!file_.has(name)) continue;
      Variable result = variable(name);
      const bool period = name == std::string_view("period");
      for (double& value : result.array.values) value = period ? two_pi / value : two_pi * value;
      return result;
    }
    fail("holds neither \"omega\" nor \"period\" nor \"freq\"");
  }

  void read_frequencies() {
    const Variable omega = angular_frequencies();
    if (omega.dimensions.size() > 1) fail("the frequencies have several dimensions");
    if (!omega.dimensions.empty()) frequency_dimension_ = omega.dimensions[0];
    place_count_ = omega.array.values.size();
    omega_ = omega.array.values;
    for (std::size_t k = 0; k < place_count_; ++k) {
      const double w = omega.array.values[k];
      if (std::isinf(w)) {
        infinite_place_ = static_cast<int>(k);
      } else if (w != 0.0) {
        places_.push_back(k);
      }
    }
    std::sort(places_.begin(), places_.end(), [&](std::size_t a, std::size_t b) {
      return omega.array.values[a] < omega.array.values[b];
    });
    for (const std::size_t place : places_) {
      database_.frequencies.push_back(omega.array.values[place]);
    }
  }

  /// Mode of a degree of freedom, "Heave" or "body__Heave"; a new body is added.
  Eigen::Index mode_of(const std::string& name, bool may_add) {
    static constexpr std::array<const char*, 6> names = {"Surge", "Sway",  "Heave",
                                                         "Roll",  "Pitch", "Yaw"};
    const std::size_t split = name.rfind("__");
    const std::string body = split == std::string::npos ? "body1" : name.substr(0, split);
    const std::string motion = split == std::string::npos ? name : name.substr(split + 2);
    const auto found = std::find(names.begin(), names.end(), motion);
    if (found == names.end()) {
      fail("the degree of freedom \"" + name +
           "\" is not of a rigid body: Surge, Sway, Heave, Roll, Pitch and Yaw are read");
    }
    auto& bodies = database_.body_names;
    auto place = std::find(bodies.begin(), bodies.end(), body);
    if (place == bodies.end()) {
      if (!may_add) fail("the degree of freedom \"" + name + "\" is influenced but never moved");
      place = bodies.insert(bodies.end(), body);
    }
    return modes_per_body * (place - bodies.begin()) + (found - names.begin());
  }

  void read_modes() {
    for (const std::string& name : file_.read_texts("radiating_dof")) {
      radiating_.push_back(mode_of(name, true));
    }
    for (const std::string& name : file_.read_texts("influenced_dof")) {
      influenced_.push_back(mode_of(name, false));
    }
  }

  void read_bodies() {
    const std::size_t bodies = database_.body_names.size();
    database_.displaced_volumes.assign(bodies, 0.0);
    if (file_.has("disp_volume") || file_.has("displaced_volume")) {
      const char* const name = file_.has("disp_volume") ? "disp_volume" : "displaced_volume";
      const std::vector<double> volumes = file_.read(name).array.values;
      if (volumes.size() == bodies) database_.displaced_volumes = volumes;
    }
    database_.centres_of_mass = points("center_of_mass");
    database_.centres_of_buoyancy = points("center_of_buoyancy");
    database_.reference_points = points("rotation_center");
    if (database_.reference_points.empty()) {
      database_.reference_points = database_.centres_of_mass;
    }
    if (!told_.empty()) take_told_points();
    if (database_.reference_points.empty()) {
      database_.reference_points.assign(bodies, Vector3::Zero());
    }
  }

  /// A point of each body, bodies along the first dimension or along the second; none without.
  std::vector<Vector3> points(const std::string& name) const {
    std::vector<Vector3> result;
    if (!file_.has(name)) return result;
    const Variable from = file_.read(name);
    const std::size_t bodies = database_.body_names.size();
    const std::vector<double>& values = from.array.values;
    const std::vector<std::size_t>& shape = from.array.shape;
    const bool fits = shape.size() != 2 || shape[0] + shape[1] == 3 + bodies;
    if (values.size() != 3 * bodies || !fits) {
      fail(fmt::format("\"{}\" has {} numbers; three for each of {} bodies are due", name,
                       values.size(), bodies));
    }
    const bool across = shape.size() == 2 && bodies > 1 && shape[0] == 3 &&
                        (bodies != 3 || (from.dimensions.size() == 2 &&
                                         from.dimensions[1].find("body") != std::string::npos));
    for (std::size_t b = 0; b < bodies; ++b) {
      const auto at = [&](std::size_t axis) {
        return values[across ? axis * bodies + b : 3 * b + axis];
      };
      result.emplace_back(at(0), at(1), at(2));
    }
    return result;
  }

  void take_told_points() {
    if (tells_rotation_centres())
      fail("tells itself what its rotations are about; leave --body-at out");
    if (told_.size() != database_.body_names.size()) {
      fail(fmt::format("holds {} bodies, and {} are placed by --body-at",
                       database_.body_names.size(), told_.size()));
    }
    for (const WamitBody& body : told_) {
      if (body.heading != 0.0)
        fail("Capytaine's modes are along the world's axes; leave the heading of --body-at out");
      database_.reference_points.push_back(body.p_W);
    }
  }

  void read_radiation() {
    const std::map<std::string, std::size_t> due = {{frequency_dimension_, place_count_},
                                                    {"radiating_dof", radiating_.size()},
                                                    {"influenced_dof", influenced_.size()}};
    const Variable mass = variable("added_mass", due), damping = variable("radiation_damping", due);
    const auto copy = [&](const Variable& from, std::size_t place, MatrixXd& to) {
      for (std::size_t r = 0; r < radiating_.size(); ++r) {
        for (std::size_t i = 0; i < influenced_.size(); ++i) {
          const double value =
              from.at({{frequency_dimension_, place}, {"radiating_dof", r}, {"influenced_dof", i}});
          if (std::isnan(value)) refuse_gap(place, r, i);
          to(influenced_[i], radiating_[r]) = value;
        }
      }
    };
    for (std::size_t k = 0; k < places_.size(); ++k) {
      copy(mass, places_[k], database_.added_mass[k]);
      copy(damping, places_[k], database_.damping[k]);
    }
    if (infinite_place_ < 0) return;
    const auto modes = database_.mode_count();
    database_.infinite_added_mass = MatrixXd::Zero(modes, modes);
    copy(mass, static_cast<std::size_t>(infinite_place_), database_.infinite_added_mass);
  }

  /// Datasets that are merged have no numbers where one of them lacks what the others have.
  [[noreturn]] void refuse_gap(std::size_t place, std::size_t radiating,
                               std::size_t influenced) const {
    fail(
        fmt::format("no number for the force on \"{}\" from \"{}\" at {:.6g} rad/s: not computed, "
                    "or lost as datasets were merged",
                    file_.read_texts("influenced_dof")[influenced],
                    file_.read_texts("radiating_dof")[radiating], omega_[place]));
  }

  /// The dimension along which a force's real and imaginary part lie.
  static std::string complex_dimension(const Variable& force) {
    const auto& names = force.dimensions;
    const bool short_name = std::find(names.begin(), names.end(), "reim") != names.end();
    return short_name ? "reim" : "complex";
  }

  /// Where along it the real part is: first, unless the dimension's own names say otherwise.
  std::size_t real_part(const std::string& dimension) const {
    if (!file_.has(dimension) || !file_.holds_texts(dimension)) return 0;
    const std::vector<std::string> names = file_.read_texts(dimension);
    const auto real = std::find(names.begin(), names.end(), "re");
    if (names.size() != 2 || real == names.end()) {
      fail("\"" + dimension + "\" does not name a real part \"re\" and an imaginary one");
    }
    return static_cast<std::size_t>(real - names.begin());
  }

  /// Adds a force, conjugated: the file's time factor is e^{-i w t}.
  void add_force(const std::string& name, std::vector<MatrixXcd>& force) const {
    const std::size_t headings = database_.headings.size();
    const std::string parts = complex_dimension(file_.read(name));
    const std::size_t real = real_part(parts);
    const Variable from = variable(name, {{frequency_dimension_, place_count_},
                                          {parts, 2},
                                          {"wave_direction", headings},
                                          {"influenced_dof", influenced_.size()}});
    for (std::size_t k = 0; k < places_.size(); ++k) {
      for (std::size_t h = 0; h < headings; ++h) {
        for (std::size_t i = 0; i < influenced_.size(); ++i) {
          const auto part = [&](std::size_t complex) {
            return from.at({{frequency_dimension_, places_[k]},
                            {parts, complex},
                            {"wave_direction", h},
                            {"influenced_dof", i}});
          };
          force[k](influenced_[i], static_cast<Eigen::Index>(h)) +=
              std::complex(part(real), -part(1 - real));
        }
      }
    }
  }

  void read_forces() {
    const bool apart = file_.has("Froude_Krylov_force") && file_.has("diffraction_force");
    const bool together = file_.has("excitation_force");
    if (apart || together) database_.headings = file_.read("wave_direction").array.values;
    database_.froude_krylov.assign(
        database_.frequencies.size(),
        MatrixXcd::Zero(database_.mode_count(), database_.headings.size()));
    database_.diffraction = database_.froude_krylov;
    if (apart) {
      add_force("Froude_Krylov_force", database_.froude_krylov);
      add_force("diffraction_force", database_.diffraction);
    } else if (together) {
      add_force("excitation_force", database_.diffraction);
    }
  }

  void read_stiffness() {
    const Variable from =
        variable("hydrostatic_stiffness",
                 {{"radiating_dof", radiating_.size()}, {"influenced_dof", influenced_.size()}});
    const auto modes = database_.mode_count();
    database_.hydrostatic_stiffness = MatrixXd::Zero(modes, modes);
    for (std::size_t r = 0; r < radiating_.size(); ++r) {
      for (std::size_t i = 0; i < influenced_.size(); ++i) {
        database_.hydrostatic_stiffness(influenced_[i], radiating_[r]) =
            from.at({{"radiating_dof", r}, {"influenced_dof", i}});
      }
    }
  }

  std::filesystem::path path_;
  NetcdfFile file_;
  std::vector<WamitBody> told_;  ///< where the bodies' axes lie, if the file need not tell it
  HydrodynamicDatabase database_;
  std::string frequency_dimension_ = "omega";
  std::size_t place_count_ = 0;
  std::vector<double> omega_;        ///< at each place, rad/s
  std::vector<std::size_t> places_;  ///< of the frequencies in the file, ascending
  int infinite_place_ = -1;
  std::vector<Eigen::Index> radiating_, influenced_;  ///< mode of each degree of freedom
};

}  // namespace

HydrodynamicDatabase read_capytaine(const std::filesystem::path& path,
                                    const std::vector<WamitBody>& bodies) {
  if (const auto death = death_of_reading(path, [&] { CapytaineFile(path, bodies).read(); }))
    throw HydrodynamicFileError(path.string() + ": is damaged: reading it " + *death);
  try {
    return CapytaineFile(path, bodies).read();
  } catch (const ResultsError& error) {
    throw HydrodynamicFileError(error.what());
  } catch (const dynamics::ModelError& error) {
    throw HydrodynamicFileError(path.string() + ": " + error.what());
  }
}

bool tells_rotation_centres(const std::filesystem::path& path) {
  try {
    return CapytaineFile(path).tells_rotation_centres();
  } catch (const ResultsError& error) {
    throw HydrodynamicFileError(error.what());
  }
}

HydrodynamicFile import_hydrodynamics(const std::filesystem::path& path,
                                      const WamitScales& scales) {
  const std::string ending = path.extension().string();
  const auto imported = [&](const char* program, HydrodynamicDatabase database) {
    try {
      require_passive(database);
    } catch (const dynamics::ModelError& error) {
      throw HydrodynamicFileError(path.string() + ": " + error.what());
    }
    const std::string planes = mirror_headings(database);
    const std::string origin =
        fmt::format("{}{}{} ({})", imported_from, path.filename().string(),
                    planes.empty() ? "" : ", headings mirrored in " + planes, program);
    return HydrodynamicFile{{}, origin, dynamics::make_series(0, {0.0}, {std::move(database)})};
  };
  if (ending == ".1" || ending == ".2" || ending == ".3" || ending == ".hst") {
    std::filesystem::path name = path;
    return imported("WAMIT", read_wamit(name.replace_extension(), scales));
  }
  if (ending == ".nc") return imported("Capytaine", read_capytaine(path, scales.bodies));
  if (!scales.bodies.empty()) {
    throw HydrodynamicFileError(path.string() +
                                ": tells itself where its bodies lie; --body-at is for WAMIT's");
  }
  if (ending == ".h5") {
    if (read_identity(path)) return read_hydrodynamic_file(path);
    return imported("BEMIO", read_bemio(path));
  }
  throw HydrodynamicFileError(
      path.string() + ": the ending \"" + ending +
      "\" is none of .h5 (BEMIO), .1, .2, .3, .hst (WAMIT), .nc (Capytaine)");
}

}  // namespace blocklift::pipeline
