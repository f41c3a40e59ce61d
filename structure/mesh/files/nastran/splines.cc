// Grids that lie on an elastic line through others.

#include <fmt/format.h>

#include "structure/mesh/files/nastran/model.h"

namespace blocklift::structure {

namespace {

using Matrix3 = Eigen::Matrix3d;

/// Motion of a slender straight beam between its ends, at a share s of its length L: along the
/// beam, displacement and turn are linear; across it v = N_1 v_1 + N_2 v_1' + N_3 v_2 + N_4 v_2'
/// with Hermite's cubic polynomials and v' = theta x e.
class ElasticLine {
 public:
  ElasticLine(const Vector3& reach, double share)
      : direction_(reach.normalized()), length_(reach.norm()), share_(share) {}

  /// Coefficients of an end's displacement and turn in c . u and c . theta at the place.
  struct Shares {
    Vector3 of_displacement, of_rotation;
  };
  Shares of_displacement(const Vector3& c, int end) const {
    const double s = share_, along = end == 0 ? 1 - s : s;
    const double n = end == 0 ? 1 - 3 * s * s + 2 * s * s * s : 3 * s * s - 2 * s * s * s;
    const double slope = length_ * (end == 0 ? s - 2 * s * s + s * s * s : s * s * s - s * s);
    return {split(c, along, n), slope * direction_.cross(c)};
  }
  Shares of_rotation(const Vector3& c, int end) const {
    const double s = share_, along = end == 0 ? 1 - s : s;
    const double n = (end == 0 ? -1 : 1) * 6 * s * (1 - s) / length_;
    const double slope = end == 0 ? 1 - 4 * s + 3 * s * s : 3 * s * s - 2 * s;
    return {n * c.cross(direction_), split(c, along, slope)};
  }

 private:
  Vector3 split(const Vector3& c, double along, double across) const {
    const Vector3 part = direction_ * direction_.dot(c);
    return along * part + across * (c - part);
  }

  Vector3 direction_;
  double length_, share_;
};

class Splines {
 public:
  explicit Splines(NastranModel& model) : model_(model), mesh_(model.deck.mesh) {}

  void read() {
    model_.for_each({{"RSPLINE", [&](const CardView& card) { add(card); }}});
  }

 private:
  // RSPLINE EID D/L G1 G2 C2 G3 C3 ... Gn; a grid without components is one that the line goes
  // through as it is.
  void add(const CardView& card) {
    model_.new_element(card);
    int from = model_.vertex(card, 2, "first grid");
    std::vector<int> between;
    bool is_closed = false;
    for (std::size_t i = 3; i < card.size(); i += 2) {
      if (!card.has(i)) continue;
      const int vertex = model_.vertex(card, i, "grid");
      is_closed = !card.has(i + 1) || card.is(i + 1, "0");
      if (!is_closed) {
        const std::array<bool, 6> follows = card.components(i + 1, "components");
        if (follows != std::array<bool, 6>{true, true, true, true, true, true})
          throw CardError{fmt::format(
              "RSPLINE {}: grid {} follows in some components alone; all six (123456) or none are "
              "known",
              card.text(0), card.text(i))};
        between.push_back(vertex);
        continue;
      }
      for (const int one : between) follow(card, one, from, vertex);
      between.clear();
      from = vertex;
    }
    if (!is_closed)
      throw CardError{fmt::format("RSPLINE {}: the last grid must not follow", card.text(0))};
  }

  void follow(const CardView& card, int vertex, int first, int last) {
    constexpr double straight = 0.01;
    const Vector3 reach = model_.place(last) - model_.place(first);
    const Vector3 arm = model_.place(vertex) - model_.place(first);
    const double length = reach.norm();
    const double share = length > 1e-9 ? arm.dot(reach) / (length * length) : -1;
    if (!(share > 0 && share < 1 && arm.cross(reach).norm() < straight * length * length))
      throw CardError{fmt::format(
          "RSPLINE {}: grid {} lies not between grids {} and {} (within 1 % of their distance off "
          "their line)",
          card.text(0), mesh_.vertex_labels[vertex], mesh_.vertex_labels[first],
          mesh_.vertex_labels[last])};
    const ElasticLine line(reach, share);
    const Matrix3 axes = model_.output_axes(vertex);
    for (int i = 0; i < 6; ++i) {
      const Vector3 c = axes.col(i % 3);
      MotionEquation equation;
      equation.terms.push_back(i < 3 ? MotionEquation::Term{vertex, c, Vector3::Zero()}
                                     : MotionEquation::Term{vertex, Vector3::Zero(), c});
      for (const int end : {0, 1}) {
        const ElasticLine::Shares shares =
            i < 3 ? line.of_displacement(c, end) : line.of_rotation(c, end);
        equation.terms.push_back(
            {end == 0 ? first : last, -shares.of_displacement, -shares.of_rotation});
      }
      // A grid beside the line would else resist a turn of the whole.
      balance(mesh_, equation);
      equation.label = static_cast<long>(mesh_.equations.size()) + 1;
      mesh_.equations.push_back(std::move(equation));
    }
  }

  NastranModel& model_;
  Mesh& mesh_;
};

}  // namespace

void read_nastran_splines(NastranModel& model) { Splines(model).read(); }

}  // namespace blocklift::structure
