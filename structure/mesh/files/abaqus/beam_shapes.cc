// Shapes of beams' sections.
#include "structure/mesh/files/abaqus/beam_shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "structure/mesh/files/deck/plausibility.h"

namespace blocklift::structure {

namespace {

using Fields = std::vector<std::string_view>;

class BeamShapeReader {
 public:
  explicit BeamShapeReader(AbaqusModel& model) : model_(model), mesh_(model.deck.mesh) {}

  BeamShape read_by_dimensions(const SectionBlocks& blocks) {
    const AbaqusBlock& block = *blocks.block;
    BeamShape beam;
    beam.profile = shape_of(block, block.required("SECTION"));
    beam.material = abaqus_material(model_, block.required("MATERIAL"));
    beam.axis_2 = direction(blocks);
    beam.profile.centroid += offset_by_sizes(block);
    read_details(blocks, beam);
    return beam;
  }

  // *BEAM GENERAL SECTION, SECTION = GENERAL, ELSET = , DENSITY =
  // A, I11, I12, I22, J / n1 / E, G, coefficient of expansion
  BeamShape read_general(const SectionBlocks& blocks) {
    const AbaqusBlock& block = *blocks.block;
    const std::string kind = block.value("SECTION");
    BeamShape beam;
    const double length = model_.units.length, square = length * length;
    if (kind.empty() || kind == "GENERAL") {
      if (block.data.empty()) throw CardError{"area and moments are missing"};
      const Fields fields = block.data.front().fields();
      BeamSection& section = beam.profile.section;
      section.area = abaqus_real(fields, 0, "area") * square;
      section.second_moment_2 = abaqus_real(fields, 1, "I11", 0.0) * square * square;
      section.product_23 = abaqus_real(fields, 2, "I12", 0.0) * square * square;
      section.second_moment_3 = abaqus_real(fields, 3, "I22", 0.0) * square * square;
      section.torsion = abaqus_real(fields, 4, "J", 0.0) * square * square;
      section.shear_area_2 = section.shear_area_3 = section.area;
      if (!(section.area > 0) || section.second_moment_2 < 0 || section.second_moment_3 < 0)
        throw CardError{"area must be positive, second moments not negative"};
    } else {
      beam.profile = shape_of(block, kind);
    }
    if (block.has("MATERIAL")) {  // as CalculiX has it
      beam.material = abaqus_material(model_, block.required("MATERIAL"));
      beam.axis_2 = direction(blocks);
      if (kind != "GENERAL" && !kind.empty()) beam.profile.centroid += offset_by_sizes(block);
      read_details(blocks, beam);
      return beam;
    }
    const std::size_t line = lines_of_shape(block) + 1;
    if (block.data.size() <= line) throw CardError{"the line of E and G is missing"};
    const Fields elastic = block.data[line].fields();
    Material material;
    material.name = "of " + block.required("ELSET");
    material.youngs_modulus = abaqus_real(elastic, 0, "E") * model_.units.stress();
    const double shear = abaqus_real(elastic, 1, "G") * model_.units.stress();
    material.poisson_ratio = material.youngs_modulus / (2 * shear) - 1;
    if (const std::string density = block.value("DENSITY"); !density.empty())
      material.density = to_real(density).value_or(-1) * model_.units.density();
    check_plausible(material, "the material " + material.name, model_.units, model_.log,
                    block.line);
    beam.material =
        material_place(material, abaqus_real(elastic, 2, "coefficient of expansion", 0.0));
    beam.axis_2 = direction(blocks);
    read_details(blocks, beam, shear);
    return beam;
  }

 private:
  /// CalculiX looks at the first four letters.
  static std::string short_name(const std::string& section) {
    return section.starts_with("RECT") ? "RECT" : section.starts_with("CIRC") ? "CIRC" : section;
  }

  /// Profile in axes n1 (2) and n2 (3) about the beam's node. Source: Abaqus Elements Guide, beam
  /// cross-section library; the node of an L is where the middle lines of its legs meet.
  Profile shape(const std::string& given, const std::vector<double>& d) const {
    const std::string name = short_name(given);
    const auto need = [&](std::size_t count) {
      if (d.size() < count)
        throw CardError{fmt::format("a section {} has {} dimensions", name, count)};
    };
    if (name == "RECT") return need(2), solid_rectangle(d[0], d[1]);
    if (name == "CIRC") {
      need(1);
      // Abaqus gives the radius, CalculiX the sizes along both axes.
      if (d.size() > 1 && d[0] != d[1])
        throw CardError{"an ellipse (CIRC of two sizes) is not known"};
      return solid_circle(d.size() > 1 ? d[0] / 2 : d[0]);
    }
    if (name == "PIPE" || name == "THICK PIPE") return need(2), pipe(d[0], d[0] - d[1]);
    if (name == "BOX") return need(6), box(d[0], d[1], d[2], d[4], d[5], d[3]);
    if (name == "I") {
      need(7);
      Profile profile = seen(i_beam(d[1], d[6], d[2], d[4], d[3], d[5]), true, false, false);
      profile.centroid[1] += d[1] / 2 - d[0];
      return profile;
    }
    if (name == "L") {
      need(4);
      Profile profile = seen(angle_bar(d[0], d[2], d[1], d[3]), false, true, false);
      profile.centroid[0] += d[0] - d[3] / 2;
      return profile;
    }
    if (name == "TRAPEZOID") {
      need(4);
      return solid_polygon("trapezoid", {{-d[0] / 2, -d[3]},
                                         {d[0] / 2, -d[3]},
                                         {d[2] / 2, d[1] - d[3]},
                                         {-d[2] / 2, d[1] - d[3]}});
    }
    if (name == "HEX") return need(2), hexagonal_pipe(d[0], d[1]);
    throw CardError{
        fmt::format("SECTION = {} is not known; ARBITRARY, BOX, CIRC, HEX, I, L, PIPE, RECT, "
                    "TRAPEZOID are, and GENERAL of a *BEAM GENERAL SECTION",
                    name)};
  }

  /// By the radius of the circle about it and the thickness of its walls.
  static Profile hexagonal_pipe(double radius, double thickness) {
    const double apothem = radius * std::sqrt(0.75);
    if (!(thickness > 0 && thickness < apothem))
      throw CardError{"the walls of a hexagon are to be thinner than it is wide"};
    const auto corners = [](double around) {
      std::vector<Eigen::Vector2d> places;
      for (int i = 0; i < 6; ++i)
        places.emplace_back(around * std::cos(i * std::numbers::pi / 3),
                            around * std::sin(i * std::numbers::pi / 3));
      return places;
    };
    std::vector<Wall> walls;
    for (int i = 0; i < 6; ++i) walls.push_back({i, (i + 1) % 6, thickness});
    const auto inside = [&](double depth) { return radius * (1 - depth / apothem); };
    return outlined_profile("hexagon", {{corners(radius)}, {corners(inside(thickness)), true}},
                            corners(inside(thickness / 2)), walls);
  }

  /// Lines of data that a shape takes, before the one of its direction.
  std::size_t lines_of_shape(const AbaqusBlock& block) const {
    if (block.value("SECTION") != "ARBITRARY") return 1;
    if (block.data.empty()) throw CardError{"the segments are missing"};
    return static_cast<std::size_t>(
        abaqus_label(block.data.front().fields().front(), "number of segments"));
  }

  // Number of segments, two points, thickness / a point, the thickness up to it / ...
  Profile walls_of(const AbaqusBlock& block) const {
    const std::size_t count = lines_of_shape(block);
    if (block.data.size() < count) throw CardError{fmt::format("{} segments are due", count)};
    std::vector<Eigen::Vector2d> nodes;
    std::vector<Wall> walls;
    int last = 0;
    // A point that was there already closes a cell.
    const auto node = [&](const Fields& fields, std::size_t first) {
      const Eigen::Vector2d place =
          model_.units.length * Eigen::Vector2d(abaqus_real(fields, first, "coordinate"),
                                                abaqus_real(fields, first + 1, "coordinate"));
      for (std::size_t i = 0; i < nodes.size(); ++i)
        if ((nodes[i] - place).norm() < 1e-9) return static_cast<int>(i);
      nodes.push_back(place);
      return static_cast<int>(nodes.size()) - 1;
    };
    for (std::size_t i = 0; i < count; ++i) {
      const Fields fields = block.data[i].fields();
      if (i == 0) last = node(fields, 1);
      const int next = node(fields, i == 0 ? 3 : 0);
      walls.push_back(
          {last, next, abaqus_real(fields, i == 0 ? 5 : 2, "thickness") * model_.units.length});
      last = next;
    }
    return walled_profile("walls", nodes, walls);
  }

  Profile shape_of(const AbaqusBlock& block, const std::string& kind) const {
    try {
      return kind == "ARBITRARY" ? walls_of(block) : shape(kind, dimensions(block));
    } catch (const ModelError& error) {
      throw CardError{error.what()};
    }
  }

  std::vector<double> dimensions(const AbaqusBlock& block) const {
    if (block.data.empty()) throw CardError{"the dimensions are missing"};
    std::vector<double> values;
    const Fields fields = block.data.front().fields();
    for (std::size_t i = 0; i < fields.size(); ++i)
      values.push_back(abaqus_real(fields, i, "dimension") * model_.units.length);
    return values;
  }

  Vector3 direction(const SectionBlocks& blocks) const {
    const AbaqusBlock& block = *blocks.block;
    Vector3 given = -Vector3::UnitZ();
    const std::size_t line = lines_of_shape(block);
    if (block.data.size() > line && !block.data[line].fields().empty()) {
      const Fields fields = block.data[line].fields();
      given = Vector3(abaqus_real(fields, 0, "n1", 0.0), abaqus_real(fields, 1, "n1", 0.0),
                      abaqus_real(fields, 2, "n1", 0.0));
    }
    return blocks.scope->turn * given;
  }

  /// Of the centroid from the nodes, by CalculiX' OFFSET1 and OFFSET2: shares of the section's
  /// sizes that the nodes lie beyond its centre.
  Eigen::Vector2d offset_by_sizes(const AbaqusBlock& block) const {
    Eigen::Vector2d offset = Eigen::Vector2d::Zero();
    if (!block.has("OFFSET1") && !block.has("OFFSET2")) return offset;
    const std::string kind = short_name(block.value("SECTION"));
    const std::vector<double> d = dimensions(block);
    Eigen::Vector2d size;
    if (kind == "RECT" || kind == "BOX")
      size << d[0], d[1];
    else if (kind == "CIRC" || kind == "PIPE")
      size.setConstant(kind == "CIRC" && d.size() > 1 ? d[0] : 2 * d[0]);
    else
      throw CardError{fmt::format("OFFSET1 and OFFSET2 of SECTION = {} are not known", kind)};
    for (int i = 0; i < 2; ++i) {
      const std::string given = block.value(i == 0 ? "OFFSET1" : "OFFSET2");
      const auto share = given.empty() ? std::optional<double>(0) : to_real(given);
      if (!share) throw CardError{fmt::format("OFFSET{} = {} is no number", i + 1, given)};
      offset[i] = -*share * size[i];
    }
    return offset;
  }

  /// Sections whose materials agree share one.
  /// @param coefficient of expansion, 1/K
  int material_place(const Material& material, double coefficient) {
    Expansions& expansions = model_.deck.expansions;
    for (std::size_t i = 0; i < mesh_.materials.size(); ++i) {
      const Material& known = mesh_.materials[i];
      const bool expands_alike = i < expansions.of_materials.size() &&
                                 expansions.of_materials[i].coefficient == coefficient &&
                                 expansions.of_materials[i].obstacle.empty();
      if (known.youngs_modulus == material.youngs_modulus && known.density == material.density &&
          std::abs(known.poisson_ratio - material.poisson_ratio) < 1e-9 && expands_alike)
        return static_cast<int>(i);
    }
    const auto place = static_cast<int>(mesh_.materials.size());
    mesh_.materials.push_back(material);
    expansions.set(place, {coefficient, 0, ""});
    return place;
  }

  static bool is_about_centroid(const AbaqusBlock& detail) {
    return detail.name == "CENTROID" || detail.name == "BEAM SECTION OFFSET";
  }

  static Eigen::Vector2d pair_of(const AbaqusBlock& detail) {
    if (detail.data.empty()) throw CardError{"a line of data is missing"};
    const Fields fields = detail.data.front().fields();
    return {abaqus_real(fields, 0, "value", 0.0), abaqus_real(fields, 1, "value", 0.0)};
  }

  /// A section by figures does not tell where it twists; the nodes' line, which a centroid of its
  /// own leaves, is as likely as the centroid.
  void remark_on_twist(const SectionBlocks& blocks, const Eigen::Vector2d& centroid) {
    const auto find = [&](const char* name) {
      return std::find_if(blocks.details.begin(), blocks.details.end(),
                          [&](const AbaqusBlock* detail) { return detail->name == name; });
    };
    const auto of_centroid = find("CENTROID");
    if (of_centroid == blocks.details.end() || find("SHEAR CENTER") != blocks.details.end() ||
        centroid.isZero(0))
      return;
    model_.log.remark((*of_centroid)->line,
                      "*CENTROID without *SHEAR CENTER: the beam twists about its centroid; a "
                      "*SHEAR CENTER says where else");
  }

  void read_details(const SectionBlocks& blocks, BeamShape& beam, double shear = 0) {
    BeamSection& section = beam.profile.section;
    if (shear == 0) shear = mesh_.materials[beam.material].shear_modulus();
    // The rest counts from the centroid, whichever comes first in the deck.
    for (const AbaqusBlock* detail : blocks.details) {
      if (!is_about_centroid(*detail)) continue;
      model_.guarded(*detail, [&] {
        const Eigen::Vector2d place = pair_of(*detail) * model_.units.length;
        if (detail->name == "CENTROID")
          beam.profile.centroid = place;
        else
          beam.profile.centroid += place;
      });
    }
    remark_on_twist(blocks, beam.profile.centroid);
    for (const AbaqusBlock* detail : blocks.details) {
      if (is_about_centroid(*detail)) continue;
      model_.guarded(*detail, [&] {
        const Eigen::Vector2d pair = pair_of(*detail);
        if (detail->name == "SHEAR CENTER") {
          section.shear_centre = pair * model_.units.length - beam.profile.centroid;
        } else if (detail->name == "TRANSVERSE SHEAR STIFFNESS") {
          // K23 resists shear along n2, K13 along n1.
          const double unit = model_.units.force / shear;
          if (pair[0] > 0) section.shear_area_3 = pair[0] * unit;
          if (pair[1] > 0) section.shear_area_2 = pair[1] * unit;
        } else {
          section.stress_points.clear();
          for (const AbaqusLine& line : detail->data) {
            const Fields values = line.fields();
            for (std::size_t i = 0; i + 1 < values.size(); i += 2)
              section.stress_points.push_back(
                  Eigen::Vector2d(abaqus_real(values, i, "x1"), abaqus_real(values, i + 1, "x2")) *
                      model_.units.length -
                  beam.profile.centroid);
          }
        }
      });
    }
  }

  AbaqusModel& model_;
  Mesh& mesh_;
};

}  // namespace

BeamShape read_beam_section(AbaqusModel& model, const SectionBlocks& blocks) {
  return BeamShapeReader(model).read_by_dimensions(blocks);
}

BeamShape read_general_beam_section(AbaqusModel& model, const SectionBlocks& blocks) {
  return BeamShapeReader(model).read_general(blocks);
}

void refuse_folded_beam(long label, const Vector3& from, const Vector3& middle, const Vector3& to) {
  const double share = (middle - from).dot(to - from) / (to - from).squaredNorm();
  if (share > 0 && share < 1) return;
  throw CardError{
      fmt::format("element {} is folded: its second node is its middle by the order of nodes, and "
                  "lies {:.3g} of the way from the first to the third",
                  label, share)};
}

}  // namespace blocklift::structure
