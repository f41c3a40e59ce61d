// Fitted memories of the water, kept in the cache of databases.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <numbers>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/marine/hull/hull_shapes.h"
#include "pipeline/formats/hydrodynamics/convention_check.h"
#include "pipeline/formats/hydrodynamics/hydrodynamic_database_file.h"
#include "pipeline/hydrodynamics/cache_folder.h"
#include "pipeline/hydrodynamics/radiation_cache.h"
#include "tests/pipeline/hydrodynamics/own_cache.h"

namespace blocklift::pipeline {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

/// A dry body, and one whose heave is damped.
std::vector<dynamics::HydrodynamicDatabase> dry_and_wet(double period) {
  std::vector<dynamics::HydrodynamicDatabase> databases(2);
  for (auto& database : databases) {
    database.time_step = 0.1;
    database.retardation.assign(100, Eigen::MatrixXd::Zero(6, 6));
  }
  for (std::size_t n = 0; n < 100; ++n) {
    const double t = 0.1 * static_cast<double>(n);
    databases[1].retardation[n](2, 2) = 1e5 * std::exp(-t) * std::cos(6.0 * t / period);
  }
  return databases;
}

const dynamics::MemoryFit fit{.tolerance = 1e-3};

/// What is said while the memories of `databases` are found.
struct Found {
  std::vector<dynamics::MemoryStateSpace> memories;
  std::vector<std::string> said;
};

Found find(const std::vector<dynamics::HydrodynamicDatabase>& databases,
           const dynamics::MemoryFit& how = fit) {
  Found found;
  found.memories = find_memories(databases, how, cache_folder(),
                                 [&](const std::string& text) { found.said.push_back(text); });
  return found;
}

TEST(MemoryCache, TheSecondRunHasTheSameNumbersFromTheCache) {
  const test::OwnCache cache;
  const Found first = find(dry_and_wet(3.0)), second = find(dry_and_wet(3.0));
  EXPECT_THAT(first.said, ElementsAre(HasSubstr("fitting")));
  EXPECT_THAT(second.said, ElementsAre(HasSubstr("from ")));
  ASSERT_EQ(second.memories.size(), 2U);
  EXPECT_EQ(second.memories[0].state_count(), 0);
  EXPECT_EQ(second.memories[0].mode_count(), 6);
  EXPECT_GT(second.memories[1].state_count(), 0);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(second.memories[k].A(), first.memories[k].A());
    EXPECT_EQ(second.memories[k].B(), first.memories[k].B());
    EXPECT_EQ(second.memories[k].C(), first.memories[k].C());
    EXPECT_EQ(second.memories[k].error(), first.memories[k].error());
  }
}

TEST(MemoryCache, OtherRetardationOrAnotherFitIsAnotherEntry) {
  const test::OwnCache cache;
  find(dry_and_wet(3.0));
  EXPECT_THAT(find(dry_and_wet(3.001)).said, ElementsAre(HasSubstr("fitting")));
  EXPECT_THAT(find(dry_and_wet(3.0), {.tolerance = 1e-2}).said, ElementsAre(HasSubstr("fitting")));
  EXPECT_EQ(cache.entries().size(), 3U);
}

TEST(MemoryCache, ADamagedEntryIsFittedAgain) {
  const test::OwnCache cache;
  find(dry_and_wet(3.0));
  ASSERT_EQ(cache.entries().size(), 1U);
  fs::resize_file(cache.entries()[0], 700);
  EXPECT_THAT(find(dry_and_wet(3.0)).said, ElementsAre(HasSubstr("fitting")));
  EXPECT_THAT(find(dry_and_wet(3.0)).said, ElementsAre(HasSubstr("from ")));
}

/// Panels of 2 m down a side of half a metre and of one.
RadiationProblem lowered_box() {
  RadiationProblem problem;
  problem.bodies = {{"box",
                     std::make_shared<const dynamics::Hull>(dynamics::make_barge(
                         {.length = 8, .breadth = 4, .depth = 2}, {4, 2, 1, 1}, "box")),
                     dynamics::Pose::translation({0, 0, -1}),
                     {0, 0, 1}}};
  problem.lowered = {0, {0.5, 1}};
  problem.frequencies = {1.2, 1.8};
  for (int quarter = 0; quarter < 4; ++quarter)
    problem.headings.push_back(0.5 * std::numbers::pi * quarter);
  return problem;
}

// A lift that finds its database in the cache is to be believed no more than the first that
// computed it; of several draughts the worst is said, once.
TEST(RadiationCache, DoubtsAreThoseOfTheFirstRun) {
  const test::OwnCache cache;
  std::vector<std::string> said;
  const auto listen = [&](const std::string& what) { said.push_back(what); };
  const FoundRadiation computed = find_radiation(lowered_box(), listen);
  EXPECT_THAT(said, Contains(HasSubstr("computing")));
  said.clear();
  const FoundRadiation kept = find_radiation(lowered_box(), listen);
  EXPECT_THAT(said, Not(Contains(HasSubstr("computing"))));
  EXPECT_EQ(kept.doubts, computed.doubts);
  ASSERT_THAT(kept.doubts, Contains(HasSubstr("radiation force of box")));
  ASSERT_EQ(kept.series->databases.size(), 3U);  // the first of them dry
  double largest = 0.0;
  for (const auto& database : kept.series->databases)
    if (database.change_from_coarser.size() > 0)
      largest = std::max(largest, database.change_from_coarser.maxCoeff());
  EXPECT_THAT(kept.doubts.front(), HasSubstr(fmt::format("changes by {:.0f} %", 100 * largest)));
}

// What the surface's mesh tells of the waves between bodies lies in the database's own file, so
// that it is not meshed again.
TEST(RadiationCache, KeepsWhichWavesAreLost) {
  const test::OwnCache cache;
  RadiationProblem problem = lowered_box();
  problem.lowered.reset();
  problem.bodies.push_back(problem.bodies.front());
  problem.bodies.front().X_DB.p.y() = -4;
  problem.bodies.back().X_DB.p.y() = 4;
  problem.bodies.back().name = "other";
  const FoundRadiation computed = find_radiation(problem, {});
  const fs::path file = fs::path(std::getenv("BLOCKLIFT_CACHE")) / (identity_of(problem) + ".h5");
  HydrodynamicFile entry = read_hydrodynamic_file(file);
  ASSERT_TRUE(entry.waves_lost);
  const WavesLost found = *entry.waves_lost;
  EXPECT_EQ(find_radiation(problem, {}).doubts, computed.doubts);
  entry.waves_lost = WavesLost(dynamics::CouplingReach{0, 1, 4, 77});
  write_hydrodynamic_file(file, entry);
  EXPECT_THAT(find_radiation(problem, {}).doubts,
              Contains(HasSubstr("ox and other lie 4 m apart: waves shorter than 77 m")));
  // What is of no use, or what an older program did not write, is found again and put there; the
  // database is not computed again.
  const WavesLost of_no_body = dynamics::CouplingReach{0, 2, 4, 77};
  for (const bool is_told : {false, true}) {
    entry.waves_lost.reset();
    if (is_told) entry.waves_lost.emplace(of_no_body);
    write_hydrodynamic_file(file, entry);
    std::vector<std::string> said;
    EXPECT_EQ(
        find_radiation(problem, [&](const std::string& what) { said.push_back(what); }).doubts,
        computed.doubts);
    EXPECT_THAT(said, Not(Contains(HasSubstr("computing"))));
    const std::optional<WavesLost> again = read_hydrodynamic_file(file).waves_lost;
    ASSERT_TRUE(again);
    EXPECT_EQ(again->has_value(), found.has_value());
  }
  for (const auto& one : fs::directory_iterator(std::getenv("BLOCKLIFT_CACHE")))
    EXPECT_NE(one.path().extension(), ".coupling");
}

/// What this program computes is of its own conventions, and what is spoilt is told.
TEST(RadiationCache, WhatIsComputedHasItsConventions) {
  const test::OwnCache cache;
  RadiationProblem problem = lowered_box();
  problem.lowered.reset();
  problem.frequencies = {0.6, 0.9, 1.2, 1.5, 1.8, 2.1};
  problem.headings.clear();
  for (int h = 0; h < 12; ++h) problem.headings.push_back(std::numbers::pi / 6 * h);
  dynamics::HydrodynamicDatabase database = find_radiation(problem, {}).series->databases.front();
  database.hydrostatic_stiffness = Eigen::MatrixXd::Zero(6, 6);
  database.hydrostatic_stiffness(2, 2) = database.water.density * database.water.gravity * 8 * 4;
  EXPECT_THAT(doubts_about_conventions(database), ::testing::IsEmpty());
  dynamics::HydrodynamicDatabase spoilt = database;
  for (auto* forces : {&spoilt.froude_krylov, &spoilt.diffraction})
    for (Eigen::MatrixXcd& X : *forces) X = Eigen::MatrixXcd(-X);
  EXPECT_THAT(doubts_about_conventions(spoilt),
              ElementsAre(HasSubstr("if the forces had the opposite sign")));
  spoilt = database;
  for (Eigen::MatrixXd& B : spoilt.damping) B *= 3;
  EXPECT_THAT(doubts_about_conventions(spoilt), ElementsAre(HasSubstr("contradict each other")));
}

// What one method found is not taken for what another would; the marched surface's names stay.
TEST(RadiationCache, MethodsHaveDatabasesOfTheirOwn) {
  RadiationProblem problem;
  problem.frequencies = {0.5, 1.0};
  const std::string marched = identity_of(problem);
  problem.method = dynamics::PanelMethod::green_function;
  EXPECT_NE(identity_of(problem), marched);
}

}  // namespace
}  // namespace blocklift::pipeline
