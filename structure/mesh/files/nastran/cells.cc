// Shells, bars, beams and rods.

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "structure/mesh/beams/beam_axes.h"
#include "structure/mesh/files/deck/parted_edges.h"
#include "structure/mesh/files/deck/shell_geometry.h"
#include "structure/mesh/files/nastran/line_loads.h"
#include "structure/mesh/files/nastran/model.h"
#include "structure/mesh/shell_shape.h"

namespace blocklift::structure {

namespace {

/// Where a shell's card has what.
struct ShellLayout {
  std::size_t corners = 4;
  std::size_t middles = 0;  ///< how many grids between corners follow them
  std::size_t angle = 6, offset = 7, flag = 9, thicknesses = 10;
};

const std::unordered_map<std::string, ShellLayout>& shell_layouts() {
  static const std::unordered_map<std::string, ShellLayout> layouts{
      {"CQUAD4", {4, 0, 6, 7, 9, 10}},    {"CQUADR", {4, 0, 6, 7, 9, 10}},
      {"CTRIA3", {3, 0, 5, 6, 9, 10}},    {"CTRIAR", {3, 0, 5, 6, 9, 10}},
      {"CQUAD8", {4, 4, 14, 15, 16, 10}}, {"CTRIA6", {3, 3, 8, 9, 13, 10}}};
  return layouts;
}

class Shells {
 public:
  explicit Shells(NastranModel& model)
      : model_(model), mesh_(model.deck.mesh), edges_(mesh_, model.log, apart_of_shells) {}

  void read() {
    NastranModel::Handlers handlers;
    for (const auto& [name, layout] : shell_layouts())
      handlers[name] = [this, &layout = layout](const CardView& card) { add(card, layout); };
    model_.for_each(handlers);
  }

 private:
  void add(const CardView& card, const ShellLayout& layout) {
    Shell shell;
    shell.label = model_.new_element(card);
    const long property = card.label(1, "property", shell.label);
    std::vector<int> corners;
    for (std::size_t i = 0; i < layout.corners; ++i)
      corners.push_back(model_.vertex(card, 2 + i, "corner"));
    const std::vector<int> middles = read_middles(card, layout);
    if (!drop_repeated(card, corners, middles.empty()))
      throw CardError{fmt::format("{} {} has two corners in one grid", card.name(), card.text(0))};
    shell.vertices = lexicographic(corners);
    const double thickness = own_thickness(card, layout, property, shell);
    const double offset =
        nastran_plate_offset(model_, card, layout.offset,
                             thickness > 0 ? thickness : nastran_shell_thickness(model_, property));
    shell.section = nastran_shell_section(model_, property, thickness, offset);
    if (shell.taper >= 0 && (shell.section < 0 || mesh_.section_of(shell).laminate >= 0)) {
      shell.taper = -1;
      model_.log.remark(card.line(), card.name() +
                                         ": thicknesses at corners of plates of layers, or without "
                                         "a property, are not used");
    }
    shell.region = nastran_region(model_, property, material_of(shell));
    const auto place = static_cast<int>(mesh_.shells.size());
    if (!middles.empty()) curve(card, shell, place, corners, middles);
    if (is_folded(mesh_, shell))
      throw CardError{fmt::format(
          "element {} is folded: its corners are not in turn about it, one turns inwards{}",
          shell.label, middles.empty() ? "" : ", or middles of its edges lie far off")};
    if (shell.section >= 0 && mesh_.section_of(shell).laminate >= 0)
      shell.laminate_axis = axis_1(card, layout, corners);
    if (shell.section < 0) without_section_.insert(shell.region);
    mesh_.shells.push_back(shell);
    model_.shell_of[shell.label] = place;
    note_groups();
  }

  int material_of(const Shell& shell) const {
    return shell.section < 0 ? 0 : mesh_.section_of(shell).material;
  }

  void note_groups() {
    auto& groups = model_.deck.groups_without_thickness;
    if (groups.size() == without_section_.size()) return;
    groups.clear();
    for (const int region : without_section_) groups.push_back(mesh_.regions[region].name);
  }

  /// A quadrangle with a corner twice is a triangle; its remaining corners keep their turn.
  bool drop_repeated(const CardView& card, std::vector<int>& corners, bool is_linear) {
    const std::set<int> distinct(corners.begin(), corners.end());
    if (distinct.size() == corners.size()) return true;
    if (distinct.size() != 3 || !is_linear) return false;
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    if (corners.size() == 4 && corners.front() == corners.back()) corners.pop_back();
    if (corners.size() != 3) return false;
    model_.log.remark(card.line(), card.name() + " with a corner twice is read as a triangle");
    return true;
  }

  std::vector<int> read_middles(const CardView& card, const ShellLayout& layout) {
    std::vector<int> middles;
    bool any = false;
    for (std::size_t i = 0; i < layout.middles; ++i) {
      const std::size_t field = 2 + layout.corners + i;
      const bool given = card.has(field) && !card.is(field, "0");
      any = any || given;
      middles.push_back(given ? model_.vertex(card, field, "middle of an edge") : -1);
    }
    if (!any) middles.clear();
    return middles;
  }

  void curve(const CardView& card, Shell& shell, int place, const std::vector<int>& corners,
             const std::vector<int>& middles) {
    std::vector<Vector3> at_corners, at_middles;
    for (const int corner : corners) at_corners.push_back(model_.place(corner));
    for (std::size_t i = 0; i < middles.size(); ++i) {
      at_middles.push_back(
          middles[i] >= 0 ? model_.place(middles[i])
                          : Vector3((at_corners[i] + at_corners[(i + 1) % corners.size()]) / 2));
      if (middles[i] < 0) continue;
      model_.middles.push_back({middles[i], place, place_of_middle(corners.size(), i)});
      edges_.take({corners[i], corners[(i + 1) % corners.size()], middles[i], shell.label,
                   card.name(), card.line()});
    }
    shell.curvature = static_cast<int>(mesh_.curved_shells.size());
    mesh_.curved_shells.push_back(quadratic_points(at_corners, at_middles));
  }

  /// Mean thickness of a shell that has one of its own, which may vary between its corners; 0: its
  /// property's.
  double own_thickness(const CardView& card, const ShellLayout& layout, long property,
                       Shell& shell) {
    std::vector<double> around;
    const bool is_relative = card.is(layout.flag, "1");
    const bool has_any = [&] {
      for (std::size_t i = 0; i < layout.corners; ++i)
        if (card.has(layout.thicknesses + i)) return true;
      return false;
    }();
    if (!has_any) return 0;
    const double of_property = nastran_shell_thickness(model_, property);
    for (std::size_t i = 0; i < layout.corners; ++i) {
      const std::size_t field = layout.thicknesses + i;
      double thickness = card.has(field) ? card.real(field, "thickness at a corner") *
                                               (is_relative ? of_property : model_.units.length)
                                         : of_property;
      if (!(thickness > 0))
        throw CardError{
            fmt::format("{} {} has no positive thickness at a corner", card.name(), card.text(0))};
      around.push_back(thickness);
    }
    const auto [least, most] = std::minmax_element(around.begin(), around.end());
    // Of a quadrangle that is read as a triangle it is not known which corner went.
    if (*most > (1 + 1e-9) * *least && shell.is_triangle() == (around.size() == 3)) {
      shell.taper = static_cast<int>(mesh_.shell_tapers.size());
      mesh_.shell_tapers.push_back(lexicographic(around));
    }
    const double mean =
        std::accumulate(around.begin(), around.end(), 0.0) / static_cast<double>(around.size());
    return std::abs(mean - of_property) < 1e-9 * mean ? 0 : mean;
  }

  Vector3 axis_1(const CardView& card, const ShellLayout& layout, const std::vector<int>& corners) {
    Vector3 side = (model_.place(corners[1]) - model_.place(corners[0])).normalized();
    if (!card.has(layout.angle)) return side;
    if (card.is_integer(layout.angle)) {
      const long system = card.integer(layout.angle, "material system");
      return model_.axes_at(system, corners[0]).col(0);
    }
    const double angle = card.real(layout.angle, "angle of the material") * std::numbers::pi / 180;
    const Vector3 normal = side.cross(model_.place(corners.back()) - model_.place(corners[0]));
    return Eigen::AngleAxisd(angle, normal.normalized()) * side;
  }

  NastranModel& model_;
  Mesh& mesh_;
  std::set<int> without_section_;
  PartedEdges edges_;
};

class Bars {
 public:
  explicit Bars(NastranModel& model) : model_(model), mesh_(model.deck.mesh) {}

  void read() {
    for (const NastranCard& card : model_.bulk.cards) {
      if (card.name != "PLOAD1") continue;
      const CardView load(model_.bulk, card);
      if (const auto label = to_integer(load.text(1))) loads_.emplace(*label, load);
    }
    model_.for_each(
        {{"BAROR", [&](const CardView& card) { take_defaults(card, bar_defaults_); }},
         {"BEAMOR", [&](const CardView& card) { take_defaults(card, beam_defaults_); }}});
    model_.for_each({{"CBAR", [&](const CardView& card) { add_bar(card); }},
                     {"CBEAM", [&](const CardView& card) { add_bar(card); }},
                     {"CROD", [&](const CardView& card) { add_rod(card); }},
                     {"CTUBE", [&](const CardView& card) { add_rod(card); }},
                     {"CONROD", [&](const CardView& card) { add_rod_without_property(card); }}});
  }

 private:
  /// What BAROR or BEAMOR says of bars that leave it out.
  struct Defaults {
    std::optional<CardView> card;
    const CardView* find(std::size_t i) const { return card && card->has(i) ? &*card : nullptr; }
  };

  // BAROR blank PID blank blank X1/G0 X2 X3 OFFT
  static void take_defaults(const CardView& card, Defaults& defaults) {
    if (defaults.card) throw CardError{fmt::format("a second {}", card.name())};
    defaults.card = card;
  }
  const Defaults& defaults_of(const CardView& card) const {
    return card.name() == "CBAR" ? bar_defaults_ : beam_defaults_;
  }

  long property_of(const CardView& card, long otherwise) const {
    const CardView* given = card.has(1) ? nullptr : defaults_of(card).find(1);
    return given ? given->label(1, "property") : card.label(1, "property", otherwise);
  }

  // CBAR EID PID GA GB X1/G0 X2 X3 OFFT / PA PB W1A W2A W3A W1B W2B W3B
  void add_bar(const CardView& card) {
    if (model_.properties.empty()) {  // Gmsh writes the curves of a mesh so, along every plate
      model_.log.leave_out(card.name(), "lines: the deck has no properties at all");
      throw AlreadySaid{};  // not counted as used
    }
    Beam beam = begin(card, 2);
    const long property = property_of(card, beam.label);
    const NastranBar bar = nastran_bar(model_, property);
    beam.section = bar.section;
    beam.is_rod = bar.is_rod;
    const std::string options = option_of(card);
    const Eigen::Matrix3d axes_a = model_.output_axes(beam.vertices[0]);
    const Vector3 line = model_.place(beam.vertices[1]) - model_.place(beam.vertices[0]);
    beam.axis_2 = direction(card, beam, options[0] == 'B' ? Eigen::Matrix3d::Identity() : axes_a);
    if (!bar.is_rod && beam.axis_2.isZero(0))
      throw CardError{fmt::format("{} {} has neither a vector nor a grid that orients it",
                                  card.name(), card.text(0))};
    if (!bar.is_rod && !(line.cross(beam.axis_2).norm() > 1e-6 * line.norm() * beam.axis_2.norm()))
      throw CardError{fmt::format("{} {} runs along the vector that is to orient it", card.name(),
                                  card.text(0))};
    if (bar.is_rod) {
      beam.axis_2 = line.unitOrthogonal();
      model_.log.remark(card.line(), card.name() + " without bending stiffness is taken as a rod");
    }
    const Eigen::Matrix3d own = axes_along(line, beam.axis_2).transpose();
    for (std::size_t end = 0; end < 2; ++end) {
      const Vector3 given(card.real(10 + 3 * end, "offset", 0.0),
                          card.real(11 + 3 * end, "offset", 0.0),
                          card.real(12 + 3 * end, "offset", 0.0));
      const Eigen::Matrix3d axes =
          options[1 + end] == 'O' ? own : model_.output_axes(beam.vertices[end]);
      beam.offset[end] = model_.units.length * (axes * given);
      if (card.has(8 + end) && !card.is(8 + end, "0"))
        beam.release[end] = card.components(8 + end, "pin flags");
    }
    if (card.name() == "CBEAM" && (card.has(16) || card.has(17)))
      model_.log.leave_out("CBEAM", "warping (SA, SB)");
    beam.end_section = bar.end_section;
    add_pieces(beam, bar, property);
  }

  /// A beam, in pieces from station to station where its section is not linear from end to end, and
  /// to where loads want it divided.
  void add_pieces(const Beam& whole, const NastranBar& bar, long property) {
    const auto [first, last] = whole.vertices;
    model_.offsets_of_bar[static_cast<int>(mesh_.beams.size())] = whole.offset;
    if (!bar.stations.empty() && runs_along_shell(first, last))
      throw CardError{fmt::format(
          "the section of property {} is not linear from end to end, and its beam runs along the "
          "edge of a plate: divide the beam and the plate at its stations",
          property)};
    const Vector3 from = model_.place(first), line = model_.place(last) - from;
    const Eigen::Matrix3d axes = axes_along(line + whole.offset[1] - whole.offset[0], whole.axis_2);
    const auto offset = [&](double share, const Eigen::Vector2d& centroid) -> Vector3 {
      return whole.offset[0] + share * (whole.offset[1] - whole.offset[0]) +
             axes.bottomRows<2>().transpose() * centroid;
    };
    // Without stations it may taper from end to end; with them it ends as the last of these says.
    NastranStation end{1, whole.section, bar.end_centroid};
    if (whole.end_section >= 0) end.section = whole.end_section;
    std::vector<NastranStation> stations = with_divisions(whole, bar, end);
    stations.push_back(end);
    Beam piece = whole;
    piece.offset[0] = offset(0, bar.centroid);
    for (std::size_t i = 0; i < stations.size(); ++i) {
      const NastranStation& station = stations[i];
      const bool is_last = i + 1 == stations.size();
      piece.vertices[1] = is_last ? last : new_vertex(from + station.share * line);
      piece.end_section = station.section == piece.section ? -1 : station.section;
      piece.offset[1] = offset(station.share, station.centroid);
      piece.release[1] = is_last ? whole.release[1] : BeamRelease{};
      add(piece, property);
      piece.vertices[0] = piece.vertices[1];
      piece.section = station.section;
      piece.offset[0] = piece.offset[1];
      piece.release[0] = BeamRelease{};
    }
  }

  /// The stations of a bar's section, and places between them at which its loads want it divided.
  /// Along a plate's edge it stays whole, and a rod's pieces would be hinged to each other.
  std::vector<NastranStation> with_divisions(const Beam& whole, const NastranBar& bar,
                                             const NastranStation& end) {
    std::vector<NastranStation> all = bar.stations;
    const auto [first, last] = loads_.equal_range(whole.label);
    if (first == last || whole.is_rod || runs_along_shell(whole.vertices[0], whole.vertices[1]))
      return all;
    const double length = (model_.place(whole.vertices[1]) + whole.offset[1] -
                           model_.place(whole.vertices[0]) - whole.offset[0])
                              .norm();
    for (auto load = first; load != last; ++load) {
      try {
        for (const double share :
             divisions_by_line_load(load->second, length / model_.units.length))
          divide(all, {0, whole.section, bar.centroid}, end, share);
      } catch (const CardError&) {  // said where loads are read
      }
    }
    return all;
  }

  /// Adds a station, whose section lies between its neighbours', unless there is one.
  void divide(std::vector<NastranStation>& stations, const NastranStation& begin,
              const NastranStation& end, double share) {
    constexpr double least = 1e-6;
    const auto next = std::find_if(stations.begin(), stations.end(), [&](const auto& station) {
      return station.share > share - least;
    });
    if (next != stations.end() && next->share < share + least) return;
    const NastranStation& a = next == stations.begin() ? begin : *std::prev(next);
    const NastranStation& b = next == stations.end() ? end : *next;
    const double t = (share - a.share) / (b.share - a.share);
    NastranStation station{share, a.section, a.centroid + t * (b.centroid - a.centroid)};
    if (a.section != b.section) {
      Beam between;
      between.section = a.section;
      between.end_section = b.section;
      const BeamSection section = section_at(mesh_, between, t);
      station.section = static_cast<int>(mesh_.beam_sections.size());
      mesh_.beam_sections.push_back(section);
    }
    stations.insert(next, station);
  }

  /// A vertex that no grid of the deck is: it has a number beyond all of theirs.
  int new_vertex(const Vector3& place) {
    std::vector<long>& labels = mesh_.vertex_labels;
    if (next_label_ == 0) next_label_ = *std::max_element(labels.begin(), labels.end()) + 1;
    labels.push_back(next_label_++);
    mesh_.vertices.push_back(place);
    model_.output_system.push_back(0);
    return static_cast<int>(mesh_.vertices.size()) - 1;
  }

  bool runs_along_shell(int a, int b) {
    if (edges_.empty())
      for (const Shell& shell : mesh_.shells) {
        const auto& v = shell.vertices;
        const std::vector<int> corners = shell.is_triangle() ? std::vector{v[0], v[1], v[2]}
                                                             : std::vector{v[0], v[1], v[3], v[2]};
        for (std::size_t i = 0; i < corners.size(); ++i)
          edges_.insert(std::minmax(corners[i], corners[(i + 1) % corners.size()]));
      }
    return edges_.count(std::minmax(a, b)) > 0;
  }

  Beam begin(const CardView& card, std::size_t first) {
    Beam beam;
    beam.label = model_.new_element(card);
    for (std::size_t end = 0; end < 2; ++end)
      beam.vertices[end] = model_.vertex(card, first + end, "end");
    const double length = (model_.place(beam.vertices[1]) - model_.place(beam.vertices[0])).norm();
    if (!(length > 1e-9))
      throw CardError{fmt::format("{} {} has no length", card.name(), card.text(0))};
    return beam;
  }

  void add(Beam& beam, long property) {
    beam.region = nastran_region(model_, property, mesh_.section_of(beam).material);
    model_.beam_of.try_emplace(beam.label, static_cast<int>(mesh_.beams.size()));
    mesh_.beams.push_back(beam);
  }

  std::string option_of(const CardView& card) const {
    const CardView* given = card.has(7) ? &card : defaults_of(card).find(7);
    std::string option = given ? upper(given->text(7)) : "GGG";
    // A CBEAM may have a number there, the BIT of p-elements.
    const bool fits = option.size() == 3 && (option[0] == 'G' || option[0] == 'B') &&
                      option.find_first_not_of("GO", 1) == std::string::npos;
    if (!fits)
      throw CardError{
          fmt::format("OFFT \"{}\" is not known; G or B, then G or O twice, is due", option)};
    return option;
  }

  /// The vector that orients the plane of axes 1 and 2.
  Vector3 direction(const CardView& card, const Beam& beam, const Eigen::Matrix3d& axes) {
    const bool is_given = card.has(4) || card.has(5) || card.has(6);
    const Defaults& defaults = defaults_of(card);
    const CardView& source = is_given || !defaults.card ? card : *defaults.card;
    const bool is_grid = source.is_integer(4) && !source.has(5) && !source.has(6);
    if (is_grid) {
      const int grid = model_.vertex(source, 4, "grid that orients it");
      return model_.place(grid) - model_.place(beam.vertices[0]);
    }
    const Vector3 given(source.real(4, "vector that orients it", 0.0),
                        source.real(5, "vector that orients it", 0.0),
                        source.real(6, "vector that orients it", 0.0));
    if (!(given.norm() > 0)) return Vector3::Zero();
    return axes * given.normalized();
  }

  // CROD EID PID G1 G2
  void add_rod(const CardView& card) {
    Beam rod = begin(card, 2);
    const long property = card.label(1, "property", rod.label);
    rod.section = nastran_bar(model_, property).section;
    make_rod(rod);
    add(rod, property);
  }

  // CONROD EID G1 G2 MID A J C NSM
  void add_rod_without_property(const CardView& card) {
    Beam rod = begin(card, 1);
    rod.section = nastran_rod_section(model_, "CONROD", rod.label, card.label(3, "material"),
                                      card.real(4, "area", 0.0), card.real(5, "J", 0.0),
                                      card.real(7, "mass beyond the rod's", 0.0));
    make_rod(rod);
    // Elements without property share one region: no property has this number.
    add(rod, 0);
  }

  void make_rod(Beam& rod) const {
    rod.is_rod = true;
    rod.axis_2 = (model_.place(rod.vertices[1]) - model_.place(rod.vertices[0])).unitOrthogonal();
  }

  NastranModel& model_;
  Mesh& mesh_;
  Defaults bar_defaults_, beam_defaults_;
  std::unordered_multimap<long, CardView> loads_;  ///< PLOAD1 by their elements
  std::set<std::pair<int, int>>
      edges_;            ///< of shells, by their corners; found when they are needed
  long next_label_ = 0;  ///< of vertices that are made here; 0: not known yet
};

/// Cards that a material's number may stand for; what is none of plates and beams is told of where
/// an element needs it.
bool is_material(const std::string& card) {
  return card == "MAT1" || card == "MAT2" || card == "MAT3" || card == "MAT8" || card == "MAT9" ||
         card == "MAT11";
}

}  // namespace

void read_nastran_cells(NastranModel& model) {
  const auto keep = [&log = model.log](std::unordered_map<long, CardView>& all, const char* what) {
    return [&all, &log, what](const CardView& card) {
      const auto [first, is_new] = all.try_emplace(card.label(0, what), card);
      if (!is_new)
        throw CardError{fmt::format("{} {} is there twice, first at {}", what, card.text(0),
                                    log.place(first->second.line()))};
    };
  };
  // What they say is read, and counted, where an element needs it.
  const auto materials = keep(model.materials, "material");
  const auto properties = keep(model.properties, "property");
  for (const NastranCard& card : model.bulk.cards) {
    const CardView view(model.bulk, card);
    try {
      if (is_material(card.name)) materials(view);
      if (card.name == "PSHELL" || card.name == "PCOMP" || card.name == "PCOMPG" ||
          card.name == "PBAR" || card.name == "PBARL" || card.name == "PBEAM" ||
          card.name == "PBEAML" || card.name == "PROD" || card.name == "PTUBE" ||
          card.name == "PSOLID")
        properties(view);
    } catch (const CardError& error) {
      model.log.complain(card.line, card.name + ": " + error.text);
    }
  }
  Shells(model).read();
  Bars(model).read();
  if (!model.options.leave_solids_out) read_nastran_solids(model);
  remark_on_nastran_plates(model);
  for (const auto& [number, card] : model.materials)
    if (model.material_read.count(number) == 0)
      model.log.leave_out(card.name(), "some are of no element");
  for (const auto& [number, card] : model.properties)
    if (model.bar_read.count(number) == 0 && model.solid_properties.count(number) == 0 &&
        std::none_of(
            model.shell_section_of.begin(), model.shell_section_of.end(),
            [&, number = number](const auto& entry) { return std::get<0>(entry.first) == number; }))
      model.log.leave_out(card.name(), "some are of no element");
}

}  // namespace blocklift::structure
