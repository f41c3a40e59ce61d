#include "pipeline/comparison/compared_blocks.h"

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/comparison/comparison.h"
#include "tests/pipeline/comparison/sample_folder.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

using test::sample_stress;
using test::sample_surface;
using test::SampleBlock;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// Folders of results with blocks, or without.
class BlocksOfFolders : public ::testing::Test {
 protected:
  static void write(const std::string& folder, const std::optional<SampleBlock>& block) {
    test::write_sample_folder(folder, test::sample_summary(), "case: two-ropes\n", "", block);
  }
  static std::string page_of(const std::vector<std::filesystem::path>& folders) {
    return comparison_page(compare_results(read_compared_results(folders), {}));
  }

  const test::TemporaryFolder folder_;
};

TEST_F(BlocksOfFolders, DifferencesOnOneMeshAreTakenPointByPoint) {
  const BlockSurface surface = sample_surface(4);
  write("before", SampleBlock{surface, 1});
  write("after", SampleBlock{surface, 1.1});
  const auto results = read_compared_results({"before", "after"});
  const ComparedBlocks compared = compare_blocks(results);
  EXPECT_EQ(compared.way, "history");
  ASSERT_EQ(compared.blocks.size(), 2u);
  EXPECT_EQ(compared.blocks[1].surface_of, 0u);
  EXPECT_THAT(remarks_on_blocks(results, compared), IsEmpty());
  const std::vector<double> stress = sample_stress(surface, 1.25);
  const BlockDifference& difference = compared.blocks[1].differences.at("dynamic");
  for (std::size_t i = 0; i < stress.size(); ++i) {
    const double* place = &surface.points[3 * i];
    EXPECT_NEAR(difference.von_mises[i], 0.1 * stress[i], 1e-12 * stress[i]);
    EXPECT_NEAR(difference.displacement[i],
                0.1 * 1.25e-3 * std::hypot(place[0], place[1], place[2]), 1e-12);
  }
}

TEST_F(BlocksOfFolders, DifferencesOnOtherMeshesAreTakenPlateByPlate) {
  write("before", SampleBlock{sample_surface(3), 1});
  write("after", SampleBlock{sample_surface(5), 1.1});
  const auto results = read_compared_results({"before", "after"});
  const ComparedBlocks compared = compare_blocks(results);
  ASSERT_EQ(compared.blocks.size(), 2u);
  EXPECT_EQ(compared.blocks[1].surface_of, std::nullopt);
  EXPECT_THAT(
      remarks_on_blocks(results, compared),
      ElementsAre("The mesh of after is not that of before: for the differences each of its "
                  "points takes the value at the nearest place of the same part of "
                  "before."));
  const std::vector<double> stress = sample_stress(sample_surface(5), 1);
  for (std::size_t i = 0; i < stress.size(); ++i)
    EXPECT_NEAR(compared.blocks[1].differences.at("static").von_mises[i], 0.1 * stress[i], 1e-4);
}

TEST_F(BlocksOfFolders, PartsWithoutACounterpartAreNamedAndHaveNoDifference) {
  write("before", SampleBlock{sample_surface(3), 1});
  write("after", SampleBlock{sample_surface(4, "new bulkhead"), 1});
  const auto results = read_compared_results({"before", "after"});
  const ComparedBlocks compared = compare_blocks(results);
  ASSERT_EQ(compared.blocks.size(), 2u);
  EXPECT_THAT(compared.blocks[1].parts_without, ElementsAre("new bulkhead"));
  EXPECT_THAT(compared.blocks[1].parts_partly_without, IsEmpty());
  EXPECT_THAT(compared.blocks[1].parts_lost, ElementsAre("bulkhead"));
  EXPECT_TRUE(std::isnan(compared.blocks[1].differences.at("static").von_mises.back()));
  const std::string page = page_of({"before", "after"});
  EXPECT_THAT(page, HasSubstr("Parts of after without a counterpart in before, grey where the "
                              "difference is drawn: new bulkhead."));
  EXPECT_THAT(page, HasSubstr("Parts of before that after lacks: bulkhead."));
}

TEST_F(BlocksOfFolders, ThreeResultsShareTheirMeshes) {
  write("a", SampleBlock{sample_surface(3), 1});
  write("b", SampleBlock{sample_surface(4), 1});
  write("c", SampleBlock{sample_surface(4), 2});
  const ComparedBlocks compared = compare_blocks(read_compared_results({"a", "b", "c"}));
  ASSERT_EQ(compared.blocks.size(), 3u);
  EXPECT_EQ(compared.blocks[2].surface_of, 1u);
}

TEST_F(BlocksOfFolders, TheCheckedStressOfPlatesIsATable) {
  write("before", SampleBlock{sample_surface(3), 1});
  write("after", SampleBlock{sample_surface(4), 1.1});
  const auto results = read_compared_results({"before", "after"});
  const StressByPart stresses = stress_by_part(results, compare_blocks(results));
  EXPECT_TRUE(stresses.is_checked);
  ASSERT_EQ(stresses.parts.size(), 2u);
  EXPECT_EQ(stresses.parts[0].part, "deck at z = 0 m");
  EXPECT_DOUBLE_EQ(stresses.parts[0].at_rest[0], 100e6);
  EXPECT_DOUBLE_EQ(stresses.parts[0].in_motion[1], 1.1 * 1.25 * 100e6);
  const std::string page = page_of({"before", "after"});
  EXPECT_THAT(page, HasSubstr("Largest checked stress of each plate over the whole lift, MPa"));
  EXPECT_THAT(page, HasSubstr("<td class=\"right\">137.50</td><td class=\"right\">+12.50</td>"));
}

TEST_F(BlocksOfFolders, WithoutTheWholeLiftTheDrawnStressOfPartsIsATable) {
  write("before", SampleBlock{sample_surface(3), 1});
  write("after", SampleBlock{sample_surface(3, "wall"), 1, false});
  write("again", SampleBlock{sample_surface(3), 1, false});
  const auto results = read_compared_results({"again", "after", "before"});
  const ComparedBlocks compared = compare_blocks(results);
  EXPECT_EQ(compared.way, "simultaneous");
  ASSERT_EQ(compared.blocks.size(), 2u);
  EXPECT_THAT(compared.remarks,
              ElementsAre("There are no pictures of before: its stresses are not of the same kind "
                          "as those of again."));
  const StressByPart stresses = stress_by_part(results, compared);
  EXPECT_FALSE(stresses.is_checked);
  ASSERT_EQ(stresses.parts.size(), 3u);  // bulkhead, wall, deck
  EXPECT_EQ(stresses.parts[2].part, "deck");
  EXPECT_DOUBLE_EQ(stresses.parts[2].at_rest[0], 72e6);
  EXPECT_TRUE(std::isnan(stresses.parts[0].at_rest[stresses.parts[0].part == "wall" ? 0 : 1]));
}

TEST_F(BlocksOfFolders, ResultsWithoutStressesHaveNoPicturesAndSaySo) {
  write("without", std::nullopt);
  write("with", SampleBlock{sample_surface(3), 1});
  const std::string drawing = page_of({"with", "with"});
  const std::string neither = page_of({"without", "without"});
  EXPECT_THAT(neither,
              HasSubstr("There are no pictures: none of the results holds a block's stresses."));
  EXPECT_THAT(page_of({"without", "with"}),
              HasSubstr("There are no pictures: without, from which changes count, holds no "
                        "stresses of a block."));
  EXPECT_THAT(page_of({"with", "without"}),
              HasSubstr("There are no pictures of without: it holds no stresses of a block."));
  EXPECT_THAT(page_of({"with", "without"}), HasSubstr("\"block\":null"));
  // Only pages that draw hold the library for it.
  EXPECT_LT(neither.size() + 300'000, drawing.size());
  EXPECT_THAT(drawing, Not(HasSubstr("\"block\":null")));
}

}  // namespace
}  // namespace blocklift::pipeline
