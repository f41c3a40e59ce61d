#include "dynamics/marine/radiation/hydrodynamic_series.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "dynamics/errors.h"
#include "dynamics/marine/radiation/retardation_samples.h"

namespace blocklift::dynamics {
namespace {

using Eigen::MatrixXd;

/// (1 - s) a + s b for all matrices of a list.
template <class Matrix>
void mix(std::vector<Matrix>& a, const std::vector<Matrix>& b, double s) {
  for (std::size_t k = 0; k < a.size(); ++k) a[k] = (1.0 - s) * a[k] + s * b[k];
}

void mix(std::vector<Vector3>& a, const std::vector<Vector3>& b, double s) {
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) a[k] = (1.0 - s) * a[k] + s * b[k];
}

HydrodynamicDatabase mix(HydrodynamicDatabase a, const HydrodynamicDatabase& b, double s) {
  mix(a.reference_points, b.reference_points, s);
  mix(a.centres_of_buoyancy, b.centres_of_buoyancy, s);
  mix(a.centres_of_mass, b.centres_of_mass, s);
  for (std::size_t k = 0; k < a.displaced_volumes.size(); ++k) {
    a.displaced_volumes[k] = (1.0 - s) * a.displaced_volumes[k] + s * b.displaced_volumes[k];
  }
  if (a.hydrostatic_stiffness.size() == b.hydrostatic_stiffness.size()) {
    a.hydrostatic_stiffness = (1.0 - s) * a.hydrostatic_stiffness + s * b.hydrostatic_stiffness;
  }
  a.infinite_added_mass = (1.0 - s) * a.infinite_added_mass + s * b.infinite_added_mass;
  mix(a.retardation, b.retardation, s);
  mix(a.added_mass, b.added_mass, s);
  mix(a.damping, b.damping, s);
  mix(a.froude_krylov, b.froude_krylov, s);
  mix(a.diffraction, b.diffraction, s);
  a.mean_drift.clear();
  a.far_field = {};
  return a;
}

/// Takes a share of one body's rows, and of its columns in square matrices.
class Reduction {
 public:
  Reduction(int body, double share) : first_(modes_per_body * body), share_(share) {}

  void square(MatrixXd& matrix) const {
    if (matrix.size() == 0) return;
    matrix.middleRows<modes_per_body>(first_) *= share_;
    const Eigen::Index after = matrix.cols() - first_ - modes_per_body;
    matrix.middleCols<modes_per_body>(first_).topRows(first_) *= share_;
    matrix.middleCols<modes_per_body>(first_).bottomRows(after) *= share_;
  }
  void rows(Eigen::MatrixXcd& matrix) const { matrix.middleRows<modes_per_body>(first_) *= share_; }

 private:
  int first_;
  double share_;
};

HydrodynamicDatabase lessen(HydrodynamicDatabase database, int body, double share) {
  const Reduction reduction(body, share);
  database.displaced_volumes[body] *= share;
  database.mean_drift.clear();
  database.far_field = {};
  reduction.square(database.hydrostatic_stiffness);
  reduction.square(database.infinite_added_mass);
  for (auto* matrices : {&database.retardation, &database.added_mass, &database.damping}) {
    for (MatrixXd& matrix : *matrices) reduction.square(matrix);
  }
  for (auto* matrices : {&database.froude_krylov, &database.diffraction}) {
    for (Eigen::MatrixXcd& matrix : *matrices) reduction.rows(matrix);
  }
  return database;
}

/// Each entry of the others' modes at its place among those of all bodies.
template <class Matrix>
Matrix with_gap(const Matrix& of_others, int body, Eigen::Index modes, bool square) {
  const Eigen::Index before = modes_per_body * body;
  const auto place = [&](Eigen::Index k) { return k < before ? k : k + modes_per_body; };
  Matrix all = Matrix::Zero(modes, square ? modes : of_others.cols());
  for (Eigen::Index j = 0; j < of_others.cols(); ++j) {
    for (Eigen::Index i = 0; i < of_others.rows(); ++i) {
      all(place(i), square ? place(j) : j) = of_others(i, j);
    }
  }
  return all;
}

/// No flow at all.
void dry_out(HydrodynamicDatabase& database) {
  database.infinite_added_mass.setZero();
  for (auto* matrices : {&database.retardation, &database.added_mass, &database.damping}) {
    for (MatrixXd& matrix : *matrices) matrix.setZero();
  }
  for (auto* matrices : {&database.froude_krylov, &database.diffraction}) {
    for (Eigen::MatrixXcd& matrix : *matrices) matrix.setZero();
  }
}

void require_alike(const HydrodynamicDatabase& a, const HydrodynamicDatabase& b,
                   std::size_t number) {
  const auto differ = [&](const std::string& what) {
    throw ModelError("database " + std::to_string(number) + " of the series differs in " + what +
                     " from the first");
  };
  if (a.body_names != b.body_names) differ("its bodies");
  if (a.water.density != b.water.density || a.water.gravity != b.water.gravity ||
      a.water.depth != b.water.depth)
    differ("the water");
  if (a.frequencies != b.frequencies) differ("its frequencies");
  if (a.headings != b.headings) differ("its headings");
}

}  // namespace

HydrodynamicDatabase HydrodynamicSeries::at(double draught) const {
  if (databases.size() == 1) return databases[0];
  if (draught <= draughts.front()) {
    if (draughts.front() == 0.0) return databases.front();
    return lessen(databases.front(), lowered_body, std::max(0.0, draught / draughts.front()));
  }
  if (draught >= draughts.back()) return databases.back();
  const auto above = std::upper_bound(draughts.begin(), draughts.end(), draught);
  const auto k = static_cast<std::size_t>(above - draughts.begin());
  return mix(databases[k - 1], databases[k],
             (draught - draughts[k - 1]) / (draughts[k] - draughts[k - 1]));
}

HydrodynamicDatabase with_dry_body(const HydrodynamicDatabase& wet, int body,
                                   const HydrodynamicDatabase* others) {
  HydrodynamicDatabase dry = wet;
  dry_out(dry);
  dry.hydrostatic_stiffness = {};
  dry.centres_of_buoyancy.clear();
  dry.change_from_coarser = {};
  dry.excitation_change_from_coarser = {};
  dry.cut_off_by_end = {};
  dry.mean_drift.clear();
  dry.far_field = {};
  dry.displaced_volumes[body] = 0.0;
  if (!others) return dry;
  std::vector<std::string> names = wet.body_names;
  names.erase(names.begin() + body);
  if (others->body_names != names) {
    throw ModelError("the database for " + wet.body_names[body] +
                     " out of the water holds other bodies than that in the water");
  }
  const Eigen::Index modes = wet.mode_count();
  const auto take = [&](const auto& from, auto& to, bool square) {
    to.clear();
    for (const auto& matrix : from) to.push_back(with_gap(matrix, body, modes, square));
  };
  dry.time_step = others->time_step;
  dry.infinite_added_mass = with_gap(others->infinite_added_mass, body, modes, true);
  take(others->retardation, dry.retardation, true);
  take(others->added_mass, dry.added_mass, true);
  take(others->damping, dry.damping, true);
  take(others->froude_krylov, dry.froude_krylov, false);
  take(others->diffraction, dry.diffraction, false);
  return dry;
}

HydrodynamicSeries make_series(int lowered_body, std::vector<double> draughts,
                               std::vector<HydrodynamicDatabase> databases) {
  if (databases.empty()) throw ModelError("a series of databases needs at least one");
  if (draughts.size() != databases.size()) {
    throw ModelError("there are " + std::to_string(draughts.size()) + " draughts for " +
                     std::to_string(databases.size()) + " databases");
  }
  for (std::size_t k = 0; k < databases.size(); ++k) {
    require_sound(databases[k]);
    require_alike(databases[0], databases[k], k + 1);
    if (databases.size() == 1) break;
    const bool in_order = k == 0 ? draughts[k] >= 0.0 : draughts[k] > draughts[k - 1];
    if (!in_order || !std::isfinite(draughts[k])) {
      throw ModelError("draught " + std::to_string(k + 1) + " of the series is " +
                       std::to_string(draughts[k]) + " m: draughts must be positive and ascend");
    }
  }
  if (lowered_body < 0 || lowered_body >= databases[0].body_count()) {
    throw ModelError("body " + std::to_string(lowered_body + 1) + " of the series does not exist");
  }
  bring_to_one_step(databases);
  return {lowered_body, std::move(draughts), std::move(databases)};
}

}  // namespace blocklift::dynamics
