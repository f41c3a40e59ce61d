// What a run leaves behind: the whole of its results, or nothing.
#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "pipeline/assessment/assess.h"
#include "pipeline/checks/standard_checks.h"
#include "pipeline/results/doubts/bounce_doubts.h"
#include "pipeline/results/doubts/doubts.h"
#include "pipeline/results/summaries/history_summary.h"
#include "pipeline/results/summaries/mesh_error.h"
#include "pipeline/results/summaries/sling_summary.h"
#include "pipeline/results/summaries/summary.h"
#include "tests/pipeline/run_program.h"
#include "tests/pipeline/small_lift.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;

Assessment assess_quietly(LiftCase lift_case) {
  return assess(std::move(lift_case), [](const std::string&, double, const std::string&) {});
}

/// The small lift's assessment, once in a process.
Assessment& small_assessment() {
  static Assessment assessment = assess_quietly(test::read_small_lift());
  return assessment;
}

/// Every file below a folder with its content.
std::map<std::string, std::string> contents(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    files[fs::relative(entry.path(), folder).string()] =
        entry.is_directory() ? "folder" : test::text_of_file(entry.path());
  return files;
}

/// Gives the assessment a title that no summary can hold, while it lives.
class Unwritable {
 public:
  explicit Unwritable(Assessment& assessment)
      : title_(assessment.lift_case.title), before_(title_) {
    title_ = "\xff";
  }
  ~Unwritable() { title_ = before_; }
  Unwritable(const Unwritable&) = delete;
  Unwritable& operator=(const Unwritable&) = delete;

 private:
  std::string& title_;
  std::string before_;
};

TEST(WriteResults, PutsEverythingIntoTheFolder) {
  const TemporaryFolder folder;
  const fs::path report = write_results(small_assessment(), "results/small");
  EXPECT_EQ(report, "results/small/report.html");
  std::set<std::string> names;
  for (const auto& [name, text] : contents("results/small")) {
    names.insert(name);
    EXPECT_GT(text.size(), 1000u) << name;
  }
  EXPECT_EQ(names, (std::set<std::string>{"block-dynamic.vtu", "block-static.vtu", "lug-L1.vtu",
                                          "report.html", "results.h5", "summary.json"}));
}

/// Gives the assessment rules, while it lives.
class WithRules {
 public:
  explicit WithRules(Assessment& assessment) : assessment_(assessment), checks_(assessment.checks) {
    given::Standard& standard = assessment.lift_case.standard.emplace();
    Diagnostics diagnostics;
    ModelLibrary library = ModelLibrary::of_installation();
    for (const char* name : {"en-13001", "asme-bth-1-a"}) standard.rule_names.push_back({name, {}});
    load_rules(standard, ".", library, diagnostics);
    standard.hoisting_class = {"HC2", {}};
    standard.length_tolerance = 0.0025;
    check_by_standard(assessment);
  }
  ~WithRules() {
    assessment_.lift_case.standard.reset();
    assessment_.standard.reset();
    assessment_.checks = checks_;
  }
  WithRules(const WithRules&) = delete;
  WithRules& operator=(const WithRules&) = delete;

 private:
  Assessment& assessment_;
  std::vector<Check> checks_;
};

TEST(WriteResults, HasTheCalculationWhereTheCaseNamesRules) {
  const TemporaryFolder folder;
  Assessment& assessment = small_assessment();
  const std::size_t checks_before = assessment.checks.size();
  const WithRules rules(assessment);
  EXPECT_GT(assessment.checks.size(), checks_before);
  write_results(assessment, "results");
  const std::string calculation = test::text_of_file("results/calculation.md");
  for (const char* text :
       {"## Design basis", "## Weights", "## Rigging list", "| R1 | L1 |", "## Geometry",
        "## Load cases", "1. carry", "## Utilisations", "## Checks of the case",
        "tension against breaking load", "## Block by finite elements", "by the error of the mesh",
        "| buckling of panels in", "### sling R4", "hook C1.left", "EN 13001-2 4.2.2.2",
        "| prepared |", "hash of input and factors"})
    EXPECT_NE(calculation.find(text), std::string::npos) << text;
  const std::string word = test::text_of_file("results/calculation.docx");
  EXPECT_EQ(word.substr(0, 2), "PK");
  for (const char* text :
       {"Design basis", "sling R4", "hash of input and factors", "small-lift   "})
    EXPECT_NE(word.find(text), std::string::npos) << text;
  const auto summary = nlohmann::json::parse(test::text_of_file("results/summary.json"));
  // What the two columns of a sling say of its motion is what the histories say.
  for (const auto& rope : summary.at("ropes"))
    for (const auto& chain : summary.at("standard").at("chains")) {
      if (chain.at("name") != "sling " + rope.at("name").get<std::string>()) continue;
      double product = 1;
      for (const auto& step : chain.at("steps"))
        if (step.at("name") == "dynamic amplification" || step.at("name") == "re-sharing in motion")
          product *= step.at("simulated").get<double>();
      EXPECT_NEAR(product, rope.at("dynamic_over_static").get<double>(), 1e-9);
    }
}

TEST(WriteResults, LeavesNothingWhenItFails) {
  const TemporaryFolder folder;
  {
    const Unwritable broken(small_assessment());
    EXPECT_ANY_THROW(write_results(small_assessment(), "new/results"));
  }
  EXPECT_TRUE(contents(".").empty()) << contents(".").begin()->first;

  write_results(small_assessment(), "results");
  folder.write("results/notes.txt", "mine");
  const auto before = contents(".");
  {
    const Unwritable broken(small_assessment());
    EXPECT_ANY_THROW(write_results(small_assessment(), "results"));
  }
  EXPECT_EQ(contents("."), before);
}

TEST(WriteResults, ReplacesEarlierResults) {
  const TemporaryFolder folder;
  folder.write("results/summary.json", "old");
  folder.write("results/.in-preparation/summary.json", "left by a run that was killed");
  folder.write("results/notes.txt", "mine");
  write_results(small_assessment(), "results");
  EXPECT_NE(test::text_of_file("results/summary.json"), "old");
  EXPECT_EQ(test::text_of_file("results/notes.txt"), "mine");
  EXPECT_FALSE(fs::exists("results/.in-preparation"));
}

void expect_numbers(const nlohmann::json& object, std::initializer_list<const char*> keys) {
  for (const char* key : keys) {
    ASSERT_TRUE(object.contains(key)) << key << " in " << object.dump().substr(0, 200);
    EXPECT_TRUE(object[key].is_number()) << key;
  }
}

void expect_way(const nlohmann::json& way) {
  for (const char* state : {"static", "dynamic"})
    expect_numbers(way.at(state),
                   {"checked_von_mises_Pa", "peak_von_mises_Pa", "max_displacement_m",
                    "force_residual", "moment_residual", "reaction_over_weight"});
  expect_numbers(way, {"stress_increase_percent", "deformation_increase_percent"});
}

TEST(Summary, HoldsEverythingThatReadersCountOn) {
  const TemporaryFolder folder;
  write_results(small_assessment(), ".");
  const auto summary = nlohmann::json::parse(test::text_of_file("summary.json"));
  EXPECT_EQ(summary["case"], "small-lift");
  EXPECT_EQ(summary["verdict"], "pass");
  ASSERT_EQ(summary["checks"].size(), 17u);
  for (const auto& check : summary["checks"]) {
    expect_numbers(check, {"demand", "limit", "utilisation"});
    EXPECT_TRUE(check["name"].is_string());
    EXPECT_TRUE(check["unit"].is_string());
    EXPECT_TRUE(check["pass"].is_boolean());
  }
  ASSERT_EQ(summary["structure"]["padeyes"].size(), 1u);
  const auto& padeye = summary["structure"]["padeyes"][0];
  EXPECT_EQ(padeye["lug"], "L1");
  ASSERT_EQ(padeye["states"].size(), 4u);
  for (const auto& state : padeye["states"])
    expect_numbers(state, {"main_plate_checked_von_mises_Pa", "cheeks_checked_von_mises_Pa",
                           "peak_von_mises_Pa", "force_residual", "moment_residual"});
  for (const auto& formula : padeye["formulas"])
    expect_numbers(formula, {"demand", "limit", "utilisation"});
  for (const auto& panel : summary["structure"]["buckling"]["panels"]) {
    expect_numbers(panel, {"utilisation", "elastic_utilisation", "thickness_m", "time_s",
                           "free_edges", "s11_gradient_Pa", "s22_gradient_Pa"});
    const auto& free = panel["free_edges_along_sides"];
    ASSERT_EQ(free.size(), 2u);
    EXPECT_EQ(free[0].get<int>() + free[1].get<int>(), panel["free_edges"].get<int>());
  }
  ASSERT_EQ(summary["ropes"].size(), 4u);
  for (const auto& rope : summary["ropes"]) {
    expect_numbers(rope, {"max_static_tension_N", "time_of_max_static_s", "max_dynamic_tension_N",
                          "time_of_max_dynamic_s", "dynamic_over_static"});
    // Linked statistics: at its own largest load the rope itself has that load.
    const std::string name = rope["name"];
    EXPECT_EQ(rope["linked_dynamic_N"][name], rope["max_dynamic_tension_N"]);
    EXPECT_EQ(rope["linked_static_N"].size(), 4u);
  }
  EXPECT_EQ(summary["hoists"].size(), 2u);
  EXPECT_EQ(summary["cranes"].size(), 1u);
  const auto& structure = summary["structure"];
  EXPECT_EQ(structure["unknowns"], small_assessment().block.model->space().unknowns());
  expect_way(structure["per_rope_maxima"]);
  expect_way(structure["simultaneous"]);
  EXPECT_EQ(structure["simultaneous_by_rope"].size(), 4u);
  EXPECT_EQ(structure["lugs"].size(), 4u);
  expect_numbers(structure["mass"], {"total_kg", "steel_kg", "outfitting_kg"});
  // At the start, after each stage, and where a rope is nearest to breaking.
  ASSERT_GE(summary["natural_periods"].size(), 2u);
  EXPECT_EQ(summary["natural_periods"][0]["instant"], "start");
  for (const auto& instant : summary["natural_periods"]) {
    // Two eigenvalues a degree of freedom: a swing has both, creeping back (its damped hooks) one.
    int eigenvalues = 0;
    for (const auto& mode : instant["modes"]) {
      expect_numbers(mode, {"period_s", "frequency_Hz", "damping_ratio", "elastic_share"});
      EXPECT_GE(mode["damping_ratio"], 0.0);
      eigenvalues += mode["kind"] == "oscillating" ? 2 : 1;
    }
    EXPECT_EQ(eigenvalues, 2 * small_assessment().lift->model.system.nv_free());
    EXPECT_EQ(instant["modes"][0]["kind"], "oscillating");
  }
  EXPECT_EQ(summary["solver"]["right_hand_sides_for_differences"], 0);
  expect_numbers(summary["energy"], {"largest_imbalance_J", "relative_imbalance"});
  EXPECT_LT(summary["energy"]["relative_imbalance"], 1e-3);
  expect_numbers(summary["timing"], {"static_s", "dynamic_s", "simulated_s", "assembly_s",
                                     "factorisation_s", "solve_s", "report_s"});
  EXPECT_FALSE(summary["assumptions"].empty());
}

TEST(Summary, IsJsonEvenWhereFiguresAreNotFinite) {
  Assessment assessment = assess_quietly(test::read_small_lift());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  assessment.checks.push_back(check_at_most("broken", nan, nan, "N"));
  assessment.checks.back().time = nan;
  assessment.lift->dynamic_result.history.energy.kinetic.setConstant(nan);
  assessment.lift->static_history.rope("R1");
  for (auto& rope : assessment.lift->dynamic_result.history.ropes) rope.tension.setConstant(nan);
  assessment.block.assessment.simultaneous.dynamic_state.result.checked_von_mises.value =
      std::numeric_limits<double>::infinity();
  const auto summary = nlohmann::json::parse(make_summary(assessment).dump());
  EXPECT_EQ(summary["verdict"], "fail");
  EXPECT_TRUE(summary["checks"].back()["demand"].is_null());
  EXPECT_TRUE(summary["energy"]["relative_imbalance"].is_null());
  EXPECT_TRUE(summary["ropes"][0]["dynamic_over_static"].is_null());
  EXPECT_TRUE(summary["structure"]["simultaneous"]["dynamic"]["checked_von_mises_Pa"].is_null());
}

/// The small lift's block under a load table. @param loads lines of the table.
Assessment assess_small_table(const TemporaryFolder& folder, const std::string& loads) {
  const std::string block = test::text_of_file(std::string(BLOCKLIFT_SMALL_LIFT) + "/block.yaml");
  folder.write("block.yaml", block);
  folder.write("case.yaml",
               "case: table\n"
               "gravity: 9.81 m/s^2\n"
               "load: {model: block}\n"
               "load_table:\n" +
                   loads + "structure: {element_degree: 1, largest_element: 1 m}\n");
  return assess_quietly(read_lift_case("."));
}

// A load table has no dynamics and says so by leaving its parts out.
TEST(Summary, OfALoadTableHasNoRopes) {
  const TemporaryFolder folder;
  const Assessment assessment =
      assess_small_table(folder,
                         "  direction: [0, 0, 1]\n"
                         "  static: {L1: 2 t, L2: 2 t, L3: 2 t, L4: 2 t}\n"
                         "  dynamic: {L1: 3 t, L2: 2 t, L3: 2 t, L4: 2 t}\n");
  write_results(assessment, "results");
  const auto summary = nlohmann::json::parse(test::text_of_file("results/summary.json"));
  EXPECT_FALSE(summary.contains("ropes"));
  EXPECT_FALSE(summary.contains("energy"));
  expect_way(summary["structure"]["simultaneous"]);
  ASSERT_EQ(summary["checks"].size(), 6u);  // stress, panels of three plates, two of the padeye
  const auto& forces = assessment.block.assessment.simultaneous.dynamic_state.load.lug_forces_B;
  EXPECT_NEAR(forces[0].z(), 3e3 * 9.80665, 1e-6);
  EXPECT_NEAR(forces[1].z(), 2e3 * 9.80665, 1e-6);
  // At rest it bears the weight, but for standard gravity, 5 and 2 cm beside the centre of mass.
  const auto& table = summary["structure"]["load_table"];
  EXPECT_NEAR(table["weight_N"].get<double>(), 8000 * 9.81, 1e-3);
  EXPECT_NEAR(table["static"]["over_weight"].get<double>(), 9.80665 / 9.81, 1e-9);
  EXPECT_NEAR(table["static"]["lever_m"].get<double>(), std::hypot(0.05, 0.02), 1e-6);
  EXPECT_NEAR(table["dynamic"]["acceleration_g"].get<double>(), 9.0 / 8 * 9.80665 / 9.81 - 1, 1e-9);
  EXPECT_FALSE(summary.contains("warnings"));
  EXPECT_THAT(summary["assumptions"].dump(),
              ::testing::HasSubstr("Loads of the table, for a weight of 8.003 t: at rest they sum "
                                   "to 8 t (-0.0 %) and pull 0.0539 m beside"));
}

// Half of the weight, and the weight at one corner: neither is a block at rest.
TEST(Summary, DoubtsALoadTableThatIsNotAtRest) {
  const auto warnings = [](const std::string& loads) {
    const TemporaryFolder folder;
    const auto summary = nlohmann::json::parse(
        make_summary(assess_small_table(folder, "  direction: [0, 0, 1]\n" + loads)).dump());
    return summary.contains("warnings") ? summary["warnings"].get<std::vector<std::string>>()
                                        : std::vector<std::string>();
  };
  using ::testing::ElementsAre;
  using ::testing::HasSubstr;
  EXPECT_THAT(warnings("  static: {L1: 1 t, L2: 1 t, L3: 1 t, L4: 1 t}\n"
                       "  dynamic: {L1: 1 t, L2: 1 t, L3: 1 t, L4: 1 t}\n"),
              ElementsAre(HasSubstr("sum to 4 t, 50.0 % less than the weight of the block, 8.003 "
                                    "t; usually they are within 3 % of it")));
  EXPECT_THAT(warnings("  static: {L1: 8 t}\n"
                       "  dynamic: {L1: 9 t}\n"),
              ElementsAre(HasSubstr("pull 2.22 m beside the centre of mass")));
}

TEST(Assess, RefusesALoadTableThatPressesTheBlockDown) {
  const TemporaryFolder folder;
  try {
    assess_small_table(folder,
                       "  direction: [0, 0, -1]\n"
                       "  static: {L1: 2 t, L2: 2 t, L3: 2 t, L4: 2 t}\n"
                       "  dynamic: {L1: 2 t, L2: 2 t, L3: 2 t, L4: 2 t}\n");
    FAIL() << "a block was pressed";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("they press the block down at its lugs"));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("case.yaml:"));
  }
}

// Rounding differs with the number of threads; it must not turn a word.
TEST(Summary, RoundingMakesNoPracticeUnsafe) {
  HistoryAssessment history;
  const auto is_safe = [&](double percent) {
    history.per_rope_maxima.largest_percent = percent;
    return history_json(history)["practice"]["per_rope_maxima"]["safe"].get<bool>();
  };
  EXPECT_TRUE(is_safe(0.5));
  EXPECT_TRUE(is_safe(1e-12));
  EXPECT_TRUE(is_safe(-1e-12));
  EXPECT_FALSE(is_safe(-0.01));
}

TEST(MeshError, GivesChecksOfStressABand) {
  BlockRun block;
  block.error.relative = 0.2;
  EXPECT_EQ(checked_stress_band(block), 0.2);
  block.accuracy.steps = {{100, 10, 0.1, 50e6, 100e6}, {200, 20, 0.05, 51e6, 105e6}};
  EXPECT_NEAR(checked_stress_band(block), 0.05, 1e-12);
  Check check = check_at_most("stress", 100e6, 235e6, "Pa");
  check.note = "web";
  note_band(0.05, check);
  EXPECT_EQ(check.note, "web; 95 to 105 MPa by the error of the mesh");
  Check buckling = check_at_most("buckling", 0.4, 0.8, "1");
  note_band(0.05, buckling);
  EXPECT_EQ(buckling.note, "0.38 to 0.42 by the error of the mesh");
  EXPECT_NEAR(buckling.utilisation_band().first, 0.475, 1e-12);
  EXPECT_NEAR(buckling.utilisation_band().second, 0.525, 1e-12);
  note_band(1.5, buckling);
  EXPECT_EQ(buckling.utilisation_band().first, 0);
}

TEST(MeshError, IsBesideEveryCheckThatTheMeshGaveAndNoOther) {
  const TemporaryFolder folder;
  write_results(small_assessment(), "results");
  const auto summary = nlohmann::json::parse(test::text_of_file("results/summary.json"));
  const double band = summary.at("structure").at("accuracy").at("stress_band");
  int of_stress = 0, of_buckling = 0;
  for (const auto& check : summary.at("checks")) {
    const std::string name = check.at("name");
    const bool is_stress = name.starts_with("stress in"), buckles = name.starts_with("buckling");
    const bool is_padeye = name.find("checked von Mises in the padeye") != std::string::npos;
    of_stress += is_stress ? 1 : 0;
    of_buckling += buckles ? 1 : 0;
    EXPECT_EQ(check.contains("utilisation_band"), is_stress || buckles || is_padeye) << name;
    if (!check.contains("utilisation_band")) continue;
    const double utilisation = check.at("utilisation");
    EXPECT_NEAR(check.at("utilisation_band")[1].get<double>(), utilisation * (1 + band), 1e-9);
    EXPECT_NE(check.at("note").get<std::string>().find("by the error of the mesh"),
              std::string::npos);
  }
  EXPECT_GE(of_stress, 1);
  EXPECT_GE(of_buckling, 1);
}

class DoubtsOfALift : public ::testing::Test {
 protected:
  std::string doubts() const {
    std::string all;
    for (const std::string& doubt : list_doubts(lift_case_, *assessment_.lift)) all += doubt + "\n";
    return all;
  }
  /// The block with a change.
  template <class Change>
  void change_block(const Change& change) {
    auto block = std::make_shared<BlockModel>(*lift_case_.load.model);
    change(*block);
    lift_case_.load.model = std::move(block);
  }

  Assessment& assessment_ = small_assessment();
  LiftCase lift_case_ = assessment_.lift_case;
};

TEST_F(DoubtsOfALift, AreNoneOfASoundLift) { EXPECT_EQ(doubts(), ""); }

// What is not known of the vessels' panels stands in the report, not on the terminal alone.
TEST_F(DoubtsOfALift, PanelsOfVesselsInTheReport) {
  const std::string panels = "The panels are coarse: of barge in roll.";
  std::vector<std::string>& of_water = assessment_.lift->model.doubts_of_water;
  of_water = {panels};
  const std::string said = doubts();
  const TemporaryFolder folder;
  write_results(assessment_, "results");
  of_water.clear();  // other tests have the same assessment
  EXPECT_EQ(said, panels + "\n");
  const auto summary = nlohmann::json::parse(test::text_of_file("results/summary.json"));
  // The sample's ropes damp its bounce by much.
  EXPECT_THAT(summary.at("warnings").get<std::vector<std::string>>(),
              ::testing::ElementsAre(panels, ::testing::StartsWith("The motion \"load: bounce\"")));
  EXPECT_THAT(test::text_of_file("results/report.html"), ::testing::HasSubstr(panels));
}

TEST_F(DoubtsOfALift, PlaceOfTheLoad) {
  lift_case_.load.position.x() += 200;
  EXPECT_THAT(doubts(), ::testing::HasSubstr("The load hangs at rest 200 m from where the case"));
}

TEST_F(DoubtsOfALift, CranesInOnePlace) {
  lift_case_.cranes.push_back(lift_case_.cranes.front());
  lift_case_.cranes.back().name.value = "C2";
  EXPECT_EQ(doubts(), "Cranes C1 and C2 stand in one place.\n");
  lift_case_.cranes.back().position.x() += 5;
  EXPECT_EQ(doubts(), "");
}

TEST_F(DoubtsOfALift, WindAndItsAreas) {
  change_block([](BlockModel& block) { block.wind_areas.front().area = 1e6; });
  EXPECT_THAT(doubts(), ::testing::HasSubstr("The load has a wind area of 1e+06 m2"));
  change_block([](BlockModel& block) { block.wind_areas.clear(); });
  EXPECT_EQ(doubts(), "Wind blows, and the load has no wind_areas: it feels none of it.\n");
  lift_case_.wind.reset();
  EXPECT_EQ(doubts(), "");
}

TEST_F(DoubtsOfALift, CornersOfAFrame) {
  given::Spreader frame;
  frame.name.value = "F1";
  frame.length.value = 4;
  frame.width = 2;
  lift_case_.spreaders.push_back(frame);
  const auto add = [&](const std::string& eye, bool above) {
    ResolvedPoint at_eye, elsewhere;
    at_eye.kind = ResolvedPoint::Kind::spreader;
    at_eye.part = "F1";
    at_eye.point = *frame.eye(eye);
    elsewhere.kind = ResolvedPoint::Kind::hook;
    given::Rope rope;
    rope.path = above ? std::vector{elsewhere, at_eye} : std::vector{at_eye, elsewhere};
    lift_case_.ropes.push_back(rope);
  };
  for (const char* eye : {"upper_1", "upper_2", "upper_3"}) add(eye, true);
  for (const char* eye : {"lower_1", "lower_2", "lower_3"}) add(eye, false);
  EXPECT_EQ(list_doubts(lift_case_).size(), 0U);
  add("lower_4", false);
  EXPECT_EQ(list_doubts(lift_case_),
            std::vector<std::string>{"Slings to the load begin at corner 4 of frame F1, where none "
                                     "comes from above."});
  add("upper_4", true);
  EXPECT_EQ(list_doubts(lift_case_).size(), 0U);
}

TEST_F(DoubtsOfALift, MaterialAndMass) {
  change_block([](BlockModel& block) { block.materials.front().youngs_modulus = 0.2e9; });
  EXPECT_THAT(doubts(), ::testing::HasSubstr("0.2 GPa; metals have 40 to 450 GPa (steel 206)"));
  change_block([](BlockModel& block) {
    block.materials.front().youngs_modulus = 206e9;
    block.centre_of_mass = Located<Vector3>{Vector3(0, 0, 50), {}};
  });
  EXPECT_EQ(doubts(), "The centre of mass of the load, (0, 0, 50) m, lies outside its body.\n");
  EXPECT_EQ(list_doubts(lift_case_).size(), 1u);  // without a run
}

// What another unit makes of them: feet in gravity, t in place of kN, kN in place of MN.
TEST_F(DoubtsOfALift, GravityAndStrengthOfRopes) {
  using ::testing::HasSubstr;
  RopeModel& rope = lift_case_.ropes.front().rope;
  rope.axial_stiffness = 40e6;
  rope.breaking_load = 426e3;  // 26 mm: 0.356 d^2 x 1770 MPa
  rope.diameter = 0.026;
  EXPECT_EQ(doubts(), "");
  rope.breaking_load = 4178e3;
  EXPECT_THAT(doubts(), HasSubstr("of 26 mm has a breaking load of 4178 kN, 7869 MPa over"));
  rope.axial_stiffness = 200e3;
  rope.diameter.reset();
  EXPECT_THAT(doubts(), HasSubstr("would be 2089 % longer before it breaks, by its axial"));
  rope.axial_stiffness = 40e6;
  lift_case_.gravity = 2.99;
  EXPECT_THAT(doubts(), ::testing::StartsWith("Gravity is 2.99 m/s2; on the Earth it is 9.76"));
}

// As if the load hung on one hook, turned by 40 degrees at one instant.
TEST_F(DoubtsOfALift, TurnOfALoadThatNothingHolds) {
  LiftRun& lift = *assessment_.lift;
  const auto load = static_cast<std::size_t>(lift.model.load) - 1;
  auto& pose = lift.dynamic_result.history.bodies[load].pose;
  const auto before = pose;
  const double half = 20 * std::acos(-1.0) / 180;
  const Eigen::Matrix3d R = lift.static_history.bodies[load].X_WB(0).R;
  const Eigen::Quaterniond turned =
      Eigen::Quaterniond(std::cos(half), 0, 0, std::sin(half)) * Eigen::Quaterniond(R);
  pose.row(5).tail(4) << turned.w(), turned.x(), turned.y(), turned.z();
  EXPECT_EQ(doubts(), "");  // two hooks hold it
  lift.model.held_heading = dynamics::HeldHeading();
  EXPECT_THAT(doubts(), ::testing::HasSubstr("The load turns by 40 deg about the plumb, at "));
  pose = before;
  EXPECT_EQ(doubts(), "");
  lift.model.held_heading.reset();
}

TEST_F(DoubtsOfALift, RopesBeyondTheirStrengthAndLoadInTheGround) {
  LiftRun& lift = *assessment_.lift;
  const double strength = std::exchange(lift.model.ropes.front().breaking_load, 1e3);
  EXPECT_THAT(doubts(), ::testing::HasSubstr("more than its breaking load of 1 kN"));
  lift.model.ropes.front().breaking_load = strength;

  auto& pose =
      lift.dynamic_result.history.bodies[static_cast<std::size_t>(lift.model.load) - 1].pose;
  const auto before = pose;
  pose.col(2).array() -= 100;
  EXPECT_THAT(doubts(), ::testing::HasSubstr("m below the ground (z = 0 m)"));
  pose = before;
  EXPECT_EQ(doubts(), "");
}

// The small lift's box bounces with a third of the critical damping.
TEST_F(DoubtsOfALift, BounceThatIsDamped) {
  const LiftRun& lift = *assessment_.lift;
  const std::vector<std::string> doubts = list_bounce_doubts(lift_case_, lift);
  ASSERT_EQ(doubts.size(), 1U);
  EXPECT_THAT(doubts[0], ::testing::HasSubstr("% of the critical damping; usual are 1 to 2 %"));
}

// A worst set of just more than the rope's limit over what motion makes of its tension at rest.
TEST_F(DoubtsOfALift, SlingsOffTheirLengths) {
  const LiftRun& lift = *assessment_.lift;
  const LiftRope& rope = lift.model.ropes.front();
  const double at_rest = dynamics::find_largest_tensions(lift.static_history)[rope.rope].tension;
  const double in_motion =
      dynamics::find_largest_tensions(lift.dynamic_history())[rope.rope].tension;
  const double limit = rope.breaking_load / lift_case_.checks.rope_safety_factor;
  ASSERT_LT(in_motion, limit);
  SlingLengths lengths;
  lengths.slings = {rope.name};
  lengths.tolerance = 0.0025;
  lengths.meant.tensions = Eigen::VectorXd::Constant(1, at_rest);
  lengths.worst_tensions = Eigen::VectorXd::Constant(1, 0.999 * limit * at_rest / in_motion);
  EXPECT_TRUE(list_doubts(lift_case_, lift, lengths).empty());
  lengths.worst_tensions *= 1.002;
  const std::vector<std::string> doubts = list_doubts(lift_case_, lift, lengths);
  ASSERT_EQ(doubts.size(), 1U);
  EXPECT_THAT(doubts[0],
              ::testing::HasSubstr("are off by 0.25 % may bear more than breaking load"));
  EXPECT_THAT(doubts[0], ::testing::HasSubstr("in the worst set of lengths: " + rope.name));

  // Without sets, what one sling does by itself.
  lengths.errors = {{{lengths.worst_tensions, 0, 0, 0}, lengths.meant}};
  lengths.worst_tensions.resize(0);
  EXPECT_THAT(list_doubts(lift_case_, lift, lengths).at(0),
              ::testing::HasSubstr("in the worst case of one sling that is off"));
  // Where the check fails as it is, there is nothing to add.
  LiftCase stricter = lift_case_;
  stricter.checks.rope_safety_factor = rope.breaking_load / (0.9 * at_rest);
  EXPECT_TRUE(list_doubts(stricter, lift, lengths).empty());
}

}  // namespace
}  // namespace blocklift::pipeline
