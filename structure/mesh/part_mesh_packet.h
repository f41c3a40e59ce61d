#pragma once

#include "structure/mesh/part_mesh.h"
#include "structure/packet.h"

namespace blocklift::structure {

/// Puts a mesh into a packet for another process, and takes it out there.
void put_part_mesh(const PartMesh& mesh, Packet& packet);
PartMesh take_part_mesh(Packet& packet);

}  // namespace blocklift::structure
