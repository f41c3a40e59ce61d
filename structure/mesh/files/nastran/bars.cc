// Properties of bars, beams and rods.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "structure/mesh/beams/sections.h"
#include "structure/mesh/files/nastran/model.h"

namespace blocklift::structure {

namespace {

using Dimensions = std::vector<double>;

struct Shape {
  const char* name;
  std::size_t dimensions;
  Profile (*build)(const Dimensions&);
};

/// Z: the flange at the top points towards negative axis 3.
Profile zee(const Dimensions& d) {
  const double flange = (d[3] - d[2]) / 2, level = (d[3] - flange) / 2, reach = d[0] + d[1] / 2;
  return walled_profile("Z", {{level, -reach}, {level, 0}, {-level, 0}, {-level, reach}},
                        {{0, 1, flange, 0, d[1] / 2},
                         {1, 2, d[1], -flange / 2, -flange / 2},
                         {2, 3, flange, d[1] / 2, 0}});
}

Profile cross(const Dimensions& d) {
  const double reach = (d[0] + d[1]) / 2;
  return walled_profile(
      "cross", {{0, -reach}, {0, 0}, {0, reach}, {-d[2] / 2, 0}, {d[2] / 2, 0}},
      {{0, 1, d[3], 0, -d[1] / 2}, {2, 1, d[3], 0, -d[1] / 2}, {3, 1, d[1]}, {1, 4, d[1]}});
}

Profile hat(const Dimensions& d) {
  const double t = d[1], top = d[0] - t / 2, low = t / 2, side = (d[2] - t) / 2,
               lip = side + t / 2 + d[3];
  return walled_profile(
      "hat", {{low, -lip}, {low, -side}, {top, -side}, {top, side}, {low, side}, {low, lip}},
      {{0, 1, t, 0, t / 2},
       {1, 2, t, -t / 2, -t / 2},
       {2, 3, t, t / 2, t / 2},
       {3, 4, t, -t / 2, -t / 2},
       {4, 5, t, t / 2, 0}});
}

/// The L of PBEAML: height along axis 2, the lower leg towards positive axis 3.
Profile ell(const Dimensions& d) {
  return seen(angle_bar(d[1], d[3], d[0], d[2]), false, true, false);
}

using Corners = std::vector<Eigen::Vector2d>;

Corners rectangle(double low, double high, double left, double right) {
  return {{low, left}, {high, left}, {high, right}, {low, right}};
}

/// A hexagon with two sides along axis 3: how far its tips reach beyond these, width, height.
Profile hexagon(const Dimensions& d) {
  const double half = d[2] / 2, tip = d[1] / 2, side = tip - d[0];
  if (!(d[0] > 0 && side > 0 && half > 0))
    throw ModelError("HEXA: its tips are to be positive and less than half of the width");
  return solid_polygon(
      "hexagon", {{half, side}, {half, -side}, {0, -tip}, {-half, -side}, {-half, side}, {0, tip}});
}

/// A hat on a plate: width, height over all, width of the top, thickness of hat and of plate. The
/// hat's lips reach to the plate's edges.
Profile closed_hat(const Dimensions& d) {
  const double edge = d[0] / 2, height = d[1], top = d[2] / 2, hat = d[3], plate = d[4];
  if (!(hat > 0 && plate > 0 && top > hat && edge > top && height > plate + 2 * hat))
    throw ModelError("HAT1: its dimensions make no hat on a plate");
  const double lip = plate + hat, under = height - hat;
  const Corners outer{{plate, -edge},     {lip, -edge},       {lip, -top},
                      {height, -top},     {height, top},      {lip, top},
                      {lip, edge},        {plate, edge},      {plate, top - hat},
                      {under, top - hat}, {under, hat - top}, {plate, hat - top}};
  const double web = top - hat / 2, low = plate / 2, high = height - hat / 2;
  return outlined_profile(
      "closed hat", {{rectangle(0, plate, -edge, edge)}, {outer}},
      {{low, -edge}, {low, -web}, {high, -web}, {high, web}, {low, web}, {low, edge}},
      {{0, 1, lip}, {1, 2, hat}, {2, 3, hat}, {3, 4, hat}, {4, 5, lip}, {1, 4, plate}});
}

/// Two boxes side by side: width, height, width from the left edge to the middle wall's middle;
/// walls on the left, in the middle, on the right; top and bottom on the left, on the right.
Profile double_box(const Dimensions& d) {
  const double half = d[1] / 2, left = -d[0] / 2, right = d[0] / 2, middle = left + d[2];
  const auto hole = [&](double from, double to, double top, double bottom) -> Outline {
    if (!(from < to && bottom - half < half - top))
      throw ModelError("DBOX: its walls leave nothing inside");
    return {rectangle(bottom - half, half - top, from, to), true};
  };
  for (std::size_t i = 0; i < 10; ++i)
    if (!(d[i] > 0)) throw ModelError("DBOX: its dimensions are to be positive");
  // Between top and bottom walls of different thickness the middle wall goes to their mean.
  const double low = -half + (d[7] + d[9]) / 4, high = half - (d[6] + d[8]) / 4;
  const double from = left + d[3] / 2, to = right - d[5] / 2;
  return outlined_profile("double box",
                          {{rectangle(-half, half, left, right)},
                           hole(left + d[3], middle - d[4] / 2, d[6], d[7]),
                           hole(middle + d[4] / 2, right - d[5], d[8], d[9])},
                          {{-half + d[7] / 2, from},
                           {half - d[6] / 2, from},
                           {high, middle},
                           {low, middle},
                           {half - d[8] / 2, to},
                           {-half + d[9] / 2, to}},
                          {{0, 1, d[3]},
                           {1, 2, d[6]},
                           {2, 3, d[4]},
                           {3, 0, d[7]},
                           {2, 4, d[8]},
                           {4, 5, d[5]},
                           {5, 3, d[9]}});
}

/// Shapes of PBARL and PBEAML in the element's axes y, z. Source: MSC Nastran Quick Reference
/// Guide, PBARL, figures of the cross-sections.
const Shape* find_shape(std::string_view name) {
  static const std::array shapes{
      Shape{"ROD", 1, [](const Dimensions& d) { return solid_circle(d[0]); }},
      Shape{"TUBE", 2, [](const Dimensions& d) { return pipe(d[0], d[1]); }},
      Shape{"TUBE2", 2, [](const Dimensions& d) { return pipe(d[0], d[0] - d[1]); }},
      Shape{"BAR", 2, [](const Dimensions& d) { return solid_rectangle(d[1], d[0]); }},
      Shape{"BOX", 4, [](const Dimensions& d) { return box(d[1], d[0], d[2], d[2], d[3], d[3]); }},
      Shape{"BOX1", 6, [](const Dimensions& d) { return box(d[1], d[0], d[2], d[3], d[4], d[5]); }},
      Shape{"I", 6, [](const Dimensions& d) { return i_beam(d[0], d[3], d[1], d[4], d[2], d[5]); }},
      Shape{"I1", 4,
            [](const Dimensions& d) {
              const double flange = (d[3] - d[2]) / 2, width = d[0] + d[1];
              return i_beam(d[3], d[1], width, flange, width, flange);
            }},
      Shape{"H", 4,
            [](const Dimensions& d) {
              return seen(i_beam(d[0] + d[1], d[3], d[2], d[1] / 2, d[2], d[1] / 2), true, false,
                          false);
            }},
      Shape{"T", 4, [](const Dimensions& d) { return tee_bar(d[1], d[3], d[0], d[2]); }},
      Shape{"T2", 4,
            [](const Dimensions& d) {
              return seen(tee_bar(d[1], d[3], d[0], d[2]), false, true, false);
            }},
      Shape{"T1", 4,
            [](const Dimensions& d) {
              return seen(tee_bar(d[1] + d[2], d[3], d[0], d[2]), true, false, false);
            }},
      Shape{"CHAN", 4, [](const Dimensions& d) { return channel(d[1], d[2], d[0], d[3]); }},
      Shape{
          "CHAN1", 4,
          [](const Dimensions& d) { return channel(d[3], d[1], d[0] + d[1], (d[3] - d[2]) / 2); }},
      Shape{"CHAN2", 4,
            [](const Dimensions& d) {
              return seen(channel(d[3], d[1], d[2], d[0]), true, false, false);
            }},
      Shape{"Z", 4, zee},
      Shape{"CROSS", 4, cross},
      Shape{"HAT", 4, hat},
      Shape{"HAT1", 5, closed_hat},
      Shape{"HEXA", 3, hexagon},
      Shape{"DBOX", 10, double_box},
      Shape{"L", 4, ell}};
  for (const Shape& shape : shapes)
    if (is_same(shape.name, name)) return &shape;
  return nullptr;
}

/// Section between the ends.
struct StationCard {
  double share = 0;  ///< of the length from the first end
  BeamSection section = {};
  Eigen::Vector2d centroid = Eigen::Vector2d::Zero();
};

struct BarCard {
  BeamSection section;
  Eigen::Vector2d centroid = Eigen::Vector2d::Zero();
  long material = 0;
  std::optional<BeamSection> end = {};  ///< at the second end, if it is another
  Eigen::Vector2d end_centroid = Eigen::Vector2d::Zero();
  std::vector<StationCard> stations = {};  ///< where it is not linear from end to end
};

/// What a card says of a place along a beam: its dimensions, or area and moments, in their order.
using Figures = std::vector<double>;
struct GivenStation {
  double share = 0;  ///< of the length from the first end
  Figures figures = {};
  std::vector<Eigen::Vector2d> points = {};
};

/// Figures on the line from end to end.
Figures between(const Figures& from, const Figures& to, double share) {
  Figures middle;
  for (std::size_t i = 0; i < from.size(); ++i)
    middle.push_back(from[i] + share * (to[i] - from[i]));
  return middle;
}

/// The share of a station's length. @throws CardError if it is none between the ends.
double share_of(const CardView& card, std::size_t i) {
  const double share = card.real(i, "X/XB", 1.0);
  if (!(share > 0)) throw CardError{fmt::format("X/XB is {:g}; more than 0 is due", share)};
  return share;
}

/// The stations between the ends in their order; none if all lie on the line from end to end, to a
/// hundredth.
std::vector<GivenStation> bends_of(std::vector<GivenStation> stations, const Figures& from,
                                   const Figures& to) {
  const auto is_on_line = [&](const GivenStation& station) {
    const Figures due = between(from, to, station.share);
    for (std::size_t i = 0; i < due.size(); ++i)
      if (std::abs(station.figures[i] - due[i]) >
          0.01 * std::max(std::abs(from[i]), std::abs(to[i])))
        return false;
    return true;
  };
  if (std::all_of(stations.begin(), stations.end(), is_on_line)) return {};
  std::sort(stations.begin(), stations.end(),
            [](const auto& a, const auto& b) { return a.share < b.share; });
  for (std::size_t i = 1; i < stations.size(); ++i)
    if (stations[i].share - stations[i - 1].share < 1e-6)
      throw CardError{fmt::format("two stations are at X/XB = {:g}", stations[i].share)};
  return stations;
}

double line_mass(const NastranModel& model, double given) {
  return given * model.units.mass() / model.units.length * model.mass_factor;
}

/// Area moments and points as the card gives them, to metres.
void scale(BeamSection& section, double length) {
  const double square = length * length;
  section.area *= square;
  section.second_moment_2 *= square * square;
  section.second_moment_3 *= square * square;
  section.product_23 *= square * square;
  section.torsion *= square * square;
  for (Eigen::Vector2d& point : section.stress_points) point *= length;
}

/// A factor of zero stands for no deformation by shear.
double shear_area(double factor, double area) {
  return factor > 0 ? factor * area : std::numeric_limits<double>::infinity();
}

void read_points(const CardView& card, std::size_t first, BeamSection& section) {
  for (std::size_t i = first; i < first + 8; i += 2)
    if (card.has(i) || card.has(i + 1))
      section.stress_points.emplace_back(card.real(i, "stress point", 0.0),
                                         card.real(i + 1, "stress point", 0.0));
}

/// PBAR PID MID A I1 I2 J NSM / C1 C2 D1 D2 E1 E2 F1 F2 / K1 K2 I12
BarCard read_bar(NastranModel& model, const CardView& card) {
  BarCard bar;
  bar.material = card.label(1, "material");
  BeamSection& section = bar.section;
  section.area = card.real(2, "area", 0.0);
  section.second_moment_3 = card.real(3, "I1", 0.0);
  section.second_moment_2 = card.real(4, "I2", 0.0);
  section.torsion = card.real(5, "J", 0.0);
  section.product_23 = card.real(18, "I12", 0.0);
  read_points(card, 8, section);
  scale(section, model.units.length);
  section.shear_area_2 = shear_area(card.real(16, "K1", 0.0), section.area);
  section.shear_area_3 = shear_area(card.real(17, "K2", 0.0), section.area);
  section.mass_per_length = line_mass(model, card.real(6, "mass beyond the bar's", 0.0));
  return bar;
}

/// PBARL PID MID GROUP TYPE / DIM1 DIM2 ... NSM
/// PBEAML begins so too, then stations: SO X/XB DIM1 ... NSM
BarCard read_shaped(NastranModel& model, const CardView& card) {
  const Shape* shape = find_shape(card.text(3));
  if (shape == nullptr)
    throw CardError{fmt::format(
        "{} {}: the shape \"{}\" is not known; BAR, BOX, BOX1, CHAN, CHAN1, "
        "CHAN2, CROSS, DBOX, H, HAT, HAT1, HEXA, I, I1, L, ROD, T, T1, T2, TUBE, TUBE2, "
        "Z are",
        card.name(), card.text(0), card.text(3))};
  Dimensions dimensions;
  for (std::size_t i = 0; i < shape->dimensions; ++i)
    dimensions.push_back(card.real(8 + i, "dimension") * model.units.length);
  BarCard bar;
  bar.material = card.label(1, "material");
  const std::size_t count = shape->dimensions, after = 8 + count;
  const bool is_beam = card.name() == "PBEAML";
  const double length = model.units.length;
  Figures figures = dimensions;
  figures.push_back(card.real(after, "mass beyond the bar's", 0.0));
  const auto build = [&](const Figures& here) {
    try {
      Profile profile = shape->build(Dimensions(here.begin(), here.end() - 1));
      profile.section.mass_per_length = line_mass(model, here.back());
      return profile.section;
    } catch (const ModelError& error) {
      throw CardError{fmt::format("{} {}: {}", card.name(), card.text(0), error.what())};
    }
  };
  bar.section = build(figures);
  // A beam's axis is its shear centre's, a bar's its centroid's, about which it twists.
  bar.section.twists_about_centroid = !is_beam;
  if (!is_beam) return bar;
  bar.centroid = bar.end_centroid = -bar.section.shear_centre;
  const auto figures_at = [&](std::size_t i, Figures here) {
    for (std::size_t j = 0; j < count; ++j)
      if (card.has(i + 2 + j)) here[j] = card.real(i + 2 + j, "dimension") * length;
    here[count] = card.real(i + 2 + count, "mass beyond the bar's", here[count]);
    return here;
  };
  Figures at_end = figures;
  std::vector<std::size_t> between_ends;
  for (std::size_t i = after + 1; i + 1 < card.size(); i += count + 3) {
    if (!card.has(i) && !card.has(i + 1)) continue;
    if (share_of(card, i + 1) < 1)
      between_ends.push_back(i);
    else
      at_end = figures_at(i, figures);
  }
  std::vector<GivenStation> stations;
  for (const std::size_t i : between_ends) {
    const double share = share_of(card, i + 1);
    stations.push_back({share, figures_at(i, between(figures, at_end, share))});
  }
  for (const GivenStation& station : bends_of(std::move(stations), figures, at_end)) {
    const BeamSection section = build(station.figures);
    bar.stations.push_back({station.share, section, -section.shear_centre});
  }
  if (at_end != figures) {
    bar.end = build(at_end);
    bar.end_centroid = -bar.end->shear_centre;
  }
  return bar;
}

/// Of a section of a PBEAM, in the deck's units.
constexpr std::array beam_figure_names{"A", "I1", "I2", "I12", "J", "NSM"};

Figures beam_figures(const CardView& card, std::size_t first, Figures otherwise) {
  for (std::size_t j = 0; j < otherwise.size(); ++j)
    otherwise[j] = card.real(first + j, beam_figure_names[j], otherwise[j]);
  return otherwise;
}

BeamSection section_of(const NastranModel& model, const Figures& figures,
                       std::vector<Eigen::Vector2d> points, double k1, double k2) {
  BeamSection section;
  section.area = figures[0];
  section.second_moment_3 = figures[1];
  section.second_moment_2 = figures[2];
  section.product_23 = figures[3];
  section.torsion = figures[4];
  section.stress_points = std::move(points);
  scale(section, model.units.length);
  section.shear_area_2 = shear_area(k1, section.area);
  section.shear_area_3 = shear_area(k2, section.area);
  section.mass_per_length = line_mass(model, figures[5]);
  return section;
}

std::vector<Eigen::Vector2d> points_of(const CardView& card, std::size_t first) {
  BeamSection section;
  read_points(card, first, section);
  return section.stress_points;
}

/// PBEAM PID MID A I1 I2 I12 J NSM / C1 C2 ... F2 / stations: SO X/XB A I1 I2 I12 J NSM / C1 ... /
/// K1 K2 S1 S2 NSIA NSIB CWA CWB / M1A M2A M1B M2B N1A N2A N1B N2B
BarCard read_beam(NastranModel& model, const CardView& card) {
  BarCard bar;
  bar.material = card.label(1, "material");
  const Figures figures = beam_figures(card, 2, Figures(beam_figure_names.size(), 0.0));
  const auto is_station = [&](std::size_t field) {
    return card.is(field, "YES") || card.is(field, "YESA") || card.is(field, "NO");
  };
  // The line of stress points may be left out before stations.
  std::size_t i = is_station(8) ? 8 : 16;
  std::vector<Eigen::Vector2d> points;
  if (i == 16) points = points_of(card, 8);
  Figures at_end = figures;
  std::vector<Eigen::Vector2d> end_points = points;
  const auto points_at = [&](std::size_t field) {
    std::vector<Eigen::Vector2d> own;
    if (card.is(field, "YES")) own = points_of(card, field + 8);
    return own.size() == points.size() ? own : points;
  };
  std::vector<std::size_t> between_ends;
  for (; is_station(i); i += card.is(i, "YES") ? 16 : 8) {
    if (share_of(card, i + 1) < 1) {
      between_ends.push_back(i);
      continue;
    }
    at_end = beam_figures(card, i + 2, figures);
    end_points = points_at(i);
  }
  std::vector<GivenStation> stations;
  for (const std::size_t field : between_ends) {
    const double share = share_of(card, field + 1);
    stations.push_back(
        {share, beam_figures(card, field + 2, between(figures, at_end, share)), points_at(field)});
  }
  const double length = model.units.length;
  const double k1 = card.real(i, "K1", 1.0), k2 = card.real(i + 1, "K2", 1.0);
  bar.section = section_of(model, figures, points, k1, k2);
  if (card.real(i + 2, "S1", 0.0) != 0 || card.real(i + 3, "S2", 0.0) != 0)
    model.log.leave_out("PBEAM", "relief of shear by the taper (S1, S2)");
  if (card.real(i + 4, "NSI(A)", 0.0) != 0 || card.real(i + 5, "NSI(B)", 0.0) != 0)
    model.log.leave_out("PBEAM", "the extra mass' own moment of inertia (NSI)");
  for (const std::size_t field : {i + 6, i + 7})
    if (card.real(field, "warping coefficient", 0.0) != 0)
      model.log.leave_out("PBEAM", "warping stiffness (CW)");
  if (card.real(i + 8, "M1", 0.0) != 0 || card.real(i + 9, "M2", 0.0) != 0)
    model.log.leave_out("PBEAM", "the offset of the extra mass (M1, M2): it is on the axis");
  const double n1 = card.real(i + 12, "N1", 0.0), n2 = card.real(i + 13, "N2", 0.0);
  bar.centroid = length * Eigen::Vector2d(n1, n2);
  bar.end_centroid =
      length * Eigen::Vector2d(card.real(i + 14, "N1", n1), card.real(i + 15, "N2", n2));
  bar.section.shear_centre = -bar.centroid;
  for (GivenStation& station : bends_of(std::move(stations), figures, at_end)) {
    StationCard here;
    here.share = station.share;
    here.centroid = bar.centroid + station.share * (bar.end_centroid - bar.centroid);
    here.section = section_of(model, station.figures, std::move(station.points), k1, k2);
    here.section.shear_centre = -here.centroid;
    bar.stations.push_back(std::move(here));
  }
  if (at_end != figures || end_points != points || bar.end_centroid != bar.centroid) {
    bar.end = section_of(model, at_end, end_points, k1, k2);
    bar.end->shear_centre = -bar.end_centroid;
  }
  return bar;
}

/// PROD PID MID A J C NSM; PTUBE PID MID OD T NSM
BarCard read_rod(NastranModel& model, const CardView& card) {
  BarCard bar;
  bar.material = card.label(1, "material");
  if (card.name() == "PROD") {
    bar.section.area = card.real(2, "area", 0.0);
    bar.section.torsion = card.real(3, "J", 0.0);
    scale(bar.section, model.units.length);
    const double arm = card.real(4, "C", 0.0) * model.units.length;  // of tau = T C / J
    if (arm < 0) throw CardError{fmt::format("PROD {}: C is negative", card.text(0))};
    if (arm > 0 && bar.section.torsion > 0)
      bar.section.shear_points = {{.of_torsion = arm / bar.section.torsion}};
    bar.section.mass_per_length = line_mass(model, card.real(5, "mass beyond the rod's", 0.0));
    return bar;
  }
  const double radius = card.real(2, "outer diameter") / 2 * model.units.length;
  const double wall = card.real(3, "wall", 0.0) * model.units.length;
  if (card.has(5) && std::abs(card.real(5, "outer diameter at the end") * model.units.length -
                              2 * radius) > 0.02 * radius)
    throw CardError{fmt::format("PTUBE {} tapers by more than 1 %", card.text(0))};
  try {
    const Profile profile =
        wall > 0 && wall < radius ? pipe(radius, radius - wall) : solid_circle(radius);
    bar.section.area = profile.section.area;
    bar.section.torsion = profile.section.torsion;
    bar.section.shear_points = {{.of_torsion = profile.section.shear_points.front().of_torsion}};
  } catch (const ModelError& error) {
    throw CardError{fmt::format("PTUBE {}: {}", card.text(0), error.what())};
  }
  bar.section.mass_per_length = line_mass(model, card.real(4, "mass beyond the tube's", 0.0));
  return bar;
}

int add_section(NastranModel& model, const std::string& name, long material, BeamSection section,
                long label) {
  const double i2 = section.second_moment_2, i3 = section.second_moment_3;
  if (!(section.area > 0 || section.torsion > 0 || i2 > 0 || i3 > 0))
    throw CardError{fmt::format("{} {} has neither area nor stiffness", name, label)};
  if (section.area < 0 || i2 < 0 || i3 < 0 || section.torsion < 0 ||
      section.product_23 * section.product_23 > i2 * i3 * (1 + 1e-9))
    throw CardError{
        fmt::format("{} {}: area and second moments must not be negative, nor I12^2 "
                    "more than I1 I2",
                    name, label)};
  section.material = nastran_material_place(model, material);
  section.name = fmt::format("{} {}", name, label);
  section.label = label;
  model.deck.mesh.beam_sections.push_back(std::move(section));
  return static_cast<int>(model.deck.mesh.beam_sections.size()) - 1;
}

}  // namespace

const NastranBar& nastran_bar(NastranModel& model, long property) {
  if (const auto known = model.bar_read.find(property); known != model.bar_read.end())
    return known->second;
  const auto found = model.properties.find(property);
  if (found == model.properties.end())
    throw CardError{fmt::format("property {} does not exist", property)};
  const CardView& card = found->second;
  const std::string& name = card.name();
  try {
    BarCard bar;
    if (name == "PBAR")
      bar = read_bar(model, card);
    else if (name == "PBARL" || name == "PBEAML")
      bar = read_shaped(model, card);
    else if (name == "PBEAM")
      bar = read_beam(model, card);
    else if (name == "PROD" || name == "PTUBE")
      bar = read_rod(model, card);
    else
      throw CardError{
          fmt::format("a bar, beam or rod has property {}, which is a {}", property, name)};
    NastranBar read;
    read.is_rod = !(bar.section.second_moment_2 > 0 || bar.section.second_moment_3 > 0);
    read.section = add_section(model, name, bar.material, bar.section, property);
    if (bar.end) read.end_section = add_section(model, name, bar.material, *bar.end, property);
    read.centroid = bar.centroid;
    read.end_centroid = bar.end_centroid;
    if (read.is_rod && !bar.stations.empty())
      throw CardError{
          "its section is not linear from end to end, and it does not bend: a rod cannot be "
          "divided at its stations"};
    for (const StationCard& station : bar.stations)
      read.stations.push_back({station.share,
                               add_section(model, name, bar.material, station.section, property),
                               station.centroid});
    model.log.use(name);
    return model.bar_read[property] = read;
  } catch (const AlreadySaid&) {
    throw;
  } catch (const CardError& error) {
    const std::string whose = fmt::format("{} {}", name, property);
    model.log.complain(card.line(),
                       error.text.starts_with(whose) ? error.text : whose + ": " + error.text);
    throw AlreadySaid{{fmt::format("{} {} cannot be used", name, property)}};
  }
}

int nastran_rod_section(NastranModel& model, const std::string& name, long label, long material,
                        double area, double torsion, double mass_per_length) {
  BarCard bar;
  bar.material = material;
  bar.section.area = area;
  bar.section.torsion = torsion;
  scale(bar.section, model.units.length);
  bar.section.mass_per_length = line_mass(model, mass_per_length);
  return add_section(model, name, material, bar.section, label);
}

}  // namespace blocklift::structure
