#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/declaration/geometry_format.h"
#include "pipeline/files/standard/standard_rules.h"

namespace blocklift::pipeline {

class ModelLibrary;

namespace given {

/// Shackle at a lug.
struct Shackle {
  Located<std::string> name;  ///< of the lug
  double working_load = 0;    ///< N
  double breaking_load = 0;   ///< N
};

/// Master link between a hook and its slings.
struct MasterLink {
  Located<std::string> name;  ///< of the hook: "C1.main"
  double working_load = 0;    ///< N, of all legs together
  double breaking_load = 0;   ///< N
  double mass = 0;            ///< kg
};

/// Sheave over which a sling is led.
struct Sheave {
  Located<std::string> name;  ///< of the rope
  double working_load = 0;    ///< N, on its pin
  double breaking_load = 0;   ///< N
  double tread = 0;           ///< diameter at the bottom of the groove, m
};

/// The standard by which a case is checked, with what the case chooses of it. SI units.
struct Standard {
  std::vector<Located<std::string>> rule_names;
  StandardRules rules;  ///< after the look-up, of all names together
  std::optional<Located<std::string>> weight_class;
  std::optional<Located<std::string>> setting;  ///< of the dynamic amplification
  std::optional<Located<std::string>> hoisting_class;
  std::optional<Located<std::string>> tilt;
  std::optional<Located<std::string>> skew;
  std::optional<Located<std::string>> wear;
  std::optional<Vector3> centre_box;       ///< how far the centre of mass may lie off, m
  std::optional<double> length_tolerance;  ///< of slings, over their length
  std::optional<double> bend_diameter;     ///< of what slings are bent round, m
  std::vector<Shackle> shackles;
  std::vector<MasterLink> master_links;
  std::vector<Sheave> sheaves;
  Mark place;

  /// What a rope is bent round, m; none: nothing.
  std::optional<double> bend_of(const std::string& rope) const;
};

}  // namespace given

Format<given::Standard> standard_in_case_format();

/// Reads the files that the case names; the sections of the first count.
void load_rules(given::Standard& standard, const std::filesystem::path& beside,
                ModelLibrary& library, Diagnostics& diagnostics);

}  // namespace blocklift::pipeline
