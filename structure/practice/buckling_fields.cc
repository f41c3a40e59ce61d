#include "structure/practice/buckling_fields.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>

#include <Eigen/Dense>

#include "structure/practice/curved_sectors.h"
#include "structure/practice/plate_cuts.h"

namespace blocklift::structure {

namespace {

/// The direction in which most of a field's outline runs, in the plane across a normal; of two
/// alike the one nearer to x, then y, so that square panels of a plate lie the same way.
Vector3 main_direction(const Mesh& mesh, const PlateField& field, const Vector3& normal) {
  constexpr double parallel = 0.995;  // cosine
  std::vector<Vector3> chords;
  for (const auto& outline : field.outlines)
    for (const FieldEdge& edge : outline) {
      const Vector3 chord =
          mesh.vertices[edge.pieces.back().to] - mesh.vertices[edge.pieces.front().from];
      chords.push_back(chord - normal * normal.dot(chord));
    }
  const auto preference = [](const Vector3& d) { return std::abs(d.x()) + 0.5 * std::abs(d.y()); };
  Vector3 best = normal.unitOrthogonal();
  double longest = 0;
  for (const Vector3& chord : chords) {
    if (chord.norm() == 0) continue;
    const Vector3 direction = chord.normalized();
    double total = 0;
    for (const Vector3& other : chords)
      if (std::abs(direction.dot(other)) > parallel * other.norm()) total += other.norm();
    const bool is_alike = std::abs(total - longest) <= 1e-6 * longest;
    if (is_alike ? preference(direction) <= preference(best) + 1e-6 : total < longest) continue;
    longest = total;
    best = direction;
  }
  Eigen::Index axis = 0;
  best.cwiseAbs().maxCoeff(&axis);
  return best[axis] < 0 ? Vector3(-best) : best;
}

/// Cuts fields, and finds again what is left: shells of different labels do not go on.
class FieldDivider {
 public:
  FieldDivider(const Mesh& mesh, const std::set<EdgeKey>& beams)
      : mesh_(mesh),
        beams_(beams),
        label_(mesh.shells.size(), 0),
        sectors_(mesh.shells.size(), -1) {
    find();
  }

  BucklingFields divide() {
    cut_curved();
    cut_at_corners();
    for (PlateField& field : found_) {
      const int first = field.shells.front();
      BucklingField& whole = result_.fields.emplace_back();
      const auto length = whole_length_.find(base_[first]);
      if (length != whole_length_.end()) whole.whole_length = length->second;
      if (sectors_[first] >= 0) {
        whole.bend_axis = turns_[sectors_[first]].axis;
        whole.arc = turns_[sectors_[first]].arc;
      }
      whole.field = std::move(field);
    }
    return std::move(result_);
  }

 private:
  bool is_lug(int shell) const { return mesh_.regions[mesh_.shells[shell].region].is_lug; }

  void find() {
    found_ = find_fields(mesh_, 0.15, [&](int a, int b, int vertex_1, int vertex_2) {
               return is_lug(a) == is_lug(b) && label_[a] == label_[b] &&
                      beams_.count({vertex_1, vertex_2}) == 0;
             }).fields;
  }

  /// Twice: what is curved both ways turns within a sector, too.
  void cut_curved() {
    for (int round = 0; round < 2; ++round) {
      bool is_cut = false;
      for (const PlateField& field : found_) {
        if (is_lug(field.shells.front())) continue;
        const std::optional<CurvedSectors> sectors = find_curved_sectors(mesh_, field);
        if (!sectors) continue;
        is_cut = true;
        turns_.push_back(sectors->turn);
        for (std::size_t i = 0; i < field.shells.size(); ++i) {
          label_[field.shells[i]] = labels_ + sectors->of_shell[i];
          sectors_[field.shells[i]] = static_cast<int>(turns_.size()) - 1;
        }
        labels_ += sectors->count;
      }
      if (!is_cut) return;
      find();
    }
  }

  void cut_at_corners() {
    base_.assign(mesh_.shells.size(), -1);
    for (std::size_t f = 0; f < found_.size(); ++f)
      for (const int shell : found_[f].shells) base_[shell] = static_cast<int>(f);
    for (const int base : base_) labels_ = std::max(labels_, base + 1);
    label_ = base_;
    std::set<int> settled;
    // Each round cuts every piece at most once; a ring frame takes four.
    for (int round = 0; round < 12; ++round) {
      bool is_cut = false;
      for (const PlateField& field : found_) is_cut = cut_once(field, settled) || is_cut;
      if (!is_cut) return;
      find();
    }
  }

  bool cut_once(const PlateField& field, std::set<int>& settled) {
    const int first = field.shells.front(), label = label_[first];
    if (is_lug(first) || settled.count(label) != 0) return false;
    const std::optional<PlateCut> cut =
        find_plate_cut(mesh_, field, axes_of(mesh_, field), result_);
    if (!cut) {
      settled.insert(label);
      return false;
    }
    whole_length_.try_emplace(base_[first], cut->whole_length);
    for (std::size_t i = 0; i < field.shells.size(); ++i)
      label_[field.shells[i]] = labels_ + cut->piece_of_shell[i];
    labels_ += cut->pieces;
    result_.cuts.insert(cut->edges.begin(), cut->edges.end());
    for (const auto& [vertex, place] : cut->straightened) result_.straightened[vertex] = place;
    return true;
  }

  const Mesh& mesh_;
  const std::set<EdgeKey>& beams_;
  std::vector<int> label_;    ///< of each shell
  std::vector<int> sectors_;  ///< of each shell, place in turns_; -1: not cut
  std::vector<int> base_;     ///< of each shell, its field before cuts at corners
  int labels_ = 1;            ///< that were given so far
  std::vector<PlateTurn> turns_;
  std::vector<PlateField> found_;
  std::map<int, double> whole_length_;  ///< of a base that was cut
  BucklingFields result_;
};

}  // namespace

ShellShare share_of_shell(const Mesh& mesh, int number, bool is_flipped) {
  const Shell& shell = mesh.shells[number];
  const auto corner = [&](double x, double y) { return position(mesh, shell, {x, y}); };
  ShellShare share;
  // Two triangles: the middle of a triangle as a shell lies elsewhere than that of its square.
  const std::array<std::array<Vector3, 3>, 2> halves{
      {{corner(0, 0), corner(1, 0), corner(0, 1)}, {corner(1, 1), corner(0, 1), corner(1, 0)}}};
  Vector3 area_vector = Vector3::Zero();
  for (const auto& [a, b, c] : halves) {
    const Vector3 half = 0.5 * (b - a).cross(c - a);
    area_vector += half;
    share.area += half.norm();
    share.middle += half.norm() * (a + b + c) / 3;
  }
  share.middle /= share.area;
  share.normal = (is_flipped ? -1.0 : 1.0) * area_vector.normalized();
  return share;
}

FieldAxes axes_of(const Mesh& mesh, const PlateField& field) {
  FieldAxes axes;
  for (std::size_t i = 0; i < field.shells.size(); ++i) {
    const ShellShare share = share_of_shell(mesh, field.shells[i], field.is_flipped[i]);
    axes.normal += share.area * share.normal;
  }
  axes.normal.normalize();
  axes.e_1 = main_direction(mesh, field, axes.normal);
  axes.e_2 = axes.normal.cross(axes.e_1);
  return axes;
}

BucklingFields find_buckling_fields(const Mesh& mesh, const std::set<EdgeKey>& beams) {
  return FieldDivider(mesh, beams).divide();
}

}  // namespace blocklift::structure
