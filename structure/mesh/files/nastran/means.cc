// RBE3: grids that follow the mean motion of others.

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include <fmt/format.h>

#include "structure/mesh/files/deck/equations.h"
#include "structure/mesh/files/deck/link_frames.h"
#include "structure/mesh/files/nastran/model.h"

namespace blocklift::structure {

namespace {

using Counts = std::array<bool, 6>;

/// An RBE3: its reference and bound components, and per grid what counts of it.
struct MeanCard {
  DistributingLink link;
  std::vector<Counts> counts;
};

/// Which vertices elements, or links and equations to others, keep from moving and from turning.
class Resistance {
 public:
  explicit Resistance(const NastranModel& model)
      : moves_(model.deck.mesh.vertices.size(), 0), turns_(moves_) {
    const Mesh& mesh = model.deck.mesh;
    for (const Solid& solid : mesh.solids)
      for (const int vertex : solid.vertices) moves_[vertex] = 1;
    for (const Shell& shell : mesh.shells)
      for (const int vertex : shell.vertices) add_both(vertex);
    for (const SurfacePoint& middle : model.middles) add_both(middle.vertex);
    for (const Beam& beam : mesh.beams)
      for (const int vertex : beam.vertices) {
        moves_[vertex] = 1;
        if (!beam.is_rod) turns_[vertex] = 1;
      }
    for (const Spring& spring : mesh.springs)
      for (const int vertex : spring.vertices)
        if (vertex >= 0) add_both(vertex);
    for (const RigidLink& link : mesh.rigid_links)
      for (const int vertex : vertices_of(link)) add_both(vertex);
    for (const MotionEquation& equation : mesh.equations)
      for (const MotionEquation::Term& term : equation.terms) add_both(term.vertex);
  }
  void add_both(int vertex) { moves_[vertex] = turns_[vertex] = 1; }
  bool moves(int vertex) const { return moves_[vertex] != 0; }
  bool turns(int vertex) const { return turns_[vertex] != 0; }

 private:
  std::vector<char> moves_, turns_;
};

class Means {
 public:
  explicit Means(NastranModel& model)
      : model_(model), resistance_(model), is_all_read_(is_all_read()) {}

  void read() {
    for (const NastranCard& card : model_.bulk.cards)
      if (card.name == "RBE3") note_reference(CardView(model_.bulk, card));
    model_.for_each({{"RBE3", [&](const CardView& card) { add(card, cut(card)); }}});
  }

 private:
  /// A reference may be a grid of another RBE3.
  void note_reference(const CardView& card) {
    const auto label = to_integer(card.text(2));
    const auto known = label ? model_.vertex_of.find(*label) : model_.vertex_of.end();
    if (known != model_.vertex_of.end()) resistance_.add_both(known->second);
  }

  // RBE3 EID blank REFGRID REFC WT1 C1 G1,1 G1,2 ... WT2 ... UM ... ALPHA ...
  MeanCard cut(const CardView& card) {
    MeanCard mean;
    DistributingLink& link = mean.link;
    link.label = model_.new_element(card);
    link.reference = model_.vertex(card, 2, "reference grid");
    link.bound = card.components(3, "bound components");
    link.axes = is_free_of_axes(link.bound) ? Eigen::Matrix3d::Identity()
                                            : model_.output_axes(link.reference);
    double weight = 0;
    Counts counts{};
    bool is_after_um = false;
    for (std::size_t i = 4; i < card.size(); ++i) {
      if (!card.has(i)) continue;
      if (card.is(i, "ALPHA")) {
        model_.log.leave_out("RBE3", "ALPHA (thermal expansion)");
        break;
      }
      // UM says which freedoms the solver eliminates; the motion is the same for any of them.
      is_after_um = is_after_um || card.is(i, "UM");
      if (is_after_um) continue;
      if (!card.is_integer(i) || (link.vertices.empty() && weight == 0)) {
        weight = card.real(i, "weight");
        counts = card.components(++i, "components that count");
        if (!(weight > 0))
          throw CardError{fmt::format("RBE3 {} has a weight that is not positive", link.label)};
        continue;
      }
      link.vertices.push_back(model_.vertex(card, i, "grid"));
      link.weights.push_back(weight);
      mean.counts.push_back(counts);
    }
    if (link.vertices.empty()) throw CardError{fmt::format("RBE3 {} names no grids", link.label)};
    return mean;
  }

  void add(const CardView& card, MeanCard mean) {
    const DistributingLink& link = mean.link;
    constexpr Counts displacements{true, true, true, false, false, false};
    if (is_all_read_) require_resistance(mean);
    if (std::all_of(mean.counts.begin(), mean.counts.end(),
                    [&](const Counts& one) { return one == displacements; })) {
      model_.deck.mesh.distributing_links.push_back(link);
      return;
    }
    drop_free_rotations(card, mean);
    std::vector<CountedFreedom> counted;
    for (std::size_t i = 0; i < link.vertices.size(); ++i)
      for (const DeckFreedom& freedom : freedoms(link.vertices[i], mean.counts[i]))
        counted.push_back({freedom, link.weights[i]});
    add_mean_equations(model_.deck, freedoms(link.reference, link.bound), counted);
  }

  /// Are there elements, and none that was left out or is wrong?
  bool is_all_read() const {
    const Mesh& mesh = model_.deck.mesh;
    if (mesh.shells.empty() && mesh.beams.empty() && mesh.solids.empty()) return false;
    const DeckOptions& options = model_.options;
    return !options.leave_solids_out && options.leave_out.empty() && !model_.log.has_complaints();
  }

  /// What a link spreads to a grid without anything never arrives at the structure, held or not.
  void require_resistance(const MeanCard& mean) const {
    for (std::size_t i = 0; i < mean.link.vertices.size(); ++i) {
      const int vertex = mean.link.vertices[i];
      if (!resistance_.moves(vertex))
        throw CardError{fmt::format(
            "RBE3 {} spreads loads to grid {}, which has no element, spring or other link that "
            "would bear them: leave the grid out of it",
            mean.link.label, model_.deck.mesh.vertex_labels[vertex])};
    }
  }

  /// Rotations that nothing resists would take their share of each load and pass it on to nothing:
  /// displacements count alone there, as they do for what is free to turn.
  void drop_free_rotations(const CardView& card, MeanCard& mean) {
    for (std::size_t i = 0; i < mean.link.vertices.size(); ++i) {
      const int vertex = mean.link.vertices[i];
      Counts& counts = mean.counts[i];
      if (!resistance_.moves(vertex) || resistance_.turns(vertex)) continue;
      if (!counts[3] && !counts[4] && !counts[5]) continue;
      counts[3] = counts[4] = counts[5] = false;
      model_.log.remark(card.line(),
                        "RBE3: the rotations of a grid of solids or rods do not count, for these "
                        "resist none; its displacements do");
    }
  }

  std::vector<DeckFreedom> freedoms(int vertex, const Counts& components) {
    std::vector<DeckFreedom> list;
    for (int i = 0; i < 6; ++i)
      if (components[i]) list.push_back({vertex, i, model_.output_axes(vertex)});
    return list;
  }

  NastranModel& model_;
  Resistance resistance_;
  bool is_all_read_;
};

}  // namespace

void read_nastran_means(NastranModel& model) { Means(model).read(); }

}  // namespace blocklift::structure
