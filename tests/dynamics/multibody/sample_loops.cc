#include "tests/dynamics/multibody/sample_loops.h"

namespace blocklift::dynamics::test {
namespace {

constexpr double gravity = 9.81;  // m/s2

BodyDefinition hinged(const std::string& name, std::string_view parent, const Vector3& p_PJ,
                      double mass, const Vector3& p_BoBcm, double inertia) {
  BodyDefinition body;
  body.name = name;
  body.parent = parent;
  body.joint = {JointKind::revolute, Vector3::UnitZ()};
  body.X_PJ = Pose::translation(p_PJ);
  body.mass = mass;
  body.p_BoBcm_B = p_BoBcm;
  // Only the inertia about z has an effect; the others are those of a plate in the plane.
  body.I_BBcm_B = Vector3(0.5 * inertia, 0.5 * inertia, inertia).asDiagonal();
  return body;
}

// A uniform rod of 1 kg from its origin along `along` (m), of square section `side`.
BodyDefinition rod(const std::string& name, std::string_view parent, const Vector3& p_PJ,
                   const Vector3& axis, const Vector3& along, double side) {
  BodyDefinition body;
  body.name = name;
  body.parent = parent;
  body.joint = {JointKind::revolute, axis};
  body.X_PJ = Pose::translation(p_PJ);
  body.mass = 1.0;
  body.p_BoBcm_B = 0.5 * along;
  const double transverse = (along.squaredNorm() + side * side) / 12.0;
  const double axial = side * side / 6.0;
  const Vector3 u = along.normalized();
  body.I_BBcm_B =
      transverse * Matrix3::Identity() + (axial - transverse) * Matrix3(u * u.transpose());
  return body;
}

LoopDefinition hinge_loop(const std::string& name, const std::string& first, const Vector3& p_first,
                          const std::string& second, const Vector3& p_second, const Vector3& axis) {
  LoopDefinition loop;
  loop.name = name;
  loop.kind = LoopKind::revolute;
  loop.first = first;
  loop.second = second;
  loop.X_FirstK = Pose::translation(p_first);
  loop.X_SecondK = Pose::translation(p_second);
  loop.axis = axis;
  return loop;
}

}  // namespace

Mechanism AndrewsSqueezer::build() const {
  const Vector3 A(-0.06934, -0.00227, 0), B(-0.03635, 0.03273, 0);
  constexpr double d = 0.028, da = 0.0115, e = 0.02, ea = 0.01421, rr = 0.007, ra = 0.00092,
                   ss = 0.035, sa = 0.01874, sb = 0.01043, ta = 0.02308, tb = 0.00916, u = 0.04,
                   ua = 0.01228, ub = 0.00449, zf = 0.02, zt = 0.04, fa = 0.01421;
  MechanismBuilder builder;
  builder.set_gravity(Vector3::Zero());
  builder.add_body(hinged("K1", world_name, {0, 0, 0}, 0.04325, {ra, 0, 0}, 2.194e-6));
  builder.add_body(hinged("K2", "K1", {rr, 0, 0}, 0.00365, {-da, 0, 0}, 4.410e-7));
  builder.add_body(hinged("K3", world_name, B, 0.02373, {sb, -sa, 0}, 5.255e-6));
  builder.add_body(hinged("K5", world_name, A, 0.07050, {ta, -tb, 0}, 1.169e-5));
  builder.add_body(hinged("K4", "K5", {zt, 0, 0}, 0.00706, {0, -(e - ea), 0}, 5.667e-7));
  builder.add_body(hinged("K7", world_name, A, 0.05498, {ua, -ub, 0}, 1.912e-5));
  builder.add_body(hinged("K6", "K7", {0, -u, 0}, 0.00706, {zf - fa, 0, 0}, 5.667e-7));
  const Vector3 end(-d, 0, 0);
  for (LoopDefinition loop : {hinge_loop("B", "K2", end, "K3", {0, -ss, 0}, Vector3::UnitZ()),
                              hinge_loop("A4", "K2", end, "K4", {0, -e, 0}, Vector3::UnitZ()),
                              hinge_loop("A6", "K2", end, "K6", {zf, 0, 0}, Vector3::UnitZ())}) {
    loop.kind = kind;
    builder.add_loop(loop);
  }
  return builder.build();
}

Eigen::VectorXd AndrewsSqueezer::q_start() {
  Eigen::VectorXd q(7);
  q << -0.0617138900142764496, 0.0, 0.455279819163070380, 0.487364979543842550,
      0.222668390165885885, 1.23054744454982119, -0.222668390165885885;
  return q;
}

Mechanism bricard_linkage() {
  const Vector3 x = Vector3::UnitX(), y = Vector3::UnitY(), z = Vector3::UnitZ();
  constexpr double side = 0.1;
  MechanismBuilder builder;
  builder.set_gravity(-gravity * y);
  builder.add_body(rod("rod1", world_name, Vector3::Zero(), y, x, side));
  builder.add_body(rod("rod2", "rod1", x, z, -y, side));
  builder.add_body(rod("rod3", "rod2", -y, x, z, side));
  builder.add_body(rod("rod4", "rod3", z, y, -x, side));
  builder.add_body(rod("rod5", "rod4", -x, z, y, side));
  builder.add_loop(hinge_loop("hinge_6", "rod5", y, "world", z, x));
  return builder.build();
}

Mechanism four_bar(double crank, double coupler, double rocker, double base, bool driven_crank,
                   double side) {
  const Vector3 x = Vector3::UnitX(), z = Vector3::UnitZ();
  MechanismBuilder builder;
  builder.set_gravity(-gravity * Vector3::UnitY());
  BodyDefinition first = rod("crank", world_name, Vector3::Zero(), z, crank * x, side);
  if (driven_crank) first.driven = {true};
  builder.add_body(first);
  builder.add_body(rod("coupler", "crank", crank * x, z, coupler * x, side));
  builder.add_body(rod("rocker", "coupler", coupler * x, z, rocker * x, side));
  builder.add_loop(hinge_loop("D", "rocker", rocker * x, "world", base * x, z));
  return builder.build();
}

Mechanism random_mechanism_with_loop(examples::Random& random, LoopKind kind) {
  MechanismBuilder builder;
  builder.add_body(examples::random_body(random, JointKind::spherical, "a1", "world"));
  builder.add_body(examples::random_body(random, JointKind::cylindrical, "a2", "a1"));
  builder.add_body(examples::random_body(random, JointKind::planar, "b1", "world"));
  builder.add_body(examples::random_body(random, JointKind::universal, "b2", "b1"));
  builder.add_body(examples::random_body(random, JointKind::fixed, "b3", "b2"));
  builder.add_body(examples::random_body(random, JointKind::free, "c", "a1"));
  LoopDefinition loop;
  loop.name = "loop";
  loop.kind = kind;
  if (kind == LoopKind::gear) {
    loop.first = "a2";
    loop.second = "b1";
    loop.first_velocity = 1;
    loop.second_velocity = 2;
    loop.ratio = -1.7;
    loop.offset = 0.4;
  } else if (kind == LoopKind::rope_length) {
    loop.length = 5;
    loop.paths = {{{"a2", random.vector(1)}, {"world", random.vector(1)}, {"b3", random.vector(1)}},
                  {{"c", random.vector(1)}, {"a1", random.vector(1)}}};
  } else {
    loop.first = "c";
    loop.second = "b3";
    loop.X_FirstK = random.pose(1);
    loop.X_SecondK = random.pose(1);
    if (kind == LoopKind::distance) {
      loop.length = 1.3;
    } else {
      loop.axis = random.direction();
    }
    if (kind == LoopKind::universal) {
      loop.second_axis = loop.axis.cross(random.direction()).normalized();
    }
  }
  builder.add_loop(loop);
  return builder.build();
}

}  // namespace blocklift::dynamics::test
