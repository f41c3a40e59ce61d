// What floats: `blocklift validate` and `simulate` as a user meets them, of files with mistakes and
// of a boat that a floating crane lowers into the water.
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/pipeline/command_line/run_blocklift.h"
#include "tests/pipeline/run_program.h"
#include "tests/pipeline/sample_lift.h"

namespace blocklift::pipeline {
namespace {

using test::Outcome;
using test::with;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr auto barge = R"(kind: vessel
hull: {barge: {length: 20 m, breadth: 10 m, depth: 4 m}}
panel_size: 2 m
mass: 410 t
centre_of_mass: [0 m, 0 m, 2 m]
radii_of_gyration: [3 m, 6 m, 6 m]
)";

const std::string pair = R"(mechanism: pair
sea:
  waves: {regular: {amplitude: 0.2 m, period: 8 s, heading: 30 deg}}
  radiation: {highest_frequency: 1.2 rad/s}
vessels:
  B1: {model: barge, position: [0 m, -10 m]}
  B2: {model: barge, position: [0 m, 10 m]}
simulate: {duration: 1 s, relative_tolerance: 1e-6}
)";

class AfloatCommand : public ::testing::Test {
 protected:
  AfloatCommand() { folder_.write("barge.yaml", barge); }

  /// What is said of the file with a passage changed.
  std::string complaint(const std::string& command, const std::string& from,
                        const std::string& to) const {
    folder_.write("pair.yaml", with(pair, from, to));
    const Outcome outcome = test::run_blocklift(command + " pair.yaml");
    EXPECT_EQ(outcome.exit_code, 2) << outcome.out;
    return outcome.err;
  }

  test::TemporaryFolder folder_;
};

TEST_F(AfloatCommand, RefusesWavesThatCannotBe) {
  EXPECT_THAT(complaint("simulate", "0.2 m, period: 8 s", "9 m, period: 8 s"),
              HasSubstr("pair.yaml:3:10: error: a wave with the period 8 s and the height of 18 m "
                        "breaks: at most"));
  EXPECT_THAT(complaint("simulate", "period: 8 s", "period: 2.5 s"),
              HasSubstr("pair.yaml:3:10: error: vessel B1: hull "));
  EXPECT_THAT(complaint("simulate", "period: 8 s, ", ""),
              HasSubstr("pair.yaml:3:20: error: a regular wave needs either its frequency or its "
                        "period"));
  EXPECT_THAT(complaint("simulate", "1.2 rad/s", "6 rad/s"),
              HasSubstr("pair.yaml:4:14: error: at 6 rad/s waves are 1.71"));
  EXPECT_THAT(complaint("validate", "highest_frequency: 1.2 rad/s", "frequencies: 0"),
              HasSubstr("pair.yaml:4:28: error: "));
}

// JONSWAP of 5 s has 45.8 % of its significant height up to 1.2 rad/s, of which a thousandth of
// all energy is left out at the low end.
TEST_F(AfloatCommand, SaysWhatIsLeftOfAnIrregularSea) {
  const std::string sea =
      with(with(pair, "regular: {amplitude: 0.2 m, period: 8 s, heading: 30 deg}",
                "spectrum: {significant_height: 0.5 m, peak_period: 5 s}"),
           "{model: barge, position: [0 m, -10 m]}",
           "{model: barge, position: [0 m, -10 m], radiation: none}");
  folder_.write("pair.yaml", with(sea, "{model: barge, position: [0 m, 10 m]}",
                                  "{model: barge, position: [0 m, 10 m], radiation: none}"));
  const Outcome valid = test::run_blocklift("validate pair.yaml");
  EXPECT_EQ(valid.exit_code, 0) << valid.err;
  EXPECT_THAT(valid.out, HasSubstr("warning: The sea has 45.7 % of its significant height, 0.228 m "
                                   "of 0.5 m"));
  const Outcome run = test::run_blocklift("simulate pair.yaml --output results");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("The irregular sea has waves of 0.833 to 1.2 rad/s"));
  const auto summary = nlohmann::json::parse(test::text_of_file("results/summary.json"));
  const std::string dry = "no water moves along with B1, B2.";
  EXPECT_THAT(valid.out, HasSubstr(dry));
  ASSERT_EQ(summary["warnings"].size(), 2U);
  EXPECT_THAT(summary["warnings"][0].get<std::string>(), HasSubstr("highest_frequency is 1.2"));
  EXPECT_THAT(summary["warnings"][1].get<std::string>(), HasSubstr(dry));
}

TEST_F(AfloatCommand, RefusesVesselsInEachOthersWay) {
  EXPECT_THAT(complaint("validate", "[0 m, 10 m]", "[19 m, -1 m]"),
              HasSubstr("pair.yaml:7:3: error: vessel B1 and vessel B2 intersect, at ("));
  EXPECT_THAT(complaint("simulate", "[0 m, 10 m]", "[0 m, -10 m]"),
              HasSubstr("hulls must be apart, above the water and below: move one of them"));
}

const std::string boat_lift = R"(case: boat
gravity: 9.81 m/s^2
sea:
  waves: {regular: {amplitude: 0.1 m, frequency: 0.8 rad/s, heading: 30 deg}}
  radiation: {lowest_frequency: 0.7 rad/s, highest_frequency: 1.0 rad/s, frequencies: 3}
vessels: {B1: {model: pontoon, damping: {surge: 20 kN s/m, sway: 20 kN s/m, yaw: 2 MN m s/rad}}}
cranes: {F1: {model: crane, base: B1, start: {luffing: 60 deg, main: 24 m}}}
load:
  vessel: boat
  lugs: {L1: [-3 m, 0 m, 4 m], L2: [3 m, 0 m, 4 m]}
  position: [30 m, 0 m, 1 m]
  draughts: [0.3 m, 0.7 m]
  afloat: {position: [34 m, 0 m]}
ropes:
  R1: {from: F1.main, to: L1, model: {axial_stiffness: 50 MN, damping_time: 20 ms, breaking_load: 500 t}, length: 10 m}
  R2: {from: F1.main, to: L2, model: {axial_stiffness: 50 MN, damping_time: 20 ms, breaking_load: 500 t}, length: 10 m}
operation:
  - stage: lower
    moves: [{drives: [F1.main], by: 2 m}]
settle: 5 s
dynamics: {relative_tolerance: 1e-5, sample_interval: 0.1 s, static_interval: 5 s}
)";

/// A floating crane that lowers a boat into the water, its databases kept beside the case.
class LoweredBoat : public ::testing::Test {
 protected:
  LoweredBoat() {
    folder_.write("boat.yaml", R"(kind: vessel
hull: {barge: {length: 16 m, breadth: 8 m, depth: 4 m}}
panel_size: 4 m
mass: 80 t
centre_of_mass: [0 m, 0 m, 2 m]
radii_of_gyration: [3 m, 5 m, 5 m]
)");
    folder_.write("pontoon.yaml", R"(kind: vessel
hull: {barge: {length: 40 m, breadth: 20 m, depth: 6 m}}
panel_size: 4 m
mass: 1640 t
centre_of_mass: [0 m, 0 m, 3 m]
radii_of_gyration: [6 m, 11 m, 11 m]
)");
    folder_.write("crane.yaml", test::sample_boom);
  }

  /// Simulates the lift; what it prints is in `out_`.
  nlohmann::json simulate(const std::string& text) {
    folder_.write("case.yaml", text);
    const Outcome outcome = test::run_command("BLOCKLIFT_CACHE=kept '" BLOCKLIFT_EXECUTABLE
                                              "' simulate case.yaml --output results");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    out_ = outcome.out;
    return nlohmann::json::parse(test::text_of_file("results/summary.json"));
  }

  /// Of the place, and of panels, which are large here.
  static std::vector<std::string> warnings_of(const nlohmann::json& summary) {
    return summary.value("warnings", std::vector<std::string>());
  }

  /// The databases that are kept, with the time when each was written.
  static std::map<std::string, std::filesystem::file_time_type> kept() {
    std::map<std::string, std::filesystem::file_time_type> files;
    for (const auto& entry : std::filesystem::directory_iterator("kept")) {
      if (entry.path().extension() == ".h5")
        files[entry.path().filename().string()] = entry.last_write_time();
    }
    return files;
  }

  test::TemporaryFolder folder_;
  std::string out_;
};

// As of a mechanism, what is left of the sea is said, and kept with the results.
TEST_F(LoweredBoat, SaysWhatIsLeftOfAnIrregularSea) {
  const nlohmann::json summary =
      simulate(with(boat_lift, "regular: {amplitude: 0.1 m, frequency: 0.8 rad/s, heading: 30 deg}",
                    "spectrum: {significant_height: 0.2 m, peak_period: 8 s}"));
  EXPECT_THAT(out_, HasSubstr("The irregular sea has waves of 0.7 to 1 rad/s"));
  ASSERT_EQ(summary["assumptions"].size(), 1U);
  EXPECT_THAT(summary["assumptions"][0].get<std::string>(), HasSubstr("of the spectrum"));
}

// One database of the pontoon alone and one for each draught, computed once. The boat is put into
// the water 4 m from where they are for, which is said.
TEST_F(LoweredBoat, KeepsItsDatabasesAndIsMissedAtItsPlace) {
  const nlohmann::json first = simulate(boat_lift);
  const auto files = kept();
  EXPECT_EQ(files.size(), 3U + 1);  // and the fit of the memory
  const nlohmann::json& pair = first["radiation"]["misplacement"][0];
  EXPECT_EQ(pair["vessels"], nlohmann::json({"B1", "load"}));
  EXPECT_NEAR(pair["distance"]["size_m"].get<double>(), 4.0, 0.5);
  EXPECT_NEAR(pair["limit_m"].get<double>(), 0.2 * 8, 1e-9);
  EXPECT_EQ(pair["share_of_time_beyond"], 1.0);
  // Of which mode is another matter: panels of half the hull's breadth are too large for all.
  const auto of_radiation = HasSubstr("the radiation force of load in ");
  const auto of_waves = HasSubstr("the force of waves on load in ");
  EXPECT_THAT(warnings_of(first),
              ElementsAre(HasSubstr("B1 and load came up to"), of_radiation, of_waves));
  EXPECT_THAT(out_, HasSubstr("warning: B1 and load came up to"));
  // The boat's weight goes over from the ropes to the water.
  const double weight = 80e3 * 9.81;
  EXPECT_NEAR(first["ropes"][0]["max_static_tension_N"].get<double>(), 0.5 * weight, 0.1 * weight);

  const nlohmann::json second = simulate(boat_lift);
  EXPECT_EQ(kept(), files);
  EXPECT_EQ(second["ropes"], first["ropes"]);
  EXPECT_EQ(second["radiation"], first["radiation"]);

  const nlohmann::json near = simulate(with(boat_lift, "  afloat: {position: [34 m, 0 m]}\n", ""));
  EXPECT_EQ(kept().size(), 5U + 2);  // the pontoon alone is known
  EXPECT_LT(near["radiation"]["misplacement"][0]["distance"]["size_m"].get<double>(), 0.2 * 8);
  EXPECT_THAT(warnings_of(near), ElementsAre(of_radiation, of_waves));
}

}  // namespace
}  // namespace blocklift::pipeline
