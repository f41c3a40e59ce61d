#include "structure/output/base64.h"

#include <string>

#include <gtest/gtest.h>

namespace blocklift::structure {
namespace {

TEST(Base64, AgreesWithTheExamplesOfRfc4648) {
  const auto encode = [](const std::string& text) {
    return base64({reinterpret_cast<const unsigned char*>(text.data()), text.size()});
  };
  EXPECT_EQ(encode(""), "");
  EXPECT_EQ(encode("f"), "Zg==");
  EXPECT_EQ(encode("fo"), "Zm8=");
  EXPECT_EQ(encode("foo"), "Zm9v");
  EXPECT_EQ(encode("foobar"), "Zm9vYmFy");
}

}  // namespace
}  // namespace blocklift::structure
