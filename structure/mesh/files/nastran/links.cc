// Rigid links.

#include <algorithm>

#include <fmt/format.h>

#include "structure/mesh/files/deck/equations.h"
#include "structure/mesh/files/deck/label_range.h"
#include "structure/mesh/files/deck/link_frames.h"
#include "structure/mesh/files/nastran/model.h"

namespace blocklift::structure {

namespace {

using Components = std::array<bool, 6>;

constexpr Components all_six{true, true, true, true, true, true};

class Links {
 public:
  explicit Links(NastranModel& model) : model_(model), mesh_(model.deck.mesh) {}

  void read() {
    model_.for_each({{"RBE2", [&](const CardView& card) { add_rbe2(card); }},
                     {"RBE1", [&](const CardView& card) { add_rbe1(card); }},
                     {"RBAR", [&](const CardView& card) { add_rbar(card); }},
                     {"RTRPLT", [&](const CardView& card) { add_triangle(card); }},
                     {"RJOINT", [&](const CardView& card) { add_joint(card); }},
                     {"RROD", [&](const CardView& card) { add_rod(card); }}});
  }

 private:
  void add_rigid(long label, int master, const std::vector<int>& slaves, const Components& bound) {
    RigidLink link;
    link.label = label;
    link.master = master;
    link.bound = bound;
    for (const int slave : slaves) {
      const Eigen::Matrix3d axes = model_.output_axes(slave);
      if (is_free_of_axes(bound) || is_identity(axes)) {
        link.slaves.push_back(slave);
      } else {
        RigidLink one{master, {slave}, bound, axes, label};
        mesh_.rigid_links.push_back(one);
      }
    }
    if (!link.slaves.empty()) mesh_.rigid_links.push_back(link);
  }

  // RBE2 EID GN CM GM1 GM2 ... ALPHA
  void add_rbe2(const CardView& card) {
    const long label = model_.new_element(card);
    const int master = model_.vertex(card, 1, "independent grid");
    const Components bound = card.components(2, "bound components");
    std::vector<int> slaves;
    for (std::size_t i = 3; i < card.size(); ++i) {
      if (!card.has(i)) continue;
      if (card.is(i, "THRU")) {
        const long from = card.label(i - 1, "grid"), to = card.label(++i, "last grid");
        for (const long number : known_labels(model_.vertex_of, from + 1, to))
          slaves.push_back(model_.vertex_of.at(number));
      } else if (!card.is_integer(i) && to_real(card.text(i))) {
        model_.log.leave_out("RBE2", "ALPHA (thermal expansion)");
      } else {
        slaves.push_back(model_.vertex(card, i, "dependent grid"));
      }
    }
    if (slaves.empty()) throw CardError{fmt::format("RBE2 {} binds no grid", label)};
    if (std::find(slaves.begin(), slaves.end(), master) != slaves.end())
      throw CardError{fmt::format("RBE2 {} binds its independent grid", label)};
    add_rigid(label, master, slaves, bound);
  }

  std::vector<DeckFreedom> freedoms(int vertex, const Components& components) {
    std::vector<DeckFreedom> list;
    for (int i = 0; i < 6; ++i)
      if (components[i]) list.push_back({vertex, i, model_.output_axes(vertex)});
    return list;
  }

  Components components_or_none(const CardView& card, std::size_t i) const {
    return card.has(i) && !card.is(i, "0") ? card.components(i, "components") : Components{};
  }

  /// Grids of which some components determine a rigid motion, and others follow it.
  struct EndOfRigid {
    int vertex = 0;
    Components independent{}, dependent{};
  };
  /// Without dependent components, all that are not independent follow.
  void add_rigid_of(std::vector<EndOfRigid> ends) {
    const bool are_told = std::any_of(ends.begin(), ends.end(), [](const EndOfRigid& end) {
      return end.dependent != Components{};
    });
    std::vector<DeckFreedom> independent, dependent;
    for (EndOfRigid& end : ends) {
      for (std::size_t i = 0; i < 6 && !are_told; ++i) end.dependent[i] = !end.independent[i];
      for (const DeckFreedom& freedom : freedoms(end.vertex, end.independent))
        independent.push_back(freedom);
      for (const DeckFreedom& freedom : freedoms(end.vertex, end.dependent))
        dependent.push_back(freedom);
    }
    add_rigid_equations(model_.deck, independent, dependent);
  }

  // RTRPLT EID GA GB GC CNA CNB CNC blank / CMA CMB CMC
  void add_triangle(const CardView& card) {
    model_.new_element(card);
    std::vector<EndOfRigid> ends;
    for (std::size_t i = 0; i < 3; ++i)
      ends.push_back({model_.vertex(card, 1 + i, "corner"), components_or_none(card, 4 + i),
                      components_or_none(card, 8 + i)});
    add_rigid_of(ends);
  }

  // RJOINT EID GA GB CB
  void add_joint(const CardView& card) {
    const long label = model_.new_element(card);
    add_rigid(label, model_.vertex(card, 1, "end"), {model_.vertex(card, 2, "end")},
              card.has(3) ? card.components(3, "bound components") : all_six);
  }

  // RROD EID GA GB CMA CMB
  void add_rod(const CardView& card) {
    model_.new_element(card);
    const int a = model_.vertex(card, 1, "end"), b = model_.vertex(card, 2, "end");
    const bool a_follows = components_or_none(card, 4) == Components{};
    add_rigid_rod(model_.deck, a_follows ? a : b, a_follows ? b : a);
  }

  // RBAR EID GA GB CNA CNB CMA CMB
  void add_rbar(const CardView& card) {
    const long label = model_.new_element(card);
    const int a = model_.vertex(card, 1, "end"), b = model_.vertex(card, 2, "end");
    const Components free_a = components_or_none(card, 3), free_b = components_or_none(card, 4);
    if (free_a == all_six && free_b == Components{})
      add_rigid(label, a, {b}, card.has(6) ? components_or_none(card, 6) : all_six);
    else if (free_b == all_six && free_a == Components{})
      add_rigid(label, b, {a}, card.has(5) ? components_or_none(card, 5) : all_six);
    else
      add_rigid_of(
          {{a, free_a, components_or_none(card, 5)}, {b, free_b, components_or_none(card, 6)}});
  }

  // RBE1 EID GN1 CN1 GN2 CN2 GN3 CN3 / ... / UM GM1 CM1 GM2 CM2 ...
  void add_rbe1(const CardView& card) {
    const long label = model_.new_element(card);
    std::vector<EndOfRigid> ends;
    std::size_t i = 1;
    for (; i < card.size() && !card.is(i, "UM"); ++i) {
      if (!card.has(i)) continue;
      const int vertex = model_.vertex(card, i, "independent grid");
      ends.push_back({vertex, card.components(++i, "independent components"), {}});
    }
    const bool is_one = ends.size() == 1 && ends.front().independent == all_six;
    for (++i; i + 1 < card.size(); ++i) {
      if (!card.has(i)) continue;
      if (!card.is_integer(i)) break;  // ALPHA
      const int slave = model_.vertex(card, i, "dependent grid");
      const Components bound = card.components(++i, "dependent components");
      if (is_one)
        add_rigid(label, ends.front().vertex, {slave}, bound);
      else
        ends.push_back({slave, {}, bound});
    }
    if (!is_one) add_rigid_of(ends);
  }

  NastranModel& model_;
  Mesh& mesh_;
};

}  // namespace

void read_nastran_links(NastranModel& model) { Links(model).read(); }

}  // namespace blocklift::structure
