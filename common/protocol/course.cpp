#include "common/protocol/course.hpp"

namespace gyre::protocol {

std::vector<mechanics::TimedLayer> layers(const Course& course, SwarmTime origin, const SliceLookup& lookup) {
  const auto since = [origin](SwarmTime t) { return seconds(t - origin); };
  std::vector<mechanics::TimedLayer> out;
  const mechanics::CarrierSlice* base = lookup(course.base.number);
  if (base == nullptr) return {};
  out.push_back({base, since(course.base.epoch), 0.0, 0.0});
  for (const Transition& t : course.transitions) {
    if (t.stage != Stage::kGo) continue;
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
  for (std::size_t i = course.transitions.size(); i-- > 0;) {
    const Transition& t = course.transitions[i];
    if (t.stage != Stage::kGo || now < t.end()) continue;
    course.base = t.to;
    course.transitions.erase(course.transitions.begin(),
                             course.transitions.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    return true;
  }
  return false;
}

bool in_transition(const Course& course, SwarmTime now) {
  for (const Transition& t : course.transitions) {
    if (t.stage == Stage::kGo && now >= t.start && now < t.end()) return true;
  }
  return false;
}

}  // namespace gyre::protocol
