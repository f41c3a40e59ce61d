#include "pipeline/files/environment/wind_in_case.h"

#include <cstdint>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace blocklift::pipeline {

namespace {

using GustTable = std::vector<std::array<Quantity, 2>>;

/// What is wrong with a table, as an error with a hint; none: nothing.
struct TableFault {
  std::string message, hint;
};
std::optional<TableFault> find_fault(const GustTable& rows) {
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (rows[k][0].dimension != Dimension::time || rows[k][1].dimension != Dimension::speed)
      return TableFault{fmt::format("row {} of the gust is no time with a speed", k + 1),
                        "such as [12 s, 6 m/s]: the time, and what the gust adds to the mean then"};
    if (k > 0 && !(rows[k][0].value > rows[k - 1][0].value))
      return TableFault{fmt::format("row {} of the gust is for {:g} s, after {:g} s: times must "
                                    "ascend",
                                    k + 1, rows[k][0].value, rows[k - 1][0].value),
                        "a step is a rise within a short time, such as 0.1 s"};
  }
  return {};
}

/// Of a gust of which the reader may have complained.
bool is_sound(const given::Gust& gust) {
  if (gust.table) return gust.table->value.size() >= 2 && !find_fault(gust.table->value);
  return gust.magnitude && gust.magnitude->value > 0 && gust.start && gust.start->value >= 0 &&
         gust.duration && gust.duration->value > 0;
}

void check_shape(const given::Gust& gust, Reading& reading, const Mark& mark) {
  if (gust.table) {
    const auto refuse = [&](const char* key, const auto& given) {
      if (given)
        reading.error(given->mark,
                      fmt::format("the gust is given twice, by its table and by its {}", key),
                      {"give either table, or magnitude, start and duration, and shape if wanted"});
    };
    refuse("shape", gust.shape);
    refuse("magnitude", gust.magnitude);
    refuse("start", gust.start);
    refuse("duration", gust.duration);
    if (const auto fault = find_fault(gust.table->value))
      reading.error(gust.table->mark, fault->message, {fault->hint});
    return;
  }
  if (gust.magnitude && gust.start && gust.duration) return;
  reading.error(mark, "the gust says neither its table nor all of its shape",
                {"give either table, or magnitude, start and duration"});
}

Format<given::Gust> gust_format() {
  using Shape = dynamics::WindGust::Shape;
  Table<given::Gust> table("gust",
                           "A single gust along the wind, which acts everywhere at once: what it "
                           "adds to the mean speed over time.");
  const auto pair = array_of<Quantity, 2>(quantity_of({Dimension::time, Dimension::speed}));
  table
      .optional(
          "shape", &given::Gust::shape,
          located(choice<Shape>({{"one_minus_cosine", Shape::one_minus_cosine},
                                 {"coherent_rise", Shape::coherent_rise},
                                 {"operating", Shape::operating}})),
          "up by the magnitude and back, as 1 - cosine, which it is if left out; up by half of a "
          "cosine, to stay; or the operating gust of IEC 61400-1: down by 0.27, up by 0.74 of the "
          "magnitude, down and back")
      .optional("magnitude", &given::Gust::magnitude,
                located(quantity(Dimension::speed, Range::positive())),
                "of the shape: what it adds at most, of the operating one V_gust of the standard")
      .optional("start", &given::Gust::start,
                located(quantity(Dimension::time, Range::not_negative())),
                "since the operation begins")
      .optional("duration", &given::Gust::duration,
                located(quantity(Dimension::time, Range::positive())),
                "of the whole shape, or of the rise; 10.5 s of the operating gust in IEC 61400-1, "
                "10 s of its coherent rise by 15 m/s")
      .optional(
          "table", &given::Gust::table, list_of(pair, 2),
          "in place of a shape: what is added over time, [[20 s, 0 m/s], [21 s, 6 m/s], ...], "
          "straight between, constant before the first point and behind the last")
      .place(&given::Gust::place)
      .rule(check_shape);
  return table.format();
}

/// Air that flows back is no gust of this wind.
void check_gust(const given::Wind& wind, Reading& reading, const Mark&) {
  if (!wind.gust || !is_sound(*wind.gust)) return;
  const double least = wind.gust->make_gust().lowest();
  if (wind.speed + least < 0)
    reading.error(wind.gust->place,
                  fmt::format("the gust takes {:.4g} m/s from a wind of {:g} m/s, which would blow "
                              "back then",
                              -least, wind.speed),
                  {"a gust takes no more than there is"});
}

}  // namespace

dynamics::WindGust given::Gust::make_gust() const {
  if (!table) {
    const auto of_shape = shape ? shape->value : dynamics::WindGust::Shape::one_minus_cosine;
    return {of_shape, magnitude->value, start->value, duration->value};
  }
  std::vector<double> times, speeds;
  for (const auto& [time, speed] : table->value) {
    times.push_back(time.value);
    speeds.push_back(speed.value);
  }
  return {std::move(times), std::move(speeds)};
}

std::vector<double> given::Wind::breakpoints() const {
  return gust ? gust->make_gust().breakpoints() : std::vector<double>();
}

std::shared_ptr<const dynamics::WindField> given::Wind::make_field(bool at_rest) const {
  dynamics::WindField::Definition definition;
  definition.speed = speed;
  definition.heading = towards;
  definition.air_density = air_density;
  definition.profile = profile;
  definition.gusts = gusts;
  definition.gust_height = gust_height;
  definition.seed = static_cast<std::uint64_t>(seed);
  if (gust) definition.gust = gust->make_gust();
  const dynamics::WindField field(definition);
  return std::make_shared<const dynamics::WindField>(at_rest ? field.mean() : field);
}

Format<given::Wind> wind_format() {
  using dynamics::GustSpectrum;
  using dynamics::WindProfile;
  Table<given::Wind> table("wind", "Wind on the wind areas of bodies: steady, or with gusts.");
  table
      .required("speed", &given::Wind::speed, quantity(Dimension::speed, Range::not_negative()),
                "mean of the air, 10 m above z = 0 where it grows with the height")
      .required("towards", &given::Wind::towards, quantity(Dimension::angle),
                "where it blows to, from +x towards +y")
      .by_default("air_density", &given::Wind::air_density,
                  quantity(Dimension::density, Range::positive()), "1.25 kg/m^3", "of the air")
      .by_default("profile", &given::Wind::profile,
                  choice<WindProfile>({{"uniform", WindProfile::uniform},
                                       {"power", WindProfile::power},
                                       {"npd", WindProfile::npd}}),
                  "uniform",
                  "over the height: the same, to the power of 0.12, or by the NPD (ISO 19901-1)")
      .by_default("gusts", &given::Wind::gusts,
                  choice<GustSpectrum>({{"none", GustSpectrum::none},
                                        {"npd", GustSpectrum::npd},
                                        {"api", GustSpectrum::api},
                                        {"davenport", GustSpectrum::davenport}}),
                  "none", "spectrum of the gusts; static equilibrium is that of the mean wind")
      .by_default("gust_height", &given::Wind::gust_height,
                  quantity(Dimension::length, Range::positive()), "10 m",
                  "at which the spectrum is taken")
      .by_default("seed", &given::Wind::seed, integer(Range::not_negative()), "1",
                  "of the gusts' random phases")
      .optional("gust", &given::Wind::gust, gust_format(),
                "a single gust, in the motion alone; it comes besides the gusts of a spectrum")
      .rule(check_gust);
  return table.format();
}

}  // namespace blocklift::pipeline
