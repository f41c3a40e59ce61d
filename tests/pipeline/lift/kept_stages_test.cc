// Finished stages as bytes, and back.
#include "pipeline/lift/kept_stages.h"

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "pipeline/formats/atomic_file.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

TEST(KeptStagesTest, StressIsLookedIntoWhereTheFileIsMapped) {
  const test::TemporaryFolder folder;
  std::vector<structure::Square> squares(5);
  for (int i = 0; i < 5; ++i) squares[i].centre_B.x() = i;
  const Eigen::MatrixXd components = Eigen::MatrixXd::Random(15, 54);
  const structure::StressBasis basis(squares, components);
  write_file("kept", bytes_of_stress_basis(basis));
  const auto file = std::make_shared<const MappedFile>("kept");
  std::optional<structure::StressBasis> read = stress_basis_in(file);
  EXPECT_EQ(read->components(), components);
  EXPECT_EQ(read->weights(), basis.weights());
  ASSERT_EQ(read->squares().size(), 5U);
  EXPECT_EQ(read->squares()[3].centre_B, squares[3].centre_B);
  EXPECT_EQ(static_cast<const void*>(read->components().data()), file->bytes().data() + 16);
  // A copy keeps the file, too.
  const structure::StressBasis copy = *read;
  read.reset();
  EXPECT_EQ(copy.components(), components);
}

TEST(KeptStagesTest, StressThatEndsEarlyIsRefused) {
  const test::TemporaryFolder folder;
  const std::string whole = bytes_of_stress_basis(
      structure::StressBasis(std::vector<structure::Square>(2), Eigen::MatrixXd::Ones(6, 51)));
  for (const std::size_t length : {std::size_t{3}, std::size_t{20}, whole.size() - 1}) {
    write_file("kept", whole.substr(0, length));
    EXPECT_THROW(stress_basis_in(std::make_shared<const MappedFile>("kept")), std::runtime_error);
  }
}

}  // namespace
}  // namespace blocklift::pipeline
