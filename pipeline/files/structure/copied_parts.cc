#include "pipeline/files/structure/copied_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "pipeline/declaration/table.h"
#include "structure/mesh/beams/sections.h"

namespace blocklift::pipeline {

namespace {

constexpr int most_copies = 10000;  // of all parts of a block

/// Where a copy lies: moved, or mirrored about a plane normal to an axis.
class Placing {
 public:
  static Placing moved(const Vector3& by) { return {Vector3::Ones(), by}; }
  static Placing mirrored(std::size_t normal, double at) {
    const auto axis = static_cast<Eigen::Index>(normal);
    return {Vector3::Ones() - 2 * Vector3::Unit(axis), 2 * at * Vector3::Unit(axis)};
  }

  bool is_mirror() const { return sign_.prod() < 0; }
  bool turns(std::size_t axis) const { return sign_[axis] < 0; }

  double coordinate(std::size_t axis, double value) const {
    const auto i = static_cast<Eigen::Index>(axis);
    return sign_[i] * value + shift_[i];
  }
  void place(std::vector<double>& positions, std::size_t axis) const {
    for (double& position : positions) position = coordinate(axis, position);
  }
  void place(std::array<std::optional<Located<std::array<double, 2>>>, 3>& extents) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!extents[axis]) continue;
      auto& [lower, upper] = extents[axis]->value;
      lower = coordinate(axis, lower);
      upper = coordinate(axis, upper);
      if (turns(axis)) std::swap(lower, upper);
    }
  }
  void place(std::vector<Vector3>& points) const {
    for (Vector3& point : points) place(point);
  }
  void turn(Vector3& direction) const { direction = sign_.cwiseProduct(direction); }
  void place(Vector3& point) const { point = sign_.cwiseProduct(point) + shift_; }

 private:
  Placing(const Vector3& sign, const Vector3& shift) : sign_(sign), shift_(shift) {}
  Vector3 sign_, shift_;
};

/// A row's profile points its flange to (along) x (away from the plate), which does not follow a
/// reflection across the stiffeners: the profile itself is reflected then.
void place_stiffeners(const Placing& placing, const PlateModel& plate, StiffenersModel& row) {
  if (plate.is_free()) {  // mirrored, its own axes keep to its sides, and its normal turns about
    if (!placing.is_mirror()) return;
    row.side = -row.side;
    if (row.profile) row.profile = structure::seen(*row.profile, false, false, true);
    return;
  }
  const std::size_t across = 3 - row.along - plate.normal;
  if (across > 2) return;  // along the normal: complained about elsewhere
  if (!row.first && placing.turns(across) && plate.extent[across])
    row.first = plate.extent[across]->value[0];
  if (row.first) row.first = placing.coordinate(across, *row.first);
  if (placing.turns(plate.normal)) row.side = -row.side;
  if (row.profile && (placing.turns(plate.normal) || placing.turns(across)))
    row.profile = structure::seen(*row.profile, false, false, true);
}

void place_part(const Placing& placing, PlateModel& plate) {
  if (plate.stiffeners) place_stiffeners(placing, plate, *plate.stiffeners);
  placing.place(plate.at, plate.normal);
  placing.place(plate.extent);
  if (plate.corners) placing.place(plate.corners->value);
  if (plate.edges)
    for (EdgeModel& edge : plate.edges->value) placing.place(edge.points);
}

/// A profile's axis 3 is (along) x (axis 2), which does not follow a reflection.
void place_part(const Placing& placing, BarModel& bar) {
  placing.place(bar.points.value);
  if (!placing.is_mirror()) return;
  if (bar.towards) placing.turn(*bar.towards);
  std::optional<structure::Profile>& profile = bar.section.value;
  if (profile) profile = structure::seen(*profile, false, false, true);
}

void place_part(const Placing& placing, PadModel& pad) {
  if (pad.is_in_plate_frame) return;
  pad.at = placing.coordinate(pad.normal, pad.at);
  placing.place(pad.extent);
}

/// In the frame of its plate, which is copied with it, a lug stays; but mirrored, n turns about.
void place_in_plate(const Placing& placing, LugModel& lug) {
  constexpr std::size_t n = 2;
  if (!placing.is_mirror()) return;
  lug.pin_in_plate.z() = -lug.pin_in_plate.z();
  if (lug.normal == n) lug.at = -lug.at;
  if (!lug.extent[n]) return;
  const std::array<double, 2> reach = lug.extent[n]->value;
  lug.extent[n]->value = {-reach[1], -reach[0]};
}

void place_part(const Placing& placing, LugModel& lug) {
  if (lug.is_in_plate_frame) {
    place_in_plate(placing, lug);
    return;
  }
  lug.at = placing.coordinate(lug.normal, lug.at);
  placing.place(lug.extent);
  placing.place(lug.pin.value);
}

void place_part(const Placing& placing, LoadEdge& edge) {
  placing.place(edge.from);
  placing.place(edge.to);
  placing.turn(edge.outside);
}

/// How far parts reach along an axis, m; empty where it is not known.
using Reach = std::vector<double>;

void add_points(const std::vector<Vector3>& points, std::size_t axis, Reach& reach) {
  for (const Vector3& point : points) reach.push_back(point[axis]);
}

Reach reach_of(const std::array<std::optional<Located<std::array<double, 2>>>, 3>& extents,
               std::size_t axis) {
  if (!extents[axis]) return {};
  return {extents[axis]->value[0], extents[axis]->value[1]};
}

Reach reach_of(const PlateModel& plate, std::size_t axis) {
  Reach reach;
  if (plate.corners) add_points(plate.corners->value, axis, reach);
  if (plate.edges)
    for (const EdgeModel& edge : plate.edges->value) add_points(edge.points, axis, reach);
  if (plate.is_free()) return reach;
  return axis == plate.normal ? plate.at : reach_of(plate.extent, axis);
}

Reach reach_of(const BarModel& bar, std::size_t axis) {
  Reach reach;
  add_points(bar.points.value, axis, reach);
  return reach;
}

Reach reach_of(const LoadEdge& edge, std::size_t axis) {
  Reach reach;
  add_points({edge.from, edge.to}, axis, reach);
  return reach;
}

template <class T>
Reach reach_of_one(const T& part, std::size_t axis) {
  if (part.is_in_plate_frame) return {};
  return axis == part.normal ? Reach{part.at} : reach_of(part.extent, axis);
}
Reach reach_of(const PadModel& pad, std::size_t axis) { return reach_of_one(pad, axis); }
Reach reach_of(const LugModel& lug, std::size_t axis) { return reach_of_one(lug, axis); }

Reach reach_of(const OpeningModel& opening, std::size_t axis) {
  Reach reach = reach_of(opening.extent, axis);
  add_points(opening.corners, axis, reach);
  add_points(opening.centres, axis, reach);
  return reach;
}

/// Parts that are copied, by their names.
struct Selection {
  std::set<std::string> plates, bars, openings, pads, lugs, edges;
};

/// Where they stand in the lists of a block.
struct Places {
  std::vector<std::size_t> plates, bars, openings, pads, lugs, edges;
};

bool has_name(const std::set<std::string>& names, const std::string& name) {
  return names.count(name) != 0;
}

class Copying {
 public:
  Copying(BlockModel block, Reading* reading) : block_(std::move(block)), reading_(reading) {
    names_ = select({});
  }

  void repeat(const RepeatModel& repeat) {
    if (repeat.count < 1 || !repeat.step.value.allFinite() || repeat.step.value.isZero(same_place))
      return;
    Selection selected = select(repeat);
    keep_with_plates(&repeat, selected);
    const Places places = places_of(selected);
    for (int i = 1; i <= repeat.count && has_room(repeat); ++i)
      copy(repeat, selected, places, Placing::moved(i * repeat.step.value),
           fmt::format("{}{}", repeat.label, i));
  }

  void mirror(const MirrorModel& mirror) {
    if (!std::isfinite(mirror.at.value) || !has_room(mirror)) return;
    Selection selected = select(mirror);
    keep_with_plates(&mirror, selected);
    keep_beside(mirror, block_.plates, "plate", selected.plates);
    keep_beside(mirror, block_.bars, "bar", selected.bars);
    keep_with_plates(nullptr, selected);  // a plate in the mirror plane stays with what it carries
    keep_openings_beside(mirror, selected);
    keep_beside(mirror, block_.pads, "pad", selected.pads);
    keep_beside(mirror, block_.lugs, "lug", selected.lugs);
    drop_own_images(mirror, selected.edges);
    keep_beside(mirror, block_.edges, "edge", selected.edges);
    const std::size_t plates = block_.plates.size(), openings = block_.openings.size();
    copy(mirror, selected, places_of(selected), Placing::mirrored(mirror.normal, mirror.at.value),
         mirror.label);
    drop_in_plane(mirror, plates, openings);
  }

  BlockModel take() { return std::move(block_); }

 private:
  void complain(const Mark& mark, std::string message, std::vector<std::string> hints) {
    if (reading_) reading_->error(mark, std::move(message), std::move(hints));
  }

  template <class T>
  static void select(const std::vector<T>& items, const CopiedParts& what,
                     std::set<std::string>& selected) {
    for (const T& item : items) {
      const auto is_meant = [&](const Located<std::string>& name) {
        return name.value == item.name.value || name.value == item.origin;
      };
      if (!what.parts || std::any_of(what.parts->begin(), what.parts->end(), is_meant))
        selected.insert(item.name.value);
    }
  }

  Selection select(const CopiedParts& what) {
    Selection selected;
    select(block_.plates, what, selected.plates);
    select(block_.bars, what, selected.bars);
    select(block_.openings, what, selected.openings);
    select(block_.pads, what, selected.pads);
    select(block_.lugs, what, selected.lugs);
    select(block_.edges, what, selected.edges);
    for (const OpeningModel& opening : block_.openings)
      if (has_name(selected.plates, opening.plate.value))
        selected.openings.insert(opening.name.value);
    if (what.parts)
      for (const Located<std::string>& name : *what.parts) require_part(name);
    return selected;
  }

  void require_part(const Located<std::string>& name) {
    std::vector<std::string> names;
    const auto add = [&](const std::vector<std::string>& more) {
      names.insert(names.end(), more.begin(), more.end());
    };
    add(names_of(block_.plates));
    add(names_of(block_.bars));
    add(names_of(block_.openings));
    add(names_of(block_.pads));
    add(names_of(block_.lugs));
    add(names_of(block_.edges));
    if (name.value.empty() || std::find(names.begin(), names.end(), name.value) != names.end())
      return;
    complain(
        name.mark,
        fmt::format("\"{}\" is to be copied, and the block has no part of that name", name.value),
        {names_hint("its parts are", names, name.value)});
  }

  /// What is given in the frame of a plate is copied with it alone.
  /// @param what hears complaints; null: nobody does.
  void keep_with_plates(const CopiedParts* what, Selection& selected) {
    const auto keep = [&](const auto& items, const char* noun, const auto& base,
                          const std::set<std::string>& bases, std::set<std::string>& names) {
      for (const auto& item : items) {
        if (!item.is_in_plate_frame || has_name(bases, base(item)) ||
            names.erase(item.name.value) == 0 || !what)
          continue;
        complain(what->place,
                 fmt::format("{} {} would be copied without {}, in whose frame it is", noun,
                             item.name.value, base(item)),
                 {"name both"});
      }
    };
    keep(
        block_.pads, "pad", [](const PadModel& pad) { return pad.plate.value; }, selected.plates,
        selected.pads);
    keep(
        block_.lugs, "lug", [](const LugModel& lug) { return lug.pad.value; }, selected.pads,
        selected.lugs);
  }

  /// Complains once when there are too many parts.
  bool has_room(const CopiedParts& what) {
    if (copies_ <= most_copies) return true;
    if (!is_full_)
      complain(what.place, fmt::format("there would be more than {} copies of parts", most_copies),
               {"take a smaller count, or fewer parts"});
    is_full_ = true;
    return false;
  }

  template <class T>
  static std::vector<std::size_t> places_of(const std::vector<T>& items,
                                            const std::set<std::string>& names) {
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < items.size(); ++i)
      if (has_name(names, items[i].name.value)) places.push_back(i);
    return places;
  }

  Places places_of(const Selection& selected) const {
    return {places_of(block_.plates, selected.plates),     places_of(block_.bars, selected.bars),
            places_of(block_.openings, selected.openings), places_of(block_.pads, selected.pads),
            places_of(block_.lugs, selected.lugs),         places_of(block_.edges, selected.edges)};
  }

  void copy(const CopiedParts& what, const Selection& selected, const Places& places,
            const Placing& placing, const std::string& suffix) {
    const auto refer = [&](const std::set<std::string>& copied, std::string& name) {
      if (has_name(copied, name)) name += "." + suffix;
    };
    copy_items(what, "plate", suffix, places.plates, block_.plates, names_.plates,
               [&](PlateModel& plate) { place_part(placing, plate); });
    copy_items(what, "bar", suffix, places.bars, block_.bars, names_.bars,
               [&](BarModel& bar) { place_part(placing, bar); });
    copy_items(what, "opening", suffix, places.openings, block_.openings, names_.openings,
               [&](OpeningModel& opening) {
                 place_opening(placing, opening);
                 refer(selected.plates, opening.plate.value);
               });
    copy_items(what, "pad", suffix, places.pads, block_.pads, names_.pads, [&](PadModel& pad) {
      place_part(placing, pad);
      refer(selected.plates, pad.plate.value);
    });
    copy_items(what, "lug", suffix, places.lugs, block_.lugs, names_.lugs, [&](LugModel& lug) {
      place_part(placing, lug);
      refer(selected.pads, lug.pad.value);
    });
    copy_items(what, "edge", suffix, places.edges, block_.edges, names_.edges,
               [&](LoadEdge& edge) { place_part(placing, edge); });
  }

  void place_opening(const Placing& placing, OpeningModel& opening) const {
    const PlateModel* plate =
        opening.at.empty() ? nullptr : find_by_name(block_.plates, opening.plate.value);
    if (plate) placing.place(opening.at, plate->normal);
    placing.place(opening.extent);
    placing.place(opening.corners);
    placing.place(opening.centres);
  }

  template <class T, class Place>
  void copy_items(const CopiedParts& what, const char* noun, const std::string& suffix,
                  const std::vector<std::size_t>& places, std::vector<T>& items,
                  std::set<std::string>& names, const Place& place) {
    for (const std::size_t i : places) {
      T copy = items[i];
      if (copy.origin.empty()) copy.origin = copy.name.value;
      copy.name.value += "." + suffix;
      if (!names.insert(copy.name.value).second) {
        complain(what.place,
                 fmt::format("a copy of {} {} would be called {}, as one is already", noun,
                             items[i].name.value, copy.name.value),
                 {fmt::format("give a label: copies of {0} are then called {0}.<label>...",
                              items[i].name.value)});
        continue;
      }
      place(copy);
      items.push_back(std::move(copy));
      ++copies_;
    }
  }

  /// Leaves in the selection what lies beside the mirror plane; complains about what it cuts.
  template <class T>
  void keep_beside(const MirrorModel& mirror, const std::vector<T>& items, const char* noun,
                   std::set<std::string>& selected) {
    for (const T& item : items)
      if (has_name(selected, item.name.value) && !is_beside(mirror, item, noun))
        selected.erase(item.name.value);
  }

  template <class T>
  bool is_beside(const MirrorModel& mirror, const T& item, const char* noun) {
    const Reach reach = reach_of(item, mirror.normal);
    if (reach.empty()) return true;
    const double lower = *std::min_element(reach.begin(), reach.end()) - mirror.at.value;
    const double upper = *std::max_element(reach.begin(), reach.end()) - mirror.at.value;
    if (lower < -same_place && upper > same_place) {
      complain(mirror.at.mark,
               fmt::format("the mirror plane {} = {:.6g} m passes through {} {}, which reaches "
                           "from {:.6g} m to {:.6g} m",
                           "xyz"[mirror.normal], mirror.at.value, noun, item.name.value,
                           lower + mirror.at.value, upper + mirror.at.value),
               {"what is mirrored lies on one side of the plane: end it there, or name the parts "
                "that are mirrored without it"});
      return false;
    }
    return lower < -same_place || upper > same_place;
  }

  /// An edge across the mirror plane, from one side as far to the other, is its own image.
  void drop_own_images(const MirrorModel& mirror, std::set<std::string>& selected) const {
    const Placing placing = Placing::mirrored(mirror.normal, mirror.at.value);
    for (const LoadEdge& edge : block_.edges) {
      LoadEdge image = edge;
      place_part(placing, image);
      const auto is_at = [](const Vector3& a, const Vector3& b) {
        return (a - b).norm() < same_place;
      };
      if (is_at(image.from, edge.to) && is_at(image.to, edge.from) &&
          is_at(image.outside, edge.outside))
        selected.erase(edge.name.value);
    }
  }

  /// An opening is copied with its plate. In a plate that is not copied it has a place of its own;
  /// across the mirror's axis its image is itself.
  void keep_openings_beside(const MirrorModel& mirror, Selection& selected) {
    for (const OpeningModel& opening : block_.openings) {
      if (!has_name(selected.openings, opening.name.value) ||
          has_name(selected.plates, opening.plate.value))
        continue;
      const PlateModel* plate = find_by_name(block_.plates, opening.plate.value);
      const bool is_own_image = plate && !plate->is_free() && plate->normal == mirror.normal;
      if (is_own_image || !is_beside(mirror, opening, "opening"))
        selected.openings.erase(opening.name.value);
    }
  }

  /// Of equal plates those that stand in the mirror plane are not doubled.
  void drop_in_plane(const MirrorModel& mirror, std::size_t first_plate,
                     std::size_t first_opening) {
    const auto drop = [&](std::vector<double>& positions) {
      positions.erase(
          std::remove_if(positions.begin(), positions.end(),
                         [&](double at) { return std::abs(at - mirror.at.value) < same_place; }),
          positions.end());
    };
    for (std::size_t i = first_plate; i < block_.plates.size(); ++i)
      if (block_.plates[i].normal == mirror.normal) drop(block_.plates[i].at);
    for (std::size_t i = block_.openings.size(); i-- > first_opening;) {
      OpeningModel& opening = block_.openings[i];
      const PlateModel* plate = find_by_name(block_.plates, opening.plate.value);
      if (opening.at.empty() || !plate || plate->is_free() || plate->normal != mirror.normal)
        continue;
      drop(opening.at);
      if (opening.at.empty())
        block_.openings.erase(block_.openings.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }

  BlockModel block_;
  Reading* reading_;
  Selection names_;  ///< of all parts
  int copies_ = 0;
  bool is_full_ = false;
};

template <class T>
Table<T>& add_parts_key(Table<T>& table) {
  return table
      .optional(
          "parts", &T::parts, list_of(located(reference()), 1),
          "names of plates, bars, openings, pads, lugs and edges, each with the copies made of it "
          "before; openings go with their plate; all parts of the block if left out")
      .place(&T::place);
}

}  // namespace

Format<RepeatModel> repeat_format() {
  Table<RepeatModel> table(
      "repetition",
      "Copies of parts, the first moved by the step, the second by twice the step, and so on. "
      "Those of a part web are named web.1, web.2, ...; the part itself keeps its name and place. "
      "A copy of a pad, opening or lug belongs to the copied plate or pad, if that is copied too.");
  add_parts_key(table)
      .required("count", &RepeatModel::count, integer(Range::between(1, most_copies)),
                "how many copies, besides the part itself")
      .required("step", &RepeatModel::step, position_format(), "from one to the next")
      .optional("label", &RepeatModel::label, name(),
                "stands before the number in names of copies: web.<label>1")
      .rule([](const RepeatModel& repeat, Reading& reading, const Mark&) {
        if (repeat.step.value.allFinite() && repeat.step.value.isZero(same_place))
          reading.error(repeat.step.mark, "the step of " + reading.owner() + " has no length",
                        {"the copies would lie upon one another"});
      });
  return table.format();
}

Format<MirrorModel> mirror_format() {
  Table<MirrorModel> table(
      "mirror",
      "Copies of parts on the other side of a plane, made after all that is repeated; stiffeners "
      "are mirrored with their plates. That of a part web is named web.mirrored. What lies in the "
      "plane itself is not copied; nothing may reach through it.");
  add_parts_key(table)
      .required("normal", &MirrorModel::normal, choice<std::size_t>({{"x", 0}, {"y", 1}, {"z", 2}}),
                "axis across the plane")
      .required("at", &MirrorModel::at, quantity(Dimension::length), "position of the plane")
      .by_default("label", &MirrorModel::label, name(), "mirrored", "in names of copies");
  return table.format();
}

namespace {

/// Pins that are given in the frames of plates have their places in the block's.
BlockModel with_pins_in_place(BlockModel block) {
  for (LugModel& lug : block.lugs) {
    if (!lug.is_in_plate_frame) continue;
    if (const auto frame = block.find_frame(lug)) lug.pin.value = frame->point(lug.pin_in_plate);
  }
  return block;
}

}  // namespace

BlockModel with_copies(const BlockFile& file, Reading* reading) {
  if (file.repeats.empty() && file.mirrors.empty()) return with_pins_in_place(file);
  if (file.mesh) {
    const Mark& mark =
        file.repeats.empty() ? file.mirrors.front().place : file.repeats.front().place;
    if (reading)
      reading->error(mark, "the block is a mesh, whose deck has the plates as they are",
                     {"parts of plates are repeated and mirrored"});
    return file;
  }
  Copying copying(file, reading);
  for (const RepeatModel& repeat : file.repeats) copying.repeat(repeat);
  for (const MirrorModel& mirror : file.mirrors) copying.mirror(mirror);
  return with_pins_in_place(copying.take());
}

}  // namespace blocklift::pipeline
