#include "structure/space/elimination.h"

#include <vector>

#include <gtest/gtest.h>

#include "parallel/threads.h"

namespace blocklift::structure {
namespace {

/// Cubes of eight unknowns, so many a side.
std::vector<std::vector<int>> cubes(int side) {
  const int points = side + 1;
  std::vector<std::vector<int>> elements;
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y)
      for (int z = 0; z < side; ++z) {
        elements.emplace_back();
        for (int corner = 0; corner < 8; ++corner)
          elements.back().push_back(((x + corner % 2) * points + y + corner / 2 % 2) * points + z +
                                    corner / 4);
      }
  return elements;
}

// The order decides the last bits of whatever is solved by it.
TEST(Elimination, IsTheSameWhateverOtherThreadsOrderMeanwhile) {
  constexpr int side = 12, unknowns = (side + 1) * (side + 1) * (side + 1), orders = 12;
  const std::vector<std::vector<int>> elements = cubes(side);
  const std::vector<int> alone = find_elimination(unknowns, elements).place;
  std::vector<std::vector<int>> together(orders);
  parallel::for_each(orders, 4,
                     [&](int i) { together[i] = find_elimination(unknowns, elements).place; });
  for (const std::vector<int>& place : together) EXPECT_EQ(place, alone);
}

}  // namespace
}  // namespace blocklift::structure
