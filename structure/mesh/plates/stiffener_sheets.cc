#include "structure/mesh/plates/stiffener_sheets.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "structure/error.h"
#include "structure/mesh/plates/line_pieces.h"

namespace blocklift::structure {

namespace {

constexpr double same_plane = 1e-6, same_place = 1e-3;  // m
/// Shares of the shorter side of an opening that is no rectangle: a web that passes nearer to it
/// than the first ends by the second before it, where its frame of shells begins.
constexpr double beside_opening = 1.0 / 8, before_opening = 1.0 / 3;

/// Makes the sheets of one line of a row after another.
class StiffenerMaker {
 public:
  StiffenerMaker(const BlockDescription& block, const std::vector<Sheet>& plates)
      : block_(block),
        plates_(plates),
        first_group_(
            static_cast<int>(block.plates.size() + block.pads.size() + block.lugs.size())) {}

  void add(const Sheet& base, const StiffenerLine& line) {
    const Stiffeners& row = block_.stiffeners[line.row];
    const StiffenerPlates& shape = row.plates.value();
    const int across = 3 - line.along - base.normal;
    const double place = aligned(across, line.position, shape.web_thickness);
    double far = base.position + line.side * (base.thickness / 2 + shape.web_height);
    if (shape.flange_thickness > 0) far = aligned(base.normal, far, shape.flange_thickness);
    const LinePieces pieces = pieces_of(base, line, place);
    for (const Interval& piece : pieces) {
      Sheet sheet;
      sheet.group = first_group_ + line.row;
      sheet.rank = SheetRank::stiffener;
      sheet.material =
          row.material.empty() ? base.material : place_of_material(block_, row.name, row.material);
      sheet.extent[line.along] = piece;
      const std::string name =
          fmt::format("{} at {} = {:g} m, {} = {:g} m{}", row.name, "xyz"[base.normal],
                      base.position, "xyz"[across], place, piece_name(line, pieces, piece));
      Sheet web = sheet;
      web.name = name + ", web";
      web.normal = across;
      web.position = place;
      web.thickness = shape.web_thickness;
      web.extent[base.normal] = {std::min(base.position, far), std::max(base.position, far)};
      made_.push_back(std::move(web));
      if (!(shape.flange_thickness > 0)) continue;
      sheet.name = name + ", flange";
      sheet.normal = base.normal;
      sheet.position = far;
      sheet.thickness = shape.flange_thickness;
      sheet.extent[across] = flange_of(base, line, place);
      made_.push_back(std::move(sheet));
    }
  }

  std::vector<Sheet> take() { return std::move(made_); }

 private:
  /// The position, or that of the nearest parallel sheet within whose thickness it would lie.
  double aligned(int normal, double position, double thickness) const {
    double nearest = position, least = 1e300;
    for (const auto* sheets : {&plates_, &made_})
      for (const Sheet& sheet : *sheets) {
        const double distance = std::abs(sheet.position - position);
        if (sheet.normal != normal || distance >= least ||
            distance > (thickness + sheet.thickness) / 2 + same_place)
          continue;
        least = distance;
        nearest = sheet.position;
      }
    return nearest;
  }

  Interval flange_of(const Sheet& base, const StiffenerLine& line, double place) const {
    const Stiffeners& row = block_.stiffeners[line.row];
    auto [from, to] = row.plates.value().flange_reach;
    // Axis 3 is (along) x (away from the plate).
    const bool is_cyclic = (line.along + 1) % 3 == base.normal;
    if ((is_cyclic ? 1 : -1) * line.side < 0) from = -std::exchange(to, -from);
    return {place + from, place + to};
  }

  LinePieces pieces_of(const Sheet& base, const StiffenerLine& line, double place) const {
    const int across = 3 - line.along - base.normal;
    LinePieces pieces{base.extent[line.along]};
    for (const auto& hole : base.holes) {
      const auto& [lower, upper] = hole[across];
      if (lower < place - same_place && place + same_place < upper)
        leave_out(hole[line.along].lower, hole[line.along].upper, pieces);
    }
    for (const Cutout& cutout : base.cutouts) {
      const Eigen::Vector2d lower = cutout.outline.lower(), upper = cutout.outline.upper();
      const double size = (upper - lower).minCoeff();
      // The outline's two axes follow the sheet's normal.
      const int i = (across - base.normal + 2) % 3, j = 1 - i;
      if (place < lower[i] - beside_opening * size || place > upper[i] + beside_opening * size)
        continue;
      leave_out(lower[j] - before_opening * size, upper[j] + before_opening * size, pieces);
    }
    for (const Sheet& other : plates_)
      if (stands_there(other, base, line.side, across, place))
        leave_out(other.extent[line.along].lower, other.extent[line.along].upper, pieces);
    std::erase_if(pieces, [](const Interval& p) { return p.upper - p.lower < same_place; });
    return pieces;
  }

  /// Whether a plate stands where a web would, on the same side of its plate.
  static bool stands_there(const Sheet& other, const Sheet& base, int side, int across,
                           double place) {
    if (other.normal != across || std::abs(other.position - place) > same_plane) return false;
    const double face = base.thickness / 2 + same_place;
    const double lower = other.extent[base.normal].lower - base.position,
                 upper = other.extent[base.normal].upper - base.position;
    return side > 0 ? lower < face && upper > face : upper > -face && lower < -face;
  }

  /// One of several pieces of a line says which it is.
  static std::string piece_name(const StiffenerLine& line, const LinePieces& pieces,
                                const Interval& piece) {
    if (pieces.size() < 2) return "";
    return fmt::format(", {} = {:g} m to {:g} m", "xyz"[line.along], piece.lower, piece.upper);
  }

  const BlockDescription& block_;
  const std::vector<Sheet>& plates_;
  int first_group_;
  std::vector<Sheet> made_;
};

}  // namespace

StiffenerFigures figures_as_plates(const StiffenerPlates& plates, double plate_thickness) {
  const double height = plate_thickness / 2 + plates.web_height;
  const double flange = plates.flange_thickness * (plates.flange_reach[1] - plates.flange_reach[0]);
  return {plates.web_thickness * height + flange,
          plates.web_thickness * std::pow(height, 3) / 3 +
              flange * (height * height + std::pow(plates.flange_thickness, 2) / 12)};
}

StiffenerFigures figures_as_beam(const Profile& profile, double plate_thickness) {
  const double arm = plate_thickness / 2 + profile.centroid[0];
  return {profile.section.area, profile.section.second_moment_3 + profile.section.area * arm * arm};
}

void make_stiffener_sheets(const BlockDescription& block, std::vector<Sheet>& sheets) {
  StiffenerMaker maker(block, sheets);
  for (Sheet& sheet : sheets) {
    std::vector<StiffenerLine> beams;
    for (const StiffenerLine& line : sheet.stiffeners)
      if (block.stiffeners[line.row].plates)
        maker.add(sheet, line);
      else
        beams.push_back(line);
    sheet.stiffeners = std::move(beams);
  }
  for (Sheet& sheet : maker.take()) sheets.push_back(std::move(sheet));
}

}  // namespace blocklift::structure
