#include "structure/parallel/part_share.h"

#include <metis.h>

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "structure/error.h"
#include "structure/index.h"
#include "structure/mesh/part_mesh_packet.h"

namespace blocklift::structure {

namespace {

std::vector<int> deal_out(const PartMesh& mesh, int processes) {
  const auto count = static_cast<int>(mesh.solids.size());
  if (processes > count)
    throw ModelError(fmt::format("{} processes are too many for {} solid elements; start fewer",
                                 processes, count));
  if (processes == 1) return std::vector<int>(at(count), 0);
  std::vector<idx_t> start = {0}, corners, weights;
  for (const int solid : mesh.solids) {
    const ElementKind& kind = mesh.kind(solid);
    for (int i = 0; i < kind.corners; ++i) corners.push_back(mesh.node(solid, i));
    start.push_back(static_cast<idx_t>(corners.size()));
    weights.push_back(kind.nodes);
  }
  idx_t solids = count, nodes = static_cast<idx_t>(mesh.nodes.cols()), parts = processes;
  idx_t corners_of_a_face = 3, cut = 0;
  std::vector<idx_t> of_solid(at(count)), of_node(at(static_cast<int>(mesh.nodes.cols())));
  if (METIS_PartMeshDual(&solids, &nodes, start.data(), corners.data(), weights.data(), nullptr,
                         &corners_of_a_face, &parts, nullptr, nullptr, &cut, of_solid.data(),
                         of_node.data()) != METIS_OK)
    throw ModelError("the mesh could not be dealt out to the processes");
  return {of_solid.begin(), of_solid.end()};
}

// What is sent of each, in one order: `pass` puts it into a packet or takes it out.
template <typename OneMaterial, typename Pass>
void pass_material(OneMaterial& material, const Pass& pass) {
  pass(material.name);
  pass(material.youngs_modulus);
  pass(material.poisson_ratio);
  pass(material.density);
  pass(material.yield_stress);
}

template <typename Share, typename Pass>
void pass_share(Share& share, const Pass& pass) {
  for (auto& material : share.model.materials) pass_material(material, pass);
  pass(share.model.material_of_solid);
  pass(share.own_solids);
  pass(share.row_of_node);
  pass(share.node_in_whole);
  pass(share.first_row);
  pass(share.end_row);
  pass(share.fixed);
  pass(share.load);
}

// Adds solids to a share, with the nodes that it does not have yet.
class ShareMaker {
 public:
  ShareMaker(const PartModel& whole, const std::vector<int>& row_of_node, PartShare& share)
      : whole_(whole),
        row_of_node_(row_of_node),
        share_(share),
        place_(at(static_cast<int>(whole.mesh.nodes.cols())), -1) {
    share_.model.mesh.kinds = whole.mesh.kinds;
    share_.model.materials = whole.materials;
  }

  bool has(int node) const { return place_[node] >= 0; }

  void add(int solid) {
    const int element = whole_.mesh.solids[solid];
    PartMesh& mesh = share_.model.mesh;
    mesh.solids.push_back(static_cast<int>(mesh.elements.size()));
    mesh.elements.push_back({whole_.mesh.elements[element].kind,
                             static_cast<int>(mesh.element_nodes.size()),
                             whole_.mesh.elements[element].tag});
    share_.model.material_of_solid.push_back(whole_.material_of_solid[solid]);
    for (int i = 0; i < whole_.mesh.kind(element).nodes; ++i)
      mesh.element_nodes.push_back(place(whole_.mesh.node(element, i)));
  }

  void take_places() {
    Eigen::Matrix3Xd& nodes = share_.model.mesh.nodes;
    nodes.resize(3, share_.node_in_whole.size());
    for (Eigen::Index i = 0; i < nodes.cols(); ++i)
      nodes.col(i) = whole_.mesh.nodes.col(share_.node_in_whole[i]);
  }

 private:
  int place(int node) {
    int& known = place_[node];
    if (known < 0) {
      known = static_cast<int>(share_.node_in_whole.size());
      share_.node_in_whole.push_back(node);
      share_.row_of_node.push_back(row_of_node_[node]);
    }
    return known;
  }

  const PartModel& whole_;
  const std::vector<int>& row_of_node_;
  PartShare& share_;
  std::vector<int> place_;
};

}  // namespace

void PartShare::put_into(Packet& packet) const {
  put_part_mesh(model.mesh, packet);
  packet.put(model.materials.size());
  pass_share(*this, [&](const auto& value) { packet.put(value); });
}

PartShare PartShare::from(Packet packet) {
  PartShare share;
  share.model.mesh = take_part_mesh(packet);
  std::size_t materials = 0;
  packet.take(materials);
  share.model.materials.resize(materials);
  pass_share(share, [&](auto& value) { packet.take(value); });
  return share;
}

PartDistribution::PartDistribution(const PartModel& model, int processes)
    : model_(model), process_of_solid_(deal_out(model.mesh, processes)) {
  const auto nodes = static_cast<int>(model.mesh.nodes.cols());
  std::vector<int> owner(at(nodes), processes);  // none
  for (std::size_t solid = 0; solid < model.mesh.solids.size(); ++solid) {
    const int element = model.mesh.solids[solid];
    for (int i = 0; i < model.mesh.kind(element).nodes; ++i) {
      int& of_node = owner[model.mesh.node(element, i)];
      of_node = std::min(of_node, process_of_solid_[solid]);
    }
  }
  row_of_node_.assign(nodes, -1);
  for (int process = 0; process < processes; ++process) {
    first_rows_.push_back(static_cast<int>(node_of_row_.size()));
    for (int node = 0; node < nodes; ++node) {
      if (owner[node] != process) continue;
      row_of_node_[node] = static_cast<int>(node_of_row_.size());
      node_of_row_.push_back(node);
    }
  }
  first_rows_.push_back(static_cast<int>(node_of_row_.size()));
}

PartShare PartDistribution::share(int process, const std::vector<FixedUnknown>& fixed,
                                  const Eigen::VectorXd& load) const {
  PartShare share;
  ShareMaker maker(model_, row_of_node_, share);
  const auto solids = static_cast<int>(model_.mesh.solids.size());
  for (int solid = 0; solid < solids; ++solid)
    if (process_of_solid_[solid] == process) maker.add(solid);
  share.own_solids = static_cast<int>(share.model.mesh.solids.size());
  std::vector<int> halo;
  for (int solid = 0; solid < solids; ++solid) {
    if (process_of_solid_[solid] == process) continue;
    const int element = model_.mesh.solids[solid];
    bool touches = false;
    for (int i = 0; i < model_.mesh.kind(element).nodes && !touches; ++i)
      touches = maker.has(model_.mesh.node(element, i));
    if (touches) halo.push_back(solid);
  }
  for (const int solid : halo) maker.add(solid);
  maker.take_places();
  share.first_row = first_rows_[process];
  share.end_row = first_rows_[at(process) + 1];
  for (const FixedUnknown& one : fixed) {
    const int row = row_of_node_[one.unknown / 3];
    if (row >= share.first_row && row < share.end_row)
      share.fixed.push_back({3 * row + one.unknown % 3, one.value});
  }
  share.load.resize(3 * (share.end_row - share.first_row));
  for (int row = share.first_row; row < share.end_row; ++row)
    share.load.segment<3>(3 * (row - share.first_row)) = load.segment<3>(3 * node_of_row_[row]);
  return share;
}

}  // namespace blocklift::structure
