// Masses, rigid and distributing links, springs, equations of two freedoms.

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <fmt/format.h>

#include "structure/index.h"
#include "structure/mesh/files/deck/label_range.h"
#include "structure/mesh/files/deck/link_frames.h"
#include "structure/mesh/files/nastran/model.h"

namespace blocklift::structure {

namespace {

using Components = std::array<bool, 6>;

constexpr Components all_six{true, true, true, true, true, true};

bool is_sound(const Eigen::Matrix3d& inertia) {
  const Eigen::Vector3d moments =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia).eigenvalues();
  return moments[0] >= -1e-6 * std::abs(moments[2]);
}

class Masses {
 public:
  explicit Masses(NastranModel& model) : model_(model) {}
  void read() {
    model_.for_each({{"CONM2", [&](const CardView& card) { add(card); }},
                     {"CONM1", [&](const CardView& card) { add_matrix(card); }}});
  }

 private:
  double unit() const { return model_.units.mass() * model_.mass_factor; }

  // CONM2 EID G CID M X1 X2 X3 / I11 I21 I22 I31 I32 I33
  void add(const CardView& card) {
    PointMass mass;
    mass.label = model_.new_element(card);
    mass.vertex = model_.vertex(card, 1, "grid");
    const long system = card.integer(2, "coordinate system", 0);
    mass.mass = card.real(3, "mass", 0.0) * unit();
    const Vector3 offset(card.real(4, "offset", 0.0), card.real(5, "offset", 0.0),
                         card.real(6, "offset", 0.0));
    const double length = model_.units.length;
    // -1: the centre's coordinates in the basic system rather than an offset.
    const Eigen::Matrix3d axes =
        system < 0 ? Eigen::Matrix3d::Identity() : model_.axes_at(system, mass.vertex);
    mass.offset = system < 0 ? Vector3(offset * length - model_.place(mass.vertex))
                             : Vector3(axes * offset * length);
    std::array<double, 6> moment{};
    for (std::size_t i = 0; i < 6; ++i) moment[i] = card.real(8 + i, "moment of inertia", 0.0);
    Eigen::Matrix3d inertia;
    inertia << moment[0], -moment[1], -moment[3], -moment[1], moment[2], -moment[4], -moment[3],
        -moment[4], moment[5];
    mass.inertia = axes * (inertia * unit() * length * length) * axes.transpose();
    finish(card, mass);
  }

  // CONM1 EID G CID M11 M21 M22 M31 M32 / M33 M41 ... M66: the lower triangle by rows
  void add_matrix(const CardView& card) {
    PointMass mass;
    mass.label = model_.new_element(card);
    mass.vertex = model_.vertex(card, 1, "grid");
    Eigen::Matrix<double, 6, 6> matrix;
    std::size_t field = 3;
    for (int row = 0; row < 6; ++row)
      for (int column = 0; column <= row; ++column)
        matrix(row, column) = matrix(column, row) = card.real(field++, "mass", 0.0);
    const double m = matrix(0, 0), least = 1e-6 * std::abs(m);
    Eigen::Matrix3d rest = matrix.topLeftCorner<3, 3>() - m * Eigen::Matrix3d::Identity();
    Eigen::Matrix3d arm =
        matrix.bottomLeftCorner<3, 3>();  // m times the cross product by the offset
    if (rest.cwiseAbs().maxCoeff() > least ||
        (arm + arm.transpose()).cwiseAbs().maxCoeff() > 1e-6 * (arm.norm() + least))
      throw CardError{
          fmt::format("CONM1 {} is not the matrix of a rigid body's mass; only such "
                      "masses can be carried",
                      card.text(0))};
    const Eigen::Matrix3d axes =
        model_.axes_at(card.integer(2, "coordinate system", 0), mass.vertex);
    const double length = model_.units.length;
    Vector3 offset = Vector3::Zero();
    if (m > 0) offset << arm(2, 1) / m, arm(0, 2) / m, arm(1, 0) / m;
    const Eigen::Matrix3d inertia =
        matrix.bottomRightCorner<3, 3>() -
        m * (offset.squaredNorm() * Eigen::Matrix3d::Identity() - offset * offset.transpose());
    mass.mass = m * unit();
    mass.offset = axes * offset * length;
    mass.inertia = axes * (inertia * unit() * length * length) * axes.transpose();
    finish(card, mass);
  }

  void finish(const CardView& card, const PointMass& mass) {
    if (mass.mass < 0)
      throw CardError{fmt::format("{} {} has a negative mass", card.name(), card.text(0))};
    if (!is_sound(mass.inertia))
      throw CardError{
          fmt::format("{} {} has a negative moment of inertia", card.name(), card.text(0))};
    model_.deck.mesh.masses.push_back(mass);
  }

  NastranModel& model_;
};

class Links {
 public:
  explicit Links(NastranModel& model) : model_(model), mesh_(model.deck.mesh) {}

  void read() {
    model_.for_each({{"RBE2", [&](const CardView& card) { add_rbe2(card); }},
                     {"RBE3", [&](const CardView& card) { add_rbe3(card); }},
                     {"RBE1", [&](const CardView& card) { add_rbe1(card); }},
                     {"RBAR", [&](const CardView& card) { add_rbar(card); }}});
  }

 private:
  void add_rigid(long label, int master, const std::vector<int>& slaves, const Components& bound) {
    RigidLink link;
    link.label = label;
    link.master = master;
    link.bound = bound;
    for (const int slave : slaves) {
      const Eigen::Matrix3d axes = model_.output_axes(slave);
      if (is_free_of_axes(bound) || is_identity(axes)) {
        link.slaves.push_back(slave);
      } else {
        RigidLink one{master, {slave}, bound, axes, label};
        mesh_.rigid_links.push_back(one);
      }
    }
    if (!link.slaves.empty()) mesh_.rigid_links.push_back(link);
  }

  // RBE2 EID GN CM GM1 GM2 ... ALPHA
  void add_rbe2(const CardView& card) {
    const long label = model_.new_element(card);
    const int master = model_.vertex(card, 1, "independent grid");
    const Components bound = card.components(2, "bound components");
    std::vector<int> slaves;
    for (std::size_t i = 3; i < card.size(); ++i) {
      if (!card.has(i)) continue;
      if (card.is(i, "THRU")) {
        const long from = card.label(i - 1, "grid"), to = card.label(++i, "last grid");
        for (const long number : known_labels(model_.vertex_of, from + 1, to))
          slaves.push_back(model_.vertex_of.at(number));
      } else if (!card.is_integer(i) && to_real(card.text(i))) {
        model_.log.leave_out("RBE2", "ALPHA (thermal expansion)");
      } else {
        slaves.push_back(model_.vertex(card, i, "dependent grid"));
      }
    }
    if (slaves.empty()) throw CardError{fmt::format("RBE2 {} binds no grid", label)};
    if (std::find(slaves.begin(), slaves.end(), master) != slaves.end())
      throw CardError{fmt::format("RBE2 {} binds its independent grid", label)};
    add_rigid(label, master, slaves, bound);
  }

  // RBE3 EID blank REFGRID REFC WT1 C1 G1,1 G1,2 ... WT2 ... UM ... ALPHA ...
  void add_rbe3(const CardView& card) {
    DistributingLink link;
    link.label = model_.new_element(card);
    link.reference = model_.vertex(card, 2, "reference grid");
    link.bound = card.components(3, "bound components");
    link.axes = is_free_of_axes(link.bound) ? Eigen::Matrix3d::Identity()
                                            : model_.output_axes(link.reference);
    double weight = 0;
    for (std::size_t i = 4; i < card.size(); ++i) {
      if (!card.has(i)) continue;
      if (card.is(i, "ALPHA")) {
        model_.log.leave_out("RBE3", "ALPHA (thermal expansion)");
        break;
      }
      if (card.is(i, "UM")) {
        // Which freedoms the solver eliminates does not change the motion.
        model_.log.leave_out("RBE3", "UM (which freedoms are eliminated)");
        break;
      }
      if (!card.is_integer(i) || (link.vertices.empty() && weight == 0)) {
        weight = card.real(i, "weight");
        const Components counts = card.components(++i, "components that count");
        if (counts != Components{true, true, true, false, false, false})
          throw CardError{fmt::format(
              "RBE3 {} counts components {} of its grids; the three displacements (123) are due",
              link.label, card.text(i))};
        if (!(weight > 0))
          throw CardError{fmt::format("RBE3 {} has a weight that is not positive", link.label)};
        continue;
      }
      link.vertices.push_back(model_.vertex(card, i, "grid"));
      link.weights.push_back(weight);
    }
    if (link.vertices.empty()) throw CardError{fmt::format("RBE3 {} names no grids", link.label)};
    mesh_.distributing_links.push_back(link);
  }

  // RBAR EID GA GB CNA CNB CMA CMB
  void add_rbar(const CardView& card) {
    const long label = model_.new_element(card);
    const int a = model_.vertex(card, 1, "end"), b = model_.vertex(card, 2, "end");
    const auto components = [&](std::size_t i) {
      return card.has(i) && !card.is(i, "0") ? card.components(i, "components") : Components{};
    };
    const Components free_a = components(3), free_b = components(4);
    if (free_a == all_six && free_b == Components{})
      add_rigid(label, a, {b}, card.has(6) ? components(6) : all_six);
    else if (free_b == all_six && free_a == Components{})
      add_rigid(label, b, {a}, card.has(5) ? components(5) : all_six);
    else
      throw CardError{
          fmt::format("RBAR {} has independent components at both ends; all six at one "
                      "end are due",
                      label)};
  }

  // RBE1 EID GN1 CN1 GN2 CN2 GN3 CN3 / ... / UM GM1 CM1 GM2 CM2 ...
  void add_rbe1(const CardView& card) {
    const long label = model_.new_element(card);
    const int master = model_.vertex(card, 1, "independent grid");
    if (card.components(2, "independent components") != all_six)
      throw CardError{
          fmt::format("RBE1 {}: all six components of one grid are due as independent", label)};
    std::size_t i = 3;
    while (i < card.size() && !card.is(i, "UM")) {
      if (card.has(i))
        throw CardError{fmt::format("RBE1 {} has more than one independent grid", label)};
      ++i;
    }
    for (++i; i + 1 < card.size(); ++i) {
      if (!card.has(i)) continue;
      if (!card.is_integer(i)) break;  // ALPHA
      const int slave = model_.vertex(card, i, "dependent grid");
      add_rigid(label, master, {slave}, card.components(++i, "dependent components"));
    }
  }

  NastranModel& model_;
  Mesh& mesh_;
};

class Springs {
 public:
  explicit Springs(NastranModel& model) : model_(model), mesh_(model.deck.mesh) {}

  void read() {
    for (const NastranCard& card : model_.bulk.cards)
      if (card.name == "PELAS" || card.name == "PBUSH") keep(CardView(model_.bulk, card));
    model_.for_each(
        {{"CELAS1", [&](const CardView& card) { add_with_property(card); }},
         {"CELAS2", [&](const CardView& card) { add_spring(card, card.real(1, "stiffness"), 2); }},
         {"CBUSH", [&](const CardView& card) { add_bush(card); }}});
  }

 private:
  // PELAS PID1 K1 GE1 S1 PID2 K2 GE2 S2
  // PBUSH PID K K1 ... K6 / ...
  void keep(const CardView& card) {
    try {
      if (card.name() == "PBUSH") {
        bushes_.emplace(card.label(0, "property"), card);
        return;
      }
      for (const std::size_t first : {0U, 4U})
        if (card.has(first))
          springs_.emplace(card.label(first, "property"), card.real(first + 1, "stiffness"));
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

  // CBUSH EID PID GA GB X1/G0 X2 X3 CID / S OCID S1 S2 S3
  void add_bush(const CardView& card) {
    Spring spring;
    spring.label = model_.new_element(card);
    const auto found = bushes_.find(card.label(1, "property", spring.label));
    if (found == bushes_.end())
      throw CardError{fmt::format("property {} does not exist", card.text(1))};
    spring.vertices[0] = model_.vertex(card, 2, "end");
    const bool has_end = card.has(3) && !card.is(3, "0");
    if (has_end) spring.vertices[1] = model_.vertex(card, 3, "end");
    const Vector3 from = model_.place(spring.vertices[0]);
    const Vector3 to = has_end ? model_.place(spring.vertices[1]) : from;
    spring.axes[0] = spring.axes[1] = bush_axes(card, spring, from, to);
    Vector3 place = from + card.real(8, "place of the spring", 0.5) * (to - from);
    if (const long system = card.integer(9, "system of its place", -1); system >= 0) {
      const Vector3 given(card.real(10, "place", 0.0), card.real(11, "place", 0.0),
                          card.real(12, "place", 0.0));
      place = model_.units.length * model_.systems.get(system).place(given);
    }
    spring.arms[0] = place - from;
    if (has_end) spring.arms[1] = place - to;
    const std::array<double, 6> stiffness = bush_stiffness(found->second);
    for (int i = 0; i < 6; ++i) {
      spring.components = {i, i};
      add(card, spring, stiffness[at(i)] * unit(i));
    }
  }

  Eigen::Matrix3d bush_axes(const CardView& card, const Spring& spring, const Vector3& from,
                            const Vector3& to) {
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

  std::array<double, 6> bush_stiffness(const CardView& property) {
    std::array<double, 6> stiffness{};
    for (std::size_t first = 1; first < property.size(); first += 8) {
      if (property.is(first, "K")) {
        for (std::size_t i = 0; i < 6; ++i)
          stiffness[i] = property.is(first + 1 + i, "RIGID")
                             ? throw CardError{"a RIGID component of PBUSH is not known"}
                             : property.real(first + 1 + i, "stiffness", 0.0);
      } else if (property.has(first)) {
        model_.log.leave_out("PBUSH", "damping, stress coefficients and mass");
      }
    }
    model_.log.use("PBUSH");
    return stiffness;
  }

  NastranModel& model_;
  Mesh& mesh_;
  std::unordered_map<long, double> springs_;
  std::unordered_map<long, CardView> bushes_;
};

}  // namespace

void read_nastran_links(NastranModel& model) {
  Masses(model).read();
  Links(model).read();
  Springs(model).read();
}

}  // namespace blocklift::structure
