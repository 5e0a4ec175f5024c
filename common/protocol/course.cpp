#include "common/protocol/course.hpp"

namespace gyre::protocol {

namespace {

/// In motion at the end of its lease, which has passed.
bool stops_alone(const Course& course, SwarmTime now) {
  return course.lease && now > *course.lease && !course.pace.rests(*course.lease);
}

}  // namespace

Pace Course::flown_pace(SwarmTime now) const {
  return stops_alone(*this, now) ? pace.with_ramp(*lease, stopping, 0.0) : pace;
}

// Asked for at every tick: nothing is copied where nothing stops.
PlanMoment Course::moment(SwarmTime now) const {
  return stops_alone(*this, now) ? flown_pace(now).at(now) : pace.at(now);
}

bool same_motion(const Course& a, const Course& b) {
  return a.pace == b.pace && a.base == b.base && a.transitions == b.transitions;
}

bool operator==(const Course& a, const Course& b) {
  return a.term == b.term && a.revision == b.revision && a.wish == b.wish && a.lease == b.lease &&
         a.stopping == b.stopping && same_motion(a, b);
}

std::vector<mechanics::TimedLayer> layers(const Course& course, PlanTime origin, const SliceLookup& lookup) {
  const auto since = [origin](PlanTime t) { return seconds(t - origin); };
  std::vector<mechanics::TimedLayer> out;
  const mechanics::CarrierSlice* base = lookup(course.base.number);
  if (base == nullptr) return {};
  out.push_back({base, since(course.base.epoch), 0.0, 0.0});
  for (const Transition& t : course.transitions) {
    const mechanics::CarrierSlice* slice = lookup(t.to.number);
    if (slice == nullptr) return {};
    out.push_back({slice, since(t.to.epoch), since(t.start), seconds(t.duration)});
  }
  return out;
}

std::vector<PlanNumber> plans_of(const Course& course) {
  std::vector<PlanNumber> out{course.base.number};
  for (const Transition& t : course.transitions) out.push_back(t.to.number);
  return out;
}

bool settle(Course& course, SwarmTime now) {
  const PlanTime plan_time = course.moment(now).at;
  // What lies beyond the end of the lease is not flown yet: whoever extends it may still want it.
  course.pace.settle(course.lease ? std::min(now, *course.lease) : now);
  for (std::size_t i = course.transitions.size(); i-- > 0;) {
    const Transition& t = course.transitions[i];
    if (plan_time < t.end()) continue;
    course.base = t.to;
    course.transitions.erase(course.transitions.begin(),
                             course.transitions.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    return true;
  }
  return false;
}

}  // namespace gyre::protocol
