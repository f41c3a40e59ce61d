// Which waves an irregular sea keeps, for which radiation is computed, and what is doubted of
// vessels in it.
#include "pipeline/files/environment/sea_band.h"

#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/build/build_mechanism.h"
#include "pipeline/files/environment/vessel_doubts.h"
#include "pipeline/files/mechanism/mechanism_file.h"
#include "tests/pipeline/sample_lift.h"

namespace blocklift::pipeline {
namespace {

using test::TemporaryFolder;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr double g = 9.80665;
constexpr auto follower = R"(kind: vessel
hull: {barge: {length: 1 m, breadth: 1 m, depth: 3 m}}
panel_size: 0.4 m
mass: 512.5 kg
centre_of_mass: [0 m, 0 m, 0.1 m]
radii_of_gyration: [0.4 m, 0.4 m, 0.4 m]
)";

struct Read {
  std::optional<MechanismFile> file;
  std::string complaints;
};

/// A mechanism of one vessel.
/// @param sea keys under the sea. @param vessel its model and keys.
Read read_afloat(const std::string& sea, const std::string& vessel) {
  const TemporaryFolder folder;
  folder.write("vessels/barge.yaml", test::sample_barge);
  folder.write("vessels/buoy.yaml", follower);
  std::string record = "time,elevation\n";
  for (int i = 0; i < 400; ++i) {
    record += std::to_string(0.5 * i) + "," + std::to_string(0.1 * std::cos(1.5 * 0.5 * i)) + "\n";
  }
  folder.write("waves.csv", record);
  folder.write("mechanism.yaml", "mechanism: afloat\nsea:\n  " + sea +
                                     "\nvessels:\n  B1: {model: " + vessel +
                                     "}\nsimulate: {duration: 1 s, relative_tolerance: 1e-6}\n");
  Diagnostics diagnostics;
  ModelLibrary library({});
  Read read;
  read.file = read_mechanism("mechanism.yaml", library, diagnostics);
  read.complaints = diagnostics.to_text();
  return read;
}

MechanismFile sound_afloat(const std::string& sea, const std::string& vessel) {
  Read read = read_afloat(sea, vessel);
  EXPECT_TRUE(read.file) << read.complaints;
  return read.file.value_or(MechanismFile());
}

std::string spectrum(const std::string& period) {
  return "waves: {spectrum: {significant_height: 0.5 m, peak_period: " + period + "}}";
}

/// What is doubted of the sea itself.
std::string doubt_of_sea(const MechanismFile& file) { return doubt_about_sea(file, g); }

const std::string bare_buoy = "vessels/buoy, radiation: none",
                  bare_barge = "vessels/barge, radiation: none";

// Shares of JONSWAP's energy by a sum of 60,000 steps of ln(omega): 0.1 % lies below 0.6626 of the
// peak's frequency, 0.4 % above 3.781 of it.
TEST(SeaBand, IsThatOfTheSeaWhereNothingRadiates) {
  const MechanismFile file = sound_afloat(spectrum("5 s"), bare_buoy);
  const SeaBand band = find_sea_band(file, g);
  const double peak = 2 * M_PI / 5;
  EXPECT_NEAR(band.sea[0], 0.6626 * peak, 1e-3);
  EXPECT_NEAR(band.sea[1], 3.781 * peak, 3e-3);
  EXPECT_NEAR(band.kept, std::sqrt(0.995), 1e-4);
  EXPECT_NEAR(make_sea(file, g).waves.significant_height(), 0.5 * band.kept, 1e-4);
  EXPECT_EQ(doubt_of_sea(file), "");
  EXPECT_THAT(describe_sea(file, g), HasSubstr("99.7 % of the 0.5 m of the spectrum"));
}

TEST(SeaBand, KeepsTheUsualRadiationForLongSeas) {
  const SeaBand band = find_sea_band(sound_afloat(spectrum("12 s"), "vessels/barge"), g);
  EXPECT_EQ(band.radiation, (std::array<double, 2>{0.3, 1.2}));
  EXPECT_EQ(band.frequencies, 19);
  EXPECT_NEAR(band.kept, 0.985, 1e-3);
}

// Panels of the barge are 4 x 3.33 m and 5.21 m across: three go into waves of 15.6 m, which have
// 1.985 rad/s.
TEST(SeaBand, RadiationReachesWhatTheSeaAsksFor) {
  const MechanismFile short_sea = sound_afloat(spectrum("9 s"), "vessels/barge");
  const SeaBand band = find_sea_band(short_sea, g);
  EXPECT_DOUBLE_EQ(band.radiation[0], 0.3);
  EXPECT_NEAR(band.radiation[1], 1.95, 1e-9);
  EXPECT_EQ(band.frequencies, 34);  // 0.05 rad/s apart
  EXPECT_GT(band.kept, kept_without_doubt);
  EXPECT_THAT(short_sea.doubts, IsEmpty());

  const SeaBand long_sea = find_sea_band(sound_afloat(spectrum("20 s"), "vessels/barge"), g);
  EXPECT_NEAR(long_sea.radiation[0], 0.2, 1e-9);
  EXPECT_DOUBLE_EQ(long_sea.radiation[1], 1.2);
  EXPECT_NEAR(long_sea.kept, std::sqrt(0.995), 1e-3);
}

// Of a peak period of 5 s what lies below 1.2 rad/s is 45.8 % of the significant height; a
// thousandth of the energy is left out at the low end.
TEST(SeaBand, ObeysAHighestFrequency) {
  for (const char* vessel : {"vessels/buoy, radiation: none", "vessels/barge"}) {
    const MechanismFile file =
        sound_afloat("radiation: {highest_frequency: 1.2 rad/s}\n  " + spectrum("5 s"), vessel);
    const SeaBand band = find_sea_band(file, g);
    EXPECT_DOUBLE_EQ(band.sea[1], 1.2);
    EXPECT_DOUBLE_EQ(band.radiation[1], 1.2);
    EXPECT_NEAR(band.kept, std::sqrt(0.458 * 0.458 - 1e-3), 1e-3);
    ASSERT_FALSE(file.doubts.empty());
    EXPECT_EQ(file.doubts[0], doubt_of_sea(file));
    EXPECT_THAT(file.doubts[0], AllOf(HasSubstr("The sea has 45.7 % of its significant height"),
                                      HasSubstr("highest_frequency is 1.2 rad/s")));
  }
}

TEST(SeaBand, RefusesASeaThatIsHardlyThere) {
  const std::string panels = read_afloat(spectrum("3 s"), bare_barge).complaints;
  EXPECT_THAT(panels, AllOf(HasSubstr("mechanism.yaml:3:10: error: of the sea's waves those of "),
                            HasSubstr("panels of vessel B1 are up to 5.21 m wide"),
                            HasSubstr("highest_frequency under radiation")));
  const std::string none =
      read_afloat("radiation: {highest_frequency: 1.2 rad/s}\n  " + spectrum("3 s"), bare_buoy)
          .complaints;
  EXPECT_THAT(none, AllOf(HasSubstr("of the sea's waves none are left, with 0 % of"),
                          HasSubstr("a higher highest_frequency under radiation")));
}

TEST(SeaBand, ARecordKeepsItsWaves) {
  const std::string record = "waves: {record: {file: waves.csv}}";
  const MechanismFile file = sound_afloat(record, bare_buoy);
  EXPECT_NEAR(make_sea(file, g).waves.significant_height(), 4 * 0.1 / std::sqrt(2), 0.005);
  EXPECT_EQ(doubt_of_sea(file), "");
  const MechanismFile cut =
      sound_afloat("waves: {record: {file: waves.csv, highest_frequency: 1.4 rad/s}}", bare_buoy);
  EXPECT_LT(find_sea_band(cut, g).kept, 0.2);
  EXPECT_NE(doubt_of_sea(cut), "");
}

// Whoever floats in waves without added mass hears of it, once for all.
TEST(VesselDoubts, AreOfDryVesselsInWaves) {
  MechanismFile file = sound_afloat(spectrum("9 s"), bare_barge);
  const std::vector<std::string> doubts = doubts_about_vessels(file);
  EXPECT_THAT(doubts, ElementsAre(AllOf(HasSubstr("radiation: none: no water moves along with B1."),
                                        HasSubstr("leave radiation out"))));
  EXPECT_EQ(file.doubts, doubts);
  file.vessels.push_back(file.vessels.front());
  file.vessels.back().name.value = "B2";
  EXPECT_THAT(doubts_about_vessels(file), ElementsAre(HasSubstr("along with B1, B2.")));
  EXPECT_THAT(doubts_about_vessels(sound_afloat(spectrum("9 s"), "vessels/barge")), IsEmpty());
  EXPECT_THAT(sound_afloat("depth: 20 m", bare_barge).doubts, IsEmpty());
}

// A barge that heads along y in a current of 2 m/s towards x, from its side: its damping of sway
// pulls by 2 m/s x 30 kN s/m.
TEST(VesselDoubts, AreOfACurrentThatPullsTwice) {
  const std::string current = "current: {speed: 2 m/s, towards: 0 deg}";
  const auto barge = [](const std::string& damping, const std::string& load) {
    return "vessels/barge, heading: 90 deg, damping: " + damping + load;
  };
  const std::string load =
      ", current_load: {area: 40 m^2, length: 20 m, coefficients: [[0 deg, 0.1, 0, 0], "
      "[180 deg, -0.1, 0, 0]]}";
  EXPECT_THAT(sound_afloat(current, barge("{surge: 9 kN s/m, sway: 30 kN s/m}", load)).doubts,
              ElementsAre(HasSubstr("the current of 2 m/s pulls vessel B1 by 60 kN through it")));
  EXPECT_THAT(sound_afloat(current, barge("{sway: 30 kN s/m}", "")).doubts, IsEmpty());
  EXPECT_THAT(sound_afloat(current, barge("{roll: 3 MN m s/rad}", load)).doubts, IsEmpty());
}

// It floats 2 m deep, by its weight or its draught.
TEST(SeaBand, AVesselDoesNotStandOnTheBottom) {
  const std::string message = "error: vessel B1 reaches 2 m below the water, which is 1.5 m deep";
  EXPECT_THAT(read_afloat("depth: 1.5 m", "vessels/barge, radiation: none").complaints,
              AllOf(HasSubstr("mechanism.yaml:5:3: "), HasSubstr(message)));
  EXPECT_THAT(read_afloat("depth: 1.5 m", "vessels/barge, draught: 2 m").complaints,
              HasSubstr(message));
  EXPECT_EQ(read_afloat("depth: 2.5 m", "vessels/barge, radiation: none").complaints, "");
}

TEST(SeaBand, ADraughtThatIsNoNumberIsComplainedOfOnce) {
  EXPECT_THAT(read_afloat("depth: 20 m", "vessels/barge, draught: .nan m").complaints,
              AllOf(HasSubstr("draught \".nan m\" is no number"), Not(HasSubstr("nan m, and"))));
}

TEST(SeaBand, PeakednessIsThatOfJonswap) {
  EXPECT_THAT(read_afloat("waves: {spectrum: {shape: pierson_moskowitz, significant_height: 0.5 m, "
                          "peak_period: 9 s, peakedness: 5}}",
                          bare_buoy)
                  .complaints,
              HasSubstr("a spectrum of this shape has no key \"peakedness\""));
}

}  // namespace
}  // namespace blocklift::pipeline
