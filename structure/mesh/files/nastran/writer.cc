#include "structure/mesh/files/nastran/writer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <tuple>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "structure/index.h"
#include "structure/mesh/beams/beam_axes.h"
#include "structure/mesh/files/deck/edge_middles.h"
#include "structure/mesh/files/deck/equations.h"
#include "structure/mesh/files/deck/link_frames.h"
#include "structure/mesh/files/deck/numbering.h"
#include "structure/mesh/files/deck/shell_geometry.h"
#include "structure/mesh/files/nastran/card_writer.h"
#include "structure/mesh/files/nastran/load_cards.h"
#include "structure/mesh/files/nastran/shell_cards.h"
#include "structure/mesh/files/nastran/solid_faces.h"
#include "structure/mesh/solid_shape.h"

namespace blocklift::structure {

namespace {

/// Number of the set of all equations (MPC).
constexpr long equation_set = 1;

class NastranText {
 public:
  explicit NastranText(const Deck& deck)
      : deck_(deck),
        mesh_(deck_.mesh),
        units_(deck.units),
        axes_(vertex_axes(deck)),
        elements_(element_labels(deck.mesh)) {}

  std::string write() {
    for (const HoldingEquation& held : deck_.holding_equations)
      mesh_.equations.push_back(held.equation);
    MiddleVertices middles(mesh_);
    for (const Shell& shell : mesh_.shells)
      middles_.push_back(shell.curvature >= 0 ? middles.of(shell) : std::vector<int>{});
    axes_.resize(mesh_.vertices.size(), Eigen::Matrix3d::Identity());
    for (const SurfacePoint& point : mesh_.surface_points) check_surface_point(point);
    number_sets();
    write_case_control();
    write_grids();
    write_materials();
    write_shells();
    write_beams();
    write_solids();
    write_masses();
    write_links();
    write_springs();
    write_supports();
    write_loads();
    out_.line("ENDDATA");
    return out_.take();
  }

 private:
  using Fields = std::vector<CardField>;

  long label(int vertex) const {
    return mesh_.vertex_labels.empty() ? vertex + 1 : mesh_.vertex_labels[vertex];
  }
  double length(double metres) const { return metres / units_.length; }
  double area(double square) const { return square / (units_.length * units_.length); }
  double fourth(double moment) const { return moment / std::pow(units_.length, 4); }
  double per_area(double mass) const {
    return mass / units_.mass() * units_.length * units_.length;
  }
  double per_length(double mass) const { return mass / units_.mass() * units_.length; }

  static void append(Fields& fields, const Vector3& vector) {
    for (int i = 0; i < 3; ++i) fields.emplace_back(vector[i]);
  }

  void check_surface_point(const SurfacePoint& point) const {
    const std::vector<int>& middles = middles_[point.shell];
    if (std::find(middles.begin(), middles.end(), point.vertex) == middles.end())
      throw ModelError(
          fmt::format("vertex {} lies within a shell; a deck says this of the middles "
                      "of quadratic edges alone",
                      label(point.vertex)));
  }

  void number_sets() {
    Numbering supports, loads;
    for (const SupportSet& set : deck_.support_sets) supports.raise(set.label);
    for (const SupportSet& set : deck_.support_sets)
      support_label_.push_back(supports.take(set.label));
    for (const LoadSet& set : deck_.load_sets) loads.raise(set.label);
    for (const DeckLoadCase& one : deck_.load_cases) loads.raise(one.label);
    for (const LoadSet& set : deck_.load_sets) load_label_.push_back(loads.take(set.label));
    for (const DeckLoadCase& one : deck_.load_cases) {
      combined_supports_.push_back(one.supports.size() > 1 ? supports.take(0) : 0);
      const bool is_one = one.loads.size() == 1 && one.loads.front().second == 1.0;
      combined_loads_.push_back(is_one || one.loads.empty() ? 0 : loads.take(0));
    }
  }

  void refuse_temperatures() const {
    for (const DeckLoadCase& one : deck_.load_cases)
      if (one.temperatures >= 0)
        throw ModelError("temperatures of load cases are not written here");
  }

  void write_case_control() {
    refuse_temperatures();
    out_.line("$ lengths, forces and masses in " + units_.name);
    out_.line("SOL 101");
    out_.line("CEND");
    if (!deck_.title.empty()) out_.line("TITLE = " + deck_.title);
    for (const char* result : {"DISPLACEMENT", "SPCFORCES", "STRESS"})
      out_.line(std::string(result) + " = ALL");
    if (!mesh_.equations.empty()) out_.line(fmt::format("MPC = {}", equation_set));
    for (std::size_t i = 0; i < deck_.load_cases.size(); ++i) {
      const DeckLoadCase& one = deck_.load_cases[i];
      out_.line(fmt::format("SUBCASE {}", one.label > 0 ? one.label : static_cast<long>(i) + 1));
      if (!one.title.empty()) out_.line("  SUBTITLE = " + one.title);
      if (!one.supports.empty())
        out_.line(fmt::format("  SPC = {}", combined_supports_[i] > 0
                                                ? combined_supports_[i]
                                                : support_label_[one.supports.front()]));
      if (!one.loads.empty())
        out_.line(fmt::format("  LOAD = {}", combined_loads_[i] > 0
                                                 ? combined_loads_[i]
                                                 : load_label_[one.loads.front().first]));
    }
    out_.line("BEGIN BULK");
  }

  /// Number of a rectangular system with these axes; 0: the basic one.
  long system(const Eigen::Matrix3d& axes) {
    if (is_identity(axes)) return 0;
    for (std::size_t i = 0; i < systems_.size(); ++i)
      if ((systems_[i] - axes).norm() < 1e-10) return static_cast<long>(i) + 1;
    systems_.push_back(axes);
    const auto number = static_cast<long>(systems_.size());
    Fields fields{number, 0L, 0.0, 0.0, 0.0};
    append(fields, axes.col(2));
    append(fields, axes.col(0) + axes.col(2));
    out_.card("CORD2R", fields);
    return number;
  }

  void write_grids() {
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) {
      const long output = system(axes_[v]);
      Fields fields{label(static_cast<int>(v)), CardField()};
      append(fields, mesh_.vertices[v] / units_.length);
      if (output > 0) fields.emplace_back(output);
      out_.card("GRID", fields);
    }
  }

  void write_materials() {
    for (std::size_t m = 0; m < mesh_.materials.size(); ++m) {
      const Material& material = mesh_.materials[m];
      Fields fields{static_cast<long>(m) + 1, material.youngs_modulus / units_.stress(),
                    CardField(), material.poisson_ratio, material.density / units_.density()};
      if (material.yield_stress > 0) {
        fields.resize(8);
        fields.emplace_back(material.yield_stress / units_.stress());
      }
      out_.card("MAT1", fields);
    }
    next_material_ = static_cast<long>(mesh_.materials.size());
  }

  // Z offsets belong to elements: sections that differ in them alone are one property.
  // So do thicknesses at corners.
  long shell_property(const ShellSection& section, bool is_tapered) {
    const auto key = std::tuple(is_tapered ? 0.0 : section.thickness, section.material,
                                section.mass_per_area, section.laminate, section.label);
    const auto found = shell_property_.find(key);
    if (found != shell_property_.end()) return found->second;
    const long property = properties_.take(section.label);
    shell_property_[key] = property;
    const long material = section.material + 1;
    const double t = section.thickness;
    Fields fields{property, material, length(t), material, CardField(), material};
    if (section.laminate >= 0) {
      const Laminate& laminate = mesh_.laminates[section.laminate];
      const double density = mesh_.materials[section.material].density;
      Eigen::Matrix3d shear = Eigen::Matrix3d::Zero();
      shear.topLeftCorner<2, 2>() = laminate.shear / t;
      fields[1] = CardField(matrix_material(laminate.membrane / t, density));
      fields[3] = CardField(matrix_material(laminate.bending * 12 / (t * t * t), 0));
      fields[5] = CardField(matrix_material(shear, 0));
      fields.emplace_back(1.0);
      if (section.mass_per_area > 0) fields.emplace_back(per_area(section.mass_per_area));
      if (!laminate.coupling.isZero()) {
        fields.resize(10);
        fields.emplace_back(matrix_material(laminate.coupling / (t * t), 0));
      }
    } else if (section.mass_per_area > 0) {
      fields.resize(7);
      fields.emplace_back(per_area(section.mass_per_area));
    }
    out_.card("PSHELL", fields);
    return property;
  }

  /// The name of a property's first group, as preprocessors keep it in comments.
  void note_group(long property, int region) {
    if (mesh_.regions.empty() || !named_.insert(property).second) return;
    const std::string& name = mesh_.groups[mesh_.regions[region].group].name;
    if (name.find('"') == std::string::npos)
      out_.line(fmt::format("$HMNAME PROP {:>19}\"{}\"", property, name));
  }

  long matrix_material(const Eigen::Matrix3d& matrix, double density) {
    const Eigen::Matrix3d g = matrix / units_.stress();
    out_.card("MAT2", {++next_material_, g(0, 0), g(0, 1), g(0, 2), g(1, 1), g(1, 2), g(2, 2),
                       density / units_.density()});
    return next_material_;
  }

  void write_shells() {
    for (const ShellSection& section : mesh_.shell_sections) properties_.raise(section.label);
    for (const BeamSection& section : mesh_.beam_sections) properties_.raise(section.label);
    for (std::size_t s = 0; s < mesh_.shells.size(); ++s) {
      const Shell& shell = mesh_.shells[s];
      if (shell.section < 0)
        throw ModelError(fmt::format("shell {} has no thickness; a deck needs one", shell.label));
      const ShellSection& section = mesh_.section_of(shell);
      const long property = shell_property(section, shell.taper >= 0);
      note_group(property, shell.region);
      std::vector<int> around{shell.vertices[0], shell.vertices[1], shell.vertices[3]};
      if (!shell.is_triangle()) around.push_back(shell.vertices[2]);
      const std::size_t corners = around.size();
      around.insert(around.end(), middles_[s].begin(), middles_[s].end());
      shell_number_.push_back(elements_.take(shell.label));
      Fields fields{shell_number_.back(), property};
      for (const int vertex : around) fields.emplace_back(label(vertex));
      const bool is_quadratic = !middles_[s].empty();
      const std::vector<double> thicknesses = corner_thicknesses(mesh_, shell);
      if (is_quadratic && corners == 4) fields.resize(10);
      if (is_quadratic && corners == 4)
        for (std::size_t i = 0; i < 4; ++i)
          fields.push_back(thicknesses.empty() ? CardField() : CardField(length(thicknesses[i])));
      fields.push_back(section.laminate < 0 ? CardField()
                                            : CardField(laminate_angle(mesh_, shell)));
      if (section.offset != 0) fields.emplace_back(length(section.offset));
      if (!thicknesses.empty() && !(is_quadratic && corners == 4)) {
        fields.resize(10);
        for (const double thickness : thicknesses) fields.emplace_back(length(thickness));
      }
      const char* name = corners == 4 ? (is_quadratic ? "CQUAD8" : "CQUAD4")
                                      : (is_quadratic ? "CTRIA6" : "CTRIA3");
      out_.card(name, fields);
    }
  }

  long beam_property(int place, int end, bool is_rod) {
    const auto [found, is_new] = beam_property_.try_emplace({place, end, is_rod}, 0);
    if (!is_new) return found->second;
    const BeamSection& section = mesh_.beam_sections[place];
    const long property = properties_.take(section.label);
    found->second = property;
    const long material = section.material + 1;
    const double a = area(section.area), i1 = fourth(section.second_moment_3),
                 i2 = fourth(section.second_moment_2), i12 = fourth(section.product_23),
                 j = fourth(section.torsion), mass = per_length(section.mass_per_length);
    if (is_rod) {
      const bool has_shear = section.shear_points.size() == 1 && section.torsion > 0;
      const CardField arm =
          has_shear ? CardField(length(section.shear_points[0].of_torsion * section.torsion))
                    : CardField();
      out_.card("PROD", {property, material, a, j, arm, mass});
      return property;
    }
    const auto factor = [&](double shear_area) {
      return std::isfinite(shear_area) ? shear_area / section.area : 0.0;
    };
    const auto points_of = [&](const BeamSection& of) {
      Fields points;
      for (std::size_t i = 0; i < 4; ++i)
        for (int k = 0; k < 2; ++k)
          points.push_back(i < of.stress_points.size() ? CardField(length(of.stress_points[i][k]))
                                                       : CardField());
      return points;
    };
    const Fields points = points_of(section);
    const double k1 = factor(section.shear_area_2), k2 = factor(section.shear_area_3);
    if (section.twist_centre().isZero() && end < 0) {
      Fields fields{property, material, a, i1, i2, j, mass, CardField()};
      fields.insert(fields.end(), points.begin(), points.end());
      for (const double value : {k1, k2, i12}) fields.emplace_back(value);
      out_.card("PBAR", fields);
      return property;
    }
    Fields fields{property, material, a, i1, i2, i12, j, mass};
    fields.insert(fields.end(), points.begin(), points.end());
    const BeamSection& last = end < 0 ? section : mesh_.beam_sections[end];
    if (end >= 0) {
      const Fields of_end{"YES",
                          1.0,
                          area(last.area),
                          fourth(last.second_moment_3),
                          fourth(last.second_moment_2),
                          fourth(last.product_23),
                          fourth(last.torsion),
                          per_length(last.mass_per_length)};
      fields.insert(fields.end(), of_end.begin(), of_end.end());
      const Fields end_points = points_of(last);
      fields.insert(fields.end(), end_points.begin(), end_points.end());
    }
    const std::size_t before = fields.size();
    for (const double value : {k1, k2}) fields.emplace_back(value);
    fields.resize(before + 12);
    for (const BeamSection* of : {&section, &last})
      for (int i = 0; i < 2; ++i) fields.emplace_back(length(-of->twist_centre()[i]));
    out_.card("PBEAM", fields);
    return property;
  }

  /// A beam's offsets lead to its shear centres, whose line tells its axes; where the sections
  /// differ, it is turned a little against the line of the centroids.
  std::array<Vector3, 2> offsets_of_centres(const Beam& beam) const {
    const Vector3 between = mesh_.vertices[beam.vertices[1]] - mesh_.vertices[beam.vertices[0]];
    std::array<Vector3, 2> offsets = beam.offset;
    constexpr int rounds = 20;  // each is as much smaller as the sections' difference to the length
    for (int round = 0; round < rounds; ++round) {
      const Eigen::Matrix3d axes = axes_along(between + offsets[1] - offsets[0], beam.axis_2);
      for (std::size_t end = 0; end < 2; ++end) {
        const Eigen::Vector2d centre =
            section_at(mesh_, beam, static_cast<double>(end)).twist_centre();
        offsets[end] = beam.offset[end] + axes.bottomRows<2>().transpose() * centre;
      }
    }
    return offsets;
  }

  void write_beams() {
    for (const Beam& beam : mesh_.beams) {
      const long property = beam_property(beam.section, beam.end_section, beam.is_rod);
      note_group(property, beam.region);
      const long number = elements_.take(beam.label);
      beam_number_.push_back(number);
      const int a = beam.vertices[0], b = beam.vertices[1];
      if (beam.is_rod) {
        out_.card("CROD", {number, property, label(a), label(b)});
        continue;
      }
      const bool is_bar = mesh_.section_of(beam).twist_centre().isZero() && beam.end_section < 0;
      Fields fields{number, property, label(a), label(b)};
      append(fields, axes_[a].transpose() * beam.axis_2.normalized());
      fields.emplace_back();
      for (const BeamRelease& release : beam.release) fields.emplace_back(digits(release));
      const std::array<Vector3, 2> to_centres = offsets_of_centres(beam);
      for (std::size_t end = 0; end < 2; ++end)
        append(fields, axes_[beam.vertices[end]].transpose() * to_centres[end] / units_.length);
      const bool is_plain = digits(beam.release[0]).empty() && digits(beam.release[1]).empty() &&
                            beam.offset[0].isZero() && beam.offset[1].isZero() && is_bar;
      if (is_plain) fields.resize(7);
      out_.card(is_bar ? "CBAR" : "CBEAM", fields);
    }
  }

  void write_solids() {
    static const std::map<SolidShape, std::pair<const char*, std::vector<int>>> cards{
        {SolidShape::tetrahedron, {"CTETRA", {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}}},
        {SolidShape::wedge, {"CPENTA", {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 14, 9, 10, 11}}},
        {SolidShape::hexahedron,
         {"CHEXA", {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 16, 17, 18, 19, 12, 13, 14, 15}}},
        {SolidShape::pyramid, {"CPYRAM", {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}}}};
    std::map<std::tuple<int, int, int>, long> properties;
    for (const Solid& solid : mesh_.solids) {
      const auto [found, is_new] =
          properties.try_emplace({solid.region, solid.material, solid.elasticity}, 0);
      if (is_new) {
        found->second = properties_.take(0);
        out_.card("PSOLID", {found->second, material_of(solid)});
        note_group(found->second, solid.region);
      }
      const auto& [name, order] = cards.at(solid.shape);
      Fields fields{solid_number_.emplace_back(elements_.take(solid.label)), found->second};
      for (const int node : order) fields.emplace_back(label(solid.vertices[node]));
      out_.card(name, fields);
    }
  }

  /// Where it depends on the direction a MAT9 along the basic axes, which PSOLID means.
  long material_of(const Solid& solid) {
    if (solid.elasticity < 0) return static_cast<long>(solid.material) + 1;
    const Elasticity g = mesh_.elasticities[solid.elasticity] / units_.stress();
    Fields fields{++next_material_};
    for (Eigen::Index i = 0; i < 6; ++i)
      for (Eigen::Index j = i; j < 6; ++j) fields.emplace_back(g(i, j));
    fields.emplace_back(mesh_.materials[solid.material].density / units_.density());
    out_.card("MAT9", fields);
    return next_material_;
  }

  void write_masses() {
    for (const PointMass& mass : mesh_.masses) {
      Fields fields{elements_.take(mass.label), label(mass.vertex), 0L, mass.mass / units_.mass()};
      append(fields, mass.offset / units_.length);
      if (!mass.inertia.isZero()) {
        const Eigen::Matrix3d i = mass.inertia / (units_.mass() * units_.length * units_.length);
        fields.emplace_back();
        for (const double value : {i(0, 0), -i(1, 0), i(1, 1), -i(2, 0), -i(2, 1), i(2, 2)})
          fields.emplace_back(value);
      }
      out_.card("CONM2", fields);
    }
  }

  void write_links() {
    for (const RigidLink& link : mesh_.rigid_links) {
      Fields fields{elements_.take(link.label), label(link.master), digits(link.bound)};
      for (const int slave : link.slaves) fields.emplace_back(label(slave));
      out_.card("RBE2", fields);
    }
    for (const DistributingLink& link : mesh_.distributing_links) {
      Fields fields{elements_.take(link.label), CardField(), label(link.reference),
                    digits(link.bound)};
      double last = -1;
      for (std::size_t i = 0; i < link.vertices.size(); ++i) {
        if (link.weights[i] != last) {
          fields.emplace_back(link.weights[i]);
          fields.emplace_back("123");
          last = link.weights[i];
        }
        fields.emplace_back(label(link.vertices[i]));
      }
      out_.card("RBE3", fields);
    }
    write_equations();
  }

  void write_equations() {
    std::set<int> taken;
    for (const MotionEquation& equation : mesh_.equations) {
      Fields fields{equation_set};
      for (const ScalarTerm& term : scalar_terms(equation, units_, axes_, taken)) {
        // Two terms a line, its first and last field blank.
        if (fields.size() % 8 == 7) fields.resize(fields.size() + 2);
        fields.emplace_back(label(term.vertex));
        fields.emplace_back(static_cast<long>(term.component) + 1);
        fields.emplace_back(term.factor);
      }
      out_.card("MPC", fields);
    }
  }

  void write_springs() {
    for (const Spring& spring : mesh_.springs) {
      const int a = spring.vertices[0], b = spring.vertices[1];
      const double unit = spring.components[0] < 3 ? units_.force / units_.length : units_.moment();
      const double stiffness = spring.stiffness / unit;
      const long number = elements_.take(spring.label);
      if (spring.arms[0].isZero() && spring.arms[1].isZero()) {
        Fields fields{number, stiffness, label(a), spring.components[0] + 1};
        if (b >= 0) {
          fields.emplace_back(label(b));
          fields.emplace_back(spring.components[1] + 1);
        }
        out_.card("CELAS2", fields);
        continue;
      }
      const Vector3 place = mesh_.vertices[a] + spring.arms[0];
      const bool meets =
          b < 0 || (mesh_.vertices[b] + spring.arms[1] - place).norm() < 1e-9 * (1 + place.norm());
      if (!meets || spring.components[0] != spring.components[1] ||
          (b >= 0 && (spring.axes[0] - spring.axes[1]).norm() > 1e-9))
        throw ModelError(fmt::format("spring {} is none that a CBUSH says", spring.label));
      const long property = properties_.take(0);
      Fields stiffnesses{property, "K"};
      stiffnesses.resize(2 + at(spring.components[0]));
      stiffnesses.emplace_back(stiffness);
      out_.card("PBUSH", stiffnesses);
      Fields fields{number, property, label(a), b >= 0 ? CardField(label(b)) : CardField()};
      fields.resize(7);
      fields.emplace_back(system(spring.axes[0]));
      fields.emplace_back();
      fields.emplace_back(0L);
      append(fields, place / units_.length);
      out_.card("CBUSH", fields);
    }
  }

  void write_supports() {
    for (std::size_t s = 0; s < deck_.support_sets.size(); ++s)
      for (const Support& support : deck_.support_sets[s].supports) {
        std::array<bool, 6> plain{};
        for (std::size_t i = 0; i < 6; ++i) {
          plain[i] = support.held[i] && support.value[i] == 0;
          if (support.held[i] && support.value[i] != 0)
            out_.card("SPC", {support_label_[s], label(support.vertex), static_cast<long>(i) + 1,
                              i < 3 ? length(support.value[i]) : support.value[i]});
        }
        if (!digits(plain).empty())
          out_.card("SPC1", {support_label_[s], digits(plain), label(support.vertex)});
      }
    for (std::size_t i = 0; i < deck_.load_cases.size(); ++i) {
      if (combined_supports_[i] == 0) continue;
      Fields fields{combined_supports_[i]};
      for (const int set : deck_.load_cases[i].supports) fields.emplace_back(support_label_[set]);
      out_.card("SPCADD", fields);
    }
  }

  void write_loads() {
    for (std::size_t s = 0; s < deck_.load_sets.size(); ++s) {
      const LoadSet& set = deck_.load_sets[s];
      for (const PointLoad& load : set.point_loads) write_point_load(load_label_[s], load);
      for (const PlateLoad& load : set.plate_loads) write_plate_load(load_label_[s], load);
      for (const SolidLoad& load : set.solid_loads) write_solid_load(load_label_[s], load);
      for (const BeamLoad& load : set.beam_loads) write_beam_load(load_label_[s], load);
      write_loads_of_masses(set, load_label_[s], units_, out_);
    }
    for (std::size_t i = 0; i < deck_.load_cases.size(); ++i) {
      if (combined_loads_[i] == 0) continue;
      Fields fields{combined_loads_[i], 1.0};
      for (const auto& [set, factor] : deck_.load_cases[i].loads) {
        fields.emplace_back(factor);
        fields.emplace_back(load_label_[set]);
      }
      out_.card("LOAD", fields);
    }
  }

  void write_beam_load(long set, const BeamLoad& load) {
    const Beam& beam = mesh_.beams[load.beam];
    if (beam.is_rod)  // has no PLOAD1
      for (const PointLoad& at_end : loads_at_ends(mesh_, load)) write_point_load(set, at_end);
    else
      write_line_load(mesh_, load, set, beam_number_[load.beam], offsets_of_centres(beam), units_,
                      out_);
  }

  void write_point_load(long set, const PointLoad& load) {
    write_vector("FORCE", set, load.vertex, load.force / units_.force);
    write_vector("MOMENT", set, load.vertex, load.moment / units_.moment());
  }

  void write_vector(const char* name, long set, int vertex, const Vector3& value) {
    if (value.isZero(0)) return;
    Fields fields{set, label(vertex), 0L, 1.0};
    append(fields, value);
    out_.card(name, fields);
  }

  void write_plate_load(long set, const PlateLoad& load) {
    const Shell& shell = mesh_.shells[load.shell];
    Fields fields{set, shell_number_[load.shell]};
    for (const std::size_t i : {0U, 1U, 3U, 2U})
      if (i != 2 || !shell.is_triangle()) fields.emplace_back(load.pressure[i] / units_.stress());
    pressures_.write(std::move(fields), load.direction, load.system);
  }

  void write_solid_load(long set, const SolidLoad& load) {
    const FaceGrids grids = grids_of_face(mesh_.solids[load.solid], load.face);
    Fields fields{set, solid_number_[load.solid]};
    for (const double p : load.pressure) fields.emplace_back(p / units_.stress());
    fields.emplace_back(label(grids.corner));
    if (grids.second) fields.emplace_back(label(*grids.second));
    pressures_.write(std::move(fields), load.direction, load.system);
  }

  Deck deck_;  // middles of curved shells may be added
  Mesh& mesh_;
  const UnitSystem units_;
  std::vector<Eigen::Matrix3d> axes_;
  Numbering elements_, properties_;
  std::set<long> named_;  ///< properties whose group is written
  std::vector<std::vector<int>> middles_;
  std::vector<long> shell_number_, solid_number_, beam_number_;
  std::vector<long> support_label_, load_label_, combined_supports_, combined_loads_;
  std::vector<Eigen::Matrix3d> systems_;
  std::map<std::tuple<double, int, double, int, long>, long> shell_property_;
  std::map<std::tuple<int, int, bool>, long> beam_property_;  ///< section, that at the end, rod
  long next_material_ = 0;
  CardWriter out_;
  PressureCards pressures_{units_, out_};
};

}  // namespace

std::string to_nastran(const Deck& deck) { return NastranText(with_held_middles(deck)).write(); }

void write_nastran(const Deck& deck, const std::filesystem::path& path) {
  const std::string text = to_nastran(deck);
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw ModelError("cannot write \"" + path.string() + "\"");
}

}  // namespace blocklift::structure
