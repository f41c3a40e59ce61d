#include "pipeline/files/schema/schema.h"

#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace blocklift::pipeline {
namespace {

TEST(SchemaTest, IsJsonWithEveryKindOfFile) {
  const auto schema = nlohmann::json::parse(json_schema());
  EXPECT_EQ(schema.at("anyOf").size(), input_file_kinds().size());
  const auto rope = nlohmann::json::parse(json_schema("rope"));
  EXPECT_EQ(rope.at("required"), nlohmann::json({"kind", "breaking_load"}));
  EXPECT_EQ(rope.at("additionalProperties"), false);
  EXPECT_EQ(rope.at("properties").at("damping_time").at("$comment"), "default: 5 ms");
}

TEST(SchemaTest, ManualDescribesEveryKeyOfARope) {
  EXPECT_NE(
      markdown_manual("rope").find("## rope\n\nA wire rope, a sling, or all falls of a tackle "
                                   "taken together.\n\n| key | value | default | meaning |"),
      std::string::npos);
  EXPECT_NE(
      markdown_manual("rope").find("| `breaking_load` | a force or a mass, as `140 t`, greater "
                                   "than 0 | required | smallest breaking load, of all falls "
                                   "together |"),
      std::string::npos);
}

TEST(SchemaTest, RefusesAnUnknownKind) { EXPECT_THROW(json_schema("boat"), std::invalid_argument); }

}  // namespace
}  // namespace blocklift::pipeline
