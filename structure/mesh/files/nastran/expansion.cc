// How materials expand with heat.

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "structure/mesh/files/nastran/model.h"

namespace blocklift::structure {

namespace {

/// Where a card of materials has its coefficients, as strains xx, yy, zz, xy, yz, zx, and TREF.
struct ExpansionFields {
  std::vector<std::size_t> strains;  ///< places among the six numbers, in the card's order
  std::size_t first = 0, reference = 0;
};

const std::map<std::string, ExpansionFields, std::less<>>& expansion_fields() {
  static const std::map<std::string, ExpansionFields, std::less<>> all{
      {"MAT1", {{0}, 5, 6}},
      {"MAT2", {{0, 1, 3}, 8, 11}},
      {"MAT8", {{0, 1}, 8, 10}},
      {"MAT9", {{0, 1, 2, 3, 4, 5}, 23, 29}},
      {"MAT11", {{0, 1, 2}, 11, 14}}};
  return all;
}

/// The line of a card that makes a material's expansion depend on the temperature; none if there is
/// none. MATTi has the tables of MATi's fields in the fields of the same places.
const NastranCard* dependence_of(const NastranModel& model, std::string_view card, long number,
                                 const ExpansionFields& fields) {
  const std::string name = "MATT" + std::string(card.substr(3));
  const auto found =
      std::find_if(model.bulk.cards.begin(), model.bulk.cards.end(), [&](const NastranCard& one) {
        if (one.name != name) return false;
        const CardView view(model.bulk, one);
        if (to_integer(view.text(0)) != number) return false;
        for (std::size_t i = 0; i < fields.strains.size(); ++i)
          if (view.has(fields.first + i) && !view.is(fields.first + i, "0")) return true;
        return false;
      });
  return found == model.bulk.cards.end() ? nullptr : &*found;
}

}  // namespace

void read_nastran_expansion(const NastranModel& model, const CardView& card,
                            NastranMaterial& material) {
  const auto found = expansion_fields().find(card.name());
  if (found == expansion_fields().end()) return;
  const ExpansionFields& fields = found->second;
  ExpansionStrains& strains = material.expansion;
  for (std::size_t i = 0; i < fields.strains.size(); ++i)
    strains[fields.strains[i]] = card.real(fields.first + i, "coefficient of expansion", 0.0);
  if (fields.strains.size() == 1) strains.head<3>().setConstant(strains[0]);
  material.reference = card.real(fields.reference, "reference temperature", 0.0);
  material.ply.expansion << strains[0], strains[1], strains[3];
  if (const NastranCard* table =
          dependence_of(model, card.name(), card.label(0, "material"), fields))
    material.obstacle = fmt::format("{} {} expands by the temperature ({} at {})", card.name(),
                                    card.text(0), table->name, model.log.place(table->line));
}

}  // namespace blocklift::structure
