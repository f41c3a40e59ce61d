#include "pipeline/formats/hydrodynamics/hydrodynamic_database_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "dynamics/errors.h"
#include "pipeline/formats/hydrodynamics/radiation_check.h"
#include "pipeline/formats/read_apart.h"
#include "pipeline/formats/results_store.h"

namespace blocklift::pipeline {
namespace {

using dynamics::HydrodynamicDatabase;
using dynamics::Vector3;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

constexpr const char* format_name = "blocklift hydrodynamic database";
constexpr double format_version = 1;
constexpr const char* waves_lost_group = "/waves_lost";

std::string state_group(std::size_t index) { return "/states/" + std::to_string(index); }

// ---------------------------------------------------------------------------------------- writing

/// The matrices one after the other, row by row, each number through `part`.
template <class Matrix, class Part>
void write_matrices(ResultsWriter& file, const std::string& dataset,
                    const std::vector<Matrix>& matrices, std::size_t rows, std::size_t columns,
                    const Part& part, const Meaning& meaning) {
  std::vector<double> values;
  values.reserve(matrices.size() * rows * columns);
  for (const Matrix& matrix : matrices) {
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
      for (Eigen::Index j = 0; j < matrix.cols(); ++j) values.push_back(part(matrix(i, j)));
    }
  }
  const std::array<std::size_t, 3> shape{matrices.size(), rows, columns};
  file.write_array(dataset, values, shape, meaning);
}

void write_complex(ResultsWriter& file, const std::string& group,
                   const std::vector<MatrixXcd>& matrices, std::size_t rows, std::size_t columns,
                   const Meaning& meaning) {
  using Complex = std::complex<double>;
  write_matrices(file, group + "/re", matrices, rows, columns, [](Complex x) { return x.real(); },
                 {meaning.units, meaning.description + ", real part"});
  write_matrices(file, group + "/im", matrices, rows, columns, [](Complex x) { return x.imag(); },
                 {meaning.units, meaning.description + ", imaginary part: Re x a exp(i w t)"});
}

void write_forces(ResultsWriter& file, const std::string& group,
                  const std::vector<MatrixXcd>& matrices, const HydrodynamicDatabase& database,
                  const std::string& what) {
  write_complex(file, group, matrices, static_cast<std::size_t>(database.mode_count()),
                database.headings.size(),
                {"N m-1", what + " by frequency, mode (N/m; rotations N) and heading"});
}

void write_drift(ResultsWriter& file, const std::string& group,
                 const HydrodynamicDatabase& database) {
  const auto modes = static_cast<std::size_t>(database.mode_count());
  const std::size_t headings = database.headings.size();
  if (!database.mean_drift.empty()) {
    write_matrices(file, group + "/mean_drift", database.mean_drift, modes, headings,
                   [](double x) { return x; },
                   {"N m-2",
                    "mean force in a wave of unit amplitude by frequency, mode (rotations: N m-1) "
                    "and heading"});
  }
  const dynamics::FarField& far = database.far_field;
  if (far.empty()) return;
  file.write(group + "/far_field/directions", std::span<const double>(far.directions),
             {"rad", "into which waves are sent"});
  write_complex(file, group + "/far_field/radiated", far.radiated, far.directions.size(), modes,
                {"m0.5", "far field of unit motion by frequency, direction and mode"});
  write_complex(file, group + "/far_field/scattered", far.scattered, far.directions.size(),
                headings, {"m0.5", "far field of held bodies by frequency, direction and heading"});
}

void write_state(ResultsWriter& file, const std::string& group,
                 const HydrodynamicDatabase& database, double draught) {
  const auto modes = static_cast<std::size_t>(database.mode_count());
  const auto same = [](double x) { return x; };
  file.write_attribute(group, "draught", draught);
  file.write_points(group + "/reference_points", database.reference_points,
                    {"m", "about which rotations and moments are taken, in the world"});
  if (!database.centres_of_buoyancy.empty()) {
    file.write_points(group + "/centres_of_buoyancy", database.centres_of_buoyancy,
                      {"m", "of the displaced volumes, in the world"});
  }
  if (!database.centres_of_mass.empty()) {
    file.write_points(group + "/centres_of_mass", database.centres_of_mass,
                      {"m", "of the bodies, in the world"});
  }
  file.write(group + "/displaced_volumes", std::span<const double>(database.displaced_volumes),
             {"m3", "at rest"});
  if (database.hydrostatic_stiffness.size() > 0) {
    file.write_matrix(
        group + "/hydrostatic_stiffness", database.hydrostatic_stiffness,
        {"N m-1", "restoring force by displacement, weight included (rotations: N, N m)"});
  }
  const auto write_errors = [&](const char* name, const Eigen::VectorXd& errors, const char* what) {
    if (errors.size() == 0) return;
    file.write(group + name,
               std::span<const double>(errors.data(), static_cast<std::size_t>(errors.size())),
               {"1", what});
  };
  write_errors("/change_from_coarser", database.change_from_coarser,
               "of each mode's radiation force, from panels of twice the size to these");
  write_errors("/excitation_change_from_coarser", database.excitation_change_from_coarser,
               "of the force of waves on each mode, of its largest, from panels of twice the size");
  write_errors("/cut_off_by_end", database.cut_off_by_end,
               "of each mode's radiation force, by the end of the impulse runs");
  file.write_matrix(group + "/infinite_added_mass", database.infinite_added_mass,
                    {"kg", "added mass at infinite frequency (rotations: kg m, kg m2)"});
  write_matrices(file, group + "/added_mass", database.added_mass, modes, modes, same,
                 {"kg", "by frequency, force mode and motion mode (rotations: kg m, kg m2)"});
  write_matrices(
      file, group + "/damping", database.damping, modes, modes, same,
      {"kg s-1", "by frequency, force mode and motion mode (rotations: kg m/s, kg m2/s)"});
  write_matrices(file, group + "/retardation", database.retardation, modes, modes, same,
                 {"kg s-2", "by time, force mode and motion mode (rotations: kg m/s2, kg m2/s2)"});
  file.write_attribute(group + "/retardation", "time_step", database.time_step);
  write_forces(file, group + "/froude_krylov", database.froude_krylov, database,
               "force of the undisturbed wave of unit amplitude");
  write_forces(file, group + "/diffraction", database.diffraction, database,
               "force of the wave's diffraction");
  write_drift(file, group, database);
}

void write_waves_lost(ResultsWriter& file, const WavesLost& lost) {
  file.make_group(waves_lost_group);
  file.write_attribute(waves_lost_group, "are", lost ? 1.0 : 0.0);
  if (!lost) return;
  file.write_attribute(waves_lost_group, "first", lost->first);
  file.write_attribute(waves_lost_group, "second", lost->second);
  file.write_attribute(waves_lost_group, "gap", lost->gap);
  file.write_attribute(waves_lost_group, "shortest", lost->shortest);
}

void write_all(const std::filesystem::path& path, const HydrodynamicFile& contents) {
  const HydrodynamicDatabase& first = contents.series.databases.front();
  ResultsWriter file(path);
  file.write_attribute("/", "format", format_name);
  file.write_attribute("/", "format_version", format_version);
  file.write_attribute("/", "identity", contents.identity);
  file.write_attribute("/", "origin", contents.origin);
  file.write_attribute("/", "lowered_body", contents.series.lowered_body);
  file.write_number("/water/density", first.water.density, {"kg m-3", "of the water"});
  file.write_number("/water/gravity", first.water.gravity, {"m s-2", "acceleration of gravity"});
  file.write_number("/water/depth", first.water.depth, {"m", "of the water; infinite: deep"});
  file.write_texts("/bodies/names", first.body_names, "in the order of the modes, six each");
  file.write("/frequencies", std::span<const double>(first.frequencies), {"rad s-1", "ascending"});
  file.write("/headings", std::span<const double>(first.headings),
             {"rad", "direction in which the waves travel, from x towards y"});
  for (std::size_t k = 0; k < contents.series.databases.size(); ++k) {
    write_state(file, state_group(k), contents.series.databases[k], contents.series.draughts[k]);
  }
  if (contents.waves_lost) write_waves_lost(file, *contents.waves_lost);
  file.finish();
}

// ---------------------------------------------------------------------------------------- reading

std::string text_of(const std::vector<std::size_t>& shape) {
  std::string text;
  for (const std::size_t extent : shape)
    text += (text.empty() ? "" : " x ") + std::to_string(extent);
  return text.empty() ? "a single number" : text;
}

/// Reads datasets of known shapes.
class Source {
 public:
  explicit Source(const std::filesystem::path& path) : path_(path), file_(path) {}

  const ResultsReader& file() const { return file_; }

  [[noreturn]] void fail(const std::string& what) const {
    throw HydrodynamicFileError(path_.string() + ": " + what);
  }

  /// Reads numbers of any number of rows, the rest of the shape given.
  std::vector<double> read(const std::string& dataset, const std::vector<std::size_t>& due) const {
    Array<double> array = file_.read(dataset);
    if (array.shape != due) {
      fail("\"" + dataset + "\" is " + text_of(array.shape) + " where " + text_of(due) + " is due");
    }
    return std::move(array.values);
  }

  std::vector<double> read_row(const std::string& dataset) const {
    Array<double> array = file_.read(dataset);
    if (array.shape.size() != 1) {
      fail("\"" + dataset + "\" is " + text_of(array.shape) + " where a row of numbers is due");
    }
    return std::move(array.values);
  }

  double number(const std::string& dataset) const { return read(dataset, {})[0]; }

  MatrixXd matrix(const std::string& dataset, std::size_t rows, std::size_t columns) const {
    const std::vector<double> values = read(dataset, {rows, columns});
    return Eigen::Map<const RowMajorMatrix>(values.data(), static_cast<Eigen::Index>(rows),
                                            static_cast<Eigen::Index>(columns));
  }

  std::vector<MatrixXd> matrices(const std::string& dataset, std::size_t count, std::size_t rows,
                                 std::size_t columns) const {
    const std::vector<double> values = read(dataset, {count, rows, columns});
    std::vector<MatrixXd> result;
    for (std::size_t k = 0; k < count; ++k) {
      result.emplace_back(Eigen::Map<const RowMajorMatrix>(values.data() + k * rows * columns,
                                                           static_cast<Eigen::Index>(rows),
                                                           static_cast<Eigen::Index>(columns)));
    }
    return result;
  }

  std::vector<MatrixXcd> complex(const std::string& group, std::size_t count, std::size_t rows,
                                 std::size_t columns) const {
    const auto re = matrices(group + "/re", count, rows, columns);
    const auto im = matrices(group + "/im", count, rows, columns);
    std::vector<MatrixXcd> result(count);
    for (std::size_t k = 0; k < count; ++k) {
      result[k].resize(re[k].rows(), re[k].cols());
      result[k].real() = re[k];
      result[k].imag() = im[k];
    }
    return result;
  }

  std::vector<Vector3> points(const std::string& dataset, std::size_t count) const {
    const MatrixXd matrix = this->matrix(dataset, count, 3);
    std::vector<Vector3> result;
    for (Eigen::Index k = 0; k < matrix.rows(); ++k) result.emplace_back(matrix.row(k));
    return result;
  }

 private:
  std::filesystem::path path_;
  ResultsReader file_;
};

void require_format(const Source& source) {
  const ResultsReader& file = source.file();
  if (!file.has_attribute("/", "format") ||
      file.read_text_attribute("/", "format") != format_name) {
    source.fail(
        "is not a hydrodynamic database of blocklift; files of other programs are taken over by "
        "\"blocklift hydro --import FILE -o db.h5\"");
  }
  const double version = file.read_number_attribute("/", "format_version");
  if (version != format_version) {
    source.fail("has version " + std::to_string(static_cast<int>(version)) +
                " of the format; this program reads version " +
                std::to_string(static_cast<int>(format_version)));
  }
}

HydrodynamicDatabase read_state(const Source& source, const std::string& group,
                                HydrodynamicDatabase database) {
  const std::size_t bodies = database.body_names.size(), modes = dynamics::modes_per_body * bodies;
  const std::size_t frequencies = database.frequencies.size();
  const std::size_t headings = database.headings.size();
  database.reference_points = source.points(group + "/reference_points", bodies);
  for (auto [name, points] : {std::pair{"/centres_of_buoyancy", &database.centres_of_buoyancy},
                              std::pair{"/centres_of_mass", &database.centres_of_mass}}) {
    if (source.file().has(group + name)) *points = source.points(group + name, bodies);
  }
  database.displaced_volumes = source.read(group + "/displaced_volumes", {bodies});
  if (source.file().has(group + "/hydrostatic_stiffness")) {
    database.hydrostatic_stiffness = source.matrix(group + "/hydrostatic_stiffness", modes, modes);
  }
  for (auto [name, errors] :
       {std::pair{"/change_from_coarser", &database.change_from_coarser},
        std::pair{"/excitation_change_from_coarser", &database.excitation_change_from_coarser},
        std::pair{"/cut_off_by_end", &database.cut_off_by_end}}) {
    if (!source.file().has(group + name)) continue;
    const std::vector<double> found = source.read(group + name, {modes});
    *errors = Eigen::Map<const Eigen::VectorXd>(found.data(), static_cast<Eigen::Index>(modes));
  }
  database.infinite_added_mass = source.matrix(group + "/infinite_added_mass", modes, modes);
  database.added_mass = source.matrices(group + "/added_mass", frequencies, modes, modes);
  database.damping = source.matrices(group + "/damping", frequencies, modes, modes);
  const std::string retardation = group + "/retardation";
  const Array<double> samples = source.file().read(retardation);
  database.retardation = source.matrices(retardation, samples.rows(), modes, modes);
  database.time_step = source.file().read_number_attribute(retardation, "time_step");
  database.froude_krylov = source.complex(group + "/froude_krylov", frequencies, modes, headings);
  database.diffraction = source.complex(group + "/diffraction", frequencies, modes, headings);
  if (source.file().has(group + "/mean_drift")) {
    database.mean_drift = source.matrices(group + "/mean_drift", frequencies, modes, headings);
  }
  const std::string far = group + "/far_field";
  if (source.file().has(far)) {
    database.far_field.directions = source.read_row(far + "/directions");
    const std::size_t directions = database.far_field.directions.size();
    database.far_field.radiated = source.complex(far + "/radiated", frequencies, directions, modes);
    database.far_field.scattered =
        source.complex(far + "/scattered", frequencies, directions, headings);
  }
  return database;
}

/// None where the file does not tell, or what it tells is of no use for so many bodies.
std::optional<WavesLost> read_waves_lost(const ResultsReader& file, std::size_t bodies) {
  if (!file.has(waves_lost_group)) return std::nullopt;
  const auto number = [&](const char* name) {
    return file.has_attribute(waves_lost_group, name)
               ? file.read_number_attribute(waves_lost_group, name)
               : dynamics::not_a_number;
  };
  if (number("are") == 0.0) return WavesLost{};
  const double first = number("first"), second = number("second");
  const auto is_body = [&](double body) {
    return body >= 0.0 && body < static_cast<double>(bodies) && body == std::floor(body);
  };
  const double gap = number("gap"), shortest = number("shortest");
  const bool is_sound = number("are") == 1.0 && is_body(first) && is_body(second) && gap >= 0.0 &&
                        shortest > 0.0 && std::isfinite(gap + shortest);
  if (!is_sound) return std::nullopt;
  return WavesLost(
      dynamics::CouplingReach{static_cast<int>(first), static_cast<int>(second), gap, shortest});
}

HydrodynamicFile read_all(const Source& source) {
  require_format(source);
  HydrodynamicFile result;
  result.identity = source.file().read_text_attribute("/", "identity");
  result.origin = source.file().read_text_attribute("/", "origin");
  HydrodynamicDatabase common;
  common.water = {source.number("/water/density"), source.number("/water/gravity"),
                  source.number("/water/depth")};
  common.body_names = source.file().read_texts("/bodies/names");
  common.frequencies = source.read_row("/frequencies");
  common.headings = source.read_row("/headings");
  std::vector<double> draughts;
  std::vector<HydrodynamicDatabase> databases;
  for (std::size_t k = 0; source.file().has(state_group(k)); ++k) {
    draughts.push_back(source.file().read_number_attribute(state_group(k), "draught"));
    databases.push_back(read_state(source, state_group(k), common));
  }
  const double lowered = source.file().read_number_attribute("/", "lowered_body");
  if (!(lowered >= 0.0 && lowered < static_cast<double>(common.body_names.size()))) {
    source.fail("the attribute lowered_body is no body's number");
  }
  // Older programs imported what is refused today. What was computed here is not held to it: where
  // water swings between hulls, damping may come out below zero.
  if (result.origin.starts_with(imported_from))
    std::for_each(databases.begin(), databases.end(), require_passive);
  result.waves_lost = read_waves_lost(source.file(), common.body_names.size());
  result.series = make_series(static_cast<int>(lowered), std::move(draughts), std::move(databases));
  return result;
}

}  // namespace

void write_hydrodynamic_file(const std::filesystem::path& path, const HydrodynamicFile& file) {
  try {
    HydrodynamicFile checked = file;
    checked.series =
        make_series(file.series.lowered_body, file.series.draughts, file.series.databases);
    write_all(path, checked);
  } catch (const std::runtime_error& error) {
    throw HydrodynamicFileError("cannot write the hydrodynamic database " + path.string() + ": " +
                                error.what());
  }
}

HydrodynamicFile read_hydrodynamic_file(const std::filesystem::path& path) {
  if (const auto death = death_of_reading(path, [&] { read_all(Source(path)); })) {
    throw HydrodynamicFileError(path.string() + ": is damaged: reading it " + *death);
  }
  try {
    return read_all(Source(path));
  } catch (const ResultsError& error) {
    throw HydrodynamicFileError(error.what());
  } catch (const dynamics::ModelError& error) {
    throw HydrodynamicFileError(path.string() + ": " + error.what());
  }
}

void write_hydrodynamic_database(const std::filesystem::path& path,
                                 const dynamics::HydrodynamicDatabase& database,
                                 const std::string& identity, const std::string& origin) {
  write_hydrodynamic_file(path, {identity, origin, {0, {0.0}, {database}}});
}

dynamics::HydrodynamicDatabase read_hydrodynamic_database(const std::filesystem::path& path) {
  HydrodynamicFile file = read_hydrodynamic_file(path);
  if (file.series.databases.size() > 1) {
    throw HydrodynamicFileError(path.string() + ": holds " +
                                std::to_string(file.series.databases.size()) +
                                " draughts where a single database is due");
  }
  return std::move(file.series.databases.front());
}

std::optional<std::string> read_identity(const std::filesystem::path& path) {
  const auto read = [&] {
    const Source source(path);
    require_format(source);
    return source.file().read_text_attribute("/", "identity");
  };
  if (death_of_reading(path, [&] { read(); })) return std::nullopt;
  try {
    return read();
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
}

}  // namespace blocklift::pipeline
