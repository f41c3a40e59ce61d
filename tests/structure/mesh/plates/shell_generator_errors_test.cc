// What is said when the description of a block is wrong.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "structure/error.h"
#include "structure/mesh/plates/shell_generator.h"
#include "tests/structure/hull_block.h"

namespace blocklift::structure {
namespace {

using test::cross_of_plates;
using ::testing::HasSubstr;

std::string refusal(const BlockDescription& block) {
  try {
    generate_shell_mesh(block);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ShellGeneratorErrors, PlateThatTouchesNothingIsNamed) {
  BlockDescription block = cross_of_plates();
  block.plates.push_back({"stray", Axis::y, {5}, {{{4, 5}, {}, {1, 2}}}, 0.01, "AH36"});
  EXPECT_THAT(refusal(block), HasSubstr("not joined to the rest of the block: stray at y = 5 m"));
}

TEST(ShellGeneratorErrors, PlateThatTouchesACornerOnlyIsNamed) {
  BlockDescription block = cross_of_plates();
  block.plates.push_back({"corner", Axis::z, {0}, {{{2, 3}, {1, 2}, {}}}, 0.02, "AH36"});
  EXPECT_THAT(refusal(block), HasSubstr("not joined to the rest of the block: corner at z = 0 m"));
}

TEST(ShellGeneratorErrors, UnknownMaterialListsTheKnown) {
  BlockDescription block = cross_of_plates();
  block.plates[0].material = "AH32";
  EXPECT_THAT(refusal(block), HasSubstr("\"AH32\", which is not among the materials: AH36"));
}

TEST(ShellGeneratorErrors, OverlapOfDifferentThicknessNamesBoth) {
  BlockDescription block = cross_of_plates();
  block.plates.push_back({"doubler", Axis::z, {0}, {{{1.5, 2.5}, {0, 1}, {}}}, 0.03, "AH36"});
  EXPECT_THAT(refusal(block), HasSubstr("plates flat at z = 0 m (20 mm) and doubler at z = 0 m"));
}

TEST(ShellGeneratorErrors, ThicknessLargerThanSpacing) {
  BlockDescription block = cross_of_plates();
  block.plates[1].positions = {1, 1.008};
  EXPECT_THAT(refusal(block), HasSubstr("upright at x = 1 m and upright at x = 1.008 m lie 8 mm"));
}

TEST(ShellGeneratorErrors, PlateWithinAnothersThickness) {
  BlockDescription block = cross_of_plates();
  block.plates[1].extent[2] = {-0.009, 0.008};
  EXPECT_THAT(refusal(block), HasSubstr("it lies within the thickness of a plate there"));
}

TEST(ShellGeneratorErrors, ElementsThatNoMemoryHoldsAreRefusedAtOnce) {
  BlockDescription block = cross_of_plates();
  block.largest_element = 1e-9;
  EXPECT_THAT(refusal(block), HasSubstr("use larger elements"));
  block.largest_element = 0;
  EXPECT_THAT(refusal(block), HasSubstr("the largest element is 0 m; it must be positive"));
}

TEST(ShellGeneratorErrors, ThicknessMustBePositive) {
  BlockDescription block = cross_of_plates();
  block.plates[1].thickness = -0.01;
  EXPECT_THAT(refusal(block), HasSubstr("\"upright\" has a thickness of -0.01 m"));
}

TEST(ShellGeneratorErrors, NameUsedTwice) {
  BlockDescription block = cross_of_plates();
  block.plates[1].name = "flat";
  EXPECT_THAT(refusal(block), HasSubstr("\"flat\" bears a name that another part has"));
}

TEST(ShellGeneratorErrors, LugMustTouchItsPad) {
  BlockDescription block = test::small_block();
  block.lugs[0].extent[0] = {3.2, 4};  // at the other end of the side, on the pad of L2
  block.lugs[1].extent[0] = {0, 0.8};
  EXPECT_THAT(refusal(block), HasSubstr("lug \"L1\" does not touch its pad \"pad_L1\""));
}

TEST(ShellGeneratorErrors, PinOutOfReach) {
  BlockDescription block = test::small_block();
  block.lugs[2].p_BPin = {0.4, 3, 5.25};
  EXPECT_THAT(refusal(block), HasSubstr("the pin of lug \"L3\" lies 2.87"));
}

TEST(ShellGeneratorErrors, LugOnAPadThatIsNotThere) {
  BlockDescription block = test::small_block();
  block.lugs[0].pad = "pad_7";
  EXPECT_THAT(refusal(block), HasSubstr("its pads are pad_L1, pad_L2"));
}

TEST(ShellGeneratorErrors, PadThinnerThanItsPlate) {
  BlockDescription block = test::small_block();
  block.pads[1].thickness = 0.010;
  EXPECT_THAT(refusal(block), HasSubstr("pad \"pad_L2\" is 10 mm thick in total, thinner than"));
}

TEST(ShellGeneratorErrors, PadBesideEveryPlate) {
  BlockDescription block = test::small_block();
  block.pads[0].position = 1.3;
  EXPECT_THAT(refusal(block), HasSubstr("pad \"pad_L1\" at y = 1.3 m lies on no plate"));
}

TEST(ShellGeneratorErrors, OpeningInAPlateThatIsNotThere) {
  BlockDescription block = cross_of_plates();
  block.openings = {{"hole", "deck", {}, {{{0.8, 1.2}, {0.3, 0.7}, {}}}}};
  EXPECT_THAT(refusal(block), HasSubstr("opening \"hole\" is cut into plate \"deck\""));
}

TEST(ShellGeneratorErrors, MaterialOutOfRange) {
  BlockDescription block = cross_of_plates();
  block.materials[0].poisson_ratio = 0.5;
  EXPECT_THAT(refusal(block), HasSubstr("material \"AH36\": Poisson's ratio"));
}

}  // namespace
}  // namespace blocklift::structure
