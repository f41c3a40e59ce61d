#include "dynamics/multibody/loop_definition.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "dynamics/errors.h"
#include "dynamics/multibody/mechanism.h"
#include "dynamics/multibody/message_text.h"

namespace blocklift::dynamics {
namespace {

using Rotation = Loop::Rotation;

struct LoopProperties {
  std::string_view name;
  bool is_joint;
  std::array<bool, 3> held;  // translations along the aligned axes
  Rotation rotation;
  int rows;
};

constexpr std::array<LoopProperties, 12> loop_properties{
    {{"fixed", true, {true, true, true}, Rotation::equal, 6},
     {"revolute", true, {true, true, true}, Rotation::axes_parallel, 5},
     {"prismatic", true, {true, true, false}, Rotation::equal, 5},
     {"cylindrical", true, {true, true, false}, Rotation::axes_parallel, 4},
     {"universal", true, {true, true, true}, Rotation::axes_perpendicular, 4},
     {"spherical", true, {true, true, true}, Rotation::none, 3},
     {"planar", true, {false, false, true}, Rotation::axes_parallel, 3},
     {"translational", true, {false, false, false}, Rotation::equal, 3},
     {"distance", false, {false, false, false}, Rotation::none, 1},
     {"point_on_line", false, {true, true, false}, Rotation::none, 2},
     {"gear", false, {false, false, false}, Rotation::none, 1},
     {"rope_length", false, {false, false, false}, Rotation::none, 1}}};

const LoopProperties& properties_of(LoopKind kind) {
  return loop_properties[static_cast<std::size_t>(kind)];
}

std::string rounded_text(const Vector3& a) {
  // Zeros without a sign.
  const Vector3 b = (a.array().abs() < 5e-7).select(Vector3::Zero(), a);
  return text("(", b.x(), ", ", b.y(), ", ", b.z(), ")");
}

// "x" or "(0.6, 0.8, 0)".
std::string direction_name(const Vector3& direction) {
  for (int i = 0; i < 3; ++i) {
    if (std::abs(std::abs(direction[i]) - 1.0) < 1e-9) return std::string(1, "xyz"[i]);
  }
  return rounded_text(direction);
}

/// Checks of one definition.
class LoopMaker {
 public:
  LoopMaker(const LoopDefinition& definition, const std::vector<Body>& bodies)
      : d_(definition), bodies_(bodies) {
    if (d_.name.empty()) throw ModelError("a loop has no name; each needs one of its own");
  }

  Loop make() {
    check_what_is_given();
    loop_.name = d_.name;
    loop_.kind = d_.kind;
    loop_.row_count = properties_of(d_.kind).rows;
    switch (d_.kind) {
      case LoopKind::gear:
        make_gear();
        break;
      case LoopKind::rope_length:
        make_rope();
        break;
      default:
        make_pair();
    }
    return std::move(loop_);
  }

 private:
  template <class... Parts>
  [[noreturn]] void fail(const Parts&... parts) const {
    throw ModelError("loop \"" + d_.name + "\": " + text(parts...));
  }

  bool uses_axis() const {
    const LoopProperties& kind = properties_of(d_.kind);
    return kind.is_joint || d_.kind == LoopKind::point_on_line;
  }

  void check_what_is_given() const {
    const auto refuse = [&](bool given, const char* what, const char* kinds) {
      if (given) {
        fail("a ", loop_kind_name(d_.kind), " loop has no ", what, "; only ", kinds, " take one");
      }
    };
    const bool gear = d_.kind == LoopKind::gear;
    const bool rope = d_.kind == LoopKind::rope_length;
    refuse(!std::isnan(d_.length) && !rope && d_.kind != LoopKind::distance, "length",
           "distance and rope_length");
    refuse(!std::isnan(d_.ratio) && !gear, "ratio", "gears");
    refuse(!std::isnan(d_.offset) && !gear, "offset", "gears");
    refuse((d_.first_velocity != 0 || d_.second_velocity != 0) && !gear, "choice of velocities",
           "gears");
    refuse(!d_.paths.empty() && !rope, "paths", "rope_length loops");
    refuse(rope && (d_.first != world_name || d_.second != world_name), "first and second body",
           "the other kinds");
    const bool has_frames = !gear && !rope;
    const auto moved = [](const Pose& X) {
      return !(X.R == Matrix3::Identity()) || !(X.p == Vector3::Zero());
    };
    refuse(!has_frames && (moved(d_.X_FirstK) || moved(d_.X_SecondK)), "frame in its bodies",
           "joints, distance and point_on_line");
    refuse(!uses_axis() && d_.axis != Vector3::UnitZ(), "axis", "joints and point_on_line");
    const bool second = !d_.second_axis.array().isNaN().all();
    refuse(second && d_.kind != LoopKind::universal && d_.kind != LoopKind::planar, "second axis",
           "universal and planar");
  }

  BodyIndex find_body(const std::string& name) const {
    std::string names;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      if (bodies_[i].name == name) return static_cast<BodyIndex>(i);
      names += (names.empty() ? "" : ", ") + bodies_[i].name;
    }
    fail("its body \"", name,
         "\" is not there; bodies come before loops, and so far there are: ", names);
  }

  const Body& body(BodyIndex i) const { return bodies_[i]; }

  // The body itself where it moves against its parent, else the one that it is fixed to.
  BodyIndex moving(BodyIndex i) const {
    return i == world_index || body(i).nv() > 0 ? i : body(i).carrier;
  }

  BodyIndex common_carrier(BodyIndex a, BodyIndex b) const {
    a = moving(a);
    b = moving(b);
    while (a != b) {
      BodyIndex& outer = a > b ? a : b;
      outer = body(outer).carrier;
    }
    return a;
  }

  void check_frame(const Pose& X, const char* which) const {
    if (!X.p.allFinite() || !X.R.allFinite()) fail("the place of its ", which, " is not finite");
    if ((X.R.transpose() * X.R - Matrix3::Identity()).norm() > 1e-9 || X.R.determinant() < 0) {
      fail("the orientation of its ", which, " is not a rotation matrix");
    }
  }

  Vector3 unit(const Vector3& axis, const char* which) const {
    const double length = axis.norm();
    if (!(length > 0) || !std::isfinite(length)) {
      fail("its ", which, " ", rounded_text(axis),
           " has no direction; give a vector of any length but zero");
    }
    return axis / length;
  }

  // K' in K: z' along the axis; x' along the second axis or, where there is none, the next axis of
  // K.
  Matrix3 aligned_frame() const {
    const Vector3 z = unit(d_.axis, "axis");
    Vector3 x;
    if (d_.second_axis.array().isNaN().all()) {
      Eigen::Index largest = 0;
      z.cwiseAbs().maxCoeff(&largest);
      const Vector3 next = Vector3::Unit((largest + 1) % 3);
      x = (next - next.dot(z) * z).normalized();
    } else {
      x = unit(d_.second_axis, "second axis");
      if (std::abs(x.dot(z)) > 1e-9) {
        fail("its two axes enclose ", std::acos(x.dot(z)) * 180.0 / M_PI, " degrees; 90 are due");
      }
    }
    Matrix3 R;
    R << x, z.cross(x), z;
    return R;
  }

  void make_pair() {
    loop_.first = find_body(d_.first);
    loop_.second = find_body(d_.second);
    if (moving(loop_.first) == moving(loop_.second)) {
      fail(d_.first == d_.second ? "both its bodies are \"" + d_.first + "\""
                                 : "its bodies \"" + d_.first + "\" and \"" + d_.second +
                                       "\" are fixed to each other",
           "; a loop connects two bodies that move against each other (one may be the world)");
    }
    check_frame(d_.X_FirstK, "frame in the first body");
    check_frame(d_.X_SecondK, "frame in the second body");
    const LoopProperties& kind = properties_of(d_.kind);
    if (uses_axis()) loop_.R_KKaligned = aligned_frame();
    const Pose aligned{loop_.R_KKaligned, Vector3::Zero()};
    const bool swapped = d_.kind == LoopKind::point_on_line;
    loop_.base = swapped ? loop_.second : loop_.first;
    loop_.follower = swapped ? loop_.first : loop_.second;
    loop_.common = common_carrier(loop_.first, loop_.second);
    loop_.X_BaseK = (swapped ? d_.X_SecondK : d_.X_FirstK) * aligned;
    loop_.X_FollowerK = (swapped ? d_.X_FirstK : d_.X_SecondK) * aligned;
    for (int i = 0; i < 3; ++i) {
      if (kind.held[i]) loop_.held_translations.push_back(i);
    }
    loop_.rotation = kind.rotation;
    if (d_.kind == LoopKind::distance) check_length("rod");
  }

  void check_length(const char* what) {
    if (!std::isnan(d_.length) && !(d_.length > 0 && std::isfinite(d_.length))) {
      fail("the length of its ", what, " is ", d_.length,
           " m; it is positive (for points that coincide, take a spherical loop)");
    }
    loop_.length = d_.length;
  }

  // Index of a geared velocity within its joint, checked.
  const Body& geared_body(BodyIndex i, int k, const char* which) const {
    const Body& b = body(i);
    const std::string joint =
        "the joint of its " + std::string(which) + " body \"" + b.name + "\" ";
    if (b.nv() == 0) fail(joint, "does not move; gears connect joints that do");
    if (!velocities_are_rates(b.joint.kind)) {
      fail(joint, "is ", joint_kind_name(b.joint.kind),
           " and has no coordinate whose rate is its velocity; gears connect angles and "
           "displacements");
    }
    if (k < 0 || k >= b.nv()) {
      fail(joint, "has ", b.nv(), b.nv() == 1 ? " velocity" : " velocities", " and no number ", k,
           " (counted from 0)");
    }
    return b;
  }

  void make_gear() {
    loop_.first = find_body(d_.first);
    loop_.second = find_body(d_.second);
    const Body& first = geared_body(loop_.first, d_.first_velocity, "first");
    const Body& second = geared_body(loop_.second, d_.second_velocity, "second");
    if (!std::isfinite(d_.ratio) || d_.ratio == 0) {
      fail("its ratio is ", d_.ratio, "; give first velocity / second velocity, not zero");
    }
    if (std::isinf(d_.offset)) fail("its offset is not finite");
    loop_.ratio = d_.ratio;
    loop_.offset = d_.offset;
    loop_.first_velocity = first.v_offset + d_.first_velocity;
    loop_.second_velocity = second.v_offset + d_.second_velocity;
    loop_.first_coordinate = first.q_offset + d_.first_velocity;
    loop_.second_coordinate = second.q_offset + d_.second_velocity;
    if (loop_.first_velocity == loop_.second_velocity) fail("it gears a joint with itself");
    if (first.driven[d_.first_velocity] && second.driven[d_.second_velocity]) {
      fail("both its joints, \"", first.name, "\" and \"", second.name,
           "\", are driven; drive one of them and let the gear move the other");
    }
    loop_.turns = turns(first.joint.kind, d_.first_velocity);
  }

  static bool turns(JointKind kind, int k) {
    switch (kind) {
      case JointKind::prismatic:
      case JointKind::translational:
        return false;
      case JointKind::cylindrical:
        return k == 0;
      case JointKind::planar:
        return k == 2;
      default:
        return true;
    }
  }

  void make_rope() {
    if (d_.paths.empty()) fail("it has no path; give one or more, each over two points or more");
    bool stretches = false;
    for (const std::vector<LoopPoint>& path : d_.paths) {
      if (path.size() < 2) {
        fail("a path has ", path.size(), " point(s); it leads over two or more");
      }
      std::vector<Loop::PathPoint>& points = loop_.paths.emplace_back();
      for (const LoopPoint& point : path) {
        if (!point.p_BoQ_B.allFinite()) fail("a point of a path is not finite");
        points.push_back({find_body(point.body), point.p_BoQ_B});
        if (points.size() < 2) continue;
        const Loop::PathPoint& last = points[points.size() - 2];
        stretches = stretches || moving(last.body) != moving(points.back().body);
      }
    }
    if (!stretches) {
      fail(
          "none of its paths leads from one body to another that moves against it, so that its "
          "length never changes");
    }
    loop_.first = loop_.paths.front().front().body;
    loop_.second = loop_.paths.back().back().body;
    check_length("rope");
  }

  const LoopDefinition& d_;
  const std::vector<Body>& bodies_;
  Loop loop_;
};

}  // namespace

std::string_view loop_kind_name(LoopKind kind) { return properties_of(kind).name; }

std::optional<LoopKind> loop_kind(std::string_view name) {
  for (std::size_t i = 0; i < loop_properties.size(); ++i) {
    if (loop_properties[i].name == name) return static_cast<LoopKind>(i);
  }
  return std::nullopt;
}

const std::vector<std::string_view>& loop_kind_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> result;
    result.reserve(loop_properties.size());
    for (const LoopProperties& kind : loop_properties) result.push_back(kind.name);
    return result;
  }();
  return names;
}

int loop_row_count(LoopKind kind) { return properties_of(kind).rows; }

std::string Loop::row_name(int i) const {
  if (kind == LoopKind::gear) return "ratio";
  if (kind == LoopKind::distance || kind == LoopKind::rope_length) return "length";
  const auto translations = static_cast<int>(held_translations.size());
  if (i < translations) {
    return "displacement along " + direction_name(R_KKaligned.col(held_translations[i]));
  }
  if (rotation == Rotation::axes_perpendicular) return "angle between the axes";
  return "rotation about " + direction_name(R_KKaligned.col(i - translations));
}

bool Loop::row_is_angle(int i) const {
  if (kind == LoopKind::gear) return turns;
  return i >= static_cast<int>(held_translations.size()) && rotation != Rotation::none;
}

Loop make_loop(const LoopDefinition& definition, const std::vector<Body>& bodies) {
  return LoopMaker(definition, bodies).make();
}

}  // namespace blocklift::dynamics
