// One problem of panels with one identity and one cache, whoever asks for its database.
#include "pipeline/hydrodynamics/panel_cache.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/marine/hull/hull_shapes.h"
#include "pipeline/build/build_mechanism.h"
#include "pipeline/hydrodynamics/cache_folder.h"
#include "pipeline/hydrodynamics/hydrodynamic_problem.h"
#include "pipeline/hydrodynamics/radiation_cache.h"
#include "tests/pipeline/formats/hydrodynamics/same_database.h"
#include "tests/pipeline/hydrodynamics/own_cache.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

std::shared_ptr<const dynamics::Hull> box_of(double length) {
  return std::make_shared<const dynamics::Hull>(
      dynamics::make_barge({.length = length, .breadth = 4, .depth = 2}, {4, 2, 1, 1}, "box"));
}

PanelProblem some_problem() {
  PanelProblem problem;
  problem.bodies = {{"box", box_of(8), dynamics::Pose::translation({0, 0, -1}), {0, 0, 1}}};
  problem.frequencies = {1.2, 1.8};
  problem.headings = {0.0, 0.5};
  problem.lids = {{{-1, 2}, {1, 4}, 0.1}};
  return problem;
}

TEST(PanelProblem, WhateverDiffersInItMakesAnotherIdentity) {
  using Change = std::function<void(PanelProblem&)>;
  const std::vector<Change> changes = {
      [](PanelProblem& p) { p.bodies[0].name = "other"; },
      [](PanelProblem& p) { p.bodies[0].hull = box_of(8.001); },
      [](PanelProblem& p) { p.bodies[0].X_DB.p.z() = -1.001; },
      [](PanelProblem& p) { p.bodies[0].X_DB.R = dynamics::rotation_about(Vector3(0, 0, 1), 0.1); },
      [](PanelProblem& p) { p.bodies[0].p_BoR_B.z() = 1.5; },
      [](PanelProblem& p) { p.bodies.push_back(p.bodies[0]); },
      [](PanelProblem& p) { p.water.density = 1000; },
      [](PanelProblem& p) { p.water.gravity = 9.81; },
      [](PanelProblem& p) { p.water.depth = 20; },
      [](PanelProblem& p) { p.frequencies[1] = 1.9; },
      [](PanelProblem& p) { p.frequencies.push_back(1.9); },
      [](PanelProblem& p) { p.headings[1] = 0.6; },
      [](PanelProblem& p) { p.headings.clear(); },
      [](PanelProblem& p) { p.method = dynamics::PanelMethod::green_function; },
      [](PanelProblem& p) { p.lids[0].low.x() = -1.5; },
      [](PanelProblem& p) { p.lids[0].high.y() = 5; },
      [](PanelProblem& p) { p.lids[0].rate = 0.2; },
      [](PanelProblem& p) { p.lids.clear(); },
      [](PanelProblem& p) { p.symmetry = false; },
      [](PanelProblem& p) { p.far_field = true; }};
  std::set<std::string> identities = {identity_of(some_problem())};
  for (const Change& change : changes) {
    PanelProblem problem = some_problem();
    change(problem);
    identities.insert(identity_of(problem));
  }
  EXPECT_EQ(identities.size(), changes.size() + 1);
  // The same hull read again, and zeros of either sign.
  PanelProblem same = some_problem();
  same.bodies[0].hull = box_of(8);
  same.bodies[0].X_DB.p.x() = -0.0;
  EXPECT_EQ(identity_of(same), identity_of(some_problem()));
}

/// A barge whose centre of mass lies in the water line over its origin, where a lift has its
/// reference point.
class PanelsOfFiles : public ::testing::Test {
 protected:
  PanelsOfFiles() {
    folder_.write("vessels/barge.yaml", R"(kind: vessel
hull: {barge: {length: 40 m, breadth: 16 m, depth: 8 m}}
panel_size: 4 m
mass: 2296 t
centre_of_mass: [0 m, 0 m, 3.5 m]
radii_of_gyration: [6 m, 12 m, 12 m]
)");
  }

  /// As `hydro` is asked for it.
  HydrodynamicProblem of_hydro(const std::string& hydrodynamics = {}) const {
    folder_.write("hydro.yaml",
                  "kind: vessels\nvessels:\n"
                  "  B1: {vessel: vessels/barge, position: [0 m, 0 m], draughts: [3.5 m]}\n"
                  "hydrodynamics:\n"
                  "  frequencies: {lowest: 0.4 rad/s, highest: 1.2 rad/s, count: 5}\n" +
                      hydrodynamics);
    Diagnostics diagnostics;
    auto problem = read_hydrodynamic_problem("hydro.yaml", ModelLibrary({}), diagnostics);
    EXPECT_TRUE(problem) << diagnostics.to_text();
    return problem.value_or(HydrodynamicProblem());
  }

  /// As a mechanism has it, and a lift likewise.
  RadiationProblem of_mechanism(const std::string& radiation = {}) const {
    folder_.write("mechanism.yaml",
                  "mechanism: afloat\nsea:\n  radiation: {lowest_frequency: 0.4 rad/s, "
                  "highest_frequency: 1.2 rad/s, frequencies: 5" +
                      radiation +
                      "}\nvessels:\n"
                      "  B1: {model: vessels/barge, position: [30 m, -4 m], draught: 3.5 m}\n"
                      "simulate: {duration: 1 s}\n");
    Diagnostics diagnostics;
    ModelLibrary library({});
    const auto file = read_mechanism("mechanism.yaml", library, diagnostics);
    EXPECT_TRUE(file) << diagnostics.to_text();
    return file ? radiation_problem(*file) : RadiationProblem();
  }

  test::OwnCache cache_;
  test::TemporaryFolder folder_;  // the working directory
};

TEST_F(PanelsOfFiles, HydroAndLiftsAskForOneProblem) {
  const PanelProblem lift = of_mechanism();
  EXPECT_EQ(identity_of(prepare_state(of_hydro(), 0).panels), identity_of(lift));
  EXPECT_NE(identity_of(prepare_state(of_hydro("  symmetry: false\n"), 0).panels),
            identity_of(lift));
  EXPECT_NE(identity_of(prepare_state(of_hydro("  mean_drift: true\n"), 0).panels),
            identity_of(lift));
  const std::string method = "method: green function";
  EXPECT_EQ(identity_of(prepare_state(of_hydro("  " + method + "\n"), 0).panels),
            identity_of(of_mechanism(", " + method)));
}

void expect_same(const HydrodynamicFile& one, const HydrodynamicFile& other) {
  EXPECT_EQ(one.identity, other.identity);
  EXPECT_EQ(one.series.draughts, other.series.draughts);
  ASSERT_EQ(one.series.databases.size(), other.series.databases.size());
  for (std::size_t k = 0; k < one.series.databases.size(); ++k)
    test::expect_same(one.series.databases[k], other.series.databases[k]);
}

/// The file of a problem, and what is said meanwhile.
HydrodynamicFile find(const HydrodynamicProblem& problem, std::vector<std::string>& said,
                      const std::filesystem::path& cache = cache_folder()) {
  said.clear();
  return find_hydrodynamics(problem, {prepare_state(problem, 0)}, {}, cache,
                            [&](const std::string& what) { said.push_back(what); });
}

TEST_F(PanelsOfFiles, WhatIsKeptIsWhatIsComputed) {
  HydrodynamicProblem problem = of_hydro("  mean_drift: true\n  headings: [0 deg, 90 deg]\n");
  const HydrodynamicFile computed = compute_hydrodynamics(problem, {prepare_state(problem, 0)});
  EXPECT_THAT(cache_.entries(), IsEmpty());
  std::vector<std::string> said;
  expect_same(find(problem, said), computed);
  EXPECT_THAT(said, IsEmpty());
  expect_same(find(problem, said), computed);
  EXPECT_THAT(said, ElementsAre(HasSubstr("B1 at a draught of 3.500 m: from the cache, ")));
  // Another mass in the same panels: only what follows from it differs.
  problem.bodies[0].radii_of_gyration.y() = 10.0;
  const HydrodynamicFile other = find(problem, said);
  EXPECT_EQ(said.size(), 1U);
  EXPECT_NE(other.identity, computed.identity);
  EXPECT_EQ(other.series.databases[0].added_mass, computed.series.databases[0].added_mass);
  EXPECT_NE(other.series.databases[0].mean_drift, computed.series.databases[0].mean_drift);
  EXPECT_EQ(cache_.entries().size(), 1U);
}

TEST_F(PanelsOfFiles, WhatALiftHasComputedServesHydroAndTheReverse) {
  std::vector<std::string> said;
  const FoundRadiation lift = find_radiation(of_mechanism(), {});
  const HydrodynamicFile file = find(of_hydro(), said);
  EXPECT_THAT(said, ElementsAre(HasSubstr("from the cache")));
  EXPECT_EQ(file.series.databases[0].retardation, lift.series->databases[0].retardation);
  const std::string method = "method: green function";
  const HydrodynamicFile hulls = find(of_hydro("  " + method + "\n"), said);
  EXPECT_THAT(said, IsEmpty());
  const FoundRadiation again = find_radiation(
      of_mechanism(", " + method), [&](const std::string& what) { said.push_back(what); });
  ASSERT_FALSE(said.empty());
  EXPECT_THAT(said.front(), HasSubstr("from the cache"));
  EXPECT_EQ(again.series->databases[0].added_mass, hulls.series.databases[0].added_mass);
}

// Nothing is taken, either: what lies in the cache is computed anew.
TEST_F(PanelsOfFiles, NothingIsKeptWithoutACache) {
  std::vector<std::string> said;
  for (int run = 0; run < 2; ++run) {
    find(of_hydro(), said, no_cache());
    EXPECT_THAT(said, IsEmpty());
    const auto listen = [&](const std::string& what) { said.push_back(what); };
    find_radiation(of_mechanism(), listen, {}, no_cache());
    EXPECT_THAT(said, Not(Contains(HasSubstr("cache"))));
    EXPECT_EQ(cache_.entries().size(), run == 0 ? 0U : 2U);
    if (run == 0) find_radiation(of_mechanism(), {});
  }
}

}  // namespace
}  // namespace blocklift::pipeline
