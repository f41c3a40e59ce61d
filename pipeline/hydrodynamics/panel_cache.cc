#include "pipeline/hydrodynamics/panel_cache.h"

#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "pipeline/formats/hydrodynamics/hull_hash.h"
#include "pipeline/hydrodynamics/cache_lock.h"
#include "pipeline/hydrodynamics/method_hash.h"
#include "pipeline/version.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;

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

/// What an entry says. One of an older program does not tell which waves are lost: that is found,
/// and put into it.
FoundDatabase take_entry(const PanelProblem& problem, const DatabaseMaker& maker,
                         HydrodynamicFile entry, const fs::path& file) {
  if (!entry.waves_lost && may_lose_waves(problem)) {
    entry.waves_lost = maker.find_waves_lost();
    try {
      write_hydrodynamic_file(file, entry);
    } catch (const std::runtime_error&) {
      // What cannot be kept is found again.
    }
  }
  return {std::move(entry.series.databases.front()), entry.waves_lost.value_or(WavesLost{}), file};
}

}  // namespace

std::string identity_of(const PanelProblem& problem) {
  ContentHash hash;
  hash.add(std::int64_t{dynamics::panel_method_version});
  if (problem.bodies.size() > 1) hash.add(std::int64_t{dynamics::distant_groups_version});
  for (const PanelProblem::Body& body : problem.bodies) {
    hash.add(body.name);
    add(hash, *body.hull);
    for (Eigen::Index column = 0; column < 3; ++column) {
      add(hash, dynamics::Vector3(body.X_DB.R.col(column)));
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
  // Others are kept under the names that they had before there was a choice.
  if (!problem.symmetry) hash.add("whole");
  if (problem.far_field) hash.add("far field");
  for (const dynamics::DampingLid& lid : problem.lids) {
    hash.add(std::span<const double>(lid.low.data(), 2));
    hash.add(std::span<const double>(lid.high.data(), 2));
    hash.add(lid.rate);
  }
  return hash.digits();
}

bool may_lose_waves(const PanelProblem& problem) {
  return problem.bodies.size() > 1 && problem.method != dynamics::PanelMethod::green_function;
}

FoundDatabase find_database(const PanelProblem& problem, const DatabaseMaker& maker,
                            const fs::path& cache,
                            const std::function<void(const std::string&)>& say) {
  if (cache.empty()) return maker.compute();
  const std::string identity = identity_of(problem);
  const fs::path file = cache / (identity + ".h5");
  const auto read = [&]() -> std::optional<FoundDatabase> {
    std::optional<HydrodynamicFile> entry = read_entry(file, identity);
    if (!entry) return std::nullopt;
    say("from the cache, " + file.string());
    return take_entry(problem, maker, std::move(*entry), file);
  };
  return take_or_make(
      file, read, [&] { say("waiting for another run that computes that of " + maker.of_what); },
      maker.compute,
      [&](const FoundDatabase& made) {
        HydrodynamicFile entry{
            identity,
            fmt::format("computed by blocklift {} of {}", program_version, maker.of_what),
            {0, {0.0}, {made.database}}};
        if (may_lose_waves(problem)) entry.waves_lost = made.lost;
        write_hydrodynamic_file(file, entry);
      });
}

}  // namespace blocklift::pipeline
