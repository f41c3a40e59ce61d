#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "structure/mesh/files/deck/deck.h"
#include "structure/response/elastic_model.h"
#include "structure/rigid_body.h"
#include "structure/stress/stress.h"

namespace blocklift::structure {

/// What a deck's support exerts at one of its vertices.
struct SupportReaction {
  int vertex = 0;
  Vector3 force = Vector3::Zero();   ///< N
  Vector3 moment = Vector3::Zero();  ///< N m
};

/// One of a deck's own load cases, solved with its own supports.
struct DeckCaseSolution {
  int load_case = 0;       ///< place in Deck::load_cases
  Eigen::VectorXd motion;  ///< six rows a node, m and rad
  Wrench applied;          ///< of all loads, about the origin
  Wrench supported;        ///< of all reactions and springs to the ground, about the origin
  std::vector<SupportReaction> reactions;
  /// |loads + reactions| over the sum of the magnitudes of both; 0 without any. Forces are held
  /// against moments, and moments against forces, with the mesh's size as the arm, where these are
  /// more.
  double force_residual = 0, moment_residual = 0;
  double strain_energy = 0;    ///< J; of what is hot beyond its free expansion
  double estimated_error = 0;  ///< of the stress field, in the energy norm (BlockError)
  LoadCaseResult stress;       ///< its balance is not set: see the residuals
};

/// Load case of a deck that cannot be solved by itself: nothing holds it, or else nothing acts.
struct SkippedCase {
  int load_case = 0;
  bool is_held = false;
};

/// Wall-clock times of a deck's solution, s.
struct DeckTimes {
  double assembly = 0;  ///< of stiffness and loads
  /// Supports put into the equations, their analysis, and dealing out to several processes with it.
  double factorisation = 0;
  double solve = 0;     ///< motions and reactions of all cases
  double recovery = 0;  ///< stresses and the estimates of their error
};

struct DeckSolution {
  std::vector<DeckCaseSolution> cases;  ///< in the deck's order
  std::vector<SkippedCase> skipped;
  std::vector<int> idle_supports;  ///< vertices that are held and that nothing is joined to
  DeckTimes times;
};

/// Solves the load cases of a deck as it states them: its supports hold, its loads act. Cases with
/// the same supports share a factorisation.
/// @param model of the deck's mesh.
/// @throws ModelError if the supports of a case leave a motion that nothing resists, or a load acts
///   where no element bears it, naming case and place; if supports contradict each other; or memory
///   does not suffice.
DeckSolution solve_deck(const ElasticModel& model, const Deck& deck, int threads = 0);

/// Degree of the elements that a deck itself has: 1, or 2 where its shells are quadratic. Forces at
/// its nodes stand for loads along edges and over areas with these.
int own_degree(const Deck& deck);

/// "case 3 (lifting)": how a load case is called.
std::string name_of(const DeckLoadCase& load_case);

}  // namespace blocklift::structure
