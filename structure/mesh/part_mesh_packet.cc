#include "structure/mesh/part_mesh_packet.h"

namespace blocklift::structure {

namespace {

// What is sent of each, in one order: `pass` puts it into a packet or takes it out.
template <typename Kind, typename Pass>
void pass_kind(Kind& kind, const Pass& pass) {
  pass(kind.name);
  pass(kind.dimension);
  pass(kind.order);
  pass(kind.nodes);
  pass(kind.corners);
  pass(kind.local);
  pass(kind.rule);
  pass(kind.weights);
  pass(kind.values);
  pass(kind.gradients);
  pass(kind.gradients_at_nodes);
  pass(kind.corner_order);
  pass(kind.edge_order);
}

template <typename Mesh, typename Pass>
void pass_mesh(Mesh& mesh, const Pass& pass) {
  for (auto& kind : mesh.kinds) pass_kind(kind, pass);
  for (auto& group : mesh.groups) {
    pass(group.name);
    pass(group.dimension);
    pass(group.elements);
  }
  pass(mesh.nodes);
  pass(mesh.elements);
  pass(mesh.element_nodes);
  pass(mesh.solids);
  pass(mesh.meshed_here);
}

}  // namespace

void put_part_mesh(const PartMesh& mesh, Packet& packet) {
  packet.put(mesh.kinds.size());
  packet.put(mesh.groups.size());
  pass_mesh(mesh, [&](const auto& value) { packet.put(value); });
}

PartMesh take_part_mesh(Packet& packet) {
  PartMesh mesh;
  std::size_t kinds = 0, groups = 0;
  packet.take(kinds);
  packet.take(groups);
  mesh.kinds.resize(kinds);
  mesh.groups.resize(groups);
  pass_mesh(mesh, [&](auto& value) { packet.take(value); });
  return mesh;
}

}  // namespace blocklift::structure
