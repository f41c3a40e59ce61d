// Springs and bushes.

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "structure/mesh/files/nastran/model.h"

namespace blocklift::structure {

namespace {

class Springs {
 public:
  explicit Springs(NastranModel& model) : model_(model), mesh_(model.deck.mesh) {}

  void read() {
    for (const NastranCard& card : model_.bulk.cards)
      if (card.name == "PELAS" || card.name == "PBUSH" || card.name == "PBUSH1D")
        keep(CardView(model_.bulk, card));
    model_.for_each(
        {{"CELAS1", [&](const CardView& card) { add_with_property(card); }},
         {"CELAS2", [&](const CardView& card) { add_spring(card, card.real(1, "stiffness"), 2); }},
         {"CBUSH", [&](const CardView& card) { add_bush(card); }},
         {"CBUSH1D", [&](const CardView& card) { add_line_bush(card); }}});
    for (const auto& [number, card] : line_bushes_)
      if (used_line_bushes_.count(number) == 0)
        model_.log.leave_out("PBUSH1D", "some are of no element");
  }

 private:
  // PELAS PID1 K1 GE1 S1 PID2 K2 GE2 S2
  // PBUSH PID K K1 ... K6 / B B1 ... B6 / GE GE1 ... GE6 / RCV SA ST EA ET / M M
  // PBUSH1D PID K C M blank SA SE / ...
  void keep(const CardView& card) {
    try {
      const auto keep_once = [&](auto& all, std::size_t field, const auto& what) {
        if (!all.emplace(card.label(field, "property"), what).second)
          throw CardError{fmt::format("property {} is there twice", card.text(field))};
      };
      if (card.name() == "PBUSH1D") {
        keep_once(line_bushes_, 0, card);
        return;
      }
      if (card.name() == "PBUSH") {
        keep_once(bushes_, 0, card);
        return;
      }
      for (const std::size_t first : {0U, 4U})
        if (card.has(first)) keep_once(springs_, first, card.real(first + 1, "stiffness"));
    } catch (const CardError& error) {
      model_.log.complain(card.line(), card.name() + ": " + error.text);
    }
  }

  double unit(int component) const {
    return component < 3 ? model_.units.force / model_.units.length : model_.units.moment();
  }

  void add_with_property(const CardView& card) {
    const auto found = springs_.find(card.label(1, "property"));
    if (found == springs_.end())
      throw CardError{fmt::format("property {} does not exist", card.text(1))};
    model_.log.use("PELAS");
    add_spring(card, found->second, 2);
  }

  // ... G1 C1 G2 C2
  void add_spring(const CardView& card, double stiffness, std::size_t first) {
    Spring spring;
    spring.label = model_.new_element(card);
    for (std::size_t end = 0; end < 2; ++end) {
      const std::size_t field = first + 2 * end;
      if (!card.has(field) || card.is(field, "0")) continue;
      if (model_.is_scalar_point(card.label(field, "end"))) {
        model_.log.leave_out(card.name(), "springs to points without a place");
        return;
      }
      spring.vertices[end] = model_.vertex(card, field, "end");
      spring.components[end] = component(card, field + 1);
      spring.axes[end] = model_.output_axes(spring.vertices[end]);
    }
    if (spring.vertices[0] < 0) {
      std::swap(spring.vertices[0], spring.vertices[1]);
      std::swap(spring.components[0], spring.components[1]);
      std::swap(spring.axes[0], spring.axes[1]);
    }
    if (spring.vertices[0] < 0)
      throw CardError{fmt::format("{} {} joins nothing", card.name(), card.text(0))};
    if (spring.vertices[1] < 0) {
      spring.components[1] = spring.components[0];
      spring.axes[1] = spring.axes[0];
    }
    if ((spring.components[0] < 3) != (spring.components[1] < 3))
      throw CardError{
          fmt::format("{} {} joins a displacement with a rotation", card.name(), card.text(0))};
    add(card, spring, stiffness * unit(spring.components[0]));
  }

  static int component(const CardView& card, std::size_t i) {
    const long number = card.integer(i, "component");
    if (number < 1 || number > 6)
      throw CardError{fmt::format("component {} is none of 1 to 6", number)};
    return static_cast<int>(number) - 1;
  }

  void add(const CardView& card, Spring& spring, double stiffness) {
    if (!(stiffness >= 0))
      throw CardError{fmt::format("{} {} has a negative stiffness", card.name(), card.text(0))};
    spring.stiffness = stiffness;
    if (stiffness > 0) mesh_.springs.push_back(spring);
  }

  // ... EID PID GA GB: reads label and ends, and finds the property.
  const CardView& read_bush(const CardView& card, const std::unordered_map<long, CardView>& known,
                            const char* kind, Spring& spring) {
    spring.label = model_.new_element(card);
    const auto found = known.find(card.label(1, "property", spring.label));
    if (found == known.end())
      throw CardError{fmt::format("property {} does not exist, or is no {}", card.text(1), kind)};
    spring.vertices[0] = model_.vertex(card, 2, "end");
    if (card.has(3) && !card.is(3, "0")) spring.vertices[1] = model_.vertex(card, 3, "end");
    return found->second;
  }

  /// From its first end to the second; zero where it ends on the ground, m.
  Vector3 line_of(const Spring& spring) const {
    if (spring.vertices[1] < 0) return Vector3::Zero();
    return model_.place(spring.vertices[1]) - model_.place(spring.vertices[0]);
  }

  // CBUSH EID PID GA GB X1/G0 X2 X3 CID / S OCID S1 S2 S3
  void add_bush(const CardView& card) {
    Spring spring;
    const CardView& property = read_bush(card, bushes_, "PBUSH", spring);
    const bool has_end = spring.vertices[1] >= 0;
    const Vector3 from = model_.place(spring.vertices[0]);
    const Vector3 to = from + line_of(spring);
    const auto& [stiffness, mass] = bush_property(property);
    const bool is_along_line =
        stiffness[1] == 0 && stiffness[2] == 0 && stiffness[4] == 0 && stiffness[5] == 0;
    spring.axes[0] = spring.axes[1] = bush_axes(card, spring, from, to, is_along_line);
    Vector3 place = from + card.real(8, "place of the spring", 0.5) * (to - from);
    if (const long system = card.integer(9, "system of its place", -1); system >= 0) {
      const Vector3 given(card.real(10, "place", 0.0), card.real(11, "place", 0.0),
                          card.real(12, "place", 0.0));
      place = model_.units.length * model_.systems.get(system).place(given);
    }
    spring.arms[0] = place - from;
    if (has_end) spring.arms[1] = place - to;
    for (int i = 0; i < 6; ++i) {
      spring.components = {i, i};
      add(card, spring, stiffness[i] * unit(i));
    }
    add_masses(spring, mass * model_.units.mass() * model_.mass_factor);
  }

  /// Where it resists nothing but along and about its line, any vector across serves.
  Eigen::Matrix3d bush_axes(const CardView& card, const Spring& spring, const Vector3& from,
                            const Vector3& to, bool is_along_line) {
    if (card.has(7))
      return model_.axes_at(card.integer(7, "coordinate system"), spring.vertices[0]);
    const Vector3 line = to - from;
    if (!(line.norm() > 1e-9))
      throw CardError{
          fmt::format("CBUSH {} has no length and no coordinate system (CID)", card.text(0))};
    Vector3 vector = Vector3::Zero();
    if (card.is_integer(4) && !card.has(5))
      vector = model_.place(model_.vertex(card, 4, "grid that orients it")) - from;
    else if (card.has(4) || card.has(5) || card.has(6))
      vector = model_.output_axes(spring.vertices[0]) * Vector3(card.real(4, "vector", 0.0),
                                                                card.real(5, "vector", 0.0),
                                                                card.real(6, "vector", 0.0));
    else if (is_along_line)
      vector = line.unitOrthogonal();
    if (!(line.cross(vector).norm() > 1e-6 * line.norm() * vector.norm()))
      throw CardError{
          fmt::format("CBUSH {} has neither a coordinate system nor a vector that "
                      "orients it",
                      card.text(0))};
    Eigen::Matrix3d axes;
    axes.col(0) = line.normalized();
    axes.col(2) = line.cross(vector).normalized();
    axes.col(1) = axes.col(2).cross(axes.col(0));
    return axes;
  }

  /// In the deck's units.
  struct BushProperty {
    std::array<double, 6> stiffness{};
    double mass = 0;
  };

  BushProperty bush_property(const CardView& card) {
    BushProperty property;
    for (std::size_t first = 1; first < card.size(); first += 8) {
      if (card.is(first, "K")) {
        for (std::size_t i = 0; i < 6; ++i)
          property.stiffness[i] = card.is(first + 1 + i, "RIGID")
                                      ? throw CardError{"a RIGID component of PBUSH is not known"}
                                      : card.real(first + 1 + i, "stiffness", 0.0);
      } else if (card.is(first, "M")) {
        property.mass = card.real(first + 1, "mass", 0.0);
        if (property.mass < 0)
          throw CardError{fmt::format("PBUSH {} has a negative mass", card.text(0))};
      } else if (card.is(first, "B") || card.is(first, "GE") || card.is(first, "RCV") ||
                 card.is(first, "T")) {
        model_.log.leave_out("PBUSH", "damping, coefficients of stress and of heat");
      } else {
        refuse_line_of_bush(card, first);
      }
    }
    model_.log.use("PBUSH");
    return property;
  }

  /// A line whose word is another or missing; one without anything says nothing.
  static void refuse_line_of_bush(const CardView& card, std::size_t first) {
    if (card.has(first))
      throw CardError{fmt::format(
          "PBUSH {} has a line of \"{}\", which is not known; K, B, GE, RCV, T and M are",
          card.text(0), card.text(first))};
    for (std::size_t i = first + 1; i < first + 7; ++i)
      if (card.has(i))
        throw CardError{
            fmt::format("PBUSH {} has \"{}\" without a word before it that tells what it is: K, B, "
                        "GE, RCV, T or M",
                        card.text(0), card.text(i))};
  }

  // CBUSH1D EID PID GA GB CID: along the line of its grids, or axis 1 of CID
  void add_line_bush(const CardView& card) {
    Spring spring;
    const CardView& property = read_bush(card, line_bushes_, "PBUSH1D", spring);
    const Vector3 line = line_of(spring);
    Vector3 along = line;
    if (card.has(4))
      along = model_.axes_at(card.integer(4, "coordinate system"), spring.vertices[0]).col(0);
    else if (!(line.norm() > 1e-9))
      throw CardError{
          fmt::format("CBUSH1D {} has no length and no coordinate system (CID)", card.text(0))};
    Eigen::Matrix3d axes;
    axes.col(0) = along.normalized();
    axes.col(1) = axes.col(0).unitOrthogonal();
    axes.col(2) = axes.col(0).cross(axes.col(1));
    spring.axes = {axes, axes};
    // Both act on one line, so that the spring holds no turn of the whole.
    spring.arms = {line / 2, -line / 2};
    if (used_line_bushes_.insert(card.label(1, "property", spring.label)).second)
      model_.log.use("PBUSH1D");
    if (property.size() > 8)
      model_.log.leave_out("PBUSH1D", "its tables and equations: K is used, as for small motions");
    else if (property.has(2))
      model_.log.leave_out("PBUSH1D", "damping");
    add_masses(spring, property.real(3, "mass", 0.0) * model_.units.mass() * model_.mass_factor);
    add(card, spring, property.real(1, "stiffness", 0.0) * unit(0));
  }

  /// Half of an element's mass at either end; what is on the ground is no block's.
  void add_masses(const Spring& spring, double mass) {
    if (!(mass > 0)) return;
    for (const int vertex : spring.vertices) {
      if (vertex < 0) continue;
      PointMass point;
      point.vertex = vertex;
      point.mass = mass / 2;
      point.label = spring.label;
      mesh_.masses.push_back(point);
    }
  }

  NastranModel& model_;
  Mesh& mesh_;
  std::unordered_map<long, double> springs_;
  std::unordered_map<long, CardView> bushes_, line_bushes_;
  std::unordered_set<long> used_line_bushes_;
};

}  // namespace

void read_nastran_springs(NastranModel& model) { Springs(model).read(); }

}  // namespace blocklift::structure
