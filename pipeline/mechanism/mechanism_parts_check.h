#pragma once

#include "pipeline/mechanism/mechanism_parts.h"

/// Rules that concern several keys of a mechanism's parts; run by their formats.
namespace blocklift::pipeline {

void check_body(const BodyModel& body, Reading& reading, const Mark& mark);
void check_joint(const JointModel& joint, Reading& reading, const Mark& mark);
void check_loop_side(const LoopSide& side, Reading& reading, const Mark& mark);
void check_loop(const LoopModel& loop, Reading& reading, const Mark& mark);
void check_spring(const SpringModel& spring, Reading& reading, const Mark& mark);

/// Complains about ends of joints, drives, loops and springs that do not exist or do not fit,
/// bodies without joint or with several, and joints in a ring. reading.owner() is whose parts they
/// are.
void check_parts(const MechanismParts& parts, Reading& reading);
/// The part of check_parts that concerns loops and springs.
void check_loops_and_springs(const MechanismParts& parts, Reading& reading);

/// Complains about positions for joints that do not exist or that do not fit their joint.
/// @param user what they belong to, for messages: "the initial state".
void check_joint_positions(const MechanismParts& parts, const JointValues& values,
                           const std::string& user, Reading& reading);
/// The same of velocities.
void check_joint_velocities(const MechanismParts& parts, const JointValues& values,
                            const std::string& user, Reading& reading);

/// Complains if the lowest coordinate is not below the highest.
void check_range_ascends(const DriveLimits& limits, const std::string& owner, const Mark& mark,
                         Reading& reading);

/// Is it an angle or something over an angle?
bool is_angular(Dimension dimension);

/// Looks up the body of a point; "world" exists always. @returns false after a complaint.
bool check_point(const MechanismParts& parts, const PointModel& point, const std::string& user,
                 Reading& reading);

/// Looks up a joint for `user` ("force motor"). @returns null, after a complaint unless the name is
/// empty.
const JointModel* look_up_joint(const MechanismParts& parts, const Located<std::string>& name,
                                const std::string& user, Reading& reading);

/// Looks up a joint and its degree of freedom for `user` ("force motor").
/// @returns whether it turns; nothing after a complaint.
std::optional<bool> check_freedom(const MechanismParts& parts, const JointAxis& freedom,
                                  const std::string& user, Reading& reading);

}  // namespace blocklift::pipeline
