#pragma once

#include <optional>

#include "structure/mesh/fields/fields.h"
#include "structure/stress/squares.h"

namespace blocklift::structure {

/// The square of a given side whose centre lies nearest to a place: in the middle about it, or
/// moved towards the inside of its field, in steps of a quarter of its side, where it would reach
/// beyond.
/// At a joint it lies on the first of the plates that are equally near. Its site is not marked.
/// @param place m; on plating or up to two sides away from some.
/// @param size of a side, m
/// @returns nothing where no square of this size fits within two sides of the place.
std::optional<Square> square_about(const Mesh& mesh, const PlateFields& fields,
                                   const FieldWalker& walker, const Vector3& place, double size);

}  // namespace blocklift::structure
