#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "structure/mesh/files/deck/deck.h"
#include "structure/response/elastic_model.h"

namespace blocklift::structure {

/// Loads on a free structure that are in balance, as UnitResponses::load_vector gives them.
struct TitledLoads {
  std::string title;
  Eigen::VectorXd loads;  ///< six rows a node, N and N m
};

enum class DeckElements { as_they_are, quadratic };

/// The structure under balanced loads as a deck for another solver.
///
/// - Mesh: the model's own with its numbers. As quadratic elements its shells have eight nodes,
///   triangles six, and beams on their edges are divided in two. Divisions of cells are not in it.
///   Yield stresses are left out: the comparison is a linear one.
/// - Loads: forces at nodes, nothing else; weight and inertia are among them, so that the solver's
///   own mass and gravity play no part. Every node of the model passes its force and moment on to
///   the nodes of the deck's shell or beam that it lies on, by that element's shape functions
///   (equal virtual work), and as a moment what a curved shell's other shape would lose: resultant
///   and moment stay as they are to rounding.
/// - Moments that are less than a hundredth of the largest nodal force times the edge of a shell
///   there (rotary inertia of plates, for one) become forces at that shell's corners.
/// - Supports: six components of displacement at three corners, which carry nothing.
///
/// @param elements of the deck: those of the mesh as they are, or quadratic ones, for a mesh whose
///   elements are the model's own affair and of degree 2 or more.
/// @throws ModelError if there is no shell to hold the structure at.
Deck load_case_deck(const ElasticModel& model, const std::vector<TitledLoads>& cases,
                    const UnitSystem& units, DeckElements elements);

/// Displacement of the model's own vertices against the supports of such a deck, to set beside what
/// its solver finds, m; a column a vertex, not a number where nothing uses it.
/// @param motion of the model against any statically determinate support, six rows a node.
Eigen::Matrix3Xd displacement_against(const std::vector<Support>& supports,
                                      const ElasticModel& model, const Eigen::VectorXd& motion);

/// Force and moment about the origin of a load set's forces and moments at vertices.
Wrench resultant_of_points(const Mesh& mesh, const LoadSet& loads);

}  // namespace blocklift::structure
