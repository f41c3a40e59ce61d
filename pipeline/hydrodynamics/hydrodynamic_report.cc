#include "pipeline/hydrodynamics/hydrodynamic_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "dynamics/marine/radiation/response_amplitude.h"
#include "dynamics/marine/radiation/retardation_from_damping.h"
#include "pipeline/formats/hydrodynamics/convention_check.h"
#include "pipeline/formats/hydrodynamics/radiation_check.h"
#include "pipeline/hydrodynamics/line_chart.h"
#include "pipeline/terminal/text_table.h"

namespace blocklift::pipeline {
namespace {

using dynamics::HydrodynamicDatabase;
using dynamics::modes_per_body;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

constexpr std::array<const char*, 6> mode_names = {"surge", "sway",  "heave",
                                                   "roll",  "pitch", "yaw"};
/// Largest change of a radiation force from panels of twice the size that is not warned of. The
/// error is a third of it where panels converge at second order: some three per cent.
constexpr double acceptable_change = 0.1;
/// The same of the force of waves, as a share of its largest.
constexpr double acceptable_change_in_waves = 0.1;
/// Of a radiation force, by the end of the impulse runs.
constexpr double acceptable_cut = 0.05;
constexpr double degree = std::numbers::pi / 180.0;

bool is_rotation(Eigen::Index mode) { return mode % modes_per_body >= 3; }

// ----------------------------------------------------------------------------------------- tables

/// Rows of the table: at most twelve frequencies, evenly chosen.
std::vector<std::size_t> chosen_frequencies(const HydrodynamicDatabase& database) {
  const std::size_t count = database.frequencies.size();
  std::vector<std::size_t> chosen;
  const std::size_t rows = std::min<std::size_t>(count, 12);
  for (std::size_t r = 0; r < rows; ++r) {
    chosen.push_back(rows == 1 ? 0 : r * (count - 1) / (rows - 1));
  }
  return chosen;
}

/// A table with a column for each motion of a body.
class ModeTable {
 public:
  explicit ModeTable(const std::string& what) : table_(columns(what)) {}

  template <class Value>
  void add(const std::string& label, Eigen::Index first, const Value& value) {
    std::vector<TextTable::Cell> row = {label};
    for (Eigen::Index m = first; m < first + modes_per_body; ++m) row.emplace_back(value(m));
    table_.add_row(std::move(row));
  }
  std::string text() const { return "\n" + table_.text(); }

 private:
  static std::vector<TableColumn> columns(const std::string& what) {
    std::vector<TableColumn> columns = {{what}};
    for (const char* const name : mode_names) columns.push_back({name, 4});
    return columns;
  }

  TextTable table_;
};

std::string frequency_label(const HydrodynamicDatabase& database, std::size_t k) {
  return fmt::format("{:.3f} rad/s", database.frequencies[k]);
}

/// Added mass and damping (t, t m2; t/s, t m2/s) of one body.
std::string radiation_table(const HydrodynamicDatabase& database, Eigen::Index first) {
  ModeTable mass("added mass, t, t m2"), damping("damping, t/s, t m2/s");
  for (const std::size_t k : chosen_frequencies(database)) {
    const std::string label = frequency_label(database, k);
    mass.add(label, first, [&](Eigen::Index m) { return database.added_mass[k](m, m) / 1e3; });
    damping.add(label, first, [&](Eigen::Index m) { return database.damping[k](m, m) / 1e3; });
  }
  mass.add("infinite", first,
           [&](Eigen::Index m) { return database.infinite_added_mass(m, m) / 1e3; });
  return mass.text() + damping.text();
}

/// How far panels and runs are from fine and long enough; empty where it is not known.
std::string error_table(const HydrodynamicDatabase& database, Eigen::Index first) {
  std::string text;
  const auto add = [&](const char* what, const char* how, const Eigen::VectorXd& errors) {
    if (errors.size() == 0) return;
    ModeTable table(what);
    table.add(how, first, [&](Eigen::Index m) { return 100.0 * errors[m]; });
    text += table.text();
  };
  add("error of panels, %", "at most, by coarser ones", database.change_from_coarser);
  add("error of panels in waves, %", "of the largest force",
      database.excitation_change_from_coarser);
  add("error of the runs' end, %", "at most, by what fades", database.cut_off_by_end);
  return text;
}

/// Excitation (kN/m, kN) and response (m/m, deg/m): the largest over all headings.
std::string wave_table(const HydrodynamicDatabase& database,
                       const std::vector<MatrixXcd>& responses, Eigen::Index first) {
  if (database.headings.empty()) return {};
  ModeTable excitation("excitation, kN/m, kN m/m"), response("response, m/m, deg/m");
  for (const std::size_t k : chosen_frequencies(database)) {
    const MatrixXcd X = database.excitation(k);
    excitation.add(frequency_label(database, k), first,
                   [&](Eigen::Index m) { return X.row(m).cwiseAbs().maxCoeff() / 1e3; });
    if (responses.empty()) continue;
    response.add(frequency_label(database, k), first, [&](Eigen::Index m) {
      return responses[k].row(m).cwiseAbs().maxCoeff() / (is_rotation(m) ? degree : 1.0);
    });
  }
  std::string text = excitation.text() + (responses.empty() ? "" : response.text());
  if (!database.mean_drift.empty()) {
    ModeTable drift("mean drift, kN/m2, kN m/m2");
    for (const std::size_t k : chosen_frequencies(database)) {
      drift.add(frequency_label(database, k), first, [&](Eigen::Index m) {
        return database.mean_drift[k].row(m).cwiseAbs().maxCoeff() / 1e3;
      });
    }
    text += drift.text();
  }
  return "\nthe largest over all headings:" + text;
}

/// Responses of a draught; none without masses or stiffness.
std::vector<MatrixXcd> responses_of(const HydrodynamicFile& file,
                                    const std::vector<MatrixXd>& masses, std::size_t state) {
  const HydrodynamicDatabase& database = file.series.databases[state];
  if (masses.size() <= state || database.hydrostatic_stiffness.size() == 0) return {};
  return calc_response_amplitudes(database, masses[state]);
}

/// A body with the draught of the state: its own, or that of the body that is lowered beside it.
std::string name_of_state(const HydrodynamicFile& file, std::size_t state, int body) {
  const std::vector<std::string>& names = file.series.databases[state].body_names;
  const std::string& name = names[body];
  const double draught = file.series.draughts[state];
  if (!(draught > 0.0)) return name + ", draught unknown";
  const int lowered = file.series.lowered_body;
  if (body == lowered) return fmt::format("{}, draught {:.3f} m", name, draught);
  if (file.series.draughts.size() == 1) return name;
  return fmt::format("{}, {} at a draught of {:.3f} m", name, names[lowered], draught);
}

// ------------------------------------------------------------------------------------------ page

template <class Value>
Curve over_frequency(const HydrodynamicDatabase& database, const std::string& name,
                     const Value& value) {
  Curve curve{name, database.frequencies, {}};
  for (std::size_t k = 0; k < database.frequencies.size(); ++k) curve.y.push_back(value(k));
  return curve;
}

template <class Value>
LineChart by_heading(const HydrodynamicDatabase& database, std::string title, std::string unit,
                     const Value& value) {
  LineChart chart{std::move(title), "rad/s", std::move(unit), {}};
  // As many as can be told apart, evenly chosen.
  constexpr std::size_t most_curves = 8;
  const std::size_t stride = (database.headings.size() + most_curves - 1) / most_curves;
  for (std::size_t h = 0; h < database.headings.size(); h += stride) {
    chart.curves.push_back(
        over_frequency(database, fmt::format("{:.0f} deg", database.headings[h] / degree),
                       [&](std::size_t k) { return value(k, static_cast<Eigen::Index>(h)); }));
  }
  return chart;
}

/// The charts of one mode of one body at a draught.
std::string charts_of_mode(const HydrodynamicDatabase& database,
                           const std::vector<MatrixXcd>& responses, Eigen::Index m) {
  const bool rotation = is_rotation(m);
  const std::string name = mode_names[m % modes_per_body];
  LineChart mass{"added mass, " + name, "rad/s", rotation ? "t m2" : "t", {}};
  mass.curves.push_back(over_frequency(
      database, "A", [&](std::size_t k) { return database.added_mass[k](m, m) / 1e3; }));
  mass.curves.push_back(over_frequency(database, "infinite frequency", [&](std::size_t) {
    return database.infinite_added_mass(m, m) / 1e3;
  }));
  LineChart damping{"damping, " + name, "rad/s", rotation ? "t m2/s" : "t/s", {}};
  damping.curves.push_back(
      over_frequency(database, "", [&](std::size_t k) { return database.damping[k](m, m) / 1e3; }));
  LineChart memory{"retardation function, " + name, "s", rotation ? "t m2/s2" : "t/s2", {}};
  Curve kernel;
  const std::size_t stride = database.retardation.size() / 500 + 1;
  for (std::size_t n = 0; n < database.retardation.size(); n += stride) {
    kernel.x.push_back(static_cast<double>(n) * database.time_step);
    kernel.y.push_back(database.retardation[n](m, m) / 1e3);
  }
  memory.curves.push_back(std::move(kernel));
  std::string page = to_svg(mass) + to_svg(damping) + to_svg(memory);
  if (database.headings.empty()) return page;
  page += to_svg(by_heading(
      database, "excitation, " + name, rotation ? "kN m/m" : "kN/m",
      [&](std::size_t k, Eigen::Index h) {
        return std::abs(database.froude_krylov[k](m, h) + database.diffraction[k](m, h)) / 1e3;
      }));
  if (!database.mean_drift.empty() && !database.mean_drift.front().row(m).isZero(0.0)) {
    page += to_svg(by_heading(
        database, "mean drift, " + name, rotation ? "kN m/m2" : "kN/m2",
        [&](std::size_t k, Eigen::Index h) { return database.mean_drift[k](m, h) / 1e3; }));
  }
  if (responses.empty()) return page;
  return page + to_svg(by_heading(database, "response, " + name, rotation ? "deg/m" : "m/m",
                                  [&](std::size_t k, Eigen::Index h) {
                                    return std::abs(responses[k](m, h)) / (rotation ? degree : 1.0);
                                  }));
}

constexpr const char* page_head = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="identity" content="{2}"><title>{0}</title><style>
body {{ font: 14px system-ui, sans-serif; max-width: 1340px; margin: 24px auto; padding: 0 16px; color: #222; }}
.charts {{ display: flex; flex-wrap: wrap; }} svg {{ width: 420px; }}
svg text {{ font: 10px system-ui, sans-serif; }} svg .title {{ font-weight: 600; font-size: 11px; }}
svg path {{ fill: none; stroke-width: 1.4; }} svg .grid {{ stroke: #ddd; }}
pre {{ overflow-x: auto; background: #f6f6f6; padding: 10px; }}
</style></head><body><h1>{0}</h1><p>{1}</p>
)";

double wave_length(double frequency, const dynamics::Water& water) {
  return 2.0 * std::numbers::pi / dynamics::calc_wave_number(frequency, water);
}

std::string origin_text(const HydrodynamicFile& file) {
  const dynamics::Water& water = file.series.databases[0].water;
  return fmt::format(
      "{}; water of {:.6g} kg/m3, {}", file.origin, water.density,
      std::isinf(water.depth) ? std::string("deep") : fmt::format("{:.6g} m deep", water.depth));
}

}  // namespace

std::string hydrodynamic_table(const HydrodynamicFile& file, const std::vector<MatrixXd>& masses) {
  std::string text = origin_text(file) + "\n";
  for (std::size_t s = 0; s < file.series.databases.size(); ++s) {
    const HydrodynamicDatabase& database = file.series.databases[s];
    const std::vector<MatrixXcd> responses = responses_of(file, masses, s);
    for (int b = 0; b < database.body_count(); ++b) {
      text += fmt::format("\n{}, {:.6g} m3 displaced\n", name_of_state(file, s, b),
                          database.displaced_volumes[b]);
      const Eigen::Index first = Eigen::Index{modes_per_body} * b;
      if (!responses.empty()) {
        ModeTable periods("natural period, s");
        periods.add("alone", first,
                    [&](Eigen::Index m) { return calc_natural_period(database, masses[s], m); });
        text += periods.text();
      }
      text += error_table(database, first) + radiation_table(database, first) +
              wave_table(database, responses, first);
    }
    text += fmt::format(
        "\nerror of retardation functions: they miss added mass and damping by {:.2g} % of "
        "the waves' largest share at most\n",
        100.0 * calc_memory_error(database));
    std::vector<std::string> doubts = {doubt_about_panels(database),
                                       doubt_about_excitation(database), doubt_about_runs(database),
                                       doubt_about_memory(database)};
    // What this program computed has its conventions.
    if (file.origin.starts_with(imported_from)) {
      for (std::string& doubt : doubts_about_conventions(database))
        doubts.push_back(std::move(doubt));
    }
    for (const std::string& doubt : doubts) {
      if (!doubt.empty()) text += "\nwarning: " + doubt + "\n";
    }
  }
  return text;
}

std::string doubt_about_panels(const HydrodynamicDatabase& database) {
  if (database.change_from_coarser.size() == 0) return {};
  Eigen::Index worst = 0;
  const double change = database.change_from_coarser.maxCoeff(&worst);
  if (change <= acceptable_change) return {};
  const auto body = static_cast<std::size_t>(worst / modes_per_body);
  if (!std::isfinite(change))
    return fmt::format(
        "the panels are coarse: those of twice the size have no solution for {}, or cannot be made "
        "of these, and nothing is known of the error of these; take smaller panels",
        database.body_names[body]);
  std::string doubt = fmt::format(
      "the panels are coarse: the radiation force of {} in {} changes by {:.0f} % from panels of "
      "twice the size to these; take smaller panels until that is below {:.0f} %",
      database.body_names[body], mode_names[worst % modes_per_body], 100.0 * change,
      100.0 * acceptable_change);
  // Panels alone do not change a force by more than itself; a resonance that moves does.
  if (change > 1.0) {
    doubt += "; water that swings in a gap or moonpool without damping does that, which lids give";
  }
  return doubt;
}

std::string doubt_about_excitation(const HydrodynamicDatabase& database) {
  if (database.excitation_change_from_coarser.size() == 0) return {};
  Eigen::Index worst = 0;
  const double change = database.excitation_change_from_coarser.maxCoeff(&worst);
  // Coarser panels without a solution are doubt_about_panels' matter.
  if (change <= acceptable_change_in_waves || !std::isfinite(change)) return {};
  return fmt::format(
      "the panels are coarse: the force of waves on {} in {} changes by {:.0f} % of its largest "
      "from panels of twice the size to these; take smaller panels until that is below {:.0f} %",
      database.body_names[worst / modes_per_body], mode_names[worst % modes_per_body],
      100.0 * change, 100.0 * acceptable_change_in_waves);
}

std::string doubt_about_runs(const HydrodynamicDatabase& database) {
  if (database.cut_off_by_end.size() == 0) return {};
  Eigen::Index worst = 0;
  const double cut = database.cut_off_by_end.maxCoeff(&worst);
  if (cut <= acceptable_cut) return {};
  return fmt::format(
      "water swings longer than its impulse responses were followed: their end cuts off about "
      "{:.0f} % of the radiation force of {} in {}; a lower lowest_frequency follows them longer, "
      "a "
      "lid damps the water, method: green function needs no such responses",
      100.0 * cut, database.body_names[worst / modes_per_body], mode_names[worst % modes_per_body]);
}

std::string doubt_about_mass(const std::string& name, double displaced, double mass) {
  constexpr double acceptable = 0.05;
  if (std::abs(mass - displaced) <= acceptable * displaced) return {};
  return fmt::format(
      "vessel {} displaces {:.5g} t as it is meshed, and its mass is {:.5g} t: with that it floats "
      "at another draught, unless moorings hold it; give the mass that is displaced, or leave out "
      "water_line and give the hull up to its deck",
      name, displaced / 1e3, mass / 1e3);
}

std::string note_on_groups(const dynamics::PanelModel& model,
                           const std::vector<dynamics::BodyGroup>& groups) {
  if (groups.size() < 2) return {};
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t b = 1; b < groups.size(); ++b) {
    for (std::size_t a = 0; a < b; ++a)
      nearest = std::min(nearest, (groups[a].centre - groups[b].centre).norm());
  }
  std::vector<std::string> names;
  for (const dynamics::BodyGroup& group : groups) {
    std::string name;
    for (const int body : group.bodies) {
      if (!name.empty()) name += " with ";
      name += model.bodies()[body].name;
    }
    names.push_back(std::move(name));
  }
  return fmt::format(
      "{} lie {:.4g} m apart or more (centres): each on a surface of its own, coupled by the waves "
      "that go from one to the other, without the local flow about the other",
      fmt::join(names, ", "), nearest);
}

std::optional<dynamics::CouplingReach> find_lost_coupling(
    const dynamics::PanelModel& model, const std::vector<dynamics::BodyGroup>& groups,
    double highest_frequency) {
  std::optional<dynamics::CouplingReach> reach;
  for (const dynamics::CouplingReach& pair : find_coupling_reaches(model)) {
    const bool together =
        std::any_of(groups.begin(), groups.end(), [&](const dynamics::BodyGroup& group) {
          const auto holds = [&](int body) {
            return std::count(group.bodies.begin(), group.bodies.end(), body) > 0;
          };
          return holds(pair.first) && holds(pair.second);
        });
    if (together && (!reach || pair.shortest > reach->shortest)) reach = pair;
  }
  if (reach && reach->shortest <= wave_length(highest_frequency, model.water())) reach.reset();
  return reach;
}

std::string doubt_about_coupling(const std::vector<std::string>& names,
                                 const dynamics::CouplingReach& lost, const dynamics::Water& water,
                                 double highest_frequency) {
  return fmt::format(
      "{} and {} lie {:.4g} m apart: waves shorter than {:.4g} m, above {:.3g} rad/s in deep "
      "water, "
      "are lost between them, so that each is computed as if it lay alone there; the shortest "
      "wave asked for is {:.4g} m long",
      names.at(static_cast<std::size_t>(lost.first)),
      names.at(static_cast<std::size_t>(lost.second)), lost.gap, lost.shortest,
      std::sqrt(2.0 * std::numbers::pi * water.gravity / lost.shortest),
      wave_length(highest_frequency, water));
}

std::string hydrodynamic_page(const HydrodynamicFile& file, const std::string& title,
                              const std::vector<MatrixXd>& masses) {
  std::string page = fmt::format(page_head, title, origin_text(file), file.identity);
  for (std::size_t s = 0; s < file.series.databases.size(); ++s) {
    const HydrodynamicDatabase& database = file.series.databases[s];
    const std::vector<MatrixXcd> responses = responses_of(file, masses, s);
    for (int b = 0; b < database.body_count(); ++b) {
      page += fmt::format("<h2>{}</h2>\n<div class=\"charts\">\n", name_of_state(file, s, b));
      for (int m = 0; m < modes_per_body; ++m) {
        page += charts_of_mode(database, responses, Eigen::Index{modes_per_body} * b + m);
      }
      page += "</div>\n";
    }
  }
  page +=
      "<p>Responses are those of bodies that float freely, damped by the waves they radiate "
      "alone.</p>\n<pre>" +
      hydrodynamic_table(file, masses) + "</pre>\n</body></html>\n";
  return page;
}

}  // namespace blocklift::pipeline
