#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/declaration/format.h"
#include "structure/square_site.h"

namespace blocklift::pipeline {

/// A figure of a standard with the clause that gives it.
struct ClauseFactor {
  double value = 1;
  std::string clause;
};

/// A figure by the name that a case chooses it by: weight class "B", material "polyester".
struct NamedFactor : ClauseFactor {
  Located<std::string> name;
};

/// Dynamic amplification of hook loads up to a weight: factor + root sqrt(100 t / static hook
/// load).
struct AmplificationRow {
  std::optional<double> up_to;  ///< static hook load, N; none: whatever is heavier
  double factor = 1;
  double root = 0;
  std::string clause;

  double at(double static_hook_load) const;
};

/// Rows of one setting ("onshore"), the lightest first.
struct AmplificationTable {
  Located<std::string> name;
  std::vector<AmplificationRow> rows;

  /// The row of a static hook load, N: the first that reaches it.
  const AmplificationRow& row_of(double static_hook_load) const;
};

/// Hoisting factor phi_2 = least + per_speed v_h, v_h the steady hoisting speed (m/s).
struct HoistingClass {
  Located<std::string> name;
  double least = 1;
  double per_speed = 0;  ///< s/m
  std::string clause;

  double at(double speed) const { return least + per_speed * speed; }
};

/// What two hooks may differ by, for one arrangement of their cranes.
struct TiltRule {
  Located<std::string> name;
  double angle = 0;              ///< rad
  std::optional<double> height;  ///< between the hooks, m: the more onerous of the two holds
  std::string clause;
};

/// Safety factor of slings by partial factors, the greater of
///   load consequence reduction wear material twist  and  floor reduction wear twist,
/// reduction = max(termination, bending), bending = 1 / (1 - bending / sqrt(D/d)), and for fibre 1.
struct SlingRules {
  ClauseFactor load, consequence, floor;
  ClauseFactor bending;  ///< 0.5 of the formula
  /// What a share E/T of the environment takes off the load factor: load - share E/T, though no
  /// less than 1 + (load - 1) E/T. None: the standard allows no such reduction.
  std::optional<ClauseFactor> environment;
  std::vector<NamedFactor> material, wear, termination;
};

/// Shackles, and what rules say alike of other accessories: static load <= working load; dynamic
/// load
/// <= working load x DAF, <= breaking load / breaking.
struct ShackleRules {
  ClauseFactor working;  ///< on the static load
  ClauseFactor breaking;
};

/// What shackles bear of their working load where they are pulled out of the plane of their bow.
struct SideLoadRow {
  double up_to = 0;   ///< angle out of the plane, rad
  double factor = 1;  ///< on working load and breaking load
  std::string clause;
};

/// What a crane may carry of its capacity where so many lift together.
struct TandemRow {
  int cranes = 1;
  double factor = 1;
  std::string clause;
};

/// Consequence factors on the structure.
struct ConsequenceRules {
  ClauseFactor lift_point;  ///< and its attachment
  std::optional<ClauseFactor> members, others;
};

/// What class rules allow in a small square by finite elements of its size, over what they allow in
/// a field of plating.
struct FineMeshRules {
  double square = 0.05;      ///< side that the factors are for, m
  ClauseFactor plate;        ///< in the plate's own material, corners of openings
  ClauseFactor beside_weld;  ///< with a side on a weld: roots of lugs, toes

  /// None in a field.
  const ClauseFactor* of(structure::SquareSite site) const;
};

/// Rules of one or several standards: each section is there or not. Clauses are complete ("0027/ND
/// 5.4.7") once a file has been read.
struct StandardRules {
  std::string kind;
  std::string title;
  std::string name;     ///< as clauses are quoted: "0027/ND"
  std::string edition;  ///< "rev. 11.2 (2016)"
  std::string source;   ///< how far the figures can be trusted
  std::vector<NamedFactor> weight_classes;
  std::optional<ClauseFactor> centre_of_mass;  ///< where no box bounds the centre
  std::vector<AmplificationTable> dynamic_amplification;
  std::vector<HoistingClass> hoisting_classes;
  std::vector<TiltRule> tilt;
  std::optional<ClauseFactor> yaw;
  std::vector<NamedFactor> skew;
  std::optional<ClauseFactor> length_tolerance;  ///< of slings, over their length, either way
  std::optional<SlingRules> sling;
  std::optional<ShackleRules> shackle;
  std::optional<ShackleRules> accessory;       ///< master links and sheaves
  std::vector<SideLoadRow> shackle_side_load;  ///< the smallest angle first
  std::optional<ConsequenceRules> consequence;
  std::optional<FineMeshRules> fine_mesh;
  std::optional<ClauseFactor> lateral;  ///< along a lug's pin, share of the rope's force
  /// Families of formulae of lugs, and what stands before the load (or over the strength).
  std::vector<NamedFactor> lug;
  std::vector<TandemRow> tandem;
  Mark place;

  /// Takes from other rules the sections that these lack; formulae of lugs of both.
  void add(const StandardRules& others);
};

/// Families of formulae of lugs that a standard may name.
const std::vector<std::string>& lug_formula_families();

/// The format of a standard's file. A figure without a clause is refused.
Format<StandardRules> standard_rules_format();

}  // namespace blocklift::pipeline
