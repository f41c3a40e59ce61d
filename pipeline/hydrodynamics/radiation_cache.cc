#include "pipeline/hydrodynamics/radiation_cache.h"

#include <cctype>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "dynamics/errors.h"
#include "dynamics/marine/loads/excitation_drift.h"
#include "dynamics/marine/radiation/mean_drift.h"
#include "dynamics/marine/radiation/response_amplitude.h"
#include "pipeline/formats/hydrodynamics/hull_hash.h"
#include "pipeline/formats/hydrodynamics/memory_file.h"
#include "pipeline/hydrodynamics/cache_lock.h"
#include "pipeline/hydrodynamics/given_database.h"
#include "pipeline/hydrodynamics/hydrodynamic_report.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;

/// What `compute` makes of a problem; what is wrong with the problem is wrong input.
/// @param place of the problem in its file.
template <class Compute>
auto or_refuse(const Mark& place, const Compute& compute) {
  try {
    return compute();
  } catch (const dynamics::ModelError& error) {
    Diagnostics diagnostics;
    diagnostics.error(place, error.what());
    throw InputError(diagnostics);
  }
}

std::string names_of_bodies(const PanelProblem& problem) {
  std::vector<std::string> names;
  for (const PanelProblem::Body& body : problem.bodies) names.push_back(body.name);
  return list_of_names(names);
}

}  // namespace

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

WavesLost find_waves_lost(const PanelProblem& problem, const dynamics::PanelModel& model) {
  if (!may_lose_waves(problem)) return {};
  const double highest = problem.frequencies.back();
  return find_lost_coupling(model, find_distant_groups(model, highest), highest);
}

/// doubt_about_coupling of the bodies at their deepest draughts.
std::string doubt_about_distances(const PanelProblem& problem, const WavesLost& lost) {
  if (!lost) return {};
  std::vector<std::string> names;
  for (const PanelProblem::Body& body : problem.bodies) names.push_back(body.name);
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

/// Where a problem stands in its file, who is told what is done about it, and where it is kept.
struct Asker {
  Mark place;
  Say say;
  Tell tell;
  fs::path cache;
};

/// Computes the database of bodies that stay.
/// @param of_what the bodies, and their draught.
FoundDatabase compute_database(const PanelProblem& problem, const std::string& of_what,
                               const Asker& asker) {
  asker.say("computing that of " + of_what);
  const auto progress = [&](double fraction, const char* what) {
    asker.tell(fraction, of_what + ": " + what);
  };
  return or_refuse(asker.place, [&]() -> FoundDatabase {
    const dynamics::PanelModel model = make_panel_model(problem);
    const double highest = problem.frequencies.back();
    require_panels_for_waves(model, highest);
    if (problem.method == dynamics::PanelMethod::green_function)
      return {compute_radiation(problem, model, {}, progress)};
    const auto groups = find_distant_groups(model, highest);
    if (const std::string note = note_on_groups(model, groups); !note.empty()) asker.say(note);
    return {compute_radiation(problem, model, groups, progress), find_waves_lost(problem, model)};
  });
}

/// What is found of bodies that stay.
/// @param where stands behind their names: the draught of one that is lowered.
FoundDatabase find_for(const Asker& asker, const PanelProblem& problem, const std::string& where) {
  const std::string of_what = names_of_bodies(problem) + where;
  return find_database(problem,
                       {of_what, [&] { return compute_database(problem, of_what, asker); },
                        [&] {
                          return or_refuse(asker.place, [&] {
                            return find_waves_lost(problem, make_panel_model(problem));
                          });
                        }},
                       asker.cache, asker.say);
}

/// What is found of a problem, for all draughts.
struct FoundSeries {
  dynamics::HydrodynamicSeries series;
  WavesLost lost = {};  ///< of the bodies at their deepest
};

/// The databases of a problem with a body that is lowered.
FoundSeries find_series(const RadiationProblem& problem, const Asker& asker) {
  const std::size_t body = problem.lowered->body;
  const std::vector<double>& deeper = problem.lowered->draughts;
  const PanelProblem others = without_lowered(problem);
  double done = 0.0;
  const double all = static_cast<double>(deeper.size()) + (others.bodies.empty() ? 0.0 : 1.0);
  const Asker of_all{
      asker.place, asker.say,
      [&](double fraction, const std::string& what) { asker.tell((done + fraction) / all, what); },
      asker.cache};
  std::optional<dynamics::HydrodynamicDatabase> alone;
  if (!others.bodies.empty()) {
    alone = find_for(of_all, others, "").database;
    done += 1.0;
  }
  std::vector<double> draughts = {0.0};
  std::vector<dynamics::HydrodynamicDatabase> databases(1);
  WavesLost lost;
  for (const double draught : deeper) {
    draughts.push_back(draught);
    FoundDatabase found =
        find_for(of_all, at_draught(problem, draught),
                 fmt::format(", {} at a draught of {:.4g} m", problem.bodies[body].name, draught));
    databases.push_back(std::move(found.database));
    lost = found.lost;
    done += 1.0;
  }
  const int index = static_cast<int>(body);
  databases[0] = with_dry_body(databases[1], index, alone ? &*alone : nullptr);
  return {dynamics::make_series(index, std::move(draughts), std::move(databases)), lost};
}

}  // namespace

std::vector<dynamics::MemoryStateSpace> find_memories(
    const std::vector<dynamics::HydrodynamicDatabase>& databases, const dynamics::MemoryFit& fit,
    const fs::path& cache, const std::function<void(const std::string&)>& report) {
  const Say say = [&](const std::string& text) {
    if (report) report(text);
  };
  const auto compute = [&] {
    say("fitting the memory of the water");
    return fit_memories(databases, fit);
  };
  if (cache.empty()) return compute();
  const std::string identity = identity_of(databases, fit);
  const fs::path file = cache / (identity + ".h5");
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
                              const std::function<void(double, const std::string&)>& progress,
                              const fs::path& cache) {
  if (problem.bodies.empty() || problem.direct) return {};
  const Say say = [&](const std::string& text) {
    if (report) report(text);
  };
  const Tell tell = [&](double fraction, const std::string& what) {
    if (progress) progress(fraction, what);
  };
  const Asker asker{problem.place, say, tell, cache};
  dynamics::HydrodynamicSeries series;
  WavesLost lost;
  if (problem.given) {
    say("of the file that the case names");
    series = {0, {0.0}, {take_given_database(problem)}};
  } else if (problem.lowered) {
    FoundSeries found = find_series(problem, asker);
    series = std::move(found.series);
    lost = found.lost;
  } else {
    FoundDatabase found = find_for(asker, problem, "");
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
  series.memories = find_memories(series.databases, memory_fit_of_vessels(), cache, say);
  return {std::make_shared<const dynamics::HydrodynamicSeries>(std::move(series)),
          std::move(doubts)};
}

MarchedWater find_marched_water(const RadiationProblem& problem) {
  return or_refuse(problem.place, [&] { return make_marched_water(problem); });
}

}  // namespace blocklift::pipeline
