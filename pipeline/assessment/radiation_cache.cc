#include "pipeline/assessment/radiation_cache.h"

#include <cstdint>
#include <cstdlib>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "dynamics/errors.h"
#include "pipeline/formats/hull_hash.h"
#include "pipeline/formats/hydrodynamic_database_file.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;

/// Grows when the panel method changes what it computes.
constexpr std::int64_t method_version = 1;

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
  hash.add(method_version);
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
  return hash.digits();
}

std::shared_ptr<const dynamics::HydrodynamicDatabase> find_radiation(
    const RadiationProblem& problem, const std::function<void(const std::string&)>& report) {
  if (problem.bodies.empty() || problem.direct) return nullptr;
  const auto say = [&](const std::string& text) {
    if (report) report(text);
  };
  const std::string identity = identity_of(problem);
  const fs::path folder = cache_folder();
  const fs::path file = folder / (identity + ".h5");
  if (!folder.empty() && read_identity(file) == identity) {
    try {
      auto database =
          std::make_shared<const dynamics::HydrodynamicDatabase>(read_hydrodynamic_database(file));
      say("from " + file.string());
      return database;
    } catch (const HydrodynamicFileError&) {
      // Of an older version, or damaged: computed anew.
    }
  }
  say("computing that of " + names_of_bodies(problem));
  auto database = std::make_shared<const dynamics::HydrodynamicDatabase>(
      compute_or_refuse(problem, [](const RadiationProblem& p) { return compute_radiation(p); }));
  if (folder.empty()) return database;
  try {
    std::error_code ignored;
    fs::create_directories(folder, ignored);
    write_hydrodynamic_database(file, *database, identity,
                                "computed for a case with " + names_of_bodies(problem));
  } catch (const std::runtime_error&) {
    // What cannot be kept is computed again.
  }
  return database;
}

MarchedWater find_marched_water(const RadiationProblem& problem) {
  return compute_or_refuse(problem, make_marched_water);
}

}  // namespace blocklift::pipeline
