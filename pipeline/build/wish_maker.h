#pragma once

#include <map>
#include <string>
#include <vector>

#include "dynamics/simulation/steering.h"
#include "pipeline/build/build_lift.h"

namespace blocklift::pipeline {

/// Makes the wishes of steered drives, and what laws of Python see, of what their keys name: points
/// of the lift's bodies, its ropes and hoists.
class WishMaker {
 public:
  /// @param body_of by the names of points' bodies; all that is given outlives this.
  WishMaker(const LiftCase& lift_case, const std::map<std::string, dynamics::BodyIndex>& body_of,
            const std::vector<LiftRope>& ropes, const std::vector<LiftHoist>& hoists)
      : lift_case_(lift_case), body_of_(body_of), ropes_(ropes), hoists_(hoists) {}

  /// @throws InputError if it asks for a law that nobody gives.
  dynamics::Wish make_wish(const given::Keep& keep, const std::string& drive) const;

 private:
  dynamics::BodyPoint body_point(const ResolvedPoint& point) const;
  int rope_of(const std::string& name) const;
  dynamics::Sight make_sight(const given::Sight& sight) const;
  dynamics::OwnLaw make_law(const given::Keep& keep) const;

  const LiftCase& lift_case_;
  const std::map<std::string, dynamics::BodyIndex>& body_of_;
  const std::vector<LiftRope>& ropes_;
  const std::vector<LiftHoist>& hoists_;
};

}  // namespace blocklift::pipeline
