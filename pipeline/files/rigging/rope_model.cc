#include "pipeline/files/rigging/rope_model.h"

namespace blocklift::pipeline {
namespace {

Table<RopeModel>& add_rope_keys(Table<RopeModel>& table, bool breaking_load_required) {
  table
      .required("axial_stiffness", &RopeModel::axial_stiffness,
                quantity(Dimension::force, Range::positive()),
                "EA, the tension at which the rope would be twice as long; of all falls together")
      .by_default("damping_time", &RopeModel::damping_time,
                  quantity(Dimension::time, Range::between(0, 1)), "5 ms",
                  "damping over stiffness (Kelvin-Voigt): the tension gains stiffness times this "
                  "time times the rate of stretching")
      .optional("diameter", &RopeModel::diameter, quantity(Dimension::length, Range::positive()),
                "of the rope, for bending and tolerances by a standard")
      .optional(
          "mass", &RopeModel::mass_per_length,
          quantity(Dimension::mass_per_length, Range::positive()),
          "per length, of all falls together; rigging weight where a case has a standard, and "
          "in the motion where it asks for rope_weight")
      .optional("material", &RopeModel::material, located(reference()),
                "by which a standard has its material factor")
      .optional("termination", &RopeModel::termination, located(reference()),
                "of the ends, by which a standard has its termination factor")
      .place(&RopeModel::place);
  const Format<double> load = quantity(Dimension::load, Range::positive());
  if (breaking_load_required) {
    return table.required("breaking_load", &RopeModel::breaking_load, load,
                          "smallest breaking load, of all falls together");
  }
  return table.optional("breaking_load", &RopeModel::breaking_load, load,
                        "smallest breaking load, of all falls together; shown beside the tension");
}

}  // namespace

Format<RopeModel> rope_model_format() {
  Table<RopeModel> table("rope", "A wire rope, a sling, or all falls of a tackle taken together.");
  table
      .required("kind", &RopeModel::kind, choice<std::string>({{"rope", "rope"}}),
                "what this file describes")
      .optional("title", &RopeModel::title, text(), "for people");
  return add_rope_keys(table, true).format();
}

Format<RopeChoice> rope_choice_format(bool breaking_load_required) {
  Table<RopeModel> table("rope",
                         "A rope described where it is used; a model file has the same keys.");
  const auto by_name = converted<Located<std::string>, RopeChoice>(
      located(reference()), [](Located<std::string> name) {
        return RopeChoice{std::move(name), std::nullopt};
      });
  const auto by_keys = converted<RopeModel, RopeChoice>(
      add_rope_keys(table, breaking_load_required).format(), [](RopeModel rope) {
        return RopeChoice{std::nullopt, std::move(rope)};
      });
  return by_shape<RopeChoice>(by_name, std::nullopt, by_keys);
}

}  // namespace blocklift::pipeline
