#include "tests/benchmarks/peers/simbody_simulations.h"

#include <Simbody.h>

namespace blocklift::peers {

namespace {

using namespace SimTK;

// ---- the block on six ropes --------------------------------------------------------------------

using Block = BlockOnSixRopes;

// Velocity of the unstretched length: ramps of 2 s at both ends. Returns length and its rate.
std::pair<Real, Real> rope_feed(Real t) {
  constexpr Real v = Block::hoisting_speed, r = Block::ramp, end = Block::duration;
  if (t < r) return {Block::rope_length - v * t * t / (2 * r), -v * t / r};
  if (t < end - r) return {Block::rope_length - v * (t - r / 2), -v};
  const Real left = end - t;
  return {Block::rope_length - v * (end - r) + v * left * left / (2 * r), -v * left / r};
}

class SixRopes : public Force::Custom::Implementation {
 public:
  explicit SixRopes(const MobilizedBody& block) : block_(block) {
    constexpr Real k = Block::axial_stiffness / Block::rope_length;
    damping_ = 0.01 * 2 * std::sqrt(6 * k * Block::mass) / 6;
    const Real stretch = Block::mass * gravity / (6 * k);
    std::size_t i = 0;
    for (const Real x : {-10.0, 0.0, 10.0}) {
      for (const Real y : {-6.0, 6.0}) {
        station_[i] = Vec3(x, y, 5);
        fixed_[i++] = Vec3(x, y, 5 + Block::rope_length + stretch);
      }
    }
  }

  void calcForce(const State& state, Vector_<SpatialVec>& bodyForces, Vector_<Vec3>&,
                 Vector&) const override {
    const auto [length, rate] = rope_feed(state.getTime());
    for (std::size_t i = 0; i < 6; ++i) {
      Vec3 p, v;
      block_.findStationLocationAndVelocityInGround(state, station_[i], p, v);
      const Vec3 rope = fixed_[i] - p;
      const Real stretched = rope.norm();
      const Vec3 direction = rope / stretched;
      const Real elongation = stretched - length;
      if (elongation <= 0) continue;
      const Real tension =
          Block::axial_stiffness / length * elongation + damping_ * (-dot(direction, v) - rate);
      if (tension > 0) {
        block_.applyForceToBodyPoint(state, station_[i], tension * direction, bodyForces);
      }
    }
  }
  Real calcPotentialEnergy(const State&) const override { return 0; }

 private:
  const MobilizedBody& block_;
  Real damping_;
  std::array<Vec3, 6> station_, fixed_;
};

void count(const Integrator& integrator, SimulationRun& run) {
  run.steps = integrator.getNumStepsTaken();
  run.evaluations = integrator.getNumRealizations();
}

}  // namespace

SimulationRun simulate_block_on_six_ropes(double accuracy) {
  MultibodySystem system;
  SimbodyMatterSubsystem matter(system);
  GeneralForceSubsystem forces(system);
  Force::UniformGravity(forces, matter, Vec3(0, 0, -gravity));
  const auto [x, y, z] = Block::size;
  const Real m = Block::mass;
  const Inertia inertia(m / 12 * (y * y + z * z), m / 12 * (x * x + z * z),
                        m / 12 * (x * x + y * y));
  MobilizedBody::Free block(matter.Ground(), Body::Rigid(MassProperties(m, Vec3(0), inertia)));
  Force::Custom(forces, new SixRopes(block));  // the force subsystem deletes it
  system.realizeTopology();
  State state = system.getDefaultState();
  block.setUToFitVelocity(state, SpatialVec(Vec3(0, 0, 0.002), Vec3(0.1, -0.05, 0)));

  RungeKuttaMersonIntegrator integrator(system);
  integrator.setAccuracy(accuracy);
  TimeStepper stepper(system, integrator);
  stepper.initialize(state);
  SimulationRun run;
  for (int i = 1; i <= Block::samples; ++i) {
    stepper.stepTo(i * Block::duration / Block::samples);
    const Vec3 p = block.getBodyOriginLocation(integrator.getState());
    run.values.insert(run.values.end(), {p[0], p[1], p[2]});
  }
  count(integrator, run);
  return run;
}

// ---- Andrews' squeezer -------------------------------------------------------------------------

namespace {

using A = Andrews;

// Body `number` (1 to 7) with its centre of mass; in the plane only the inertia about the normal
// counts.
Body planar_body(int number, const Vec3& p_BoBcm) {
  const auto i = static_cast<std::size_t>(number - 1);
  const Inertia central(A::inertia[i] / 2, A::inertia[i] / 2, A::inertia[i]);
  return Body::Rigid(
      MassProperties(A::mass[i], p_BoBcm, central.shiftFromMassCenter(p_BoBcm, A::mass[i])));
}

// The point P of `body` stays at P of the second body, in the plane.
void close(MobilizedBody& second, MobilizedBody& body, const Vec3& p_BoP) {
  Constraint::PointInPlane(second, UnitVec3(XAxis), -A::d, body, p_BoP);
  Constraint::PointInPlane(second, UnitVec3(YAxis), 0, body, p_BoP);
}

}  // namespace

SimulationRun simulate_andrews(double accuracy) {
  MultibodySystem system;
  SimbodyMatterSubsystem matter(system);
  GeneralForceSubsystem forces(system);
  MobilizedBody& ground = matter.updGround();
  const Transform none;
  const Vec3 a(A::xa, A::ya, 0), b(A::xb, A::yb, 0), c(A::xc, A::yc, 0);
  MobilizedBody::Pin k1(ground, none, planar_body(1, {A::ra, 0, 0}), none);
  MobilizedBody::Pin k2(k1, Vec3(A::rr, 0, 0), planar_body(2, {-A::da, 0, 0}), none);
  MobilizedBody::Pin k3(ground, b, planar_body(3, {A::sb, -A::sa, 0}), none);
  MobilizedBody::Pin k5(ground, a, planar_body(5, {A::ta, -A::tb, 0}), none);
  MobilizedBody::Pin k4(k5, Vec3(A::zt, 0, 0), planar_body(4, {0, -(A::e - A::ea), 0}), none);
  MobilizedBody::Pin k7(ground, a, planar_body(7, {A::ub, -A::ua, 0}), none);
  MobilizedBody::Pin k6(k7, Vec3(0, -A::u, 0), planar_body(6, {A::zf - A::fa, 0, 0}), none);
  close(k2, k3, {0, -A::ss, 0});
  close(k2, k4, {0, -A::e, 0});
  close(k2, k6, {A::zf, 0, 0});
  Force::TwoPointLinearSpring(forces, ground, c, k3, {A::sd, -A::sc, 0}, A::stiffness,
                              A::free_length);
  Force::MobilityConstantForce(forces, k1, 0, A::moment);
  system.realizeTopology();
  State state = system.getDefaultState();
  const std::array<MobilizedBody::Pin*, 7> joints{&k1, &k2, &k3, &k4, &k5, &k6, &k7};
  for (std::size_t i = 0; i < 7; ++i) joints[i]->setAngle(state, A::start[i]);

  RungeKuttaMersonIntegrator integrator(system);
  integrator.setAccuracy(accuracy);
  TimeStepper stepper(system, integrator);
  stepper.initialize(state);
  stepper.stepTo(A::duration);
  SimulationRun run;
  for (const MobilizedBody::Pin* joint : joints) {
    run.values.push_back(joint->getAngle(integrator.getState()));
  }
  count(integrator, run);
  return run;
}

}  // namespace blocklift::peers
