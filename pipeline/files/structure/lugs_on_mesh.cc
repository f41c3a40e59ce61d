#include "pipeline/files/structure/lugs_on_mesh.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "pipeline/files/structure/block_model.h"
#include "structure/error.h"
#include "structure/letter_case.h"
#include "structure/mesh/fields/plate_finder.h"
#include "structure/mesh/lugs/lug_on_mesh.h"

namespace blocklift::pipeline {
namespace {

using structure::Deck;
using structure::Mesh;

class LugsOnMesh {
 public:
  LugsOnMesh(BlockModel& block, Deck& deck, Diagnostics& diagnostics)
      : block_(block), deck_(deck), diagnostics_(diagnostics) {}

  void put(LugModel& lug) {
    structure::LugOnMesh placed;
    placed.name = lug.name.value;
    placed.radius = lug.radius.value_or(0);
    if (lug.pin.value.allFinite()) placed.pin = lug.pin.value;
    if (!placed.pin && !lug.node && !lug.set) return;  // complained about elsewhere
    if (!find_carriers(lug, placed)) return;
    // What lies below its base carries a solid, however far the pin is from all nodes.
    if (lug.is_solid.value) placed.farthest = std::numeric_limits<double>::infinity();
    try {
      structure::add_lug(deck_.mesh, placed);
      lug.pin.value = deck_.mesh.lifting_points.back().p_BPin;
      check_base(lug, deck_.mesh);
    } catch (const structure::ModelError& wrong) {
      diagnostics_.error(lug.name.mark, wrong.what());
    }
  }

 private:
  /// @returns false after a complaint.
  bool find_carriers(const LugModel& lug, structure::LugOnMesh& placed) {
    if (lug.node) {
      const auto& labels = deck_.mesh.vertex_labels;
      const auto found = std::find(labels.begin(), labels.end(), lug.node->value);
      if (found == labels.end() ||
          std::find(found + 1, labels.end(), lug.node->value) != labels.end()) {
        diagnostics_.error(
            lug.node->mark,
            fmt::format("lug {} is at node {}, of which the deck has {}", lug.name.value,
                        lug.node->value, found == labels.end() ? "none" : "several"),
            {"give its pin, the place in the block"});
        return false;
      }
      placed.vertex = static_cast<int>(found - labels.begin());
    }
    return !lug.set || find_set(lug, placed);
  }

  bool find_set(const LugModel& lug, structure::LugOnMesh& placed) {
    const std::string wanted = structure::lower(lug.set->value);
    std::vector<std::string> names;
    for (const structure::NamedSet& set : deck_.sets) {
      names.push_back(set.name);
      if (structure::lower(set.name) != wanted) continue;
      placed.shells.insert(placed.shells.end(), set.shells.begin(), set.shells.end());
      placed.beams.insert(placed.beams.end(), set.beams.begin(), set.beams.end());
      placed.vertices.insert(placed.vertices.end(), set.vertices.begin(), set.vertices.end());
    }
    const Mesh& mesh = deck_.mesh;
    for (std::size_t g = 0; g < mesh.groups.size(); ++g) {
      names.push_back(mesh.groups[g].name);
      if (structure::lower(mesh.groups[g].name) != wanted) continue;
      const auto belongs = [&](int region) {
        return mesh.regions[region].group == static_cast<int>(g);
      };
      for (std::size_t s = 0; s < mesh.shells.size(); ++s)
        if (belongs(mesh.shells[s].region)) placed.shells.push_back(static_cast<int>(s));
      for (std::size_t b = 0; b < mesh.beams.size(); ++b)
        if (belongs(mesh.beams[b].region)) placed.beams.push_back(static_cast<int>(b));
    }
    if (!placed.shells.empty() || !placed.beams.empty() || !placed.vertices.empty()) return true;
    diagnostics_.error(lug.set->mark,
                       fmt::format("lug {} names set \"{}\", which the deck does not have",
                                   lug.name.value, lug.set->value),
                       {names_hint("its sets and groups are", names, lug.set->value)});
    return false;
  }

  /// A padeye's base lies within plates: what drives its fine mesh.
  void check_base(const LugModel& lug, const Mesh& mesh) {
    const PadeyeDesign* design = block_.find_padeye(lug);
    std::vector<std::string> faults;
    const auto placed = design ? place_padeye(*design, block_, lug, faults) : std::nullopt;
    if (!placed || !faults.empty()) return;  // complained about elsewhere
    const structure::PlateFinder plates(mesh);
    const structure::PadeyeGeometry& g = placed->geometry;
    constexpr int steps = 16;
    // A solid stands by its middle plane on whatever is below.
    const double half = lug.is_solid.value ? 0 : g.thickness / 2;
    for (int i = 0; i <= steps; ++i)
      for (const double z : {-half, half}) {
        const double x = -g.base_left + (g.base_left + g.base_right) * i / steps;
        const Vector3 place = placed->p_BP + placed->R_BP * Vector3(x, -g.height, z);
        if (plates.find(place)) continue;
        std::vector<std::string> hints{
            "it lies on a deck or along a plate's edge: look at pin, axis, up, height and base"};
        if (plates.find(placed->p_BP + placed->R_BP * Vector3(0, -g.height, 0)))
          hints.emplace_back(
              "below the pin it stands on a plate: the base is straight, and a curved plate bears "
              "one along its generators, or one that is so short that it stays in the plate");
        diagnostics_.error(
            lug.padeye->mark,
            fmt::format("the base of lug {}'s padeye is at ({:.6g}, {:.6g}, {:.6g}) m, where the "
                        "block has no plate",
                        lug.name.value, place.x(), place.y(), place.z()),
            hints);
        return;
      }
  }

  const BlockModel& block_;
  Deck& deck_;
  Diagnostics& diagnostics_;
};

}  // namespace

void put_lugs(BlockModel& block, structure::Deck& deck, Diagnostics& diagnostics) {
  LugsOnMesh mesh(block, deck, diagnostics);
  for (LugModel& lug : block.lugs) mesh.put(lug);
}

}  // namespace blocklift::pipeline
