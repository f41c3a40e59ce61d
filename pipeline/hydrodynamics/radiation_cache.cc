#include "pipeline/hydrodynamics/radiation_cache.h"

#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <span>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "dynamics/errors.h"
#include "dynamics/marine/loads/excitation_drift.h"
#include "dynamics/marine/radiation/mean_drift.h"
#include "dynamics/marine/radiation/response_amplitude.h"
#include "pipeline/formats/hydrodynamics/hull_hash.h"
#include "pipeline/formats/hydrodynamics/hydrodynamic_database_file.h"
#include "pipeline/formats/hydrodynamics/memory_file.h"
#include "pipeline/hydrodynamics/cache_lock.h"
#include "pipeline/hydrodynamics/given_database.h"
#include "pipeline/hydrodynamics/hydrodynamic_report.h"
#include "pipeline/hydrodynamics/method_hash.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;

/// What `compute` makes of the problem; what is wrong with the problem is wrong input.
template <class Compute>
auto compute_or_refuse(const RadiationProblem& problem, const Compute& compute) {
  try {
    return compute(problem);
  } catch (const dynamics::ModelError& error) {
    Diagnostics diagnostics;
    diagnostics.error(problem.place, error.what());
    throw InputError(diagnostics);
  }
}

std::string names_of_bodies(const RadiationProblem& problem) {
  std::vector<std::string> names;
  for (const RadiationProblem::Body& body : problem.bodies) names.push_back(body.name);
  return list_of_names(names);
}

}  // namespace

fs::path cache_folder() {
  if (const char* folder = std::getenv("BLOCKLIFT_CACHE")) return folder;
  if (const char* folder = std::getenv("XDG_CACHE_HOME")) return fs::path(folder) / "blocklift";
  if (const char* home = std::getenv("HOME")) return fs::path(home) / ".cache" / "blocklift";
  return {};
}

std::string identity_of(const RadiationProblem& problem) {
  ContentHash hash;
  hash.add(std::int64_t{dynamics::panel_method_version});
  if (problem.bodies.size() > 1) hash.add(std::int64_t{dynamics::distant_groups_version});
  for (const RadiationProblem::Body& body : problem.bodies) {
    hash.add(body.name);
    add(hash, body.vessel->hull);
    for (Eigen::Index column = 0; column < 3; ++column) {
      add(hash, Vector3(body.X_DB.R.col(column)));
    }
    add(hash, body.X_DB.p);
    add(hash, body.p_BoR_B);
  }
  hash.add(problem.water.density);
  hash.add(problem.water.gravity);
  hash.add(problem.water.depth);
  hash.add(problem.frequencies);
  hash.add(problem.headings);
  add(hash, problem.method);
  // Others are kept under the names that they had before there was a far field.
  if (problem.drifting) hash.add("far field");
  for (const dynamics::DampingLid& lid : problem.lids) {
    hash.add(std::span<const double>(lid.low.data(), 2));
    hash.add(std::span<const double>(lid.high.data(), 2));
    hash.add(lid.rate);
  }
  return hash.digits();
}

std::string identity_of(const std::vector<dynamics::HydrodynamicDatabase>& databases,
                        const dynamics::MemoryFit& fit) {
  ContentHash hash;
  hash.add("memory of the water");
  hash.add(std::int64_t{dynamics::memory_fit_version});
  hash.add(fit.tolerance);
  hash.add(std::int64_t{fit.most_states});
  hash.add(fit.acceptable_error);
  hash.add(fit.loose_tolerance);
  hash.add(std::int64_t{fit.most_loose_states});
  for (const dynamics::HydrodynamicDatabase& database : databases) {
    hash.add(database.time_step);
    hash.add(static_cast<std::int64_t>(database.retardation.size()));
    for (const Eigen::MatrixXd& K : database.retardation) {
      hash.add(static_cast<std::int64_t>(K.rows()));
      hash.add(std::span<const double>(K.data(), static_cast<std::size_t>(K.size())));
    }
  }
  return hash.digits();
}

namespace {

using Say = std::function<void(const std::string&)>;
using Tell = std::function<void(double, const std::string&)>;

/// The largest errors of all draughts, with the names of the bodies and nothing else.
dynamics::HydrodynamicDatabase worst_of(std::span<const dynamics::HydrodynamicDatabase> databases) {
  dynamics::HydrodynamicDatabase worst;
  worst.body_names = databases.back().body_names;
  for (const dynamics::HydrodynamicDatabase& database : databases) {
    for (const auto errors : {&dynamics::HydrodynamicDatabase::change_from_coarser,
                              &dynamics::HydrodynamicDatabase::excitation_change_from_coarser,
                              &dynamics::HydrodynamicDatabase::cut_off_by_end}) {
      const Eigen::VectorXd& of_this = database.*errors;
      Eigen::VectorXd& largest = worst.*errors;
      if (of_this.size() == 0) continue;
      largest = largest.size() == 0 ? of_this : largest.cwiseMax(of_this).eval();
    }
  }
  return worst;
}

/// What is found of a problem whose bodies stay.
struct FoundDatabase {
  dynamics::HydrodynamicDatabase database;
  WavesLost lost;
};

/// Do panels on the water couple bodies, so that these may lose waves?
bool may_lose_waves(const RadiationProblem& problem) {
  return !problem.given && problem.bodies.size() > 1 &&
         problem.method != dynamics::PanelMethod::green_function;
}

WavesLost find_waves_lost(const RadiationProblem& problem, const dynamics::PanelModel& model) {
  if (!may_lose_waves(problem)) return {};
  const double highest = problem.frequencies.back();
  return find_lost_coupling(model, find_distant_groups(model, highest), highest);
}

/// doubt_about_coupling of the bodies at their deepest draughts.
std::string doubt_about_distances(const RadiationProblem& problem, const WavesLost& lost) {
  if (!lost) return {};
  std::vector<std::string> names;
  for (const RadiationProblem::Body& body : problem.bodies) names.push_back(body.name);
  return doubt_about_coupling(names, *lost, problem.water, problem.frequencies.back());
}

/// Says what is doubted of the databases of a problem.
/// @returns the doubts as sentences.
std::vector<std::string> say_doubts(const RadiationProblem& problem,
                                    std::span<const dynamics::HydrodynamicDatabase> databases,
                                    const WavesLost& lost, const Say& say) {
  const dynamics::HydrodynamicDatabase worst = worst_of(databases);
  std::vector<std::string> sentences;
  for (const std::string& doubt : {doubt_about_panels(worst), doubt_about_excitation(worst),
                                   doubt_about_runs(worst), doubt_about_distances(problem, lost)}) {
    if (doubt.empty()) continue;
    say("warning: " + doubt);
    std::string sentence = doubt + ".";
    sentence.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(doubt.front())));
    sentences.push_back(std::move(sentence));
  }
  return sentences;
}

/// What `read` finds of an entry of the cache, or what `compute` makes and `write` puts there. What
/// another run is making is waited for.
/// @param read gives an optional: none if the entry is not there, or of no use.
/// @param wait called before another run is waited for.
template <class Read, class Compute, class Write>
auto take_or_make(const fs::path& file, const Read& read, const std::function<void()>& wait,
                  const Compute& compute, const Write& write) {
  if (auto known = read()) return std::move(*known);
  std::error_code ignored;
  fs::create_directories(file.parent_path(), ignored);
  const CacheLock lock(file, wait);
  // The other run may have been waited for.
  if (auto known = read()) return std::move(*known);
  auto made = compute();
  try {
    write(made);
  } catch (const std::runtime_error&) {
    // What cannot be kept is made again.
  }
  return made;
}

/// An entry of the cache; none if there is none that is whole, of this version and of bodies that
/// stay.
std::optional<HydrodynamicFile> read_entry(const fs::path& file, const std::string& identity) {
  if (read_identity(file) != identity) return std::nullopt;
  try {
    HydrodynamicFile entry = read_hydrodynamic_file(file);
    if (entry.series.databases.size() > 1) return std::nullopt;
    return entry;
  } catch (const HydrodynamicFileError&) {
    return std::nullopt;
  }
}

/// Computes the database of bodies that stay.
/// @param of_what the bodies, and their draught.
FoundDatabase compute_database(const RadiationProblem& problem, const std::string& of_what,
                               const Say& say, const Tell& tell) {
  say("computing that of " + of_what);
  const auto progress = [&](double fraction, const char* what) {
    tell(fraction, of_what + ": " + what);
  };
  return compute_or_refuse(problem, [&](const RadiationProblem& p) -> FoundDatabase {
    const dynamics::PanelModel model = make_panel_model(p);
    if (p.method == dynamics::PanelMethod::green_function)
      return {compute_radiation(p, model, {}, progress), {}};
    const auto groups = find_distant_groups(model, p.frequencies.back());
    if (const std::string note = note_on_groups(model, groups); !note.empty()) say(note);
    return {compute_radiation(p, model, groups, progress), find_waves_lost(p, model)};
  });
}

/// What an entry of the cache says. One of an older program does not tell which waves are lost:
/// that is found on the mesh, without the database, and put into it.
FoundDatabase take_entry(const RadiationProblem& problem, HydrodynamicFile entry,
                         const fs::path& file) {
  if (!entry.waves_lost && may_lose_waves(problem)) {
    entry.waves_lost = compute_or_refuse(
        problem, [](const RadiationProblem& p) { return find_waves_lost(p, make_panel_model(p)); });
    try {
      write_hydrodynamic_file(file, entry);
    } catch (const std::runtime_error&) {
      // What cannot be kept is found again.
    }
  }
  return {std::move(entry.series.databases.front()), entry.waves_lost.value_or(WavesLost{})};
}

/// What is found of bodies that stay.
FoundDatabase find_database(const RadiationProblem& problem, const std::string& where,
                            const Say& say, const Tell& tell) {
  const std::string of_what = names_of_bodies(problem) + where;
  const fs::path folder = cache_folder();
  if (folder.empty()) return compute_database(problem, of_what, say, tell);
  const std::string identity = identity_of(problem);
  const fs::path file = folder / (identity + ".h5");
  const auto read = [&]() -> std::optional<FoundDatabase> {
    std::optional<HydrodynamicFile> entry = read_entry(file, identity);
    if (!entry) return std::nullopt;
    say("from " + file.string());
    return take_entry(problem, std::move(*entry), file);
  };
  return take_or_make(
      file, read, [&] { say("waiting for another run that computes that of " + of_what); },
      [&] { return compute_database(problem, of_what, say, tell); },
      [&](const FoundDatabase& made) {
        HydrodynamicFile entry{
            identity, "computed for a case with " + of_what, {0, {0.0}, {made.database}}};
        if (may_lose_waves(problem)) entry.waves_lost = made.lost;
        write_hydrodynamic_file(file, entry);
      });
}

/// What is found of a problem, for all draughts.
struct FoundSeries {
  dynamics::HydrodynamicSeries series;
  WavesLost lost = {};  ///< of the bodies at their deepest
};

/// The databases of a problem with a body that is lowered.
FoundSeries find_series(const RadiationProblem& problem, const Say& say, const Tell& tell) {
  const int body = problem.lowered_body();
  const RadiationProblem others = without_lowered(problem);
  const RadiationProblem::Body& lowered = problem.bodies[body];
  double done = 0.0;
  const double all =
      static_cast<double>(lowered.draughts.size()) + (others.bodies.empty() ? 0.0 : 1.0);
  const Tell tell_of_all = [&](double fraction, const std::string& what) {
    tell((done + fraction) / all, what);
  };
  std::optional<dynamics::HydrodynamicDatabase> alone;
  if (!others.bodies.empty()) {
    alone = find_database(others, "", say, tell_of_all).database;
    done += 1.0;
  }
  std::vector<double> draughts = {0.0};
  std::vector<dynamics::HydrodynamicDatabase> databases(1);
  WavesLost lost;
  for (const double draught : lowered.draughts) {
    draughts.push_back(draught);
    FoundDatabase found = find_database(
        at_draught(problem, draught),
        fmt::format(", {} at a draught of {:.4g} m", lowered.name, draught), say, tell_of_all);
    databases.push_back(std::move(found.database));
    lost = found.lost;
    done += 1.0;
  }
  databases[0] = with_dry_body(databases[1], body, alone ? &*alone : nullptr);
  return {dynamics::make_series(body, std::move(draughts), std::move(databases)), lost};
}

}  // namespace

std::vector<dynamics::MemoryStateSpace> find_memories(
    const std::vector<dynamics::HydrodynamicDatabase>& databases, const dynamics::MemoryFit& fit,
    const std::function<void(const std::string&)>& report) {
  const Say say = [&](const std::string& text) {
    if (report) report(text);
  };
  const auto compute = [&] {
    say("fitting the memory of the water");
    return fit_memories(databases, fit);
  };
  const fs::path folder = cache_folder();
  if (folder.empty()) return compute();
  const std::string identity = identity_of(databases, fit);
  const fs::path file = folder / (identity + ".h5");
  const auto read = [&] {
    auto known = read_memories(file, identity);
    if (known && known->size() != databases.size()) known.reset();
    if (known) say("memory of the water from " + file.string());
    return known;
  };
  return take_or_make(
      file, read, [&] { say("waiting for another run that fits the memory of the water"); },
      compute,
      [&](const std::vector<dynamics::MemoryStateSpace>& made) {
        write_memories(file, made, identity);
      });
}

namespace {

/// The mean drift forces of a problem's drifting vessels that float freely, or those that a named
/// database holds of its vessels, less what the excitation of a simulation has in the mean by
/// itself (calc_excitation_drift).
void add_mean_drift(const RadiationProblem& problem, dynamics::HydrodynamicDatabase& database) {
  const RadiationProblem::FreeVessels& vessels = *problem.drifting;
  const Eigen::MatrixXd stiffness =
      std::exchange(database.hydrostatic_stiffness, vessels.stiffness);
  const std::vector<Eigen::MatrixXcd> motions =
      calc_response_amplitudes(database, vessels.mass, vessels.damping);
  if (problem.given)
    database.hydrostatic_stiffness = stiffness;
  else
    database.mean_drift =
        calc_mean_drift(database, motions, vessels.damping, !problem.lids.empty());
  const std::vector<Eigen::MatrixXd> besides = calc_excitation_drift(database, motions);
  for (std::size_t k = 0; k < besides.size(); ++k) database.mean_drift[k] -= besides[k];
}

}  // namespace

FoundRadiation find_radiation(const RadiationProblem& problem,
                              const std::function<void(const std::string&)>& report,
                              const std::function<void(double, const std::string&)>& progress) {
  if (problem.bodies.empty() || problem.direct) return {};
  const Say say = [&](const std::string& text) {
    if (report) report(text);
  };
  const Tell tell = [&](double fraction, const std::string& what) {
    if (progress) progress(fraction, what);
  };
  dynamics::HydrodynamicSeries series;
  WavesLost lost;
  if (problem.given) {
    say("of the file that the case names");
    series = {0, {0.0}, {take_given_database(problem)}};
  } else if (problem.lowered_body() >= 0) {
    FoundSeries found = find_series(problem, say, tell);
    series = std::move(found.series);
    lost = found.lost;
  } else {
    FoundDatabase found = find_database(problem, "", say, tell);
    series = {0, {0.0}, {std::move(found.database)}};
    lost = found.lost;
  }
  if (problem.drifting) {
    add_mean_drift(problem, series.databases.front());
  }
  // What is taken of a given one for the case's bodies has lost what its maker found out about it.
  const std::span<const dynamics::HydrodynamicDatabase> doubted =
      problem.given ? std::span(problem.given.get(), 1)
                    : std::span(std::as_const(series.databases));
  std::vector<std::string> doubts = say_doubts(problem, doubted, lost, say);
  series.memories = find_memories(series.databases, memory_fit_of_vessels(), say);
  return {std::make_shared<const dynamics::HydrodynamicSeries>(std::move(series)),
          std::move(doubts)};
}

MarchedWater find_marched_water(const RadiationProblem& problem) {
  return compute_or_refuse(problem, make_marched_water);
}

}  // namespace blocklift::pipeline
