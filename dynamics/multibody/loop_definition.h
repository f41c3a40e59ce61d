#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dynamics/multibody/body_index.h"
#include "dynamics/multibody/joint.h"

namespace blocklift::dynamics {

struct Body;

/// What a loop demands besides the joints of the tree. Joint kinds hold a frame of the second body
/// against one of the first as the tree's joint of that name would (see JointKind).
///
/// | kind          | holds                                                                 | rows |
/// |---------------|-----------------------------------------------------------------------|------|
/// | fixed         | both frames together                                                  | 6    |
/// | revolute      | origins together, axes parallel                                       | 5    |
/// | prismatic     | second origin on the first's axis, orientations equal                 | 5    |
/// | cylindrical   | second origin on the first's axis, axes parallel                      | 4    |
/// | universal     | origins together, second axis (of second) normal to axis of first     | 4    |
/// | spherical     | origins together                                                      | 3    |
/// | planar        | second origin in the first's plane, normals parallel                  | 3    |
/// | translational | orientations equal                                                    | 3    |
/// | distance      | distance of the origins: a rigid rod without mass                     | 1    |
/// | point_on_line | first's origin on the line through the second's origin along the axis | 2    |
/// | gear          | q_first = ratio q_second + offset, coordinates of joints of the tree  | 1    |
/// | rope_length   | sum of the lengths of all paths: an equaliser                         | 1    |
enum class LoopKind {
  fixed,
  revolute,
  prismatic,
  cylindrical,
  universal,
  spherical,
  planar,
  translational,
  distance,
  point_on_line,
  gear,
  rope_length
};

/// "revolute", "point_on_line", ...
std::string_view loop_kind_name(LoopKind kind);
/// The kind of that name; none if there is no such kind.
std::optional<LoopKind> loop_kind(std::string_view name);
/// All names, in the order of the enumeration.
const std::vector<std::string_view>& loop_kind_names();
/// Number of scalar equations of a kind: its rows in the residual, the Jacobian and the
/// multipliers.
int loop_row_count(LoopKind kind);

/// A point Q fixed in a body.
struct LoopPoint {
  std::string body{world_name};
  Vector3 p_BoQ_B = Vector3::Zero();  ///< m
};

/// What a modeller says about a loop. Members that its kind does not use stay as they are here.
struct LoopDefinition {
  std::string name;
  LoopKind kind = LoopKind::revolute;
  /// Joints, distance, point_on_line: the two bodies. Gear: the bodies whose joints are geared.
  std::string first{world_name};
  std::string second{world_name};
  Pose X_FirstK = Pose::identity();   ///< the loop's frame in the first body; a point is its origin
  Pose X_SecondK = Pose::identity();  ///< the loop's frame in the second body
  /// Directions in the frame K, of any length, as for Joint. point_on_line: the line's direction,
  /// in the second's K. universal: `axis` in the first's K, `second_axis` in the second's.
  Vector3 axis = Vector3::UnitZ();
  Vector3 second_axis = Vector3::Constant(not_a_number);
  /// distance: of the points, m. rope_length: sum of all paths, m. NaN: as it is at the start.
  double length = not_a_number;
  double ratio = not_a_number;  ///< gear: v_first = ratio v_second
  double offset =
      not_a_number;        ///< gear: q_first - ratio q_second, m or rad. NaN: as it is at the start
  int first_velocity = 0;  ///< gear: which velocity of the first joint
  int second_velocity = 0;                         ///< gear: which velocity of the second joint
  std::vector<std::vector<LoopPoint>> paths = {};  ///< rope_length: each over two points or more
};

/// One loop of a mechanism, immutable but for what is taken from the start.
struct Loop {
  /// Point of a rope's path.
  struct PathPoint {
    BodyIndex body;
    Vector3 p_BoQ_B;
  };
  /// How the orientation of the follower against the base enters.
  enum class Rotation {
    none,
    axes_parallel,  ///< 2 rows: rotation vector that carries base z to follower z, in base x and y
    axes_perpendicular,  ///< 1 row: angle by which base z and follower x miss the right angle
    equal                ///< 3 rows: rotation vector of the follower in the base
  };

  std::string name;
  LoopKind kind = LoopKind::fixed;
  BodyIndex first = -1;   ///< gear: the body whose joint is meant; rope_length: of the first point
  BodyIndex second = -1;  ///< gear: the other body; rope_length: of the last point
  int row_offset = 0;     ///< first row among all loops' rows
  int row_count = 0;

  // Joints, distance, point_on_line. The base carries the axes: it is the first body, for
  // point_on_line the second. K' is K turned so that z' is the axis; rows: translations along the
  // axes of base K' that are held, then rotations.
  BodyIndex base = -1;
  BodyIndex follower = -1;
  BodyIndex common = -1;  ///< last common carrier of both: velocities up to there do not enter
  Pose X_BaseK = Pose::identity();
  Pose X_FollowerK = Pose::identity();
  Matrix3 R_KKaligned = Matrix3::Identity();  ///< K' in K, for names of rows
  std::vector<int> held_translations = {};    ///< 0, 1, 2: x', y', z'
  Rotation rotation = Rotation::none;

  double length = not_a_number;  ///< distance, rope_length: m; NaN until the start is known

  // gear
  double ratio = not_a_number;
  double offset = not_a_number;  ///< NaN until the start is known
  bool turns = false;            ///< is the first coordinate an angle?
  int first_velocity = -1;       ///< index within v
  int second_velocity = -1;
  int first_coordinate = -1;  ///< index within q
  int second_coordinate = -1;

  std::vector<std::vector<PathPoint>> paths = {};  ///< rope_length

  /// Row i of this loop in words: "rotation about x", "displacement along (0.6, 0.8, 0)", "length".
  std::string row_name(int i) const;
  /// Is row i of this loop an angle (rad) rather than a length (m)? Gears count as their first
  /// joint.
  bool row_is_angle(int i) const;
};

/// Checks a definition against the bodies there are and makes a loop of it (row_offset not yet
/// set).
/// @throws ModelError as MechanismBuilder::add_loop.
Loop make_loop(const LoopDefinition& definition, const std::vector<Body>& bodies);

}  // namespace blocklift::dynamics
