// Fitted memories of the water, kept in the cache of databases.
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/hydrodynamics/radiation_cache.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

/// The cache is a folder of its own while this lives.
class OwnCache {
 public:
  OwnCache() {
    if (const char* before = std::getenv("BLOCKLIFT_CACHE")) before_ = before;
    ::setenv("BLOCKLIFT_CACHE", folder_.path().c_str(), 1);
  }
  ~OwnCache() {
    if (before_.empty()) {
      ::unsetenv("BLOCKLIFT_CACHE");
    } else {
      ::setenv("BLOCKLIFT_CACHE", before_.c_str(), 1);
    }
  }
  OwnCache(const OwnCache&) = delete;
  OwnCache& operator=(const OwnCache&) = delete;

  std::vector<fs::path> entries() const {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder_.path())) {
      if (entry.path().extension() == ".h5") files.push_back(entry.path());
    }
    return files;
  }

 private:
  test::TemporaryFolder folder_;
  std::string before_;
};

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
  found.memories =
      find_memories(databases, how, [&](const std::string& text) { found.said.push_back(text); });
  return found;
}

TEST(MemoryCache, TheSecondRunHasTheSameNumbersFromTheCache) {
  const OwnCache cache;
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
  const OwnCache cache;
  find(dry_and_wet(3.0));
  EXPECT_THAT(find(dry_and_wet(3.001)).said, ElementsAre(HasSubstr("fitting")));
  EXPECT_THAT(find(dry_and_wet(3.0), {.tolerance = 1e-2}).said, ElementsAre(HasSubstr("fitting")));
  EXPECT_EQ(cache.entries().size(), 3U);
}

TEST(MemoryCache, ADamagedEntryIsFittedAgain) {
  const OwnCache cache;
  find(dry_and_wet(3.0));
  ASSERT_EQ(cache.entries().size(), 1U);
  fs::resize_file(cache.entries()[0], 700);
  EXPECT_THAT(find(dry_and_wet(3.0)).said, ElementsAre(HasSubstr("fitting")));
  EXPECT_THAT(find(dry_and_wet(3.0)).said, ElementsAre(HasSubstr("from ")));
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
