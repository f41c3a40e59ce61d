#include "structure/mesh/files/surfaces/deck_packet.h"

namespace blocklift::structure {

namespace {

// One walk for both ways: `Way` puts or takes a value.
template <class Way, class List, class Each>
void walk_list(const Way& way, List& list, const Each& each) {
  std::size_t count = list.size();
  way(count);
  list.resize(count);
  for (auto& item : list) each(item);
}

template <class Way>
void walk_cells(const Way& way, Mesh& mesh) {
  walk_list(way, mesh.vertices, [&](Vector3& vertex) {
    for (double& coordinate : vertex) way(coordinate);
  });
  way(mesh.vertex_labels);
  walk_list(way, mesh.shells, [&](Shell& shell) {
    way(shell.vertices);
    way(shell.section);
    way(shell.region);
    way(shell.curvature);
    way(shell.label);
  });
  walk_list(way, mesh.curved_shells, [&](Eigen::Matrix3Xd& points) { way(points); });
  walk_list(way, mesh.beams, [&](Beam& beam) {
    way(beam.vertices);
    way(beam.section);
    way(beam.region);
    way(beam.label);
  });
  walk_list(way, mesh.surface_points, [&](SurfacePoint& point) {
    way(point.vertex);
    way(point.shell);
    for (double& coordinate : point.xi) way(coordinate);
  });
}

template <class Way>
void walk(const Way& way, Deck& deck) {
  walk_cells(way, deck.mesh);
  walk_list(way, deck.mesh.regions, [&](Region& region) {
    way(region.name);
    way(region.group);
  });
  walk_list(way, deck.mesh.groups, [&](Group& group) {
    way(group.name);
    way(group.material);
  });
  walk_list(way, deck.sets, [&](NamedSet& set) {
    way(set.name);
    way(set.vertices);
    way(set.shells);
    way(set.beams);
  });
  walk_list(way, deck.ledger, [&](LedgerEntry& entry) {
    way(entry.name);
    way(entry.read);
    way(entry.used);
    way(entry.left_out);
  });
  walk_list(way, deck.remarks, [&](DeckRemark& remark) {
    way(remark.place);
    way(remark.text);
    way(remark.count);
  });
  walk_list(way, deck.groups_without_thickness, [&](std::string& name) { way(name); });
  walk_list(way, deck.groups_without_section, [&](std::string& name) { way(name); });
}

}  // namespace

void put_surfaces(const Deck& deck, Packet& packet) {
  Deck copy = deck;
  walk([&](const auto& value) { packet.put(value); }, copy);
}

Deck take_surfaces(Packet& packet) {
  Deck deck;
  walk([&](auto& value) { packet.take(value); }, deck);
  return deck;
}

}  // namespace blocklift::structure
