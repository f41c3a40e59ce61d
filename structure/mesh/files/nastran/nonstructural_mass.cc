// Mass that a deck spreads over cells beside their properties.

#include <algorithm>

#include <fmt/format.h>

#include "structure/mesh/files/deck/label_range.h"
#include "structure/mesh/files/deck/spread_mass.h"
#include "structure/mesh/files/nastran/model.h"

namespace blocklift::structure {

namespace {

struct Cells {
  std::vector<int> shells, beams;
};

class SpreadMasses {
 public:
  explicit SpreadMasses(NastranModel& model) : model_(model) {}

  /// The set, or those that it is the sum of (NSMADD).
  void use(long set) {
    std::vector<long> parts{set};
    bool is_any = false;
    for (const NastranCard& card : model_.bulk.cards) {
      const CardView view(model_.bulk, card);
      if (card.name != "NSMADD" || to_integer(view.text(0)) != set) continue;
      parts.clear();
      for (std::size_t i = 1; i < view.size(); ++i)
        if (view.has(i)) parts.push_back(view.label(i, "set"));
      model_.log.use("NSMADD");
    }
    const auto one = [&](const CardView& card, auto add) {
      const long own = card.label(0, "set");
      if (std::find(parts.begin(), parts.end(), own) == parts.end()) {
        model_.log.leave_out(card.name(), "sets that case control does not ask for");
        throw AlreadySaid{};  // not counted as used
      }
      is_any = true;
      add();
    };
    model_.for_each(
        {{"NSM", [&](const CardView& card) { one(card, [&] { add_pairs(card, false); }); }},
         {"NSML", [&](const CardView& card) { one(card, [&] { add_pairs(card, true); }); }},
         {"NSM1", [&](const CardView& card) { one(card, [&] { add_list(card, false); }); }},
         {"NSML1", [&](const CardView& card) { one(card, [&] { add_list(card, true); }); }}});
    if (!is_any) throw CardError{fmt::format("set {} of spread masses (NSM) does not exist", set)};
  }

 private:
  // NSM SID TYPE ID VALUE ID VALUE ID VALUE: each a set of its own
  void add_pairs(const CardView& card, bool is_lumped) {
    for (std::size_t i = 2; i + 1 < card.size(); i += 2) {
      if (!card.has(i)) continue;
      const double value = card.real(i + 1, "mass");
      add(cells_of(card, {card.label(i, "number")}), value, is_lumped);
    }
  }

  // NSM1 SID TYPE VALUE ID ID ... | ALL | ID THRU ID BY N
  void add_list(const CardView& card, bool is_lumped) {
    const double value = card.real(2, "mass");
    std::vector<long> numbers;
    for (std::size_t i = 3; i < card.size(); ++i) {
      if (!card.has(i)) continue;
      if (card.is(i, "ALL")) {
        numbers.clear();
        break;
      }
      if (card.is(i, "THRU")) {
        const long from = card.label(i - 1, "number"), to = card.label(i + 1, "last number");
        const bool has_step = card.is(i + 2, "BY");
        const long step = has_step ? card.label(i + 3, "step") : 1;
        for (const auto* known : {&model_.shell_of, &model_.beam_of, &model_.region_of})
          for (const long number : known_labels(*known, from, to, step)) numbers.push_back(number);
        i += has_step ? 3 : 1;
        continue;
      }
      numbers.push_back(card.label(i, "number"));
    }
    add(cells_of(card, numbers), value, is_lumped);
  }

  /// Cells of elements, or of properties of one kind, with these numbers; of all, without any.
  Cells cells_of(const CardView& card, const std::vector<long>& numbers) {
    const Mesh& mesh = model_.deck.mesh;
    Cells cells;
    const auto is_named = [&](long number) {
      return numbers.empty() || std::find(numbers.begin(), numbers.end(), number) != numbers.end();
    };
    if (card.is(1, "ELEMENT") || card.is(1, "CONROD")) {
      for (const auto& [number, shell] : model_.shell_of)
        if (is_named(number) && card.is(1, "ELEMENT")) cells.shells.push_back(shell);
      for (const auto& [number, beam] : model_.beam_of)
        if (is_named(number))
          for (const int piece : model_.pieces_of_beam(beam)) cells.beams.push_back(piece);
    } else {
      std::vector<char> is_of(mesh.regions.size(), 0);
      for (const auto& [number, region] : model_.region_of)
        if (is_named(number) && is_kind(card, number)) is_of[region] = 1;
      for (std::size_t s = 0; s < mesh.shells.size(); ++s)
        if (is_of[mesh.shells[s].region] != 0) cells.shells.push_back(static_cast<int>(s));
      for (std::size_t b = 0; b < mesh.beams.size(); ++b)
        if (is_of[mesh.beams[b].region] != 0) cells.beams.push_back(static_cast<int>(b));
    }
    if (cells.shells.empty() && cells.beams.empty())
      throw CardError{
          fmt::format("there is no cell of {} that has mass spread over it", card.text(1))};
    return cells;
  }

  /// PBAR names PBARL, too, and so on.
  bool is_kind(const CardView& card, long property) const {
    const auto found = model_.properties.find(property);
    return found != model_.properties.end() &&
           std::string_view(found->second.name()).starts_with(upper(card.text(1)));
  }

  void add(const Cells& cells, double value, bool is_lumped) {
    Mesh& mesh = model_.deck.mesh;
    if (!cells.shells.empty() && !cells.beams.empty())
      throw CardError{"mass is spread over plates and bars at once: over areas or lengths?"};
    const double length = model_.units.length;
    double mass = value * model_.units.mass() * model_.mass_factor;
    if (mass < 0) throw CardError{"the mass is negative"};
    if (cells.beams.empty())
      add_mass_per_area(mesh, cells.shells,
                        mass / (is_lumped ? total_area(mesh, cells.shells) : length * length));
    else
      add_mass_per_length(mesh, cells.beams,
                          mass / (is_lumped ? total_length(mesh, cells.beams) : length));
  }

  NastranModel& model_;
};

}  // namespace

void use_nonstructural_mass(NastranModel& model, long set) { SpreadMasses(model).use(set); }

}  // namespace blocklift::structure
