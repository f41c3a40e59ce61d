#include "structure/child_process.h"

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "structure/error.h"

namespace blocklift::structure {
namespace {

using ::testing::HasSubstr;

std::string death_of(const std::function<Packet()>& work, const ChildLimits& limits = {}) {
  try {
    in_child_process(work, limits);
  } catch (const ChildDied& death) {
    return death.what();
  }
  return "it lives";
}

TEST(ChildProcess, HandsBackWhatItMakes) {
  int here = 1;
  Packet packet = in_child_process(
      [&] {
        here = 2;
        Packet result;
        result.put(std::vector<double>(300000, 1.5));  // more than a pipe holds
        result.put(std::string("text"));
        return result;
      },
      {});
  std::vector<double> numbers;
  std::string text;
  packet.take(numbers);
  packet.take(text);
  EXPECT_EQ(numbers, std::vector<double>(300000, 1.5));
  EXPECT_EQ(text, "text");
  EXPECT_EQ(here, 1);
}

TEST(ChildProcess, ErrorsComeBackWithTheirText) {
  try {
    in_child_process([]() -> Packet { throw std::runtime_error("a hole in the mesh"); }, {});
    FAIL();
  } catch (const ModelError& error) {
    EXPECT_STREQ(error.what(), "a hole in the mesh");
  }
  EXPECT_THAT(death_of([]() -> Packet { throw std::bad_alloc(); }, {10, 1e9}),
              HasSubstr("more than the 1 GB of memory"));
}

TEST(ChildProcess, CrashesAreNamed) {
  EXPECT_THAT(death_of([]() -> Packet {
                std::raise(SIGSEGV);
                return {};
              }),
              HasSubstr("crashed (Segmentation fault)"));
  EXPECT_THAT(death_of([]() -> Packet { std::abort(); }), HasSubstr("crashed (Aborted)"));
  EXPECT_THAT(death_of([]() -> Packet { std::_Exit(3); }), HasSubstr("exit code 3"));
}

TEST(ChildProcess, EndsWithItsTime) {
  EXPECT_THAT(death_of(
                  []() -> Packet {
                    std::atomic<bool> goes_on{true};
                    while (goes_on) {
                    }
                    return {};
                  },
                  {1, 0}),
              HasSubstr("came to no end in the time that it is given"));
}

}  // namespace
}  // namespace blocklift::structure
