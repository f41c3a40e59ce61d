#include "pipeline/command_line/hydro_command.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "dynamics/errors.h"
#include "pipeline/build/keel_clearance.h"
#include "pipeline/declaration/quantity.h"
#include "pipeline/files/vessel/wetted_mesh.h"
#include "pipeline/formats/atomic_file.h"
#include "pipeline/formats/hydrodynamics/convention_check.h"
#include "pipeline/formats/hydrodynamics/foreign_hydrodynamics.h"
#include "pipeline/hydrodynamics/cache_folder.h"
#include "pipeline/hydrodynamics/hydrodynamic_problem.h"
#include "pipeline/hydrodynamics/hydrodynamic_report.h"
#include "pipeline/processes/exit_code.h"
#include "pipeline/terminal/progress_bar.h"
#include "pipeline/terminal/run_log.h"
#include "pipeline/terminal/text_table.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;

/// Beside the database, with its name and another ending.
fs::path page_of(fs::path database) { return database.replace_extension(".html"); }

fs::path output_of(const HydroOptions& options, const HydrodynamicProblem& problem) {
  if (options.output) return *options.output;
  return fs::path("results") / (problem.bodies[0].hull->name() + ".h5");
}

void print_panels(const HydrodynamicState& state) {
  const dynamics::Symmetry& symmetry = state.model->symmetry();
  const std::string panels = fmt::format(
      "draught {:.3f} m: {} panels on the bodies, {} on the surface{}; {:.2f} GB of memory",
      state.draught, state.model->body_mesh().size(), state.model->surface_mesh().size(),
      symmetry.x && symmetry.y   ? ", a quarter of all"
      : symmetry.x || symmetry.y ? ", a half of all"
                                 : "",
      state.bytes / 1e9);
  log_entry(panels);
  if (!is_quiet()) print_wrapped(panels);
  const std::string note = note_on_groups(*state.model, state.groups);
  if (!note.empty()) log_entry(note);
  if (!note.empty() && !is_quiet()) print_wrapped(note);
  const double highest = state.settings.frequencies.back();
  if (!state.groups.empty()) {
    if (const auto lost = find_lost_coupling(*state.model, state.groups, highest)) {
      std::vector<std::string> names;
      for (const dynamics::WettedBody& body : state.model->bodies()) names.push_back(body.name);
      say_warning(doubt_about_coupling(names, *lost, state.model->water(), highest));
    }
  }
  std::fflush(stdout);
}

double displaced_mass(const HydrodynamicBody& body, const dynamics::Pose& X_WB, double density) {
  return density * calc_hydrostatics(dynamics::HullClusters(*body.hull), X_WB).volume;
}

/// Before anything is meshed: a hull in millimetres mostly asks for too many panels, and one that
/// lies on the water has panels too large for what is wet of it.
void say_doubts_about_sizes(const HydrodynamicProblem& problem) {
  for (const HydrodynamicBody& body : problem.bodies) {
    const std::string who = "vessel " + body.name;
    for (const std::string& doubt :
         {doubt_about_size(who, *body.hull),
          doubt_about_lightness(who, *body.hull, body.body.mass, problem.settings.water.density)}) {
      if (!doubt.empty()) say_warning(doubt);
    }
  }
}

/// A hull that floats by its weight inclines until it balances, without end if need be.
std::string doubt_about_inclination(const std::string& name, const dynamics::Matrix3& R_WB) {
  constexpr double acceptable = 5.0;  // degrees
  constexpr double degree = std::numbers::pi / 180.0;
  const double list = std::atan2(R_WB(2, 1), R_WB(2, 2)) / degree;
  const double trim = std::asin(std::clamp(-R_WB(2, 0), -1.0, 1.0)) / degree;
  if (std::max(std::abs(list), std::abs(trim)) <= acceptable) return {};
  return fmt::format(
      "vessel {} floats with a list of {:.1f} and a trim of {:.1f} degrees (about x and y), and "
      "its "
      "figures are those of the hull as it lies: its centre of mass is not over the middle of what "
      "it displaces, or too high",
      name, list, trim);
}

/// Of each body once, at its deepest: draughts ascend.
void say_doubts_about_hulls(const HydrodynamicProblem& problem,
                            const std::vector<HydrodynamicState>& states) {
  for (std::size_t b = 0; b < problem.bodies.size(); ++b) {
    const HydrodynamicBody& body = problem.bodies[b];
    const dynamics::Pose& X_WB = states.back().panels.bodies[b].X_DB;
    const std::string mass =
        body.as_meshed ? doubt_about_mass(
                             body.name, displaced_mass(body, X_WB, problem.settings.water.density),
                             body.body.mass)
                       : std::string();
    for (const std::string& doubt :
         {mass, doubt_about_inclination(body.name, X_WB.R),
          doubt_about_keel(body.name, *body.hull, X_WB, problem.settings.water.depth)}) {
      if (!doubt.empty()) say_warning(doubt);
    }
  }
}

/// Meshes all draughts; what is wrong is wrong input.
std::vector<HydrodynamicState> prepare(const HydrodynamicProblem& problem) {
  std::vector<HydrodynamicState> states;
  try {
    for (std::size_t k = 0; k < problem.state_count(); ++k) {
      states.push_back(prepare_state(problem, k));
    }
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error& error) {
    Diagnostics diagnostics;
    diagnostics.error(problem.place, error.what());
    throw InputError(diagnostics);
  }
  return states;
}

/// @param cache folder of it.
HydrodynamicFile compute(const HydrodynamicProblem& problem,
                         const std::vector<HydrodynamicState>& states, const fs::path& cache) {
  for (const HydrodynamicState& state : states) print_panels(state);
  std::vector<std::string> said;
  HydrodynamicFile file;
  {
    ProgressBar bar("hydrodynamics");
    double done = 0.0;
    file = find_hydrodynamics(
        problem, states,
        [&](double fraction, const std::string& what) {
          done = fraction;
          bar.show(fraction, what);
        },
        cache,
        [&](const std::string& what) {
          log_entry(what);
          said.push_back(what);
          bar.show(done, what);
        });
  }
  if (is_quiet()) return file;
  for (const std::string& what : said) print_wrapped(what);
  return file;
}

[[noreturn]] void refuse(const std::string& file, const std::string& what,
                         const std::vector<std::string>& hints) {
  Diagnostics diagnostics;
  diagnostics.error({std::make_shared<const std::string>(file), 0, 0}, what, hints);
  throw InputError(diagnostics);
}

/// Asks before the work whether its result can be written.
void require_writable_file(const fs::path& file) {
  try {
    const AtomicFile attempt(file);
    errno = 0;
    if (!std::ofstream(attempt.temporary_path()))
      throw std::runtime_error(std::generic_category().message(errno));
  } catch (const std::runtime_error& error) {
    refuse(file.string(), std::string("the database cannot be written here: ") + error.what(),
           {"name another file with --output"});
  }
}

/// A database with its page. Whatever fails before the database is in place leaves both as they
/// were.
void write_with_page(const fs::path& output, const HydrodynamicFile& file,
                     const std::string& page) {
  AtomicFile prepared(page_of(output));
  prepared.write(page);
  write_hydrodynamic_file(output, file);
  prepared.commit();
}

/// Is the page there, and that of this database? One of another is left where a run was stopped
/// between the two.
bool has_page(const fs::path& output, const HydrodynamicFile& file) {
  const fs::path page = page_of(output);
  return fs::exists(page) && read_file(page).find(file.identity) != std::string::npos;
}

int compute_vessel(const HydroOptions& options) {
  Diagnostics diagnostics;
  std::optional<HydrodynamicProblem> problem =
      read_hydrodynamic_problem(*options.vessel, ModelLibrary::of_installation(), diagnostics);
  if (!problem) throw InputError(diagnostics);
  if (options.memory_limit) problem->memory_limit = 1e9 * *options.memory_limit;
  const fs::path output = output_of(options, *problem);
  require_writable_file(output);
  say_doubts_about_sizes(*problem);
  const std::vector<HydrodynamicState> states = prepare(*problem);
  say_doubts_about_hulls(*problem, states);
  std::vector<Eigen::MatrixXd> masses;
  for (const HydrodynamicState& state : states) masses.push_back(state.mass);
  HydrodynamicFile file;
  const bool known = !options.anew && read_identity(output) == identity_of(*problem, states);
  if (known) {
    file = read_hydrodynamic_file(output);
  } else {
    file = compute(*problem, states, options.anew ? no_cache() : cache_folder());
  }
  const auto page = [&] { return hydrodynamic_page(file, problem->title, masses); };
  if (!known)
    write_with_page(output, file, page());
  else if (!has_page(output, file))
    write_file(page_of(output), page());
  if (is_quiet()) return exit_code::done;
  fmt::print("{}\n{}\n", problem->title, hydrodynamic_table(file, masses));
  fmt::print("{}: {}\n{}\n", known ? "already computed" : "database", output.string(),
             page_of(output).string());
  return exit_code::done;
}

bool lacks_volumes(const dynamics::HydrodynamicDatabase& database) {
  const std::vector<double>& volumes = database.displaced_volumes;
  return std::any_of(volumes.begin(), volumes.end(), [](double volume) { return !(volume > 0.0); });
}

/// A quantity of one of the dimensions; a number alone is of the unit.
double coordinate(const std::string& text, Dimension dimension, const char* unit) {
  const auto last = text.find_last_not_of(' ');
  const bool bare = last != std::string::npos &&
                    std::string_view("0123456789.").find(text[last]) != std::string_view::npos;
  return parse_quantity(bare ? text + " " + unit : text, dimension);
}

/// x,y[,z[,heading]], m and degrees where no unit is given.
WamitBody body_at(const std::string& text) {
  const std::string due = "x,y[,z[,heading]] is due, m and degrees, or with their units";
  std::vector<double> numbers;
  std::istringstream parts(text);
  try {
    for (std::string part; std::getline(parts, part, ',');) {
      const bool angle = numbers.size() == 3;
      numbers.push_back(
          coordinate(part, angle ? Dimension::angle : Dimension::length, angle ? "deg" : "m"));
    }
  } catch (const QuantityError& error) {
    refuse("--body-at " + text, error.what(), {due});
  }
  if (numbers.size() < 2 || numbers.size() > 4 || text.ends_with(','))
    refuse("--body-at " + text, fmt::format("{} numbers", numbers.size()), {due});
  numbers.resize(4, 0.0);
  return {{numbers[0], numbers[1], numbers[2]}, numbers[3]};
}

/// Where WAMIT's files count from, for people and for the command that reads them again.
std::string note_on_points(const dynamics::HydrodynamicDatabase& database, double length) {
  const std::vector<dynamics::Vector3> points = wamit_points(database);
  const std::string option = length == 1.0 ? "" : fmt::format(" --wamit-length={}", length);
  if (points.size() == 1) {
    return "about the origin of the database's world, which --import takes: of a vessel computed "
           "by itself the point of the water line over or under its own origin" +
           (option.empty() ? "" : "; to read them again:" + option);
  }
  std::string note = "about (XBODY)";
  for (std::size_t b = 0; b < points.size(); ++b) {
    note += fmt::format("{} ({}, {}, 0) m of {}", b == 0 ? "" : ",", points[b].x(), points[b].y(),
                        database.body_names[b]);
  }
  note += "; to read them again:";
  for (const dynamics::Vector3& point : points) {
    note += fmt::format(" --body-at={},{}", point.x(), point.y());
  }
  return note + option;
}

/// @throws InputError if a length is given, and nothing of WAMIT is read or written.
void require_wamit(const HydroOptions& options) {
  if (!options.wamit_length || options.export_format == "wamit") return;
  const std::string ending = options.import ? fs::path(*options.import).extension().string() : "";
  if (ending == ".1" || ending == ".2" || ending == ".3" || ending == ".hst") return;
  refuse("--wamit-length", "no file of WAMIT is read or written", {"leave it out"});
}

/// Of a database without excitation; what files would have it.
std::string lack_of_waves(const std::string& origin) {
  const char* const where = origin.ends_with("(WAMIT)")
                                ? ": there is neither a file .3 nor a .2 of its name beside it"
                                : "";
  return fmt::format(
      "holds no force of waves{}; what names the database can float in calm water alone", where);
}

bool has_rotations(const dynamics::HydrodynamicDatabase& database) {
  if (database.added_mass.empty()) return false;
  const Eigen::VectorXd diagonal = database.added_mass.front().diagonal();
  for (Eigen::Index mode = 0; mode < diagonal.size(); ++mode)
    if (mode % dynamics::modes_per_body >= 3 && diagonal[mode] != 0.0) return true;
  return false;
}

/// Capytaine's datasets do not hold the point that moments and rotations are about, which its users
/// mostly lay into the centre of mass. A database of our own that was made of one has been told it.
bool lacks_rotation_centres(const HydroOptions& options, const HydrodynamicFile& file) {
  return fs::path(*options.import).extension() == ".nc" && options.bodies_at.empty() &&
         has_rotations(file.series.databases.front()) && !tells_rotation_centres(*options.import);
}

/// What another program's file lacks, or has in other units. The latter is said by the table where
/// that is printed.
void say_doubts_about_import(const HydroOptions& options, const HydrodynamicFile& file) {
  const dynamics::HydrodynamicDatabase& database = file.series.databases.front();
  const auto say = [&](const std::string& what) { say_warning(*options.import + ": " + what); };
  if (!file.origin.starts_with(imported_from)) return;
  if (lacks_volumes(database) && file.origin.ends_with("(BEMIO)")) {
    say("bodies displace nothing (disp_vol 0): cb and cg are not taken for centres of buoyancy and "
        "mass, and weight acts where the vessel has it");
  }
  if (lacks_rotation_centres(options, file)) {
    say("does not tell what its rotations and moments are about (rotation_center or "
        "center_of_mass); the world's origin is taken; if they are about another point, as the "
        "centre of mass, give it of each body by --body-at=x,y,z");
  }
  if (database.headings.empty()) say(lack_of_waves(file.origin));
  if (!options.export_format && !is_quiet()) return;
  for (const std::string& doubt : doubts_about_conventions(database)) say(doubt);
}

/// Takes a file over and writes it as our own, or as that of another program.
int convert(const HydroOptions& options) {
  WamitScales scales;
  scales.length = options.wamit_length.value_or(1.0);
  scales.water.density = options.water_density;
  scales.water.gravity = options.gravity;
  if (options.water_depth) scales.water.depth = *options.water_depth;
  for (const std::string& text : options.bodies_at) scales.bodies.push_back(body_at(text));
  HydrodynamicFile file;
  try {
    file = import_hydrodynamics(*options.import, scales);
  } catch (const HydrodynamicFileError& error) {
    refuse(*options.import, error.what(), {});
  }
  if (!options.output) {
    refuse(*options.import, "the file that is to be made has no name", {"give it by -o FILE"});
  }
  const fs::path output = *options.output;
  say_doubts_about_import(options, file);
  if (!options.export_format) {
    write_with_page(output, file, hydrodynamic_page(file, file.origin, {}));
    if (is_quiet()) return exit_code::done;
    fmt::print("{}\ndatabase: {}\n{}\n", hydrodynamic_table(file, {}), output.string(),
               page_of(output).string());
    return exit_code::done;
  }
  if (file.series.databases.size() > 1) {
    refuse(*options.import, fmt::format("holds {} draughts", file.series.databases.size()),
           {"files of other programs hold one: compute a database of one draught"});
  }
  const dynamics::HydrodynamicDatabase& database = file.series.databases.front();
  if (*options.export_format == "bemio") {
    try {
      write_bemio(output, database);
    } catch (const HydrodynamicFileError& error) {
      refuse(*options.import, error.what(),
             {"WAMIT's files do not hold them: export to wamit, or compute the vessel by hydro"});
    }
    fmt::print("{}\n", output.string());
  } else {
    fs::path name = output;
    if (name.extension() == ".1") name.replace_extension();
    write_wamit(name, database, scales.length);
    fmt::print("{0}.1, {0}.3, {0}.hst (ULEN {1} m)\n", name.string(), scales.length);
    print_wrapped(note_on_points(database, scales.length));
  }
  return exit_code::done;
}

}  // namespace

int hydro(const HydroOptions& options) {
  require_wamit(options);
  if (options.import) return convert(options);
  if (options.vessel && !options.export_format) return compute_vessel(options);
  refuse(options.vessel.value_or("blocklift hydro"), "nothing is to be computed or converted",
         {"give the file of a vessel, or --import FILE; --export goes with --import"});
}

}  // namespace blocklift::pipeline
