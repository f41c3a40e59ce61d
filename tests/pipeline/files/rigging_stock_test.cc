// Rigging in stock, as YAML and as a table: what the reader refuses, and that the shipped stock holds together.

#include "pipeline/files/rigging_stock.h"

#include <filesystem>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/files/model_library.h"
#include "tests/pipeline/sample_lift.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;
using test::with;
using ::testing::HasSubstr;

// Chain of 8 mm, grade 8: 80.42 kN, 1.40 kg/m. Shackle of 8.5 t: pin of 28.6 mm at 325 MPa.
const std::string sample_stock = R"(kind: rigging
title: What the yard has
source: certificates in the rigging loft
rule: {name: EN 818-4, safety_factor: 4, formula: as certified}
construction: short_link_chain
slings:
  chain-8:
    rope: {axial_stiffness: 5.5 MN, breaking_load: 80.42 kN, mass: 1.40 kg/m}
    working_load: 2.0 t
shackles:
  bow-8: {working_load: 8.5 t, breaking_load: 34 t, body: 25 mm, pin: 28.6 mm,
          inside_width: 43 mm, mass: 2.4 kg}
)";

std::string complaints_about_stock(const std::string& text) {
  const TemporaryFolder folder;
  folder.write("stock.yaml", text);
  Diagnostics diagnostics;
  ModelLibrary({}).read_rigging("stock.yaml", diagnostics);
  return diagnostics.to_text();
}

TEST(RiggingStockTest, IsReadWithItsRopes) {
  const TemporaryFolder folder;
  folder.write("stock.yaml", with(sample_stock,
                                  "{axial_stiffness: 5.5 MN, breaking_load: 80.42 "
                                  "kN, mass: 1.40 kg/m}",
                                  "chain-8"));
  folder.write("chain-8.yaml",
               "{kind: rope, axial_stiffness: 5.5 MN, breaking_load: 80.42 kN, mass: 1.4 kg/m}\n");
  Diagnostics diagnostics;
  const auto stock = ModelLibrary({}).read_rigging("stock.yaml", diagnostics);
  ASSERT_EQ(diagnostics.to_text(), "");
  ASSERT_EQ(stock->slings.size(), 1U);
  EXPECT_DOUBLE_EQ(stock->slings[0].rope.breaking_load, 80.42e3);
  EXPECT_DOUBLE_EQ(stock->slings[0].working_load, 2000 * 9.80665);
  EXPECT_DOUBLE_EQ(stock->safety_factor_of(stock->slings[0]), 4);
  ASSERT_EQ(stock->shackles.size(), 1U);
  EXPECT_DOUBLE_EQ(stock->shackles[0].pin, 28.6e-3);
}

TEST(RiggingStockTest, RefusesFiguresWithoutASource) {
  EXPECT_EQ(complaints_about_stock(sample_stock), "");
  EXPECT_THAT(
      complaints_about_stock(with(sample_stock, "source: certificates in the rigging loft\n", "")),
      HasSubstr("lacks the key \"source\""));
  EXPECT_THAT(
      complaints_about_stock(with(sample_stock, "certificates in the rigging loft", "\"  \"")),
      HasSubstr("the stock has no source"));
}

TEST(RiggingStockTest, HoldsWorkingLoadsToTheRule) {
  EXPECT_THAT(
      complaints_about_stock(with(sample_stock, "working_load: 2.0 t", "working_load: 2.5 t")),
      HasSubstr("stock.yaml:7:3: error: chain-8: breaking load 80.42 kN over working load 24.5166 "
                "kN is 3.28; EN 818-4 asks for 4"));
  EXPECT_THAT(complaints_about_stock(with(sample_stock, "working_load: 2.0 t",
                                          "working_load: 1.6 t\n    safety_factor: 5")),
              "");
  EXPECT_THAT(complaints_about_stock(
                  with(sample_stock, "safety_factor: 4,", "safety_factor: 4, efficiency: 0.8,")),
              HasSubstr("EN 818-4 asks for 5 (4 over the efficiency 0.8)"));
}

TEST(RiggingStockTest, HoldsStrengthToWeightAndPin) {
  EXPECT_THAT(complaints_about_stock(with(sample_stock, "1.40 kg/m", "0.14 kg/m")),
              HasSubstr("chain-8: breaking load over mass is 574 kN m/kg; 40 to 95 are made of "
                        "this construction"));
  EXPECT_THAT(complaints_about_stock(with(sample_stock, ", mass: 1.40 kg/m", "")),
              HasSubstr("the rope of sling chain-8 has no mass"));
  EXPECT_THAT(complaints_about_stock(with(sample_stock, "pin: 28.6 mm", "pin: 28.6 cm")),
              HasSubstr("bow-8: at the breaking load the pin of 286 mm has a shear of 2.6 MPa"));
}

TEST(RiggingStockTest, RefusesAStockOfNothingKnown) {
  EXPECT_THAT(complaints_about_stock(with(sample_stock, "short_link_chain", "long_link_chain")),
              HasSubstr("did you mean \"short_link_chain\"?"));
  EXPECT_THAT(complaints_about_stock(with(sample_stock, "construction: short_link_chain\n", "")),
              HasSubstr("the stock has slings and no construction"));
  EXPECT_THAT(complaints_about_stock(
                  "{kind: rigging, title: none, source: s, rule: {name: r, safety_factor: 4, "
                  "formula: f}}\n"),
              HasSubstr("the stock has neither slings nor shackles"));
}

// The sample's chain as a spreadsheet of a country with decimal commas would write it.
const std::string sample_table =
    "title;What the yard has;;\r\nsource;\"certificates; loft 2\";;\r\nrule;EN 818-4;;\r\n"
    "safety_factor;4;;\r\nformula;as certified\r\nconstruction;short_link_chain\r\n;;;\r\n"
    "sling;working_load;breaking_load;axial_stiffness;mass;diameter\r\n"
    "chain-8;2.0 t;80.42 kN;5.5 MN;1.40 kg/m;\r\n"
    "chain-10;3.15 t;125.7 kN;8.5 MN;2.19 kg/m;10 mm\r\n";

std::string complaints_about_table(const std::string& text) {
  const TemporaryFolder folder;
  folder.write("stock.csv", text);
  Diagnostics diagnostics;
  ModelLibrary({}).read_rigging("stock.csv", diagnostics);
  return diagnostics.to_text();
}

TEST(RiggingTableTest, IsReadAsTheSameStock) {
  const TemporaryFolder folder;
  folder.write("stock.csv", sample_table);
  Diagnostics diagnostics;
  const auto stock = ModelLibrary({}).read_rigging("stock.csv", diagnostics);
  ASSERT_EQ(diagnostics.to_text(), "");
  EXPECT_EQ(stock->source, "certificates; loft 2");
  ASSERT_EQ(stock->slings.size(), 2U);
  EXPECT_EQ(stock->slings[0].name.value, "chain-8");
  EXPECT_DOUBLE_EQ(stock->slings[0].rope.breaking_load, 80.42e3);
  EXPECT_FALSE(stock->slings[0].rope.diameter);
  EXPECT_DOUBLE_EQ(*stock->slings[1].rope.diameter, 0.010);
  EXPECT_DOUBLE_EQ(stock->slings[1].working_load, 3150 * 9.80665);
}

TEST(RiggingTableTest, HasShacklesAndCommasToo) {
  EXPECT_EQ(complaints_about_table(
                "title,\"Bow \"\"shackles\"\"\"\nsource,tags\nrule,RR-C-271\nsafety_factor,4\n"
                "formula,none\n\nshackle,working_load,breaking_load,body,pin,inside_width,mass\n"
                "bow-8,8.5 t,34 t,25 mm,28.6 mm,43 mm,2.4 kg\n"),
            "");
}

TEST(RiggingTableTest, NamesTheLineOfWhatIsWrong) {
  EXPECT_THAT(complaints_about_table(with(sample_table, "3.15 t", "4.15 t")),
              HasSubstr("stock.csv:10:1: error: chain-10: breaking load"));
  EXPECT_THAT(complaints_about_table(with(sample_table, "80.42 kN", "80.42 m")),
              HasSubstr("stock.csv:9:1: error"));
  EXPECT_THAT(
      complaints_about_table(with(sample_table, "source;\"certificates; loft 2\";;\r\n", "")),
      HasSubstr("lacks the key \"source\""));
  EXPECT_THAT(complaints_about_table(with(sample_table, "loft 2\"", "loft 2")),
              HasSubstr("stock.csv:2:1: error: a quotation does not end on its line"));
  EXPECT_THAT(
      complaints_about_table(with(sample_table, "2.19 kg/m;10 mm", "2.19 kg/m;10 mm;x")),
      HasSubstr("stock.csv:10:1: error: the row of \"chain-10\" has 7 cells, and there are 6 "
                "headings"));
  EXPECT_THAT(complaints_about_table(with(sample_table, ";mass;", ";weight;")),
              HasSubstr("\"weight\""));
  EXPECT_THAT(complaints_about_table(""), HasSubstr("the file is empty"));
}

// Every shipped file is read without complaint, so its strength lies in the range of its
// construction. Here its working loads are held to its own rule within the four digits printed,
// names are not given twice, and whatever bears more weighs more and is stiffer.
TEST(ShippedRiggingTest, HoldsTogether) {
  std::set<std::string> names;
  int files = 0;
  for (const auto& entry : fs::directory_iterator(BLOCKLIFT_MODELS "/rigging")) {
    if (entry.path().extension() != ".yaml") continue;
    SCOPED_TRACE(entry.path().string());
    Diagnostics diagnostics;
    const auto stock = ModelLibrary({BLOCKLIFT_MODELS}).read_rigging(entry.path(), diagnostics);
    ASSERT_EQ(diagnostics.to_text(), "");
    ++files;
    const RopeModel* lighter = nullptr;
    for (const StockSling& sling : stock->slings) {
      EXPECT_TRUE(names.insert(sling.name.value).second) << sling.name.value;
      EXPECT_NEAR(stock->rule.efficiency * sling.rope.breaking_load / sling.working_load,
                  stock->safety_factor_of(sling), 2e-3 * stock->safety_factor_of(sling))
          << sling.name.value;
      if (lighter) {
        EXPECT_GT(sling.rope.breaking_load, lighter->breaking_load) << sling.name.value;
        EXPECT_GT(*sling.rope.mass_per_length, *lighter->mass_per_length) << sling.name.value;
        EXPECT_GT(sling.rope.axial_stiffness, lighter->axial_stiffness) << sling.name.value;
      }
      lighter = &sling.rope;
    }
    for (const StockShackle& shackle : stock->shackles) {
      EXPECT_TRUE(names.insert(shackle.name.value).second) << shackle.name.value;
      EXPECT_DOUBLE_EQ(shackle.breaking_load, stock->rule.safety_factor * shackle.working_load);
      EXPECT_GT(shackle.pin, shackle.body) << shackle.name.value;
      EXPECT_GT(shackle.inside_width, shackle.pin) << shackle.name.value;
    }
  }
  EXPECT_GE(files, 8);
}

// Published tables round to the same figures: EN 13414-1 table 4 has 4.60 t for 20 mm and 42.0 t
// for 60 mm, tables of EN 818-4 have 5.3 t for 13 mm and 31.5 t for 32 mm.
TEST(ShippedRiggingTest, AgreesWithPublishedTables) {
  const auto working_load = [](const std::string& file, const std::string& name) {
    Diagnostics diagnostics;
    const auto stock = ModelLibrary({BLOCKLIFT_MODELS})
                           .read_rigging(fs::path(BLOCKLIFT_MODELS "/rigging") / file, diagnostics);
    for (const StockSling& sling : stock->slings)
      if (sling.name.value == name) return sling.working_load / 9806.65;
    return 0.0;
  };
  EXPECT_NEAR(working_load("sling-6x36.yaml", "sling-6x36-20"), 4.60, 0.03 * 4.60);
  EXPECT_NEAR(working_load("sling-6x36.yaml", "sling-6x36-60"), 42.0, 0.03 * 42.0);
  EXPECT_NEAR(working_load("chain-grade-8.yaml", "chain-8-13"), 5.3, 0.05 * 5.3);
  EXPECT_NEAR(working_load("chain-grade-8.yaml", "chain-8-32"), 31.5, 0.05 * 31.5);
}

}  // namespace
}  // namespace blocklift::pipeline
