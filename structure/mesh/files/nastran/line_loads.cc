// PLOAD1.

#include "structure/mesh/files/nastran/line_loads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "structure/mesh/beams/beam_axes.h"

namespace blocklift::structure {

namespace {

/// Shares of a length that are one.
constexpr double same_place = 1e-6;

/// PLOAD1 SID EID TYPE SCALE X1 P1 X2 P2
struct LineLoadCard {
  int axis = 0;
  bool is_moment = false;
  bool is_along_element = false;  ///< its axis is the element's
  bool is_projected = false;
  std::array<double, 2> place{};  ///< shares of the length; one and the same: at a place
  std::array<double, 2> value{};  ///< in the deck's units

  bool is_at_a_place() const { return place[0] == place[1]; }
};

void read_type(const CardView& card, LineLoadCard& load) {
  const std::string type = upper(card.text(2));
  const bool is_known = (type.size() == 2 || (type.size() == 3 && type[2] == 'E')) &&
                        (type[0] == 'F' || type[0] == 'M') && type[1] >= 'X' && type[1] <= 'Z';
  if (!is_known)
    throw CardError{
        fmt::format("the type \"{}\" of a load of set {} is not known; FX, FY, FZ, MX, MY, MZ, or "
                    "these with E behind them, are",
                    card.text(2), card.text(0))};
  load.is_moment = type[0] == 'M';
  load.axis = type[1] - 'X';
  load.is_along_element = type.size() == 3;
}

/// The share of a length that X1 or X2 is.
double share_of_length(const CardView& card, std::size_t i, double of_end) {
  constexpr double rounding = 1e-4;  // lengths are written with few digits
  const double given = card.real(i, "place") / of_end;
  if (given < -rounding || given > 1 + rounding)
    throw CardError{
        fmt::format("{} = {} of a load of set {} on element {} is not on it; 0 to {:g} "
                    "is due",
                    i == 4 ? "X1" : "X2", card.text(i), card.text(0), card.text(1), of_end)};
  if (given < same_place) return 0;
  return given > 1 - rounding ? 1 : given;
}

LineLoadCard line_load_of(const CardView& card, double length) {
  LineLoadCard load;
  read_type(card, load);
  const std::string scale = upper(card.text(3));
  if (scale != "LE" && scale != "FR" && scale != "LEPR" && scale != "FRPR")
    throw CardError{
        fmt::format("SCALE \"{}\" of a load of set {} is not known; LE, FR, LEPR and "
                    "FRPR are",
                    card.text(3), card.text(0))};
  const double of_end = scale.starts_with("FR") ? 1.0 : length;
  load.value[0] = card.real(5, "load P1");
  load.value[1] = card.real(7, "load P2", load.value[0]);
  load.place[0] = share_of_length(card, 4, of_end);
  load.place[1] = card.has(6) ? share_of_length(card, 6, of_end) : load.place[0];
  if (load.place[1] < load.place[0])
    throw CardError{fmt::format("X2 = {} of a load of set {} lies before X1 = {}", card.text(6),
                                card.text(0), card.text(4))};
  if (load.place[1] - load.place[0] < same_place) load.place[1] = load.place[0];
  // In the element's own directions, and at a place, nothing is projected.
  load.is_projected = scale.size() == 4 && !load.is_along_element && !load.is_at_a_place();
  if (load.is_projected && load.is_moment)
    throw CardError{fmt::format("SCALE {} of moments (set {}) is not known; of forces it is", scale,
                                card.text(0))};
  return load;
}

/// A bar as a whole: the line that its offsets lead to, and its pieces by shares of it.
struct WholeBar {
  std::vector<int> pieces;
  std::vector<double> bounds;  ///< one more than pieces, from 0 to 1
  std::array<Vector3, 2> offset{Vector3::Zero(), Vector3::Zero()};
  Eigen::Matrix3d axes;  ///< rows

  Vector3 offset_at(double share) const { return (1 - share) * offset[0] + share * offset[1]; }
};

WholeBar whole_bar(const NastranModel& model, int first) {
  const std::vector<Beam>& beams = model.deck.mesh.beams;
  WholeBar bar;
  bar.pieces = model.pieces_of_beam(first);
  const auto given = model.offsets_of_bar.find(first);
  if (given != model.offsets_of_bar.end()) bar.offset = given->second;
  const Vector3 from = model.place(beams[first].vertices[0]);
  const Vector3 line = model.place(beams[bar.pieces.back()].vertices[1]) - from;
  bar.bounds.push_back(0);
  for (const int piece : bar.pieces)
    bar.bounds.push_back((model.place(beams[piece].vertices[1]) - from).norm() / line.norm());
  bar.bounds.back() = 1;
  bar.axes = axes_along(line + bar.offset[1] - bar.offset[0], beams[first].axis_2);
  return bar;
}

/// The part of a load that is on a piece of the bar.
BeamLoad on_piece(const WholeBar& bar, std::size_t piece, const std::array<double, 2>& place,
                  const std::array<Vector3, 2>& value, bool is_moment) {
  const double begin = bar.bounds[piece], size = bar.bounds[piece + 1] - begin;
  BeamLoad load;
  load.beam = bar.pieces[piece];
  (is_moment ? load.moment : load.force) = value;
  for (std::size_t end = 0; end < 2; ++end) {
    const double share = (place[end] - begin) / size;
    load.span[end] = share < same_place ? 0 : share > 1 - same_place ? 1 : share;
    load.arm[end] = bar.offset_at(bar.bounds[piece + end]);
  }
  return load;
}

}  // namespace

std::vector<double> divisions_by_line_load(const CardView& card, double length) {
  constexpr int parts = 4;  // of a linear load, whose cubic moments elements have as parabolas
  const LineLoadCard load = line_load_of(card, length);
  const auto [from, to] = load.place;
  const bool is_even = load.is_moment || load.is_at_a_place() || load.value[0] == load.value[1];
  std::vector<double> shares{from, to};
  for (int i = 1; i < parts && !is_even; ++i) shares.push_back(from + (to - from) * i / parts);
  std::erase_if(shares, [](double share) { return share <= 0 || share >= 1; });
  std::sort(shares.begin(), shares.end());
  return shares;
}

std::vector<BeamLoad> line_loads(const NastranModel& model, const CardView& card, int first) {
  const WholeBar bar = whole_bar(model, first);
  const Mesh& mesh = model.deck.mesh;
  const Vector3 line = model.place(mesh.beams[bar.pieces.back()].vertices[1]) + bar.offset[1] -
                       model.place(mesh.beams[first].vertices[0]) - bar.offset[0];
  const LineLoadCard given = line_load_of(card, line.norm() / model.units.length);
  if (given.is_moment && mesh.beams[first].is_rod)
    throw CardError{fmt::format("a moment of set {} is along element {}, which does not bend",
                                card.text(0), card.text(1))};
  const Vector3 direction = given.is_along_element ? Vector3(bar.axes.row(given.axis))
                                                   : Vector3(Vector3::Unit(given.axis));
  double unit = given.is_moment ? model.units.moment() : model.units.force;
  if (!given.is_at_a_place()) unit /= model.units.length;
  if (given.is_projected) unit *= Vector3(bar.axes.row(0)).cross(direction).norm();
  const auto value_at = [&](double share) -> Vector3 {
    const double t =
        given.is_at_a_place() ? 0 : (share - given.place[0]) / (given.place[1] - given.place[0]);
    return (given.value[0] + t * (given.value[1] - given.value[0])) * unit * direction;
  };
  std::vector<BeamLoad> loads;
  for (std::size_t p = 0; p < bar.pieces.size(); ++p) {
    const double from = std::max(bar.bounds[p], given.place[0]),
                 to = std::min(bar.bounds[p + 1], given.place[1]);
    if (given.is_at_a_place()) {
      if (given.place[0] > bar.bounds[p + 1] + same_place) continue;
      const Vector3 value = value_at(given.place[0]);
      loads.push_back(on_piece(bar, p, given.place, {value, value}, given.is_moment));
      break;
    }
    if (to - from < same_place) continue;
    loads.push_back(on_piece(bar, p, {from, to}, {value_at(from), value_at(to)}, given.is_moment));
  }
  return loads;
}

}  // namespace blocklift::structure
