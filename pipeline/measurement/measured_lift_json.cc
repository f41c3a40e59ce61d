#include <cstddef>
#include <utility>

#include "pipeline/formats/json_values.h"
#include "pipeline/measurement/measured_lift.h"

namespace blocklift::pipeline {
namespace {

using Json = nlohmann::ordered_json;

Json record_json(const AlignedRecord& record) {
  Json json{{"file", record.file}, {"shift_s", record.shift}};
  if (!record.found) return json;
  json["correlation"] = json_number(record.found->correlation);
  json["other_shift_correlation"] =
      record.found->runner_up ? json_number(*record.found->runner_up) : Json();
  json["doubtful"] = record.found->is_doubtful();
  json["clock_slow_by"] = record.found->rate;
  return json;
}

Json decay_json(const std::optional<Decay>& decay) {
  if (!decay) return nullptr;
  return {{"period_s", decay->period},
          {"period_deviation_s", json_number(decay->period_deviation)},
          {"damping_ratio", decay->damping_ratio},
          {"damping_deviation", json_number(decay->damping_deviation)},
          {"amplitude", decay->amplitude},
          {"explained", decay->explained}};
}

const char* name_of(Fault fault) {
  if (fault == Fault::spike) return "spike";
  if (fault == Fault::drop_out) return "drop_out";
  return fault == Fault::stuck ? "stuck" : "restart";
}

Json channel_json(const HeldChannel& channel, bool looked_for_decay) {
  Json json{{"name", channel.name},
            {"unit", channel.unit},
            {"samples_of_record", channel.samples},
            {"left_out", Json::array()},
            {"refused", channel.is_refused}};
  for (const LeftOut& one : channel.left_out)
    json["left_out"].push_back({{"as", name_of(one.fault)},
                                {"from_s", one.window.from},
                                {"to_s", one.window.to},
                                {"samples", one.samples}});
  if (channel.agreement) {
    const Agreement& one = *channel.agreement;
    json["samples"] = one.samples;
    json["mean_difference"] = one.mean_difference;
    json["rms_difference"] = one.rms_difference;
    json["peak_difference"] = one.peak_difference;
    json["time_of_peak_s"] = one.time_of_peak;
    json["correlation"] = json_number(one.correlation);
    json["scale"] = one.scale ? json_number(*one.scale) : Json();
    json["zero"] = one.scale ? json_number(one.zero) : Json();
    json["largest_measured"] = one.largest_measured;
    json["largest_computed"] = one.largest_computed;
    json["largest_at_rest"] = json_number(one.largest_at_rest);
    json["ratio_of_means"] = json_number(one.ratio_of_means);
    if (channel.unit == "N") {
      json["amplification_measured"] = json_number(one.measured_amplification());
      json["amplification_computed"] = json_number(one.computed_amplification());
    }
  }
  if (channel.sharing) {
    json["share_measured"] = channel.sharing->measured;
    json["share_computed"] = channel.sharing->computed;
  }
  if (looked_for_decay) {
    json["decay_measured"] = decay_json(channel.measured_decay);
    json["decay_computed"] = decay_json(channel.computed_decay);
  }
  return json;
}

Json weight_json(const HeldWeight& weight) {
  const Weighing& ours = weight.measured;
  const std::optional<Eigen::Index> open = ours.open_coordinate();
  // Along what stays open nothing is known.
  Json deviation = json_point(ours.centre_deviation);
  if (open) deviation[static_cast<std::size_t>(*open)] = nullptr;
  return {{"from_s", weight.window.from},
          {"to_s", weight.window.to},
          {"mass_kg", ours.mass},
          {"mass_deviation_kg", json_number(ours.mass_deviation)},
          {"centre_of_mass_m", json_point(ours.centre_of_mass_B)},
          {"centre_deviation_m", std::move(deviation)},
          {"open_coordinate", open ? Json(std::string(1, "xyz"[*open])) : Json()},
          {"open_coordinate_is_computed", open && weight.computed_centre_B},
          {"open_direction", ours.open_direction_B ? json_point(*ours.open_direction_B) : Json()},
          {"force_residual_N", ours.force_residual},
          {"computed_mass_kg", weight.computed_mass ? Json(*weight.computed_mass) : Json()},
          {"computed_centre_of_mass_m",
           weight.computed_centre_B ? json_point(*weight.computed_centre_B) : Json()}};
}

}  // namespace

Json measured_json(const MeasuredLift& lift) {
  Json json{{"case", lift.result.summary.value("case", "")},
            {"run", lift.result.summary.value("run", "")},
            {"records", Json::array()},
            {"channels", Json::array()}};
  for (const AlignedRecord& record : lift.records) json["records"].push_back(record_json(record));
  for (const HeldChannel& channel : lift.channels)
    json["channels"].push_back(channel_json(channel, lift.looked_for_decay));
  if (lift.weight) json["weight"] = weight_json(*lift.weight);
  if (lift.wind)
    json["wind"] = {{"mean_m_s", lift.wind->mean},
                    {"computed_mean_m_s", lift.computed_wind ? Json(*lift.computed_wind) : Json()},
                    {"deviation_m_s", lift.wind->deviation},
                    {"largest_mean_over_3_s_m_s", lift.wind->gust}};
  if (lift.waves)
    json["waves"] = {
        {"significant_height_m", lift.waves->significant_height},
        {"computed_significant_height_m",
         lift.computed_wave_height ? Json(*lift.computed_wave_height) : Json()},
        {"zero_crossing_period_s",
         lift.waves->zero_crossing_period ? Json(*lift.waves->zero_crossing_period) : Json()}};
  json["doubts"] = lift.doubts;
  return json;
}

}  // namespace blocklift::pipeline
