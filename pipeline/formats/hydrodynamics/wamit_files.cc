#include <algorithm>
#include <cctype>
#include <cmath>
#include <complex>
#include <fstream>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>

#include <fmt/format.h>

#include "dynamics/errors.h"
#include "dynamics/marine/radiation/reference_points.h"
#include "dynamics/marine/radiation/retardation_from_damping.h"
#include "pipeline/formats/atomic_file.h"
#include "pipeline/formats/hydrodynamics/foreign_hydrodynamics.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;
using dynamics::HydrodynamicDatabase;
using dynamics::modes_per_body;
using Eigen::MatrixXd;

constexpr double two_pi = 2.0 * std::numbers::pi;

fs::path with_ending(const fs::path& name, const char* ending) { return name.string() + ending; }

bool is_rotation(Eigen::Index mode) { return mode % modes_per_body >= 3; }
/// 0 for displacements, 1 mixed, 2 for rotations.
int rotations(Eigen::Index i, Eigen::Index j) {
  return (is_rotation(i) ? 1 : 0) + (is_rotation(j) ? 1 : 0);
}

// What the numbers of the files are to be multiplied by; L is ULEN, m.

/// rho L^k, of added mass, and with the frequency of damping.
double radiation_scale(const dynamics::Water& water, double L, Eigen::Index i, Eigen::Index j) {
  return water.density * std::pow(L, 3 + rotations(i, j));
}
/// rho g L^m, m = 2 or 3.
double excitation_scale(const dynamics::Water& water, double L, Eigen::Index mode) {
  return water.density * water.gravity * std::pow(L, is_rotation(mode) ? 3 : 2);
}
/// Of a mean drift force: a power less.
double drift_scale(const dynamics::Water& water, double L, Eigen::Index mode) {
  return excitation_scale(water, L, mode) / L;
}
/// rho g L^(k-1).
double stiffness_scale(const dynamics::Water& water, double L, Eigen::Index i, Eigen::Index j) {
  return water.density * water.gravity * std::pow(L, 2 + rotations(i, j));
}

/// A line of numbers with its place.
struct Line {
  int number;
  std::vector<double> values;
};

class TextFile {
 public:
  explicit TextFile(fs::path path) : path_(std::move(path)) {}

  [[noreturn]] void fail(int line, const std::string& what) const {
    throw HydrodynamicFileError(fmt::format("{}:{}: {}", path_.string(), line, what));
  }

  /// Lines of numbers; a first line that is text is a heading.
  std::vector<Line> lines() const {
    std::ifstream stream(path_);
    if (!stream) throw HydrodynamicFileError(path_.string() + ": cannot be opened");
    std::vector<Line> lines;
    std::string text;
    for (int number = 1; std::getline(stream, text); ++number) {
      std::istringstream words(text);
      Line line{number, {}};
      std::string word;
      while (words >> word) {
        std::optional<double> value = parse(word);
        if (!value && number == 1) break;
        if (!value) fail(number, "\"" + word + "\" is no number");
        if (!std::isfinite(*value)) fail(number, "\"" + word + "\" is not finite");
        line.values.push_back(*value);
      }
      if (!line.values.empty()) lines.push_back(std::move(line));
    }
    if (lines.empty()) throw HydrodynamicFileError(path_.string() + ": holds no numbers");
    return lines;
  }

  void require_columns(const Line& line, std::size_t fewest, std::size_t most,
                       const char* what) const {
    if (line.values.size() >= fewest && line.values.size() <= most) return;
    fail(line.number, fmt::format("{} numbers where {} are due", line.values.size(), what));
  }

  /// A line that comes again, as of two runs in one file, must say the same.
  /// @param largest of its kind: what should be nothing is the rounding of that, another one in
  ///   each run.
  template <class Value>
  void take(const Line& line, bool is_new, Value& place, const Value& value, double largest) const {
    if (!is_new && std::abs(value - place) > 1e-6 * largest)
      fail(line.number, "comes a second time, with other figures");
    place = value;
  }

  /// Mode from its number in the file.
  Eigen::Index mode(const Line& line, std::size_t column) const {
    const double number = line.values[column];
    if (number != std::floor(number) || number < 1.0 || number > 6000.0) {
      fail(line.number, fmt::format("{} is no mode: whole numbers from 1 are due", number));
    }
    return static_cast<Eigen::Index>(number) - 1;
  }

 private:
  /// Fortran writes 1.0D-05 of double precision, and leaves the letter out before three digits,
  /// 1.0-105.
  static std::optional<double> parse(std::string word) {
    const std::size_t exponent = word.find_first_of("dD");
    if (exponent != std::string::npos) word[exponent] = 'E';
    const std::size_t sign = word.find_last_of("+-");
    if (sign != std::string::npos && sign > 0 && word.size() == sign + 4 &&
        (word[sign - 1] == '.' || std::isdigit(static_cast<unsigned char>(word[sign - 1])) != 0))
      word.insert(sign, 1, 'E');
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    if (end == word.c_str() || *end != '\0') return std::nullopt;
    return value;
  }

  fs::path path_;
};

/// The largest figures of a file of those that have one unit, at each period.
class LargestOfKind {
 public:
  /// @param kind tells units apart, at a period.
  void add(double period, int kind, double value) {
    double& largest = largest_[{period, kind}];
    largest = std::max(largest, std::abs(value));
  }
  double at(double period, int kind) const { return largest_.at({period, kind}); }

 private:
  std::map<std::pair<double, int>, double> largest_;
};

/// Frequencies in rad/s by the periods that the file has.
struct Periods {
  std::map<double, std::size_t, std::greater<>> index;  ///< by period, longest first

  void take(double period) {
    if (period > 0.0) index.emplace(period, 0);
  }
  std::vector<double> frequencies() {
    std::vector<double> result;
    for (auto& [period, place] : index) {
      place = result.size();
      result.push_back(two_pi / period);
    }
    return result;
  }
};

/// Of each body; of a single one the world's, if nothing else is told.
std::vector<WamitBody> axes_of_bodies(const fs::path& path, const WamitScales& scales,
                                      Eigen::Index bodies) {
  const auto count = static_cast<std::size_t>(bodies);
  if (scales.bodies.size() == count) return scales.bodies;
  if (!scales.bodies.empty()) {
    throw HydrodynamicFileError(fmt::format("{}: holds {} bodies, and {} are placed by --body-at",
                                            path.string(), count, scales.bodies.size()));
  }
  if (count == 1) return {WamitBody{}};
  throw HydrodynamicFileError(
      fmt::format("{}: holds {} bodies, and WAMIT's files do not tell where their axes lie, which "
                  "coefficients are about; give XBODY of each, in their order, by --body-at "
                  "x,y[,z[,heading]] (m, degrees)",
                  path.string(), count));
}

/// From the bodies' own axes to the world's.
void turn_to_world(const std::vector<WamitBody>& bodies, HydrodynamicDatabase& database) {
  const auto is_turned = [](const WamitBody& body) { return body.heading != 0.0; };
  if (std::none_of(bodies.begin(), bodies.end(), is_turned)) return;
  MatrixXd Q = MatrixXd::Identity(database.mode_count(), database.mode_count());
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Eigen::Matrix3d R =
        Eigen::AngleAxisd(bodies[b].heading, dynamics::Vector3::UnitZ()).toRotationMatrix();
    const Eigen::Index first = modes_per_body * static_cast<Eigen::Index>(b);
    Q.block<3, 3>(first, first) = Q.block<3, 3>(first + 3, first + 3) = R;
  }
  const auto turn = [&](MatrixXd& M) {
    if (M.size() > 0) M = MatrixXd(Q * M * Q.transpose());
  };
  std::for_each(database.added_mass.begin(), database.added_mass.end(), turn);
  std::for_each(database.damping.begin(), database.damping.end(), turn);
  turn(database.infinite_added_mass);
  turn(database.hydrostatic_stiffness);
  for (Eigen::MatrixXcd& X : database.diffraction) X = Eigen::MatrixXcd(Q * X);
}

/// Pairs of modes for which a file has a line.
using Pairs = std::set<std::pair<Eigen::Index, Eigen::Index>>;

bool has_below(const Pairs& pairs) {
  return std::any_of(pairs.begin(), pairs.end(),
                     [](const auto& pair) { return pair.first > pair.second; });
}

/// All periods have the same pairs; below the diagonal they are those above it, or none.
void require_all_pairs(const fs::path& path, const std::vector<Pairs>& entries,
                       const Pairs& infinite, const HydrodynamicDatabase& database) {
  Pairs all;
  for (const Pairs& pairs : entries) all.insert(pairs.begin(), pairs.end());
  const auto require = [&](const Pairs& pairs, const std::string& where) {
    if (pairs == all) return;
    const auto missing = std::find_if(all.begin(), all.end(),
                                      [&](const auto& pair) { return pairs.count(pair) == 0; });
    if (missing == all.end()) return;
    throw HydrodynamicFileError(fmt::format(
        "{}: {} coefficients at {}, more at others: lines are missing, such as that of the modes "
        "{} and {}",
        path.string(), pairs.size(), where, missing->first + 1, missing->second + 1));
  };
  for (std::size_t k = 0; k < entries.size(); ++k) {
    require(entries[k], fmt::format("the period {} s", two_pi / database.frequencies[k]));
  }
  if (!infinite.empty()) require(infinite, "the period 0 (infinite frequency)");
  if (!has_below(all)) return;
  for (const auto& [i, j] : all) {
    if (all.count({j, i}) > 0) continue;
    throw HydrodynamicFileError(
        fmt::format("{}: lines for the modes {} and {}, and none for {} and {}: lines are missing",
                    path.string(), i + 1, j + 1, j + 1, i + 1));
  }
}

/// @return the modes that the file has on its diagonal.
std::set<Eigen::Index> read_radiation(const fs::path& path, const WamitScales& scales,
                                      Periods& periods, HydrodynamicDatabase& database) {
  const TextFile file(path);
  const std::vector<Line> lines = file.lines();
  LargestOfKind largest_mass, largest_damping;
  Eigen::Index modes = modes_per_body;
  for (const Line& line : lines) {
    file.require_columns(line, 4, 5, "period, two modes, added mass and damping");
    periods.take(line.values[0]);
    const Eigen::Index i = file.mode(line, 1), j = file.mode(line, 2);
    modes = std::max({modes, i + 1, j + 1});
    largest_mass.add(line.values[0], rotations(i, j), line.values[3]);
    if (line.values.size() > 4)
      largest_damping.add(line.values[0], rotations(i, j), line.values[4]);
  }
  const Eigen::Index bodies = (modes + modes_per_body - 1) / modes_per_body;
  modes = modes_per_body * bodies;
  // Each body has a line at each period, or a few lines would ask for any memory.
  const std::size_t periods_of_all = std::max<std::size_t>(periods.index.size(), 1);
  if (static_cast<std::size_t>(bodies) * periods_of_all > lines.size())
    throw HydrodynamicFileError(
        fmt::format("{}: {} lines are too few for the {} periods and {} bodies that they name",
                    path.string(), lines.size(), periods.index.size(), bodies));
  const std::vector<WamitBody> axes = axes_of_bodies(path, scales, bodies);
  for (Eigen::Index b = 0; b < bodies; ++b) {
    database.body_names.push_back("body" + std::to_string(b + 1));
    database.reference_points.push_back(axes[b].p_W);
    database.displaced_volumes.push_back(0.0);
  }
  database.frequencies = periods.frequencies();
  database.added_mass.assign(database.frequencies.size(), MatrixXd::Zero(modes, modes));
  database.damping = database.added_mass;
  std::vector<Pairs> entries(database.frequencies.size());
  Pairs infinite;
  for (const Line& line : lines) {
    const double period = line.values[0];
    if (period < 0.0) continue;
    const Eigen::Index i = file.mode(line, 1), j = file.mode(line, 2);
    const double scale = radiation_scale(scales.water, scales.length, i, j);
    const double mass = scale * largest_mass.at(period, rotations(i, j));
    if (period == 0.0) {
      if (database.infinite_added_mass.size() == 0) {
        database.infinite_added_mass = MatrixXd::Zero(modes, modes);
      }
      file.take(line, infinite.emplace(i, j).second, database.infinite_added_mass(i, j),
                scale * line.values[3], mass);
      continue;
    }
    file.require_columns(line, 5, 5, "period, two modes, added mass and damping");
    const std::size_t k = periods.index.at(period);
    const bool is_new = entries[k].emplace(i, j).second;
    const double rate = scale * database.frequencies[k];
    file.take(line, is_new, database.added_mass[k](i, j), scale * line.values[3], mass);
    file.take(line, is_new, database.damping[k](i, j), rate * line.values[4],
              rate * largest_damping.at(period, rotations(i, j)));
  }
  require_all_pairs(path, entries, infinite, database);
  std::set<Eigen::Index> radiating;
  if (entries.empty()) return radiating;
  for (const auto& [i, j] : entries.front())
    if (i == j) radiating.insert(i);
  if (has_below(entries.front())) return radiating;
  const auto mirror = [](MatrixXd& matrix) {
    matrix = MatrixXd(matrix.selfadjointView<Eigen::Upper>());
  };
  std::for_each(database.added_mass.begin(), database.added_mass.end(), mirror);
  std::for_each(database.damping.begin(), database.damping.end(), mirror);
  if (database.infinite_added_mass.size() > 0) mirror(database.infinite_added_mass);
  return radiating;
}

/// Modes that a file has at each frequency and heading.
using ForcesFound = std::map<std::pair<std::size_t, std::size_t>, std::set<Eigen::Index>>;

/// Each mode that radiates is pressed at each period and heading.
void require_all_forces(const fs::path& path, const ForcesFound& found,
                        const std::set<Eigen::Index>& radiating,
                        const HydrodynamicDatabase& database) {
  const std::size_t due = database.frequencies.size() * database.headings.size();
  const auto place_of = [&](std::size_t k, std::size_t h) {
    return fmt::format("the period {:.6g} s and the heading {:.6g} degrees",
                       two_pi / database.frequencies[k], database.headings[h] / degree);
  };
  for (std::size_t k = 0; k < database.frequencies.size(); ++k) {
    for (std::size_t h = 0; h < database.headings.size(); ++h) {
      const auto there = found.find({k, h});
      if (there == found.end()) {
        throw HydrodynamicFileError(
            fmt::format("{}: excitation for {} of {} periods and headings: frequencies are "
                        "missing, such as {}",
                        path.string(), found.size(), due, place_of(k, h)));
      }
      for (const Eigen::Index mode : radiating) {
        if (there->second.count(mode) > 0) continue;
        throw HydrodynamicFileError(
            fmt::format("{}: no excitation of mode {} at {}: lines are missing", path.string(),
                        mode + 1, place_of(k, h)));
      }
    }
  }
}

void read_excitation(const fs::path& path, const WamitScales& scales, const Periods& periods,
                     const std::set<Eigen::Index>& radiating, HydrodynamicDatabase& database) {
  const TextFile file(path);
  const std::vector<Line> lines = file.lines();
  std::map<double, std::size_t> headings;
  LargestOfKind largest;
  for (const Line& line : lines) {
    file.require_columns(line, 7, 7,
                         "period, heading, mode, modulus, phase, real and imaginary part");
    headings.emplace(line.values[1], 0);
    largest.add(line.values[0], is_rotation(file.mode(line, 2)) ? 1 : 0,
                std::hypot(line.values[5], line.values[6]));
  }
  for (auto& [heading, place] : headings) {
    place = database.headings.size();
    database.headings.push_back(heading * degree);
  }
  const Eigen::Index modes = database.mode_count();
  const auto columns = static_cast<Eigen::Index>(headings.size());
  database.diffraction.assign(database.frequencies.size(), Eigen::MatrixXcd::Zero(modes, columns));
  ForcesFound found;
  for (const Line& line : lines) {
    const auto period = periods.index.find(line.values[0]);
    if (period == periods.index.end()) {
      file.fail(line.number,
                fmt::format("the period {} s is not among those of the .1 file", line.values[0]));
    }
    const Eigen::Index i = file.mode(line, 2);
    if (i >= modes || radiating.count(i) == 0)
      file.fail(line.number, "a mode that the .1 file does not have");
    const double scale = excitation_scale(scales.water, scales.length, i);
    const std::size_t h = headings.at(line.values[1]);
    file.take(line, found[{period->second, h}].insert(i).second,
              database.diffraction[period->second](i, static_cast<Eigen::Index>(h)),
              scale * std::complex<double>(line.values[5], line.values[6]),
              scale * largest.at(line.values[0], is_rotation(i) ? 1 : 0));
  }
  require_all_forces(path, found, radiating, database);
}

/// The file of mean drift forces that tells most; none if there is none of use.
std::optional<fs::path> find_mean_drift(const fs::path& name, int bodies) {
  // A control surface, pressure, or momentum far away, which does not tell bodies apart.
  for (const char* ending : {".7", ".9", ".8"}) {
    if (bodies > 1 && ending == std::string_view(".8")) continue;
    if (fs::path path = with_ending(name, ending); fs::exists(path)) return path;
  }
  return std::nullopt;
}

void read_mean_drift(const fs::path& path, const WamitScales& scales, const Periods& periods,
                     HydrodynamicDatabase& database) {
  const TextFile file(path);
  const Eigen::Index modes = database.mode_count();
  const auto columns = static_cast<Eigen::Index>(database.headings.size());
  database.mean_drift.assign(database.frequencies.size(), MatrixXd::Zero(modes, columns));
  std::set<std::pair<std::size_t, Eigen::Index>> found;
  for (const Line& line : file.lines()) {
    file.require_columns(line, 7, 8, "period, two headings, mode, modulus, phase, real part");
    // Two waves that cross drift a body otherwise than each alone; that is not kept.
    if (line.values[1] != line.values[2]) continue;
    const auto period = periods.index.find(line.values[0]);
    const auto heading = std::find_if(
        database.headings.begin(), database.headings.end(),
        [&](double known) { return std::abs(known - line.values[1] * degree) < 1e-9; });
    if (period == periods.index.end() || heading == database.headings.end()) {
      file.fail(line.number,
                fmt::format("period {} s and heading {} degrees are not among those of the .1 and "
                            ".3 files",
                            line.values[0], line.values[1]));
    }
    const Eigen::Index mode = file.mode(line, 3);
    if (mode >= modes) file.fail(line.number, "a mode that the .1 file does not have");
    const auto h = static_cast<Eigen::Index>(heading - database.headings.begin());
    const double scale = drift_scale(scales.water, scales.length, mode);
    database.mean_drift[period->second](mode, h) = scale * line.values[6];
    found.emplace(period->second, h);
  }
  if (found.size() == database.frequencies.size() * database.headings.size()) return;
  throw HydrodynamicFileError(fmt::format(
      "{}: mean drift for {} of {} periods and headings: lines are missing", path.string(),
      found.size(), database.frequencies.size() * database.headings.size()));
}

std::string mean_drift_text(const HydrodynamicDatabase& database, double length) {
  std::string text;
  for (std::size_t k = 0; k < database.frequencies.size(); ++k) {
    const MatrixXd& D = database.mean_drift[k];
    for (Eigen::Index h = 0; h < D.cols(); ++h) {
      const double heading = database.headings[h] / degree;
      for (Eigen::Index i = 0; i < D.rows(); ++i) {
        const double force = D(i, h) / drift_scale(database.water, length, i);
        text += fmt::format(
            "{:23.16E} {:23.16E} {:23.16E} {:5d} {:23.16E} {:23.16E} {:23.16E} {:23.16E}\n",
            two_pi / database.frequencies[k], heading, heading, i + 1, std::abs(force),
            force < 0.0 ? 180.0 : 0.0, force, 0.0);
      }
    }
  }
  return text;
}

void read_stiffness(const fs::path& path, const WamitScales& scales,
                    HydrodynamicDatabase& database) {
  const TextFile file(path);
  const Eigen::Index modes = database.mode_count();
  database.hydrostatic_stiffness = MatrixXd::Zero(modes, modes);
  const std::vector<Line> lines = file.lines();
  LargestOfKind largest;
  for (const Line& line : lines) {
    file.require_columns(line, 3, 3, "two modes and a stiffness");
    largest.add(0, rotations(file.mode(line, 0), file.mode(line, 1)), line.values[2]);
  }
  Pairs found;
  for (const Line& line : lines) {
    const Eigen::Index i = file.mode(line, 0), j = file.mode(line, 1);
    if (i >= modes || j >= modes) file.fail(line.number, "a mode that the .1 file does not have");
    const double scale = stiffness_scale(scales.water, scales.length, i, j);
    file.take(line, found.emplace(i, j).second, database.hydrostatic_stiffness(i, j),
              scale * line.values[2], scale * largest.at(0, rotations(i, j)));
  }
  // Between bodies there is none, and a file may leave it out.
  for (Eigen::Index i = 0; i < modes; ++i) {
    const Eigen::Index first = i - i % modes_per_body;
    for (Eigen::Index j = first; j < first + modes_per_body; ++j) {
      if (found.count({i, j}) > 0) continue;
      throw HydrodynamicFileError(
          fmt::format("{}: no stiffness of the modes {} and {}: all 36 of a body are due",
                      path.string(), i + 1, j + 1));
    }
  }
}

std::string radiation_text(const HydrodynamicDatabase& database, double length) {
  const auto scale = [&](Eigen::Index i, Eigen::Index j) {
    return radiation_scale(database.water, length, i, j);
  };
  const Eigen::Index modes = database.mode_count();
  std::string text;
  for (Eigen::Index i = 0; i < modes; ++i) {
    for (Eigen::Index j = 0; j < modes; ++j) {
      text += fmt::format("{:23.16E} {:5d} {:5d} {:23.16E}\n", 0.0, i + 1, j + 1,
                          database.infinite_added_mass(i, j) / scale(i, j));
    }
  }
  for (std::size_t k = 0; k < database.frequencies.size(); ++k) {
    const double w = database.frequencies[k];
    for (Eigen::Index i = 0; i < modes; ++i) {
      for (Eigen::Index j = 0; j < modes; ++j) {
        text += fmt::format("{:23.16E} {:5d} {:5d} {:23.16E} {:23.16E}\n", two_pi / w, i + 1, j + 1,
                            database.added_mass[k](i, j) / scale(i, j),
                            database.damping[k](i, j) / (scale(i, j) * w));
      }
    }
  }
  return text;
}

std::string excitation_text(const HydrodynamicDatabase& database, double length) {
  std::string text;
  for (std::size_t k = 0; k < database.frequencies.size(); ++k) {
    const Eigen::MatrixXcd X = database.excitation(k);
    for (Eigen::Index h = 0; h < X.cols(); ++h) {
      for (Eigen::Index i = 0; i < X.rows(); ++i) {
        const std::complex<double> force = X(i, h) / excitation_scale(database.water, length, i);
        text += fmt::format("{:23.16E} {:23.16E} {:5d} {:23.16E} {:23.16E} {:23.16E} {:23.16E}\n",
                            two_pi / database.frequencies[k], database.headings[h] / degree, i + 1,
                            std::abs(force), std::arg(force) / degree, force.real(), force.imag());
      }
    }
  }
  return text;
}

std::string stiffness_text(const HydrodynamicDatabase& database, double length) {
  std::string text;
  for (Eigen::Index i = 0; i < database.mode_count(); ++i) {
    for (Eigen::Index j = 0; j < database.mode_count(); ++j) {
      text += fmt::format(
          "{:5d} {:5d} {:23.16E}\n", i + 1, j + 1,
          database.hydrostatic_stiffness(i, j) / stiffness_scale(database.water, length, i, j));
    }
  }
  return text;
}

}  // namespace

HydrodynamicDatabase read_wamit(const fs::path& name, const WamitScales& scales) {
  HydrodynamicDatabase database;
  database.water = scales.water;
  Periods periods;
  const std::set<Eigen::Index> radiating =
      read_radiation(with_ending(name, ".1"), scales, periods, database);
  const Eigen::Index modes = database.mode_count();
  database.diffraction.assign(database.frequencies.size(), Eigen::MatrixXcd::Zero(modes, 0));
  // By the diffraction potential, or by Haskind's relation.
  for (const char* ending : {".3", ".2"}) {
    const fs::path path = with_ending(name, ending);
    if (!fs::exists(path)) continue;
    read_excitation(path, scales, periods, radiating, database);
    break;
  }
  if (const auto path = find_mean_drift(name, database.body_count());
      path && !database.headings.empty()) {
    if (std::any_of(scales.bodies.begin(), scales.bodies.end(),
                    [](const WamitBody& body) { return body.heading != 0.0; })) {
      throw HydrodynamicFileError(path->string() +
                                  ": along which axes the mean drift of turned bodies is, the "
                                  "file does not tell; leave it aside, or turn no body");
    }
    read_mean_drift(*path, scales, periods, database);
  }
  database.froude_krylov.assign(database.frequencies.size(),
                                Eigen::MatrixXcd::Zero(modes, database.headings.size()));
  if (const fs::path path = with_ending(name, ".hst"); fs::exists(path)) {
    read_stiffness(path, scales, database);
  }
  turn_to_world(scales.bodies, database);
  try {
    add_retardation(database);
    if (database.infinite_added_mass.size() == 0) add_infinite_added_mass(database);
    require_sound(database);
  } catch (const dynamics::ModelError& error) {
    throw HydrodynamicFileError(name.string() + ": " + error.what());
  }
  return database;
}

std::vector<dynamics::Vector3> wamit_points(const HydrodynamicDatabase& database) {
  std::vector<dynamics::Vector3> points = database.reference_points;
  if (points.size() == 1) points.front().setZero();
  for (dynamics::Vector3& point : points) point.z() = 0.0;
  return points;
}

void write_wamit(const fs::path& name, const HydrodynamicDatabase& given, double length) {
  const HydrodynamicDatabase database = about_points(given, wamit_points(given));
  write_file(with_ending(name, ".1"), radiation_text(database, length));
  if (!database.headings.empty())
    write_file(with_ending(name, ".3"), excitation_text(database, length));
  if (!database.mean_drift.empty()) {
    write_file(with_ending(name, database.body_count() == 1 ? ".8" : ".9"),
               mean_drift_text(database, length));
  }
  if (database.hydrostatic_stiffness.size() > 0) {
    write_file(with_ending(name, ".hst"), stiffness_text(database, length));
  }
}

}  // namespace blocklift::pipeline
