#pragma once

#include <memory>
#include <string>

#include "pipeline/files/lift_case/lift_case.h"
#include "structure/response/elastic_model.h"
#include "structure/response/unit_responses.h"
#include "structure/rigid_body.h"

namespace blocklift::pipeline {

/// Complains, at the deck's place, of elements of degree 1 where something is fastened to curved
/// shells off the straight ones (fastened_off_straight_shells).
/// @returns whether it had nothing to complain of.
bool check_element_degree(const BlockModel& block, const StructureSettings& settings,
                          Diagnostics& diagnostics);

/// Mesh, mass and load vectors of a block model.
///
/// Some elements of degree 1 are refused: see check_element_degree.
/// What the mesh generator and the spreading of outfitting refuse (parts that run into one another,
/// that nothing joins or that carry a mass they cannot have; elements that no memory holds), and a
/// stated mass below that of the plates, is wrong in the input: it is said as a complaint about the
/// block's file.
/// @param name of the block, for messages.
/// @returns null after a complaint.
std::unique_ptr<structure::ElasticModel> make_block_model(const BlockModel& block,
                                                          const std::string& name,
                                                          const StructureSettings& settings,
                                                          Diagnostics& diagnostics);

/// Complains, at its place, about a stated mass that is less than that of the plates alone: nothing
/// would be left for outfitting, and steel of its own density would not be in the lift.
///
/// Up to a twentieth less is taken: shells overlap at joints and follow middle planes.
/// @param mass of the block with what it states.
/// @returns whether it had nothing to complain of.
bool check_stated_mass(const BlockModel& block, const structure::MassProperties& mass,
                       Diagnostics& diagnostics);

/// Stiffness of the block, its factor, and responses to unit loads. The model must outlive them.
///
/// A mechanism is wrong in the input, too: it is said by the block's file, with what the supports
/// of a deck, which a lift leaves out, had to do with it.
/// @throws InputError if a part of the block can move and nothing resists.
/// @throws structure::NotEnoughMemory
std::unique_ptr<structure::UnitResponses> make_unit_responses(const structure::ElasticModel& model,
                                                              const BlockModel& block);

/// The complaints of make_block_model at little cost: by the block in coarse elements of degree 1.
/// @returns that model, whose mass is the block's; null after a complaint.
std::unique_ptr<structure::ElasticModel> check_block_model(const BlockModel& block,
                                                           const std::string& name,
                                                           Diagnostics& diagnostics);

}  // namespace blocklift::pipeline
