// Files that nobody meant to write: each is refused with errors, or read; nothing crashes.

#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "pipeline/build/build_mechanism.h"
#include "pipeline/files/lift_case/lift_case.h"
#include "pipeline/files/lift_case/operation_schedule.h"
#include "tests/pipeline/sample_lift.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;
using test::SampleLift;
using test::TemporaryFolder;
using test::with;
using ::testing::HasSubstr;

const std::string two_drives = R"(mechanism: two
bodies:
  a: {mass: 1 t, radii_of_gyration: [1 m, 1 m, 1 m]}
  b: {mass: 1 t, radii_of_gyration: [1 m, 1 m, 1 m]}
joints:
  a: {kind: prismatic, child: a, axis: [1, 0, 0]}
  b: {kind: prismatic, child: b, axis: [1, 0, 0]}
drives:
  a: {joint: a, speed: 1 m/s, acceleration: 1 m/s^2, jerk: 1 m/s^3, range: [-10 m, 10 m]}
  b: {joint: b, speed: 1 m/s, acceleration: 1 m/s^2, jerk: 1 m/s^3, range: [-10 m, 10 m]}
operation:
  - {stage: s, moves: [{drives: [a], by: 1 m}, {drives: [b], follows: a, table: [[0 m, 0 m], [1 m, 0.5 m]]}]}
initial:
  positions: {a: 0 m}
simulate: {duration: 10 s, relative_tolerance: 1e-6}
)";

constexpr auto barge = R"(kind: vessel
hull: {barge: {length: 40 m, breadth: 20 m, depth: 6 m}}
panel_size: 4 m
mass: 1640 t
centre_of_mass: [0 m, 0 m, 3 m]
radii_of_gyration: [6 m, 11 m, 11 m]
)";

std::string complaints_about_mechanism(const std::string& text) {
  const TemporaryFolder folder;
  folder.write("mechanism.yaml", text);
  Diagnostics diagnostics;
  ModelLibrary library({});
  const auto mechanism = read_mechanism("mechanism.yaml", library, diagnostics);
  EXPECT_EQ(mechanism.has_value(), !diagnostics.has_errors());
  return diagnostics.to_text();
}

std::string complaints_about_case(const SampleLift& lift) {
  const TemporaryFolder folder;
  lift.write(folder);
  folder.write("barge.yaml", barge);
  Diagnostics diagnostics;
  ModelLibrary library({});
  const auto lift_case = read_lift_case("case.yaml", library, diagnostics);
  EXPECT_EQ(lift_case.has_value(), !diagnostics.has_errors());
  return diagnostics.to_text();
}

TEST(DamagedFiles, TableOfAFollowingMoveIsATable) {
  EXPECT_EQ(complaints_about_mechanism(two_drives), "");
  for (const char* table : {"3", "[]", "[[0 m, 0 m]]", "{}", "\"\"", "[3]", "[[0 m]]"}) {
    EXPECT_THAT(complaints_about_mechanism(with(two_drives, "[[0 m, 0 m], [1 m, 0.5 m]]", table)),
                HasSubstr("mechanism.yaml:12:"))
        << table;
    SampleLift lift;
    lift.lift_case = with(lift.lift_case, "[[0 m, 0 m], [5 m, 1 m], [10 m, 2 m]]", table);
    EXPECT_THAT(complaints_about_case(lift), HasSubstr("case.yaml:19:")) << table;
  }
}

TEST(DamagedFiles, DraughtsOfALoadAreAList) {
  for (const char* draughts : {"2 m", "[]", "{a: 1}", "[2]", "[1 m, 2 m, x]"}) {
    SampleLift lift;
    lift.lift_case = with(lift.lift_case, "load: {model: plate, position",
                          std::string("sea: {}\nload: {vessel: barge, draughts: ") + draughts +
                              ", lugs: {L1: [0 m, 0 m, 6 m], L2: [4 m, 0 m, 6 m]}, position");
    EXPECT_THAT(complaints_about_case(lift), HasSubstr("case.yaml:4:")) << draughts;
  }
}

TEST(DamagedFiles, NamesAreNotEmpty) {
  EXPECT_THAT(complaints_about_mechanism(with(two_drives, "{a: 0 m}", "{\"\": 0 m}")),
              HasSubstr("mechanism.yaml:14:15: error: a key is empty; a name is due"));
  EXPECT_THAT(complaints_about_mechanism(with(two_drives, "{a: 0 m}", "{'': [], a: 0 m}")),
              HasSubstr("1 error\n"));
}

// Compared each with each, four times the keys would take sixteen times the time.
TEST(DamagedFiles, UnknownKeysTakeTimeInProportion) {
  const auto seconds_for = [](int keys) {
    std::string text = "mechanism: many\n";
    for (int i = 0; i < keys; ++i) text += "key_" + std::to_string(i) + ": 1\n";
    const std::clock_t start = std::clock();
    EXPECT_THAT(complaints_about_mechanism(text), HasSubstr("more that are not shown"));
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  };
  const double few = seconds_for(8000);
  EXPECT_LT(seconds_for(32000), 10 * few);
}

TEST(DamagedFiles, MessagesQuoteNoMoreThanALine) {
  const std::string longest(300000, 'x');
  const std::string complaint = complaints_about_mechanism(
      with(two_drives, "joint: a, speed: 1 m/s", "joint: a, speed: " + longest));
  EXPECT_THAT(complaint, HasSubstr(std::string(77, 'x') + "...\""));
  EXPECT_LT(complaint.size(), 2000U);
  // Characters of several bytes stay whole.
  std::string ohms;
  for (int i = 0; i < 500; ++i) ohms += "\xCE\xA9";
  const std::string of_ohms =
      complaints_about_mechanism(with(two_drives, "stage: s", "stage: s, " + ohms + ": 1"));
  EXPECT_THAT(of_ohms, HasSubstr("\xCE\xA9...\""));
  EXPECT_LT(of_ohms.size(), 1000U);
}

// --------------------------------------------------------------------------------------- at random

/// Damages files as people and programs do: names lost, changed and doubled, lists where scalars
/// are due and the other way round, other units, extreme and empty values.
class Vandal {
 public:
  explicit Vandal(unsigned seed) : random_(seed) {}

  std::string damage(const std::string& text) {
    if (pick(8) == 0) return with_a_line_changed(text);
    YAML::Node root = YAML::Load(text);
    for (std::size_t strokes = 1 + pick(3); strokes > 0; --strokes) {
      std::vector<YAML::Node> containers;
      collect(root, containers);
      if (containers.empty()) break;
      YAML::Node container = containers[pick(containers.size())];
      container.IsMap() ? strike_map(container) : strike_list(container);
    }
    return YAML::Dump(root) + "\n";
  }

 private:
  std::size_t pick(std::size_t count) { return random_() % count; }

  static void collect(const YAML::Node& node, std::vector<YAML::Node>& containers, int depth = 0) {
    if (depth > 12 || !(node.IsMap() || node.IsSequence()) || node.size() == 0) return;
    containers.push_back(node);
    for (const auto& item : node) collect(node.IsMap() ? item.second : item, containers, depth + 1);
  }

  YAML::Node odd_value(const YAML::Node& old) {
    static const std::vector<std::string> odd = {
        "\"\"",    "~",         "0",         "-1",      "1e308",    "-1e308",         "1e-308",
        "nan",     "-inf",      "0 m",       "-3 m",    "1e300 m",  "1e-300 m",       "0 t",
        "1e200 t", "1e9 deg",   "1e8 rad/s", "0 s",     "-1 s",     "1e300 s",        "true",
        "world",   "load",      "C1.left",   "= 1 / 0", "= boom",   "= sqrt(-1)",     "2147483648",
        "[]",      "{}",        "[[]]",      "[0 m]",   "{a: 1}",   "[0, 0, 0]",      "[1, 0, 0]",
        "[~, ~]",  "{\"\": 1}", "100 %",     "-5 %",    "1 parsec", "[1 m, 1 m, 1 m]"};
    switch (pick(6)) {
      case 0:
        return YAML::Clone(YAML::Load("[" + odd[pick(odd.size())] + "]"));
      case 1: {
        YAML::Node list;
        list.push_back(YAML::Clone(old));
        return list;
      }
      case 2:
        if (old.IsSequence() && old.size() > 0) return YAML::Clone(old[pick(old.size())]);
        return YAML::Load(odd[pick(odd.size())]);
      case 3:
        if (old.IsScalar()) {
          static const std::vector<std::string> units = {" m",  " t",   " s", " deg",
                                                         " kN", "e300", ""};
          const std::string number = old.Scalar().substr(0, old.Scalar().find(' '));
          return YAML::Node(number + units[pick(units.size())]);
        }
        return YAML::Node(std::string(200, 'x'));
      default:
        return YAML::Load(odd[pick(odd.size())]);
    }
  }

  void strike_map(YAML::Node map) {
    std::vector<std::string> keys;
    for (const auto& entry : map) keys.push_back(entry.first.Scalar());
    const std::string key = keys[pick(keys.size())];
    const YAML::Node value = map[key];
    switch (pick(5)) {
      case 0:
        map.remove(key);
        break;
      case 1: {
        const YAML::Node kept = YAML::Clone(value);
        static const std::vector<std::string> names = {"",  "world", "load", "x y",
                                                       "=", "L1",    "a.b"};
        map.remove(key);
        map[pick(2) == 0 ? keys[pick(keys.size())] : names[pick(names.size())]] = kept;
        break;
      }
      case 2:
        map[keys[pick(keys.size())]] = YAML::Clone(value);
        break;
      default:
        map[key] = odd_value(value);
    }
  }

  void strike_list(YAML::Node list) {
    const std::size_t place = pick(list.size());
    switch (pick(4)) {
      case 0:
        list.remove(place);
        break;
      case 1:
        list.push_back(YAML::Clone(list[place]));
        break;
      default:
        list[place] = odd_value(list[place]);
    }
  }

  std::string with_a_line_changed(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    const std::size_t line = pick(lines.size());
    switch (pick(3)) {
      case 0:
        lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(line), lines[line]);
        break;
      case 1:
        lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(line));
        break;
      default:
        lines[line].resize(lines[line].size() / 2);
    }
    std::string changed;
    for (const std::string& one : lines) changed += one + "\n";
    return changed;
  }

  std::mt19937 random_;
};

std::string text_of(const fs::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// A file is sound or has errors, and whoever reads it comes back; the text stands in the message
/// when that is not so.
template <class Read>
void expect_errors_or_success(const std::string& text, const Read& read) {
  Diagnostics diagnostics;
  try {
    const bool is_sound = read(diagnostics);
    EXPECT_EQ(is_sound, !diagnostics.has_errors()) << text;
  } catch (const std::exception& error) {
    ADD_FAILURE() << error.what() << "\n" << text;
  }
}

constexpr unsigned first_seed = 20260;

/// How many files are damaged in each test; more by hand, in the variable BLOCKLIFT_DAMAGED_FILES.
unsigned last_seed() {
  constexpr unsigned usual = 120;
  const char* asked = std::getenv("BLOCKLIFT_DAMAGED_FILES");
  return first_seed + (asked ? static_cast<unsigned>(std::atoi(asked)) : usual);
}

TEST(DamagedFiles, AnyMechanismIsReadOrRefused) {
  std::vector<std::string> originals = {two_drives};
  for (const char* group : {"mechanisms", "benchmarks"}) {
    for (const auto& folder : fs::directory_iterator(fs::path(BLOCKLIFT_MODELS) / group)) {
      if (folder.path().filename() == "floating-crane") continue;  // its hull takes a second
      if (fs::exists(folder.path() / "mechanism.yaml"))
        originals.push_back(text_of(folder.path() / "mechanism.yaml"));
    }
  }
  ASSERT_GT(originals.size(), 10U);
  for (unsigned seed = first_seed; seed < last_seed(); ++seed) {
    const std::string text = Vandal(seed).damage(originals[seed % originals.size()]);
    const TemporaryFolder folder;
    folder.write("mechanism.yaml", text);
    expect_errors_or_success(text, [](Diagnostics& diagnostics) {
      ModelLibrary library({});
      return read_mechanism("mechanism.yaml", library, diagnostics).has_value();
    });
  }
}

TEST(DamagedFiles, AnyLiftIsReadOrRefused) {
  for (unsigned seed = first_seed; seed < last_seed(); ++seed) {
    SampleLift lift;
    std::string* const files[] = {&lift.lift_case, &lift.lift_case, &lift.crane, &lift.block,
                                  &lift.rope};
    std::string& damaged = *files[seed % 5];
    damaged = Vandal(seed).damage(damaged);
    const TemporaryFolder folder;
    lift.write(folder);
    expect_errors_or_success(damaged, [](Diagnostics& diagnostics) {
      ModelLibrary library({});
      return read_lift_case("case.yaml", library, diagnostics).has_value();
    });
  }
}

TEST(DamagedFiles, AnyShippedCaseIsReadOrRefused) {
  ModelLibrary library({BLOCKLIFT_MODELS});
  const std::string original = text_of(fs::path(BLOCKLIFT_CASES) / "goliath-turnover/case.yaml");
  for (unsigned seed = first_seed; seed < last_seed(); ++seed) {
    const std::string text = Vandal(seed).damage(original);
    const TemporaryFolder folder;
    folder.write("case.yaml", text);
    expect_errors_or_success(text, [&](Diagnostics& diagnostics) {
      return read_lift_case("case.yaml", library, diagnostics).has_value();
    });
  }
}

}  // namespace
}  // namespace blocklift::pipeline
