// Shear panels.

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "structure/mesh/element_shape.h"
#include "structure/mesh/files/deck/equations.h"
#include "structure/mesh/files/deck/shear_panel.h"
#include "structure/mesh/files/nastran/model.h"

namespace blocklift::structure {

namespace {

/// What a PSHEAR says, in SI units.
struct ShearProperty {
  long number = 0, material = 0;
  double thickness = 0, mass_per_area = 0;
  std::array<double, 2> effectiveness{};  ///< F1, F2: of the plate as bars along its edges
};

class ShearPanels {
 public:
  explicit ShearPanels(NastranModel& model) : model_(model), mesh_(model.deck.mesh) {}

  void read() {
    for (const NastranCard& card : model_.bulk.cards) {
      if (card.name != "PSHEAR") continue;
      const CardView view(model_.bulk, card);
      if (const auto number = to_integer(view.text(0))) properties_.emplace(*number, view);
    }
    model_.for_each({{"CSHEAR", [&](const CardView& card) { add(card); }}});
    for (const auto& [number, card] : properties_)
      if (read_.count(number) == 0) model_.log.leave_out("PSHEAR", "some are of no element");
    if (count_ > 0)
      model_.log.remark(line_, fmt::format("{} shear panel{} (CSHEAR) bear{} by the flow along "
                                           "edges; stress within is not checked",
                                           count_, count_ == 1 ? "" : "s", count_ == 1 ? "s" : ""));
  }

 private:
  // PSHEAR PID MID T NSM F1 F2
  const ShearProperty& property(const CardView& element, long number) {
    if (const auto known = read_.find(number); known != read_.end()) return known->second;
    const auto found = properties_.find(number);
    if (found == properties_.end())
      throw CardError{fmt::format("property {} does not exist, or is no PSHEAR", element.text(1))};
    const CardView& card = found->second;
    const double length = model_.units.length;
    ShearProperty property;
    property.number = number;
    property.material = card.label(1, "material");
    property.thickness = card.real(2, "thickness") * length;
    property.mass_per_area = card.real(3, "mass beyond the panel's", 0.0) * model_.units.mass() /
                             (length * length) * model_.mass_factor;
    property.effectiveness = {card.real(4, "F1", 0.0), card.real(5, "F2", 0.0)};
    if (!(property.thickness > 0 && property.mass_per_area >= 0 && property.effectiveness[0] >= 0 &&
          property.effectiveness[1] >= 0))
      throw CardError{fmt::format(
          "PSHEAR {}: T must be positive, NSM, F1 and F2 must not be negative", number)};
    model_.log.use("PSHEAR");
    return read_[number] = property;
  }

  // CSHEAR EID PID G1 G2 G3 G4
  void add(const CardView& card) {
    const long label = model_.new_element(card);
    const ShearProperty& section = property(card, card.label(1, "property", label));
    std::array<int, 4> corners{};
    std::array<Vector3, 4> places;
    for (std::size_t i = 0; i < 4; ++i) {
      corners[i] = model_.vertex(card, 2 + i, "corner");
      places[i] = model_.place(corners[i]);
    }
    const int of_material = nastran_material_place(model_, section.material);
    const Material material = mesh_.materials[of_material];
    const std::optional<ShearPanel> panel = [&]() -> std::optional<ShearPanel> {
      try {
        return make_shear_panel(places, material, section.thickness);
      } catch (const ModelError& error) {
        throw CardError{fmt::format("CSHEAR {}: {}", label, error.what())};
      }
    }();
    add_stiffness(*panel, corners, label);
    add_mass(corners, places, panel->area,
             material.density * section.thickness + section.mass_per_area, label);
    add_bars(corners, places, panel->area, section, of_material);
    if (++count_ == 1) line_ = card.line();
  }

  /// A spring between two turns about the normal, one of which is the other and the sum of
  /// forces times displacements over the area: it takes the panel's energy.
  void add_stiffness(const ShearPanel& panel, const std::array<int, 4>& corners, long label) {
    Spring spring;
    spring.label = label;
    spring.components = {5, 5};
    Eigen::Matrix3d axes;
    axes.col(2) = panel.normal;
    axes.col(0) = panel.normal.unitOrthogonal();
    axes.col(1) = axes.col(2).cross(axes.col(0));
    spring.axes = {axes, axes};
    std::vector<CountedFreedom> displacements;
    for (const int corner : corners)
      for (int i = 0; i < 3; ++i) displacements.push_back({{corner, i}});
    // Apart, so that they are not taken for one point by mistake.
    const Vector3 aside = 0.02 * std::sqrt(panel.area) * panel.normal;
    for (std::size_t end = 0; end < 2; ++end) {
      const int vertex = add_vertex(panel.centre + (end == 0 ? aside : Vector3(-aside)));
      spring.vertices[end] = vertex;
      std::vector<DeckFreedom> follows;
      for (int i = 0; i < 6; ++i) follows.push_back({vertex, i, axes});
      add_mean_equations(model_.deck, follows, displacements);
      if (end == 0) add_flow(panel, corners);
    }
    spring.stiffness = panel.stiffness * panel.area * panel.area;
    mesh_.springs.push_back(spring);
  }

  /// Adds what the panel's forces do work on, over its area, to the last equation's turn.
  void add_flow(const ShearPanel& panel, const std::array<int, 4>& corners) {
    MotionEquation& turn = mesh_.equations.back();
    for (std::size_t i = 0; i < 4; ++i) {
      const Vector3 share = -panel.corner_forces[i] / panel.area;
      const auto term = std::find_if(turn.terms.begin(), turn.terms.end(),
                                     [&](const auto& one) { return one.vertex == corners[i]; });
      if (term == turn.terms.end())
        turn.terms.push_back({corners[i], share, Vector3::Zero()});
      else
        term->of_displacement += share;
    }
    balance(mesh_, turn);
  }

  /// A vertex that the deck has no grid for, with the next number.
  int add_vertex(const Vector3& place) {
    if (next_label_ == 0) {
      for (const long label : mesh_.vertex_labels) next_label_ = std::max(next_label_, label);
      for (const auto& range : model_.scalar_points)
        next_label_ = std::max(next_label_, range.second);
    }
    mesh_.vertices.push_back(place);
    mesh_.vertex_labels.push_back(++next_label_);
    model_.output_system.push_back(0);
    return static_cast<int>(mesh_.vertices.size()) - 1;
  }

  /// Of the bilinear functions of its corners, so that the centre is the panel's.
  void add_mass(const std::array<int, 4>& corners, const std::array<Vector3, 4>& places,
                double area, double mass_per_area, long label) {
    if (!(mass_per_area > 0)) return;
    // The Jacobian is the bilinear function of those at the corners.
    std::array<double, 4> jacobian{};
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i)
      sum += jacobian[i] =
          (places[(i + 1) % 4] - places[i]).cross(places[(i + 3) % 4] - places[i]).norm();
    for (std::size_t i = 0; i < 4; ++i) {
      const double share = (4 * jacobian[i] + 2 * jacobian[(i + 1) % 4] +
                            2 * jacobian[(i + 3) % 4] + jacobian[(i + 2) % 4]) /
                           (9 * sum);
      PointMass mass;
      mass.vertex = corners[i];
      mass.mass = share * area * mass_per_area;
      mass.label = label;
      mesh_.masses.push_back(mass);
    }
  }

  /// Bars without mass of their own along edges 1-2 and 3-4 (F1), 2-3 and 4-1 (F2): F T A over the
  /// sum of both lengths up to F = 1.01, F T^2 / 2 beyond. Source: MSC Nastran Quick Reference
  /// Guide, PSHEAR.
  void add_bars(const std::array<int, 4>& corners, const std::array<Vector3, 4>& places,
                double area, const ShearProperty& section, int of_material) {
    for (std::size_t pair = 0; pair < 2; ++pair) {
      const double effective = section.effectiveness[pair];
      if (!(effective > 0)) continue;
      double lengths = 0;
      for (const std::size_t i : {pair, pair + 2})
        lengths += (places[(i + 1) % 4] - places[i]).norm();
      const double t = section.thickness;
      const double bar_area =
          effective <= 1.01 ? effective * t * area / lengths : effective * t * t / 2;
      for (const std::size_t i : {pair, pair + 2}) {
        Beam bar;
        bar.vertices = {corners[i], corners[(i + 1) % 4]};
        bar.section = bar_section(section, bar_area, of_material);
        bar.is_rod = true;
        bar.axis_2 = (places[(i + 1) % 4] - places[i]).unitOrthogonal();
        bar.region = nastran_region(model_, section.number, mesh_.section_of(bar).material);
        mesh_.beams.push_back(bar);
      }
    }
  }

  int bar_section(const ShearProperty& property, double area, int of_material) {
    const auto [found, is_new] = sections_.try_emplace({property.number, area}, 0);
    if (!is_new) return found->second;
    const auto [weightless, is_new_material] = weightless_.try_emplace(of_material, 0);
    if (is_new_material) {
      Material material = mesh_.materials[of_material];
      material.name += " without its mass";
      material.density = 0;
      weightless->second = static_cast<int>(mesh_.materials.size());
      mesh_.materials.push_back(material);
      model_.deck.expansions.set(
          weightless->second,
          {0, 0, "how the edges of shear panels (CSHEAR, F1 and F2) expand is not known"});
    }
    BeamSection section;
    section.name = fmt::format("PSHEAR {}", property.number);
    section.label = property.number;
    section.material = weightless->second;
    section.area = area;
    mesh_.beam_sections.push_back(section);
    return found->second = static_cast<int>(mesh_.beam_sections.size()) - 1;
  }

  NastranModel& model_;
  Mesh& mesh_;
  std::unordered_map<long, CardView> properties_;
  std::unordered_map<long, ShearProperty> read_;
  std::map<std::pair<long, double>, int> sections_;
  std::map<int, int> weightless_;  ///< of a material, its like without mass
  long next_label_ = 0;
  int count_ = 0;
  SourceLine line_;
};

}  // namespace

void read_nastran_shear_panels(NastranModel& model) { ShearPanels(model).read(); }

}  // namespace blocklift::structure
