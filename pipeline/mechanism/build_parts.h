#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "dynamics/simulation/lift_system.h"
#include "pipeline/mechanism/mechanism_parts.h"

namespace blocklift::pipeline {

/// A degree of freedom that a drive prescribes, within the dynamics.
struct DrivenFreedom {
  const DriveModel* drive = nullptr;
  dynamics::BodyIndex body = -1;  ///< that the joint carries
  int degree_of_freedom = 0;      ///< from 0
};

/// What the base of some parts stands on.
struct BaseGround {
  std::string name = "world";
  dynamics::BodyIndex body = dynamics::world_index;
};

/// Makes bodies, loops and springs of the dynamics from the parts of one file.
///
/// Names get the prefix ("C1."), and what the parts call the world is a base that stands in the
/// world, or on a body that is there already (a vessel), at X_WBase. The parts must outlive the
/// builder.
class PartsBuilder {
 public:
  /// @param X_WBase pose of the base in the world, or in the frame of the ground's body.
  PartsBuilder(const MechanismParts& parts, std::string prefix, const dynamics::Pose& X_WBase,
               BaseGround ground = {})
      : parts_(parts), prefix_(std::move(prefix)), X_WBase_(X_WBase), ground_(std::move(ground)) {}

  /// Adds all bodies, each after the one that carries it.
  /// @param held names of joints of which all velocities count as driven.
  /// @throws dynamics::ModelError if joints form a ring, or a body or joint is impossible.
  void add_bodies(dynamics::MechanismBuilder& builder, const std::vector<std::string>& held = {});
  /// Adds all loops; the bodies come first.
  /// @param known the parts by themselves, whose loops have the lengths and offsets that the file
  ///   leaves open; null: they stay open.
  /// @throws dynamics::ModelError as the builder does.
  void add_loops(dynamics::MechanismBuilder& builder,
                 const dynamics::Mechanism* known = nullptr) const;
  /// Adds all springs. @throws dynamics::ModelError as the elements do.
  void add_springs(const dynamics::Mechanism& mechanism, dynamics::ForceElements& elements) const;

  /// Puts positions that the file gives to joints into q (nq of the mechanism).
  void set_positions(const dynamics::Mechanism& mechanism, const JointValues& positions,
                     dynamics::VectorRef q) const;

  /// Adds the wind areas of all bodies.
  void add_wind_areas(const std::shared_ptr<const dynamics::WindField>& wind,
                      dynamics::ForceElements& elements) const;

  /// A body of the parts, or what their base stands on.
  dynamics::BodyIndex body(const std::string& name) const;
  /// The body that a joint carries.
  dynamics::BodyIndex carried_by(const std::string& joint) const;
  /// A point given in a body's frame, or in that of the base where the body is the world.
  dynamics::BodyPoint point(const std::string& body, const Vector3& position) const;

  /// In the order in which they were added.
  const std::vector<const BodyModel*>& added() const { return added_; }
  const std::vector<DrivenFreedom>& driven() const { return driven_; }

 private:
  void add_body(dynamics::MechanismBuilder& builder, const JointModel& joint, bool held);
  dynamics::Pose frame(const LoopSide& side) const;
  dynamics::LoopDefinition definition_of(const LoopModel& loop) const;
  std::string full_name(const std::string& body) const {
    return body == "world" ? ground_.name : prefix_ + body;
  }

  const MechanismParts& parts_;
  std::string prefix_;
  dynamics::Pose X_WBase_;
  BaseGround ground_;
  std::map<std::string, dynamics::BodyIndex> body_of_;
  std::vector<const BodyModel*> added_;
  std::vector<DrivenFreedom> driven_;
};

/// Adds a wind area of a body, which is named for messages.
void add_wind_area(const std::string& body_name, dynamics::BodyIndex body,
                   const WindAreaModel& area,
                   const std::shared_ptr<const dynamics::WindField>& wind,
                   dynamics::ForceElements& elements);

}  // namespace blocklift::pipeline
