// Results that were cut, garbled or changed by hand: each is refused with its name or can be used,
// by everything that reads results. What a check lets through and a reader then throws at fails.

#include <cstdlib>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "pipeline/comparison/comparison.h"
#include "pipeline/formats/atomic_file.h"
#include "pipeline/formats/read_apart.h"
#include "pipeline/formats/results/results_folder.h"
#include "pipeline/formats/results/results_layout.h"
#include "pipeline/formats/results_store.h"
#include "pipeline/measurement/measured_lift.h"
#include "pipeline/report/lift_frames.h"
#include "pipeline/report/report.h"
#include "tests/pipeline/damage.h"
#include "tests/pipeline/report/sample_result.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using test::Damage;
using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class DamagedResults : public ::testing::Test {
 protected:
  DamagedResults() {
    fs::create_directory("sound");
    write_sample_result("sound", {.motion_step = 1});
    std::string record = "time [s],ropes.R1 [kN]\n";
    for (int i = 1; i < 15; ++i)
      record += std::to_string(6 * i) + (i % 2 == 0 ? ",495\n" : ",505\n");
    folder_.write("record.csv", record);
  }

  /// What is said of the results after the damage; then all readers have been tried with them, if
  /// nothing is.
  std::string said_of(const std::function<void(const fs::path&)>& damage) {
    fs::remove_all("tried");
    fs::copy("sound", "tried");
    damage("tried");
    std::string said;
    for (const FileComplaint& complaint : complaints_about_folder("tried"))
      said += complaint.file.string() + ": " + complaint.message + '\n';
    ++tried_;
    if (said.empty()) {
      ++passed_;
      EXPECT_NO_THROW(use("tried"));
    } else {
      EXPECT_THAT(said, AnyOf(HasSubstr("tried/results.h5: "), HasSubstr("tried/summary.json: ")));
    }
    return said;
  }

  /// Whatever reads results.
  static void use(const fs::path& results) {
    write_report(results);
    try {
      require_frames(results);
      write_lift_frames(results, 2);
    } catch (const ResultsError& error) {
      // A dataset may lack that makes the difference between what moves and what does not.
      EXPECT_THAT(error.what(), HasSubstr("nothing that moves"));
    }
    const ResultComparison comparison =
        compare_results(read_compared_results({"sound", results}), {});
    EXPECT_FALSE(comparison_page(comparison).empty());
    EXPECT_FALSE(comparison_text(comparison).empty());
    EXPECT_FALSE(comparison_json(comparison).empty());
    MeasurementSettings settings;
    settings.shifts = {0};
    settings.decay = TimeWindow{20, 60};
    try {
      EXPECT_FALSE(
          measured_page(hold_against_measurements(results, {"record.csv"}, settings)).empty());
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("record.csv"));
    }
  }

  void change_summary(const fs::path& results, const std::function<void(Json&)>& change) const {
    Json summary = Json::parse(read_file(results / layout::summary_file));
    change(summary);
    write_file(results / layout::summary_file, summary.dump());
  }

  const test::TemporaryFolder folder_;
  int tried_ = 0, passed_ = 0;
};

TEST_F(DamagedResults, SoundOnesAreNotComplainedAbout) {
  EXPECT_EQ(said_of([](const fs::path&) {}), "");
}

TEST_F(DamagedResults, AreRefusedWhereverAFileIsCut) {
  for (const std::string_view name : {layout::results_file, layout::summary_file})
    for (int part = 0; part < 20; ++part)
      EXPECT_THAT(said_of([&](const fs::path& results) { test::cut(results / name, part / 20.0); }),
                  HasSubstr(std::string(name) + ": "))
          << name << " at " << part << " of 20";
}

TEST_F(DamagedResults, AreRefusedOrUsedWhateverBytesAreFlipped) {
  for (const std::string_view name : {layout::results_file, layout::summary_file})
    for (const int count : {1, 16})
      for (int part = 0; part < 100; ++part)
        said_of([&](const fs::path& results) {
          test::flip_bytes(results / name, (part + 0.37) / 100, count);
        });
  EXPECT_LT(passed_, tried_);
}

TEST_F(DamagedResults, AreRefusedByTheNameOfTheDatasetOrUsedWithoutIt) {
  for (const std::string& dataset : test::datasets_of("sound/results.h5"))
    for (const Damage way : test::all_damage) {
      SCOPED_TRACE(dataset + " damaged in way " + std::to_string(static_cast<int>(way)));
      const std::string said = said_of([&](const fs::path& results) {
        test::damage(results / layout::results_file, dataset, way);
      });
      // Another dataset may be what no longer fits: each tension if the time has another length.
      if (way != Damage::text) continue;
      if (said.empty())
        EXPECT_THAT(dataset, AnyOf(HasSubstr("/yaml"), HasSubstr("names")));
      else
        EXPECT_THAT(said, AllOf(HasSubstr("results.h5: \""), HasSubstr("\"" + dataset + "\""),
                                HasSubstr("due")));
    }
}

TEST_F(DamagedResults, AreRefusedByTheKeyOfTheSummaryOrUsedWithoutIt) {
  const Json summary = Json::parse(read_file("sound/summary.json"));
  const Json others[] = {nullptr,
                         7,
                         -1e308,
                         "something else",
                         true,
                         Json::array(),
                         Json::array({nullptr}),
                         Json::object(),
                         Json{{"name", 3}}};
  const Json leaves = summary.flatten();
  std::set<std::string> tried;
  std::size_t next = 0;
  for (const auto& [path, value] : leaves.items()) {
    const Json::json_pointer place(path);
    for (Json::json_pointer at = place; !at.empty() && tried.insert(at.to_string()).second;
         at = at.parent_pointer())
      // By turns, two at each place: rows are alike.
      for (int turn = 0; turn < 2; ++turn) {
        const Json& other = others[next++ % std::size(others)];
        SCOPED_TRACE(at.to_string() + " is " + other.dump());
        said_of([&](const fs::path& results) {
          change_summary(results, [&](Json& changed) { changed[at] = other; });
        });
      }
    SCOPED_TRACE(path + " is missing");
    said_of([&](const fs::path& results) {
      change_summary(results, [&](Json& changed) {
        Json& parent = changed[place.parent_pointer()];
        if (parent.is_object())
          parent.erase(place.back());
        else
          parent.erase(std::stoul(place.back()));
      });
    });
  }
  EXPECT_LT(passed_, tried_);
}

TEST(ReadingApart, NamesThePlaceWhereItDied) {
  const auto read = [](const PlaceOfReading& next) -> std::vector<std::string> {
    next("/case");
    next("/static/time");
    std::abort();
  };
  EXPECT_THAT(complaints_of_reading("results.h5", read),
              ElementsAre("is damaged: reading \"/static/time\" of it crashed (Aborted)"));
}

TEST_F(DamagedResults, SayWhatWasFoundAndWhatIsDue) {
  EXPECT_EQ(said_of([&](const fs::path& results) {
              change_summary(results, [](Json& summary) {
                summary["ropes"][0]["max_static_tension_N"] = "much";
                summary["checks"][0].erase("pass");
                summary["verdict"] = "maybe";
              });
            }),
            "tried/summary.json: \"verdict\" is the text \"maybe\"; \"pass\" or \"fail\" is due\n"
            "tried/summary.json: \"checks.Rope R1.pass\" is missing; true or false is due\n"
            "tried/summary.json: \"ropes.R1.max_static_tension_N\" is the text \"much\"; a number "
            "or null is due\n");
  EXPECT_EQ(said_of([](const fs::path& results) {
              test::damage(results / "results.h5", "/static/ropes/R1/tension", Damage::one_number);
              test::damage(results / "results.h5", "/static/ropes/R2/tension",
                           Damage::not_a_number);
            }),
            "tried/results.h5: \"/static/ropes/R1/tension\" has shape one number; 101 is due, a "
            "value for each instant of \"/static/time\"\n"
            "tried/results.h5: \"/static/ropes/R2/tension\" has nan as value 51 of 101; a number "
            "is due\n");
  EXPECT_EQ(said_of([](const fs::path& results) { fs::remove(results / "results.h5"); }),
            "tried/results.h5: there is no such file\n");
  EXPECT_THAT(said_of([](const fs::path& results) {
                write_file(results / "summary.json", R"({"case": )" + std::string(100000, '[') +
                                                         std::string(100000, ']') + "}");
              }),
              HasSubstr("more than 64 deep"));
}

}  // namespace
}  // namespace blocklift::pipeline
