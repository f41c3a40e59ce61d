#include "pipeline/files/vessel/vessel_group.h"

#include <fmt/format.h>

#include "pipeline/declaration/table.h"

namespace blocklift::pipeline {
namespace {

void check_vessels(const VesselGroup& group, Reading& reading, const Mark& mark) {
  if (group.vessels.empty()) {
    reading.error(mark, "there is no vessel", {"give at least one, with its name and place"});
  }
  if (!group.hydrodynamics.draughts.empty() || group.hydrodynamics.as_meshed) {
    reading.error(mark, "one water line for several vessels",
                  {"give draughts beside the vessel that has them"});
  }
  const Named<PlacedVessel>* lowered = nullptr;
  for (const Named<PlacedVessel>& vessel : group.vessels) {
    if (vessel.value.draughts.size() < 2) continue;
    if (lowered != nullptr) {
      reading.error(vessel.name.mark,
                    fmt::format("vessel {} has several draughts, as {} has", vessel.name.value,
                                lowered->name.value),
                    {"one vessel of a group may have several draughts: the one that is lowered"});
    }
    lowered = &vessel;
  }
}

}  // namespace

Format<VesselGroup> vessel_group_format() {
  Table<PlacedVessel> vessel("vessel", "A vessel with its place in the world.");
  vessel
      .required("vessel", &PlacedVessel::vessel, located(text()),
                "model (`vessels/ship-3800t`) or file of the vessel")
      .required("position", &PlacedVessel::position,
                array_of<double, 2>(quantity(Dimension::length)), "of its origin, [x, y]")
      .by_default("heading", &PlacedVessel::heading, quantity(Dimension::angle), "0 deg",
                  "of its x axis, from the world's x towards y")
      .optional("draughts", &PlacedVessel::draughts, draughts_format(),
                "upright, from the lowest point of the hull; several for the one vessel that is "
                "lowered into the water; afloat by its weight if left out");
  Table<VesselGroup> table("vessels", "Several floating bodies whose flows act on each other.");
  table
      .required("kind", &VesselGroup::kind, choice<std::string>({{"vessels", "vessels"}}),
                "what this file describes")
      .optional("title", &VesselGroup::title, text(), "for people")
      .required("vessels", &VesselGroup::vessels, names_to(vessel.format()), "by name")
      .by_default("hydrodynamics", &VesselGroup::hydrodynamics, hydrodynamic_settings_format(),
                  "{}", "what blocklift hydro computes")
      .place(&VesselGroup::place)
      .rule(check_vessels);
  return table.format();
}

}  // namespace blocklift::pipeline
