// Drawings of what was found in a mesh.
#include "structure/output/finding_picture.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "structure/mesh/plates/shell_generator.h"
#include "tests/structure/hull_block.h"

namespace blocklift::structure {
namespace {

std::size_t occurrences(const std::string& text, const std::string& word) {
  std::size_t found = 0;
  for (auto place = text.find(word); place != std::string::npos; place = text.find(word, place + 1))
    ++found;
  return found;
}

TEST(FindingPicture, MarksEachPlaceAndDrawsTheOutlineAlone) {
  BlockDescription block = test::cross_of_plates();
  const Mesh mesh = generate_shell_mesh(block);
  const Diagnosis diagnosis = diagnose(mesh);
  const Finding* finding = diagnosis.find("free edges");
  ASSERT_NE(finding, nullptr);
  const std::string picture = finding_picture(mesh, *finding);
  EXPECT_THAT(picture, ::testing::StartsWith("<svg "));
  EXPECT_EQ(occurrences(picture, "<circle "), finding->places.size());
  EXPECT_EQ(occurrences(picture, "<text "), 5U);
  // Free edges, and the joint of four shells: no other edge is a line.
  const double joint = 1 / (diagnosis.free_edge_length / diagnosis.free_edges);
  EXPECT_EQ(occurrences(picture, "M"),
            static_cast<std::size_t>(diagnosis.free_edges + joint + 0.5));
  EXPECT_EQ(picture.find("nan"), std::string::npos);
}

TEST(FindingPicture, NothingToDraw) {
  EXPECT_THAT(finding_picture({}, {}), ::testing::EndsWith("</svg>\n"));
}

}  // namespace
}  // namespace blocklift::structure
