#include "dynamics/rope/elastic_body.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include "algebra/decompositions.h"
#include "dynamics/errors.h"

namespace blocklift::dynamics {

namespace {

constexpr int direction_passes = 4;
// Tension laws are linearised about the pass before: Newton's method, from the rigid body on.
constexpr int passes_with_laws = 8;

std::size_t at(Eigen::Index i) { return static_cast<std::size_t>(i); }

[[noreturn]] void refuse(const ElasticBody::Definition& d, const std::string& what) {
  throw ModelError("elastic body \"" + d.name + "\": " + what);
}

void require_compliance(const ElasticBody::Definition& d) {
  const auto size = static_cast<Eigen::Index>(3 * d.ends.size());
  if (d.compliance.rows() != size || d.compliance.cols() != size || d.shapes.rows() != size ||
      d.shapes.cols() != static_cast<Eigen::Index>(d.modes.size()))
    refuse(d, "compliance and shapes must have three rows for each of its " +
                  std::to_string(d.ends.size()) + " rope ends, shapes a column for each mode");
  if (!d.compliance.allFinite() || !d.shapes.allFinite()) refuse(d, "its numbers are not finite");
  const double scale = d.compliance.cwiseAbs().maxCoeff();
  if ((d.compliance - d.compliance.transpose()).cwiseAbs().maxCoeff() > 1e-9 * scale)
    refuse(d, "its compliance is not symmetric");
  if (algebra::symmetric_eigenvalues(d.compliance)[0] < -1e-9 * scale)
    refuse(d, "its compliance is negative along some direction: it would push against the pull");
}

// A slack rope that is stretched while it contracts springs back with the body, and has yet to lose
// what it stores; one that lengthens is stretched beyond the change alone, and stores nothing.
double kept_force(const RopeLoad& load) {
  const bool keeps =
      !load.taut && load.elastic_force > 0.0 && load.length_rate - load.unstretched_rate < 0.0;
  return keeps ? load.elastic_force : 0.0;
}

}  // namespace

ElasticBody::ElasticBody(const Mechanism& mechanism, const std::vector<Rope>& ropes,
                         Definition definition)
    : d_(std::move(definition)), passes_(direction_passes) {
  if (d_.ends.empty()) refuse(d_, "no rope ends at it");
  require_compliance(d_);
  for (std::size_t e = 0; e < d_.ends.size(); ++e) {
    const End& end = d_.ends[e];
    if (end.rope < 0 || end.rope >= static_cast<int>(ropes.size()))
      refuse(d_, "there is no rope " + std::to_string(end.rope));
    const Rope& rope = ropes[end.rope];
    const BodyPoint& point = end.last ? rope.points().back() : rope.points().front();
    if (point.body != d_.body) refuse(d_, "rope \"" + rope.name() + "\" does not end at it");
    if (!rope.definition().left_out.empty())
      refuse(d_, "rope \"" + rope.name() + "\" leaves a segment out");
    if (rope.hangs()) refuse(d_, "rope \"" + rope.name() + "\" has weight");
    if (!rope.edges().empty()) refuse(d_, "rope \"" + rope.name() + "\" may touch edges");
    if (rope.definition().sheave_friction > 0.0)
      refuse(d_, "rope \"" + rope.name() + "\" has friction at its sheaves");
    if (rope.definition().tension_law) passes_ = passes_with_laws;
    for (std::size_t other = 0; other < e; ++other) {
      if (d_.ends[other].rope == end.rope && d_.ends[other].last == end.last)
        refuse(d_, "an end of rope \"" + rope.name() + "\" is named twice");
    }
    auto known = std::find(ropes_.begin(), ropes_.end(), end.rope);
    if (known == ropes_.end()) {
      first_point_.push_back(points_);
      points_ += rope.points().size();
      known = ropes_.insert(ropes_.end(), end.rope);
    }
    const auto local = static_cast<std::size_t>(known - ropes_.begin());
    const std::size_t slot = first_point_[local] + (end.last ? rope.points().size() - 1 : 0);
    places_.push_back({static_cast<Eigen::Index>(local), static_cast<Eigen::Index>(slot)});
  }
  for (std::size_t k = 0; k < d_.modes.size(); ++k) {
    const int mode = d_.modes[k];
    if (mode < 0 || mode >= static_cast<int>(mechanism.elastic_modes().size()))
      refuse(d_, "there is no elastic mode " + std::to_string(mode));
    const ElasticMode& added = modes_.emplace_back(mechanism.elastic_modes()[mode]);
    if (added.body != d_.body) refuse(d_, "mode \"" + added.name + "\" is another body's");
    if (std::count(d_.modes.begin(), d_.modes.end(), mode) > 1)
      refuse(d_, "mode \"" + added.name + "\" is named twice");
  }
}

ElasticBody::Workspace::Workspace(const ElasticBody& body, const Mechanism& mechanism) {
  const auto n = static_cast<Eigen::Index>(body.ropes_.size());
  const auto ends = static_cast<Eigen::Index>(3 * body.d_.ends.size());
  const auto points = static_cast<Eigen::Index>(3 * body.points_);
  const Eigen::Index nv = mechanism.nv();
  const auto zero = [](Eigen::Index rows, Eigen::Index columns, auto&... matrices) {
    (matrices.setZero(rows, columns), ...);
  };
  const auto unit = [](Eigen::Index rows, auto&... squares) {
    (squares.setIdentity(rows, rows), ...);
  };
  zero(ends, 1, modal, modal_rate, u, next_u, force);
  zero(n, 1, length, length_rate, elongation, rate, elastic, damping, scratch, flexibility,
       rope_damping, spring);
  zero(ends, n, gradient, compliance_gradient);
  zero(points, n, stretch, pulling, rate_stretch, scaled_stretch);
  zero(points, points, geometric, geometric_all, stiffness);
  zero(points, nv, motion, velocity_q, moved, df_dq, df_dv);
  zero(3, nv, turn, moment);
  zero(ends, nv, relaxed, end_force);
  zero(n, nv, by_rope, rope_rows);
  zero(nv, nv, dtau_dq, dtau_dv);
  unit(n, matrix, inverse, damper);
  unit(ends, compliance_W, inner, end_stiffness);
  factor.factorise(matrix);
  relaxer.factorise(inner);
  stretched.assign(body.ropes_.size(), 1);
  rate_W.assign(body.points_, Vector3::Zero());
}

void ElasticBody::set_shifts(const Ropes& ropes, const Workspace& w) const {
  for (std::size_t e = 0; e < d_.ends.size(); ++e) {
    RopeEndShifts& shifts = ropes.shifts[d_.ends[e].rope];
    RopeEndShift& shift = d_.ends[e].last ? shifts.last : shifts.first;
    const auto row = static_cast<Eigen::Index>(3 * e);
    shift.displacement_B = w.modal.segment<3>(row) + w.u.segment<3>(row);
    shift.rate_B = w.modal_rate.segment<3>(row);
  }
}

// Lengths, their rates and gradients at the displaced ends.
void ElasticBody::take_geometry(const Kinematics& kinematics, const Ropes& ropes,
                                Workspace& w) const {
  set_shifts(ropes, w);
  w.gradient.setZero();
  const Matrix3 R_BW = kinematics.X_WB[d_.body].R.transpose();
  for (std::size_t i = 0; i < ropes_.size(); ++i) {
    const auto index = static_cast<std::size_t>(ropes_[i]);
    const Rope& rope = ropes.ropes[index];
    rope.calc_path(kinematics, ropes.path, &ropes.shifts[index]);
    const RopeLoad load = rope.calc_load(ropes.path, ropes.feeds[index]);
    const auto local = static_cast<Eigen::Index>(i);
    w.length[local] = load.length;
    w.length_rate[local] = load.length_rate;
    const RopeFeed& feed = ropes.feeds[index];
    w.elongation[local] = feed.parted                     ? -feed.unstretched_length
                          : rope.definition().tension_law ? load.elastic_force / load.stiffness
                                                          : load.elongation();
    w.rate[local] = load.length_rate - load.unstretched_rate;
    w.flexibility[local] = 1.0 / load.stiffness;
    w.rope_damping[local] = rope.damping(load.stiffness);
    for (std::size_t e = 0; e < d_.ends.size(); ++e) {
      if (places_[e].rope != local) continue;
      const Vector3 g_W = d_.ends[e].last ? ropes.path.direction_W[rope.points().size() - 2]
                                          : Vector3(-ropes.path.direction_W.front());
      w.gradient.block<3, 1>(static_cast<Eigen::Index>(3 * e), local) = R_BW * g_W;
    }
  }
  w.compliance_gradient.noalias() = d_.compliance * w.gradient;
}

// Elastic and damping forces for the set of stretched ropes. Rows of the others are those of the
// identity.
void ElasticBody::solve(Workspace& w) const {
  const Eigen::Index n = w.elongation.size();
  w.matrix.noalias() = w.gradient.transpose() * w.compliance_gradient;
  for (Eigen::Index i = 0; i < n; ++i) w.matrix(i, i) += w.flexibility[i];
  w.scratch.noalias() = -w.gradient.transpose() * w.u;
  w.scratch += w.elongation;
  w.elastic = w.scratch;
  w.damping = w.rate;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (w.stretched[at(i)]) continue;
    w.matrix.row(i).setZero();
    w.matrix.col(i).setZero();
    w.matrix(i, i) = 1;
    w.elastic[i] = w.damping[i] = 0;
  }
  w.factor.factorise(w.matrix);
  w.factor.solve_in_place(w.elastic);
  w.factor.solve_in_place(w.damping);
  for (Eigen::Index i = 0; i < n; ++i)
    w.damping[i] = w.stretched[at(i)]
                       ? w.flexibility[i] * w.rope_damping[i] * w.flexibility[i] * w.damping[i]
                       : 0;
  w.factor.solve_in_place(w.damping);
  w.force.noalias() = -w.gradient * w.elastic;
  // The elongations that these forces leave.
  w.next_u.noalias() = d_.compliance * w.force;
  w.scratch.noalias() += w.gradient.transpose() * w.next_u;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (w.stretched[at(i)]) continue;
    w.elastic[i] = w.scratch[i] / w.flexibility[i];
    w.damping[i] = w.rope_damping[i] * w.rate[i];
  }
}

bool ElasticBody::declared_taut(const Ropes& ropes, Eigen::Index rope) const {
  return ropes.contacts && (*ropes.contacts)[ropes_[at(rope)]] != 0;
}

// Changes the rope that contradicts its state most; false if none does. What is declared to pull
// stays stretched, so that its law has no kink.
bool ElasticBody::correct_stretched(const Ropes& ropes, Workspace& w) const {
  Eigen::Index worst = -1;
  double most = 0;
  for (Eigen::Index i = 0; i < w.elastic.size(); ++i) {
    const double pull = w.elastic[i];
    if (declared_taut(ropes, i) || (pull > 0.0) == (w.stretched[at(i)] != 0) ||
        !(std::abs(pull) > most))
      continue;
    most = std::abs(pull);
    worst = i;
  }
  if (worst < 0) return false;
  w.stretched[at(worst)] = w.stretched[at(worst)] ? 0 : 1;
  return true;
}

void ElasticBody::add_forces(const Kinematics& kinematics, ConstVectorRef q, ConstVectorRef v,
                             const Ropes& ropes, Workspace& w, std::vector<ForceVector>& F_Bo_W,
                             VectorRef tau) const {
  w.modal.setZero();
  w.modal_rate.setZero();
  w.energy = 0.0;
  for (std::size_t k = 0; k < modes_.size(); ++k) {
    const ElasticMode& mode = modes_[k];
    const auto shape = d_.shapes.col(k);
    const double eta = q[mode.q_index];
    w.modal += eta * shape;
    w.modal_rate += v[mode.v_index] * shape;
    tau[mode.v_index] -= mode.stiffness() * eta;
    w.energy += 0.5 * mode.stiffness() * eta * eta;
  }
  std::fill(w.stretched.begin(), w.stretched.end(), static_cast<char>(1));
  w.u.setZero();
  for (int pass = 0; pass < passes_; ++pass) {
    take_geometry(kinematics, ropes, w);
    solve(w);
    for (std::size_t change = 0; change < 3 * ropes_.size(); ++change) {
      if (!correct_stretched(ropes, w)) break;
      solve(w);
    }
    // The last pass's forces belong to the displacement that its directions were found at.
    if (pass + 1 < passes_) w.u = w.next_u;
  }
  w.energy += 0.5 * w.force.dot(w.u);
  for (std::size_t i = 0; i < ropes_.size(); ++i) {
    const auto local = static_cast<Eigen::Index>(i);
    const auto index = static_cast<std::size_t>(ropes_[i]);
    const RopeFeed& feed = ropes.feeds[index];
    RopeLoad& load = ropes.loads[index];
    load.length = w.length[local];
    load.length_rate = w.length_rate[local];
    load.unstretched_length = feed.unstretched_length;
    load.unstretched_rate = feed.rate;
    load.stiffness = 1.0 / w.flexibility[local];
    load.elastic_force = w.elastic[local];
    load.damping_force = w.damping[local];
    load.taut = ropes.contacts ? declared_taut(ropes, local) : load.slack_indicator() > 0.0;
    load.tension = one_sided_force(load.elastic_force, load.damping_force, load.taut);
    load.kept_force = kept_force(load);
    if (load.tension == 0.0) continue;
    ropes.ropes[index].calc_path(kinematics, ropes.path, &ropes.shifts[index]);
    ropes.ropes[index].add_forces(ropes.path, load.tension, F_Bo_W);
    for (std::size_t k = 0; k < modes_.size(); ++k)
      tau[modes_[k].v_index] -= load.tension * w.gradient.col(local).dot(d_.shapes.col(k));
  }
}

// Motion of all points by the velocities, and how lengths and pulls change with it.
void ElasticBody::gather_points(const Kinematics& kinematics, const Ropes& ropes, Workspace& w,
                                ForceDerivatives& derivatives) const {
  for (auto* matrix : {&w.motion, &w.velocity_q, &w.stretch, &w.rate_stretch, &w.geometric,
                       &w.geometric_all, &w.turn})
    matrix->setZero();
  const Matrix3& R_WB = kinematics.X_WB[d_.body].R;
  for (Vector3& rate : w.rate_W) rate.setZero();
  for (std::size_t e = 0; e < d_.ends.size(); ++e)
    w.rate_W[at(places_[e].slot)] = R_WB * w.modal_rate.segment<3>(3 * e);
  for (std::size_t i = 0; i < ropes_.size(); ++i) {
    const auto index = static_cast<std::size_t>(ropes_[i]);
    const Rope& rope = ropes.ropes[index];
    const RopeLoad& load = ropes.loads[index];
    const auto column = static_cast<Eigen::Index>(i);
    rope.calc_path(kinematics, ropes.path, &ropes.shifts[index]);
    const std::vector<BodyPoint>& points = rope.points();
    const auto position = [&](std::size_t k) -> Vector3 {
      return kinematics.X_WB[points[k].body].p + ropes.path.r_W[k];
    };
    const auto velocity = [&](std::size_t k) -> Vector3 {
      return shift(kinematics.V_WB[points[k].body], ropes.path.r_W[k]).linear +
             w.rate_W[first_point_[i] + k];
    };
    for (std::size_t k = 0; k < points.size(); ++k) {
      const std::size_t slot = first_point_[i] + k;
      derivatives.locate(slot, points[k].body, ropes.path.r_W[k]);
      const auto row = static_cast<Eigen::Index>(3 * slot);
      derivatives.add_motion(slot, w.rate_W[slot], w.motion.middleRows<3>(row),
                             w.velocity_q.middleRows<3>(row));
    }
    if (!load.taut && !w.stretched[i]) continue;
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
      const auto a = static_cast<Eigen::Index>(3 * (first_point_[i] + k)), b = a + 3;
      const Vector3& along = ropes.path.direction_W[k];
      const double span = along.dot(position(k + 1) - position(k));
      const Matrix3 across = (Matrix3::Identity() - along * along.transpose()) / span;
      const Vector3 swing = across * (velocity(k + 1) - velocity(k));
      w.stretch.block<3, 1>(a, column) -= along;
      w.stretch.block<3, 1>(b, column) += along;
      w.rate_stretch.block<3, 1>(a, column) -= swing;
      w.rate_stretch.block<3, 1>(b, column) += swing;
      if (derivatives.stretch_only()) continue;
      derivatives.add_held_force(first_point_[i] + k, load.tension * along);
      derivatives.add_held_force(first_point_[i] + k + 1, -load.tension * along);
      const auto add = [&](Eigen::MatrixXd& to, double tension) {
        to.block<3, 3>(a, a) -= tension * across;
        to.block<3, 3>(b, b) -= tension * across;
        to.block<3, 3>(a, b) += tension * across;
        to.block<3, 3>(b, a) += tension * across;
      };
      if (w.stretched[i]) add(w.geometric, load.elastic_force);
      add(w.geometric_all, load.tension);
    }
  }
  derivatives.add_turn(at(places_.front().slot), w.turn);
  const Vector3& spin = kinematics.V_WB[d_.body].angular;
  for (std::size_t e = 0; e < d_.ends.size(); ++e) {
    const auto end = static_cast<Eigen::Index>(3 * e);
    const Eigen::Index row = 3 * places_[e].slot;
    for (std::size_t k = 0; k < modes_.size(); ++k) {
      const Vector3 shape_W = R_WB * d_.shapes.block<3, 1>(end, static_cast<Eigen::Index>(k));
      w.motion.block<3, 1>(row, modes_[k].v_index) += shape_W;
      w.velocity_q.block<3, 1>(row, modes_[k].v_index) += spin.cross(shape_W);
    }
  }
}

// How the ends are displaced against the body by each velocity: r = Q (B x - turn x f), with B the
// stiffness of the ropes at the ends and Q = (1 - C B)^-1 C. Leaves all points' motion in w.moved.
void ElasticBody::relax(const Kinematics& kinematics, bool stretch_only, Workspace& w) const {
  const Matrix3& R_WB = kinematics.X_WB[d_.body].R;
  const auto ends = static_cast<Eigen::Index>(d_.ends.size());
  // df/dp of the elastic forces on all points.
  for (Eigen::Index i = 0; i < w.spring.size(); ++i)
    w.scaled_stretch.col(i) = -w.spring[i] * w.stretch.col(i);
  w.stiffness.noalias() = w.scaled_stretch * w.stretch.transpose();
  w.stiffness += w.geometric;
  for (Eigen::Index i = 0; i < ends; ++i) {
    for (Eigen::Index j = 0; j < ends; ++j) {
      w.compliance_W.block<3, 3>(3 * i, 3 * j).noalias() =
          R_WB * d_.compliance.block<3, 3>(3 * i, 3 * j) * R_WB.transpose();
      w.end_stiffness.block<3, 3>(3 * i, 3 * j) =
          w.stiffness.block<3, 3>(3 * places_[at(i)].slot, 3 * places_[at(j)].slot);
    }
  }
  w.inner.setIdentity();
  w.inner.noalias() -= w.compliance_W * w.end_stiffness;
  w.relaxer.factorise(w.inner);
  w.df_dq.noalias() = w.stiffness * w.motion;
  for (Eigen::Index e = 0; e < ends; ++e) {
    w.end_force.middleRows<3>(3 * e) = w.df_dq.middleRows<3>(3 * places_[at(e)].slot);
    if (stretch_only) continue;
    const Vector3 f_W = R_WB * w.force.segment<3>(3 * e);
    w.end_force.middleRows<3>(3 * e).noalias() += skew(f_W) * w.turn;
  }
  w.relaxed.noalias() = w.compliance_W * w.end_force;
  w.relaxer.solve_columns(w.relaxed, w.end_force);
  w.relaxed = w.end_force;
  w.moved = w.motion;
  for (Eigen::Index e = 0; e < ends; ++e)
    w.moved.middleRows<3>(3 * places_[at(e)].slot) += w.relaxed.middleRows<3>(3 * e);
}

// What held forces do as the body turns them and as their points move within it.
void ElasticBody::add_turning(const Kinematics& kinematics, const Ropes& ropes,
                              Workspace& w) const {
  const Matrix3& R_WB = kinematics.X_WB[d_.body].R;
  for (std::size_t e = 0; e < d_.ends.size(); ++e) {
    const auto end = static_cast<Eigen::Index>(3 * e);
    const Eigen::Index rope = places_[e].rope;
    const double tension = ropes.loads[ropes_[at(rope)]].tension;
    const Vector3 g_B = w.gradient.block<3, 1>(end, rope);
    const Matrix3 turned = skew(-tension * (R_WB * g_B));
    w.moment.noalias() = turned * w.relaxed.middleRows<3>(end);
    w.dtau_dq.noalias() -= w.turn.transpose() * w.moment;
    for (std::size_t k = 0; k < modes_.size(); ++k) {
      const Vector3 shape_W = R_WB * d_.shapes.block<3, 1>(end, static_cast<Eigen::Index>(k));
      const Vector3 coupling = turned.transpose() * shape_W;
      w.dtau_dq.row(modes_[k].v_index).noalias() += coupling.transpose() * w.turn;
      w.dtau_dq.col(modes_[k].v_index).noalias() += w.turn.transpose() * coupling;
    }
  }
}

void ElasticBody::add_derivatives(const Kinematics& kinematics, const Ropes& ropes, Workspace& w,
                                  ForceDerivatives& derivatives) const {
  gather_points(kinematics, ropes, w, derivatives);
  for (Eigen::Index i = 0; i < w.spring.size(); ++i)
    w.spring[i] = w.stretched[at(i)] ? 1.0 / w.flexibility[i] : 0.0;
  relax(kinematics, derivatives.stretch_only(), w);
  // Ropes that are stretched and yet slack, as they contract faster than they can pull.
  w.pulling = w.stretch;
  for (Eigen::Index i = 0; i < w.spring.size(); ++i)
    if (!ropes.loads[ropes_[at(i)]].taut) w.pulling.col(i).setZero();
  // W^T c W of the stretched ropes.
  w.inverse.setIdentity();
  w.factor.solve_columns_in_place(w.inverse);
  for (Eigen::Index i = 0; i < w.spring.size(); ++i) {
    if (w.stretched[at(i)]) continue;
    w.inverse.row(i).setZero();
  }
  for (Eigen::Index i = 0; i < w.spring.size(); ++i)
    w.matrix.row(i) = w.flexibility[i] * w.flexibility[i] * w.rope_damping[i] * w.inverse.row(i);
  w.damper.noalias() = w.inverse.transpose() * w.matrix;

  w.stiffness.noalias() = w.pulling * w.scaled_stretch.transpose();
  w.stiffness += w.geometric_all;
  w.df_dq.noalias() = w.stiffness * w.moved;
  w.by_rope.noalias() = w.stretch.transpose() * w.velocity_q;
  w.by_rope.noalias() += w.rate_stretch.transpose() * w.motion;
  w.rope_rows.noalias() = w.damper * w.by_rope;
  w.df_dq.noalias() -= w.pulling * w.rope_rows;
  w.by_rope.noalias() = w.stretch.transpose() * w.motion;
  w.rope_rows.noalias() = w.damper * w.by_rope;
  w.df_dv.noalias() = -w.pulling * w.rope_rows;
  w.dtau_dq.noalias() = w.motion.transpose() * w.df_dq;
  w.dtau_dv.noalias() = w.motion.transpose() * w.df_dv;
  for (const ElasticMode& mode : modes_) w.dtau_dq(mode.v_index, mode.v_index) -= mode.stiffness();
  if (!derivatives.stretch_only()) add_turning(kinematics, ropes, w);
  derivatives.add_generalised(w.dtau_dq, w.dtau_dv);
}

}  // namespace blocklift::dynamics
