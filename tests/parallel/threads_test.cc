#include "parallel/threads.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "parallel/blas_threads.h"

extern "C" int openblas_get_num_threads();
extern "C" void openblas_set_num_threads(int threads);

namespace blocklift::parallel {
namespace {

TEST(Threads, DealOutEachNumberOnce) {
  for (const int threads : {1, 2, 5}) {
    std::vector<std::atomic<int>> dealt(103);
    in_batches(103, 10, threads, [&](int first, int count) {
      for (int i = first; i < first + count; ++i) ++dealt[static_cast<std::size_t>(i)];
    });
    for (const std::atomic<int>& one : dealt) EXPECT_EQ(one, 1);
  }
  for_each(0, 3, [](int) { FAIL(); });
}

TEST(Threads, TheLowestBatchThatFailsIsTold) {
  for (const int threads : {1, 4}) {
    try {
      for_each(50, threads, [](int i) {
        if (i >= 7) throw std::runtime_error(std::to_string(i));
      });
      FAIL();
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "7");
    }
  }
}

TEST(Threads, TwoWorksGoSideBySide) {
  int first = 0, second = 0;
  side_by_side([&] { first = 1; }, [&] { second = 2; });
  EXPECT_EQ(first, 1);
  EXPECT_EQ(second, 2);
  EXPECT_THROW(side_by_side([] { throw std::runtime_error("first"); }, [] {}), std::runtime_error);
}

class BlasThreads : public ::testing::Test {
 protected:
  void SetUp() override { openblas_set_num_threads(2); }
};

TEST_F(BlasThreads, AreOneWhileOneLivesAndComeBackWithTheLast) {
  {
    const OneBlasThread outer;
    EXPECT_EQ(openblas_get_num_threads(), 1);
    { const OneBlasThread inner; }
    EXPECT_EQ(openblas_get_num_threads(), 1);
    // Another thread's may live longer.
    auto other = std::make_unique<OneBlasThread>();
    std::thread([&] { other.reset(); }).join();
    EXPECT_EQ(openblas_get_num_threads(), 1);
  }
  EXPECT_EQ(openblas_get_num_threads(), 2);
}

TEST_F(BlasThreads, AreOneForEachOfSeveralThreads) {
  std::atomic<int> most{0};
  for_each(8, 2, [&](int) { most = std::max(most.load(), openblas_get_num_threads()); });
  EXPECT_EQ(most, 1);
  EXPECT_EQ(openblas_get_num_threads(), 2);
  if (usable_threads() > 1) side_by_side([&] { EXPECT_EQ(openblas_get_num_threads(), 1); }, [] {});
}

}  // namespace
}  // namespace blocklift::parallel
