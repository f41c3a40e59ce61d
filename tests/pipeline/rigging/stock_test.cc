#include "pipeline/rigging/stock.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/pipeline/rigging/sample_stock.h"
#include "tests/pipeline/sample_lift.h"

namespace blocklift::pipeline {
namespace {

using test::sling_file;
using test::TemporaryFolder;
using test::with;
using ::testing::HasSubstr;

std::string complaints_about_stock_in(const std::string& folder) {
  ModelLibrary library({BLOCKLIFT_MODELS});
  Diagnostics diagnostics;
  read_stock({folder}, {}, library, diagnostics);
  return diagnostics.to_text();
}

TEST(StockTest, GathersFilesTheWeakestFirst) {
  const TemporaryFolder folder;
  folder.write("loft/a.yaml", sling_file({300, 100}));
  folder.write("loft/b.yaml", sling_file({200}));
  folder.write("loft/c.csv",
               "title,t\nsource,a test\nrule,a fifth\nsafety_factor,5\nformula,f\n"
               "construction,wire_rope\nsling,working_load,breaking_load,axial_stiffness,mass\n"
               "s250,50 kN,250 kN,25 MN,1.6 kg/m\n");
  folder.write("loft/notes.yaml", "kind: rope\n");
  folder.write("loft/notes.txt", "nothing\n");
  ModelLibrary library({BLOCKLIFT_MODELS});
  Diagnostics diagnostics;
  const Stock stock = read_stock({"loft"}, {}, library, diagnostics);
  ASSERT_EQ(diagnostics.to_text(), "");
  ASSERT_EQ(stock.slings.size(), 4U);
  EXPECT_EQ(stock.slings[0].name(), "s100");
  EXPECT_EQ(stock.slings[1].name(), "s200");
  EXPECT_EQ(stock.slings[2].name(), "s250");
  EXPECT_EQ(stock.slings[3].name(), "s300");
  EXPECT_EQ(stock.slings[0].rule, "a fifth");
}

TEST(StockTest, SaysWhatIsNoStock) {
  const TemporaryFolder folder;
  folder.write("loft/a.yaml", sling_file({100}));
  folder.write("twice/a.yaml", sling_file({100}));
  folder.write("twice/b.yaml", sling_file({100}));
  folder.write("bad/a.yaml", with(sling_file({100}), "source: a test\n", ""));
  folder.write("empty/a.txt", "");
  EXPECT_EQ(complaints_about_stock_in("loft"), "");
  EXPECT_THAT(complaints_about_stock_in("twice"), HasSubstr("the stock has \"s100\" twice"));
  EXPECT_THAT(complaints_about_stock_in("bad"), HasSubstr("lacks the key \"source\""));
  EXPECT_THAT(complaints_about_stock_in("empty"), HasSubstr("the stock has no slings"));
  EXPECT_THAT(complaints_about_stock_in("nowhere"),
              HasSubstr("nowhere: error: no stock can be read from this folder"));
}

TEST(StockTest, TakesTheConstructionsThatAreAskedFor) {
  ModelLibrary library({BLOCKLIFT_MODELS});
  Diagnostics diagnostics;
  const Stock stock = read_stock(shipped_stock(library), {SlingConstruction::short_link_chain},
                                 library, diagnostics);
  ASSERT_EQ(diagnostics.to_text(), "");
  EXPECT_FALSE(stock.slings.empty());
  EXPECT_TRUE(std::all_of(stock.slings.begin(), stock.slings.end(), [](const SlingInStock& one) {
    return one.construction == SlingConstruction::short_link_chain;
  }));
  EXPECT_FALSE(stock.shackles.empty());
}

}  // namespace
}  // namespace blocklift::pipeline
