#include "pipeline/build/wish_maker.h"

#include <optional>

#include "pipeline/files/lift_case/own_laws.h"

namespace blocklift::pipeline {

dynamics::BodyPoint WishMaker::body_point(const ResolvedPoint& point) const {
  const std::string body = point.body_name(lift_case_.cranes);
  return {body == "world" ? dynamics::world_index : body_of_.at(body), point.point};
}

int WishMaker::rope_of(const std::string& name) const { return find_rope(ropes_, hoists_, name); }

dynamics::Sight WishMaker::make_sight(const given::Sight& sight) const {
  if (sight.over)
    return dynamics::SeenPlumb{body_point(*sight.head_at), body_point(*sight.over_at)};
  if (sight.pull) return dynamics::SeenTension{rope_of(sight.pull->value)};
  if (sight.share) {
    dynamics::SeenShare seen{rope_of(sight.share->value), {}};
    for (const Located<std::string>& other : sight.of) seen.others.push_back(rope_of(other.value));
    return seen;
  }
  dynamics::SeenHeight seen{body_point(*sight.level_at), {dynamics::world_index, Vector3::Zero()}};
  if (sight.with) seen.reference = body_point(*sight.with_at);
  return seen;
}

dynamics::OwnLaw WishMaker::make_law(const given::Keep& keep) const {
  dynamics::OwnLaw own = make_own_law(keep, lift_case_.laws);
  for (const given::Sight& sight : keep.sees) own.sights.push_back(make_sight(sight));
  return own;
}

dynamics::Wish WishMaker::make_wish(const given::Keep& keep, const std::string& drive) const {
  if (keep.law) return make_law(keep);
  if (keep.over) return dynamics::KeptPlumb{body_point(*keep.head_at), body_point(*keep.over_at)};
  std::optional<double> stiffness;
  if (keep.stiffness) stiffness = keep.stiffness->value;
  if (keep.tension) return dynamics::KeptTension{rope_of(drive), keep.tension->value, stiffness};
  if (keep.share) {
    dynamics::KeptShare wish{rope_of(drive), {}, keep.share->value, stiffness};
    for (const Located<std::string>& other : keep.of) wish.others.push_back(rope_of(other.value));
    return wish;
  }
  dynamics::KeptHeight wish{
      body_point(*keep.level_at), {dynamics::world_index, Vector3::Zero()}, std::nullopt};
  if (keep.with) wish.reference = body_point(*keep.with_at);
  if (keep.above) wish.difference = keep.above->value;
  if (keep.with && !keep.above) wish.difference = 0.0;
  return wish;
}

}  // namespace blocklift::pipeline
