// Rigging in stock, as YAML and as a table: what the reader refuses, and that the shipped stock
// holds together.

#include "pipeline/files/rigging/rigging_stock.h"

#include <filesystem>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/files/library/model_library.h"
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

std::string stock_of(const std::string& items, const char* factor) {
  return std::string("kind: rigging\ntitle: t\nsource: s\nrule: {name: own, safety_factor: ") +
         factor + ", formula: f}\n" + items;
}

// A link of 30 mm, 210 x 120 mm inside: pi 150 + 180 mm of bar weigh 3.613 kg, and 200 kN are 141.5
// MPa, 300 kN 212 MPa on its two sides.
TEST(RiggingStockTest, HoldsMasterLinksToTheirMeasures) {
  const std::string link = stock_of(
      "master_links:\n  m: {working_load: 60 kN, breaking_load: 300 kN, bar: 30 mm, "
      "inside_length: 210 mm, inside_width: 120 mm, mass: 3.6 kg}\n",
      "5");
  EXPECT_EQ(complaints_about_stock(link), "");
  EXPECT_THAT(complaints_about_stock(with(link, "3.6 kg", "4.2 kg")),
              HasSubstr("m: its mass is 4.2 kg; that of its bar by the measures is 3.61 kg"));
  EXPECT_THAT(complaints_about_stock(with(link, "60 kN", "70 kN")), HasSubstr("own asks for 5"));
  EXPECT_THAT(complaints_about_stock(with(with(link, "60 kN", "40 kN"), "300 kN", "200 kN")),
              HasSubstr("the sides of 30 mm bear 141 MPa on the mean; 150 to 600"));
}

TEST(RiggingStockTest, HoldsSheavesToTheirRope) {
  const std::string sheave = stock_of(
      "sheaves:\n  s: {working_load: 90 kN, breaking_load: 450 kN, rope: 20 mm, tread: 460 mm, "
      "mass: 32 kg}\n",
      "5");
  EXPECT_EQ(complaints_about_stock(sheave), "");
  EXPECT_THAT(complaints_about_stock(with(sheave, "460 mm", "120 mm")),
              HasSubstr("s: tread over rope is 6; sheaves have 8 to 60"));
  EXPECT_THAT(complaints_about_stock(with(sheave, "32 kg", "32 t")), HasSubstr("a full disc"));
}

// By hand: a pipe of 168.3 x 8 mm, 6 m, S355, curve a: A 4029 mm2, I 1.2973e7 mm4, Euler's load
// 746.8 kN, slenderness 1.3839, chi 0.4259. Slings at 45 degrees press it with (200 + 1.863) / 2
// kN, its 190 kg bend it with 1.397 kNm: 2 x 100.93 / 609.1 + 2 x 1.397 / (54.72 x (1 - 201.86 /
// 746.8)).
TEST(RiggingStockTest, HoldsSpreadersToTheirResistance) {
  const std::string bar = stock_of(
      "spreaders:\n  b:\n    bar: {length: 6 m, section: {pipe: [168.3 mm, 8 mm]}, yield_stress: "
      "355 MPa, buckling_curve: a, mass: 190 kg}\n    working_load: 200 kN\n    sling_angle: 45 "
      "deg\n",
      "2");
  const TemporaryFolder folder;
  folder.write("stock.yaml", bar);
  Diagnostics diagnostics;
  const auto stock = ModelLibrary({}).read_rigging("stock.yaml", diagnostics);
  ASSERT_EQ(diagnostics.to_text(), "");
  EXPECT_NEAR(stock->spreaders[0].utilisation(2), 0.4014, 3e-4);
  EXPECT_THAT(complaints_about_stock(with(bar, "200 kN", "600 kN")),
              HasSubstr("b: under its working load, times 2, it bears"));
  EXPECT_THAT(complaints_about_stock(with(bar, "sling_angle: 45 deg", "sling_angle: 95 deg")),
              HasSubstr("sling_angle"));
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

TEST(RiggingTableTest, HasMasterLinksAndSheaves) {
  EXPECT_EQ(complaints_about_table(
                "title,Links\nsource,tags\nrule,own\nsafety_factor,5\nformula,none\n"
                "master_link,working_load,breaking_load,bar,inside_length,inside_width,mass\n"
                "m-6,60 kN,300 kN,30 mm,210 mm,120 mm,3.6 kg\n"),
            "");
  EXPECT_THAT(
      complaints_about_table("title,Sheaves\nsource,tags\nrule,own\nsafety_factor,5\nformula,none\n"
                             "sheave,working_load,breaking_load,rope,tread,mass\n"
                             "s-20,90 kN,450 kN,20 mm,120 mm,32 kg\n"),
      HasSubstr("stock.csv:7:1: error: s-20: tread over rope is 6"));
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
    double lighter_link = 0;
    for (const StockMasterLink& link : stock->master_links) {
      EXPECT_TRUE(names.insert(link.name.value).second) << link.name.value;
      EXPECT_NEAR(link.breaking_load, stock->rule.safety_factor * link.working_load, 1e-6);
      EXPECT_NEAR(link.mass, link.mass_of_bar(), 0.01 * link.mass) << link.name.value;
      EXPECT_GT(link.mass, lighter_link) << link.name.value;
      lighter_link = link.mass;
    }
    for (const StockSheave& sheave : stock->sheaves) {
      EXPECT_TRUE(names.insert(sheave.name.value).second) << sheave.name.value;
      EXPECT_NEAR(sheave.tread, 23 * sheave.rope, 1e-9) << sheave.name.value;
    }
    // Rounded down by a tonne at most.
    for (const StockSpreader& spreader : stock->spreaders) {
      EXPECT_TRUE(names.insert(spreader.name.value).second) << spreader.name.value;
      const double use = spreader.utilisation(stock->rule.safety_factor);
      EXPECT_LE(use, 1) << spreader.name.value;
      EXPECT_GT(use, 1 - 1.2 * 9806.65 / spreader.working_load) << spreader.name.value;
    }
  }
  EXPECT_GE(files, 12);
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
