// Point masses.

#include <algorithm>
#include <cmath>

#include <Eigen/Core>
#include <fmt/format.h>

#include "algebra/decompositions.h"
#include "structure/mesh/files/nastran/model.h"

namespace blocklift::structure {

namespace {

bool is_sound(const Eigen::Matrix3d& inertia) {
  const Eigen::Vector3d moments = algebra::symmetric_eigenvalues(inertia);
  return moments[0] >= -1e-6 * std::abs(moments[2]);
}

class Masses {
 public:
  explicit Masses(NastranModel& model) : model_(model) {}
  void read() {
    model_.for_each({{"CONM2", [&](const CardView& card) { add(card); }},
                     {"CONM1", [&](const CardView& card) { add_matrix(card); }}});
    for (const NastranCard& card : model_.bulk.cards)
      if (card.name == "PMASS") keep(CardView(model_.bulk, card));
    model_.for_each(
        {{"CMASS1",
          [&](const CardView& card) {
            const auto found = scalar_masses_.find(card.label(1, "property"));
            if (found == scalar_masses_.end())
              throw CardError{fmt::format("property {} does not exist", card.text(1))};
            model_.log.use("PMASS");
            add_scalar(card, found->second);
          }},
         {"CMASS2", [&](const CardView& card) { add_scalar(card, card.real(1, "mass")); }}});
    join_scalars();
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

  // PMASS PID1 M1 PID2 M2 ...
  void keep(const CardView& card) {
    try {
      for (std::size_t i = 0; i + 1 < card.size(); i += 2)
        if (card.has(i))
          scalar_masses_.emplace(card.label(i, "property"), card.real(i + 1, "mass"));
    } catch (const CardError& error) {
      model_.log.complain(card.line(), card.name() + ": " + error.text);
    }
  }

  // CMASS1 EID PID G1 C1 G2 C2 | CMASS2 EID M G1 C1 G2 C2
  void add_scalar(const CardView& card, double value) {
    const long label = model_.new_element(card);
    const std::size_t end = card.has(2) && !card.is(2, "0") ? 2 : 4;
    const std::size_t other = end == 2 ? 4 : 2;
    if (card.has(other) && !card.is(other, "0"))
      throw CardError{"a mass between two freedoms is no body's"};
    if (model_.is_scalar_point(card.label(end, "grid"))) {
      model_.log.leave_out(card.name(), "masses of points without a place");
      return;
    }
    const int vertex = model_.vertex(card, end, "grid");
    const long component = card.integer(end + 1, "component");
    if (component < 1 || component > 6)
      throw CardError{fmt::format("component {} is none of 1 to 6", component)};
    if (value < 0) throw CardError{"the mass is negative"};
    const auto [of_vertex, is_new] = scalars_of_.try_emplace(vertex);
    if (is_new) of_vertex->second = {card.line(), label, {}};
    of_vertex->second.values[component - 1] += value;
  }

  /// A body's mass is the same along all three directions.
  void join_scalars() {
    for (const auto& [vertex, scalars] : scalars_of_) {
      const auto& m = scalars.values;
      const double least = std::min({m[0], m[1], m[2]}), most = std::max({m[0], m[1], m[2]});
      if (most - least > 1e-6 * most) {
        model_.log.complain(scalars.line,
                            fmt::format("CMASS: the masses along the three directions of grid {} "
                                        "are {:.6g}, {:.6g} and {:.6g}; those of a body are equal",
                                        model_.deck.mesh.vertex_labels[vertex], m[0], m[1], m[2]));
        continue;
      }
      PointMass mass;
      mass.vertex = vertex;
      mass.label = scalars.label;
      mass.mass = m[0] * unit();
      const double length = model_.units.length;
      const Eigen::Matrix3d axes = model_.output_axes(vertex);
      mass.inertia = axes * (Vector3(m[3], m[4], m[5]) * unit() * length * length).asDiagonal() *
                     axes.transpose();
      model_.deck.mesh.masses.push_back(mass);
    }
  }

  void finish(const CardView& card, const PointMass& mass) {
    if (mass.mass < 0)
      throw CardError{fmt::format("{} {} has a negative mass", card.name(), card.text(0))};
    if (!is_sound(mass.inertia))
      throw CardError{
          fmt::format("{} {} has a negative moment of inertia", card.name(), card.text(0))};
    model_.deck.mesh.masses.push_back(mass);
  }

  /// Masses along the six freedoms of a grid.
  struct Scalars {
    SourceLine line;
    long label = 0;
    std::array<double, 6> values{};
  };

  NastranModel& model_;
  std::map<long, double> scalar_masses_;  ///< PMASS
  std::map<int, Scalars> scalars_of_;     ///< by vertex
};

}  // namespace

void read_nastran_masses(NastranModel& model) { Masses(model).read(); }

}  // namespace blocklift::structure
