#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include <fmt/format.h>

#include "dynamics/errors.h"
#include "dynamics/marine/radiation/reference_points.h"
#include "dynamics/marine/radiation/retardation_from_damping.h"
#include "pipeline/formats/hydrodynamics/foreign_hydrodynamics.h"
#include "pipeline/formats/read_apart.h"
#include "pipeline/formats/results_store.h"

namespace blocklift::pipeline {
namespace {

using dynamics::HydrodynamicDatabase;
using dynamics::modes_per_body;
using dynamics::Vector3;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

constexpr const char* simulation = "/simulation_parameters/";

std::string body_group(std::size_t body) { return "/body" + std::to_string(body + 1); }

// ---------------------------------------------------------------------------------------- reading

class BemioFile {
 public:
  explicit BemioFile(const std::filesystem::path& path) : path_(path), file_(path) {}

  HydrodynamicDatabase read() {
    database_.water.density = number(simulation + std::string("rho"));
    database_.water.gravity = number(simulation + std::string("g"));
    database_.water.depth = depth();
    scaled_ = is_scaled();
    database_.frequencies = row(simulation + std::string("w"));
    for (const double heading : row(simulation + std::string("wave_dir"))) {
      database_.headings.push_back(heading * degree);
    }
    while (file_.has(body_group(bodies_))) ++bodies_;
    if (bodies_ == 0) fail("holds no group /body1");
    allocate();
    for (std::size_t b = 0; b < bodies_; ++b) read_body(b);
    read_mean_drift();
    forget_unknown_places();
    if (database_.retardation.empty()) add_retardation(database_);
    require_sound(database_);
    return std::move(database_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw HydrodynamicFileError(path_.string() + ": " + what);
  }

  std::vector<double> row(const std::string& dataset) const { return file_.read(dataset).values; }

  double number(const std::string& dataset) const {
    const std::vector<double> values = row(dataset);
    if (values.size() != 1) {
      fail(fmt::format("\"{}\" holds {} numbers where one is due", dataset, values.size()));
    }
    return values[0];
  }

  /// Deep water is the word "infinite".
  double depth() const {
    const std::string dataset = simulation + std::string("water_depth");
    try {
      return number(dataset);
    } catch (const ResultsError&) {
      const std::string text = file_.read_text(dataset);
      if (text != "infinite") fail("the water depth is \"" + text + "\"");
      return std::numeric_limits<double>::infinity();
    }
  }

  bool is_scaled() const {
    const std::string dataset = simulation + std::string("scaled");
    if (!file_.has(dataset)) return false;
    try {
      return number(dataset) != 0.0;
    } catch (const ResultsError&) {
      const std::string text = file_.read_text(dataset);
      return text == "True" || text == "true";
    }
  }

  void allocate() {
    const auto modes = static_cast<Eigen::Index>(modes_per_body * bodies_);
    const std::size_t count = database_.frequencies.size();
    database_.infinite_added_mass = MatrixXd::Zero(modes, modes);
    database_.hydrostatic_stiffness = MatrixXd::Zero(modes, modes);
    database_.added_mass.assign(count, MatrixXd::Zero(modes, modes));
    database_.damping = database_.added_mass;
    database_.froude_krylov.assign(count, MatrixXcd::Zero(modes, database_.headings.size()));
    database_.diffraction = database_.froude_krylov;
  }

  /// The rows of one body from [6, columns, depth], each number through `store(row, column, k, x)`.
  template <class Store>
  void read_rows(const std::string& dataset, std::size_t columns, std::size_t depth,
                 const Store& store) const {
    const Array<double> array = file_.read(dataset);
    if (array.values.size() != modes_per_body * columns * depth || array.rows() != modes_per_body) {
      std::string shape;
      for (const std::size_t extent : array.shape)
        shape += (shape.empty() ? "" : " x ") + std::to_string(extent);
      fail(fmt::format("\"{}\" is {} where 6 x {} x {} is due", dataset, shape, columns, depth));
    }
    std::size_t place = 0;
    for (Eigen::Index i = 0; i < modes_per_body; ++i) {
      for (std::size_t j = 0; j < columns; ++j) {
        for (std::size_t k = 0; k < depth; ++k) {
          store(i, static_cast<Eigen::Index>(j), k, array.values[place++]);
        }
      }
    }
  }

  Vector3 point(const std::string& dataset) const {
    const std::vector<double> values = row(dataset);
    if (values.size() != 3) fail("\"" + dataset + "\" is no point");
    return {values[0], values[1], values[2]};
  }

  void read_body(std::size_t b) {
    const std::string properties = body_group(b) + "/properties/";
    const std::string coefficients = body_group(b) + "/hydro_coeffs/";
    database_.body_names.push_back(file_.read_text(properties + "name"));
    database_.centres_of_buoyancy.push_back(point(properties + "cb"));
    database_.centres_of_mass.push_back(point(properties + "cg"));
    database_.reference_points.push_back(database_.centres_of_mass.back());
    database_.displaced_volumes.push_back(number(properties + "disp_vol"));
    read_radiation(b, coefficients);
    read_memory(b, coefficients + "radiation_damping/impulse_response_fun/");
    read_excitation(b, coefficients + "excitation/");
  }

  /// Programs that do not know volumes and centres write zeros. Motions are about cg in any case,
  /// but weight and buoyancy act where these say only if a body displaces something.
  void forget_unknown_places() {
    const std::vector<double>& volumes = database_.displaced_volumes;
    if (std::all_of(volumes.begin(), volumes.end(), [](double volume) { return volume > 0.0; }))
      return;
    database_.centres_of_buoyancy.clear();
    database_.centres_of_mass.clear();
  }

  void read_radiation(std::size_t b, const std::string& group) {
    const double rho = scaled_ ? 1.0 : database_.water.density;
    const double rho_g = scaled_ ? 1.0 : rho * database_.water.gravity;
    const auto first = static_cast<Eigen::Index>(modes_per_body * b);
    const std::size_t modes = modes_per_body * bodies_, count = database_.frequencies.size();
    read_rows(group + "linear_restoring_stiffness", modes_per_body, 1,
              [&](Eigen::Index i, Eigen::Index j, std::size_t, double x) {
                database_.hydrostatic_stiffness(first + i, first + j) = rho_g * x;
              });
    read_rows(group + "added_mass/inf_freq", modes, 1,
              [&](Eigen::Index i, Eigen::Index j, std::size_t, double x) {
                database_.infinite_added_mass(first + i, j) = rho * x;
              });
    read_rows(group + "added_mass/all", modes, count,
              [&](Eigen::Index i, Eigen::Index j, std::size_t k, double x) {
                database_.added_mass[k](first + i, j) = rho * x;
              });
    read_rows(group + "radiation_damping/all", modes, count,
              [&](Eigen::Index i, Eigen::Index j, std::size_t k, double x) {
                database_.damping[k](first + i, j) =
                    (scaled_ ? 1.0 : rho * database_.frequencies[k]) * x;
              });
  }

  /// Retardation functions, where the file has them at equal steps from 0.
  void read_memory(std::size_t b, const std::string& group) {
    if (!file_.has(group + "K") || !file_.has(group + "t")) return;
    const std::vector<double> t = row(group + "t");
    if (t.size() < 2 || t[0] != 0.0) fail("\"" + group + "t\" does not run from 0");
    const double step = t.back() / static_cast<double>(t.size() - 1);
    for (std::size_t n = 0; n < t.size(); ++n) {
      if (std::abs(t[n] - step * static_cast<double>(n)) > 1e-6 * t.back()) {
        fail("\"" + group + "t\" is not at equal steps");
      }
    }
    const auto modes = static_cast<Eigen::Index>(modes_per_body * bodies_);
    if (b == 0) {
      database_.time_step = t[1];
      database_.retardation.assign(t.size(), MatrixXd::Zero(modes, modes));
    }
    const double rho = scaled_ ? 1.0 : database_.water.density;
    read_rows(group + "K", modes_per_body * bodies_, database_.retardation.size(),
              [&](Eigen::Index i, Eigen::Index j, std::size_t n, double x) {
                database_.retardation[n](static_cast<Eigen::Index>(modes_per_body * b) + i, j) =
                    rho * x;
              });
  }

  void read_force(std::size_t b, const std::string& group, std::vector<MatrixXcd>& force) {
    const double rho_g = scaled_ ? 1.0 : database_.water.density * database_.water.gravity;
    const auto first = static_cast<Eigen::Index>(modes_per_body * b);
    const std::complex<double> parts[] = {{1.0, 0.0}, {0.0, 1.0}};
    for (int part = 0; part < 2; ++part) {
      read_rows(group + (part == 0 ? "re" : "im"), database_.headings.size(),
                database_.frequencies.size(),
                [&](Eigen::Index i, Eigen::Index h, std::size_t k, double x) {
                  force[k](first + i, h) += parts[part] * (rho_g * x);
                });
    }
  }

  void read_excitation(std::size_t b, const std::string& group) {
    if (database_.headings.empty()) return;
    if (!file_.has(group + "froude-krylov/re") || !file_.has(group + "scattering/re")) {
      read_force(b, group, database_.diffraction);
      return;
    }
    read_force(b, group + "froude-krylov/", database_.froude_krylov);
    read_force(b, group + "scattering/", database_.diffraction);
    if (file_.has(group + "re")) hold_against_whole(b, group);
  }

  /// Programs that do not divide the excitation leave its parts zero: the whole is taken then.
  void hold_against_whole(std::size_t b, const std::string& group) {
    constexpr double largest_difference = 0.02;
    const auto first = static_cast<Eigen::Index>(modes_per_body * b);
    std::vector<MatrixXcd> whole(
        database_.frequencies.size(),
        MatrixXcd::Zero(database_.mode_count(), database_.headings.size()));
    read_force(b, group, whole);
    double parts = 0.0;
    std::array<double, 2> largest{}, difference{};  // of displacements and rotations
    for (std::size_t k = 0; k < whole.size(); ++k) {
      for (std::size_t kind = 0; kind < 2; ++kind) {
        const Eigen::Index row = first + 3 * static_cast<Eigen::Index>(kind);
        const MatrixXcd given = whole[k].middleRows<3>(row);
        const MatrixXcd rest = given - database_.froude_krylov[k].middleRows<3>(row) -
                               database_.diffraction[k].middleRows<3>(row);
        largest[kind] = std::max(largest[kind], given.cwiseAbs().maxCoeff());
        difference[kind] = std::max(difference[kind], rest.cwiseAbs().maxCoeff());
      }
      parts =
          std::max({parts, database_.froude_krylov[k].middleRows<6>(first).cwiseAbs().maxCoeff(),
                    database_.diffraction[k].middleRows<6>(first).cwiseAbs().maxCoeff()});
    }
    if (parts == 0.0) return read_force(b, group, database_.diffraction);
    for (std::size_t kind = 0; kind < 2; ++kind) {
      if (!(difference[kind] > largest_difference * largest[kind])) continue;
      fail(fmt::format(
          "the parts of \"{}\", froude-krylov and scattering, add up to {} that are "
          "{:.3g} % of the largest off the whole, re and im",
          group, kind == 0 ? "forces" : "moments", 100.0 * difference[kind] / largest[kind]));
    }
  }

  /// By the method that all bodies have: that of a control surface or of the pressure tells bodies
  /// apart, that of momentum does not.
  void read_mean_drift() {
    if (database_.headings.empty()) return;
    for (const char* method :
         {"control_surface", "pressure_integration", "momentum_conservation"}) {
      const auto dataset = [&](std::size_t b) {
        return body_group(b) + "/hydro_coeffs/mean_drift/" + method + "/val";
      };
      bool whole = bodies_ == 1 || method != std::string_view("momentum_conservation");
      for (std::size_t b = 0; b < bodies_; ++b) whole = whole && file_.has(dataset(b));
      if (!whole) continue;
      const auto headings = static_cast<Eigen::Index>(database_.headings.size());
      database_.mean_drift.assign(database_.frequencies.size(),
                                  MatrixXd::Zero(modes_per_body * bodies_, headings));
      const double rho_g = scaled_ ? 1.0 : database_.water.density * database_.water.gravity;
      for (std::size_t b = 0; b < bodies_; ++b) {
        const auto first = static_cast<Eigen::Index>(modes_per_body * b);
        read_rows(dataset(b), database_.headings.size(), database_.frequencies.size(),
                  [&](Eigen::Index i, Eigen::Index h, std::size_t k, double x) {
                    database_.mean_drift[k](first + i, h) = rho_g * x;
                  });
      }
      return;
    }
  }

  std::filesystem::path path_;
  ResultsReader file_;
  HydrodynamicDatabase database_;
  std::size_t bodies_ = 0;
  bool scaled_ = false;
};

// ---------------------------------------------------------------------------------------- writing

/// [6, columns, depth] of the values that `value(row, column, k)` gives.
template <class Value>
void write_rows(ResultsWriter& file, const std::string& dataset, std::size_t columns,
                std::size_t depth, const Value& value, const char* description) {
  std::vector<double> values;
  for (Eigen::Index i = 0; i < modes_per_body; ++i) {
    for (std::size_t j = 0; j < columns; ++j) {
      for (std::size_t k = 0; k < depth; ++k) {
        values.push_back(value(i, static_cast<Eigen::Index>(j), k));
      }
    }
  }
  const std::size_t shape[] = {modes_per_body, columns, depth};
  file.write_array(dataset, values, shape, {"1", description});
}

void write_force(ResultsWriter& file, const std::string& group, Eigen::Index first,
                 const HydrodynamicDatabase& database, const std::vector<MatrixXcd>& force) {
  const double rho_g = database.water.density * database.water.gravity;
  const auto write = [&](const char* name, const auto& part, const char* description) {
    write_rows(
        file, group + name, database.headings.size(), database.frequencies.size(),
        [&](Eigen::Index i, Eigen::Index h, std::size_t k) {
          return part(force[k](first + i, h) / rho_g);
        },
        description);
  };
  using Complex = std::complex<double>;
  write(
      "re", [](Complex x) { return x.real(); }, "over rho g, real part");
  write(
      "im", [](Complex x) { return x.imag(); }, "over rho g, imaginary part");
  write(
      "mag", [](Complex x) { return std::abs(x); }, "over rho g, modulus");
  write(
      "phase", [](Complex x) { return std::arg(x); }, "rad");
}

/// Without these WEC-Sim would have bodies without buoyancy, turning about wrong points.
void require_places(const std::filesystem::path& path, const HydrodynamicDatabase& database) {
  std::vector<std::string> missing;
  const std::vector<double>& volumes = database.displaced_volumes;
  if (!std::all_of(volumes.begin(), volumes.end(), [](double volume) { return volume > 0.0; }))
    missing.emplace_back("displaced volumes (disp_vol)");
  if (database.centres_of_buoyancy.empty()) missing.emplace_back("centres of buoyancy (cb)");
  if (database.centres_of_mass.empty()) missing.emplace_back("centres of mass (cg)");
  if (missing.empty()) return;
  throw HydrodynamicFileError(
      fmt::format("{}: cannot be written as BEMIO: the database does not tell its bodies' {}",
                  path.string(), fmt::join(missing, ", ")));
}

void write_properties(ResultsWriter& file, std::size_t b, const HydrodynamicDatabase& database) {
  const std::string group = body_group(b) + "/properties/";
  const auto point = [&](const char* name, const Vector3& p) {
    const std::size_t shape[] = {3, 1};
    file.write_array(group + name, std::span(p.data(), 3), shape, {"m", "in the world"});
  };
  file.write_text(group + "name", database.body_names[b], "of the body");
  file.write_number(group + "body_number", static_cast<double>(b + 1), {"1", "from 1"});
  point("cb", database.centres_of_buoyancy[b]);
  point("cg", database.centres_of_mass[b]);
  file.write_number(group + "disp_vol", database.displaced_volumes[b], {"m3", "displaced"});
}

void write_coefficients(ResultsWriter& file, std::size_t b, const HydrodynamicDatabase& database) {
  const std::string group = body_group(b) + "/hydro_coeffs/";
  const auto first = static_cast<Eigen::Index>(modes_per_body * b);
  const auto modes = static_cast<std::size_t>(database.mode_count());
  const std::size_t count = database.frequencies.size();
  const double rho = database.water.density, rho_g = rho * database.water.gravity;
  write_rows(
      file, group + "linear_restoring_stiffness", modes_per_body, 1,
      [&](Eigen::Index i, Eigen::Index j, std::size_t) {
        return database.hydrostatic_stiffness.size() == 0
                   ? 0.0
                   : database.hydrostatic_stiffness(first + i, first + j) / rho_g;
      },
      "over rho g");
  write_rows(
      file, group + "added_mass/inf_freq", modes, 1,
      [&](Eigen::Index i, Eigen::Index j, std::size_t) {
        return database.infinite_added_mass(first + i, j) / rho;
      },
      "over rho");
  write_rows(
      file, group + "added_mass/all", modes, count,
      [&](Eigen::Index i, Eigen::Index j, std::size_t k) {
        return database.added_mass[k](first + i, j) / rho;
      },
      "over rho");
  write_rows(
      file, group + "radiation_damping/all", modes, count,
      [&](Eigen::Index i, Eigen::Index j, std::size_t k) {
        return database.damping[k](first + i, j) / (rho * database.frequencies[k]);
      },
      "over rho w");
  const std::string memory = group + "radiation_damping/impulse_response_fun/";
  write_rows(
      file, memory + "K", modes, database.retardation.size(),
      [&](Eigen::Index i, Eigen::Index j, std::size_t n) {
        return database.retardation[n](first + i, j) / rho;
      },
      "over rho");
  std::vector<double> times;
  for (std::size_t n = 0; n < database.retardation.size(); ++n) {
    times.push_back(static_cast<double>(n) * database.time_step);
  }
  file.write(memory + "t", std::span<const double>(times), {"s", "of K"});
  if (database.headings.empty()) return;
  std::vector<MatrixXcd> sum;
  for (std::size_t k = 0; k < count; ++k) sum.push_back(database.excitation(k));
  write_force(file, group + "excitation/", first, database, sum);
  write_force(file, group + "excitation/froude-krylov/", first, database, database.froude_krylov);
  write_force(file, group + "excitation/scattering/", first, database, database.diffraction);
  if (database.mean_drift.empty()) return;
  // Where bodies are told apart, momentum far away has not done it.
  const std::string method =
      database.body_count() == 1 ? "momentum_conservation" : "control_surface";
  write_rows(
      file, group + "mean_drift/" + method + "/val", database.headings.size(), count,
      [&](Eigen::Index i, Eigen::Index h, std::size_t k) {
        return database.mean_drift[k](first + i, h) / rho_g;
      },
      "over rho g");
}

}  // namespace

HydrodynamicDatabase read_bemio(const std::filesystem::path& path) {
  if (const auto death = death_of_reading(path, [&] { BemioFile(path).read(); }))
    throw HydrodynamicFileError(path.string() + ": is damaged: reading it " + *death);
  try {
    return BemioFile(path).read();
  } catch (const ResultsError& error) {
    throw HydrodynamicFileError(error.what());
  } catch (const dynamics::ModelError& error) {
    throw HydrodynamicFileError(path.string() + ": " + error.what());
  }
}

void write_bemio(const std::filesystem::path& path, const HydrodynamicDatabase& given) {
  require_places(path, given);
  const HydrodynamicDatabase database = about_points(given, given.centres_of_mass);
  ResultsWriter file(path);
  const std::string group = simulation;
  file.write_number(group + "rho", database.water.density, {"kg m-3", "of the water"});
  file.write_number(group + "g", database.water.gravity, {"m s-2", "gravity"});
  if (std::isinf(database.water.depth)) {
    file.write_text(group + "water_depth", "infinite", "deep water");
  } else {
    file.write_number(group + "water_depth", database.water.depth, {"m", "of the water"});
  }
  file.write_number(group + "scaled", 0.0, {"1", "0: coefficients over rho, g and frequency"});
  std::vector<double> periods, headings;
  for (const double w : database.frequencies) periods.push_back(2.0 * std::numbers::pi / w);
  for (const double heading : database.headings) headings.push_back(heading / degree);
  file.write(group + "w", std::span<const double>(database.frequencies), {"rad s-1", "ascending"});
  file.write(group + "T", std::span<const double>(periods), {"s", "2 pi / w"});
  file.write(group + "wave_dir", std::span<const double>(headings), {"degree", "of travel"});
  for (std::size_t b = 0; b < database.body_names.size(); ++b) {
    write_properties(file, b, database);
    write_coefficients(file, b, database);
  }
  file.finish();
}

}  // namespace blocklift::pipeline
