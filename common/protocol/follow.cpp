#include "common/protocol/follow.hpp"

namespace gyre::protocol {

std::optional<mechanics::Reference> reference(const Course& course, SwarmTime now, const SliceLookup& lookup) {
  const PlanMoment moment = course.moment(now);
  const auto stack = layers(course, moment.at, lookup);
  if (stack.empty()) return std::nullopt;
  const mechanics::Reference r = mechanics::evaluate_course(stack.data(), stack.size(), 0.0);
  const auto paced = [&moment](const auto& x) { return mechanics::paced(x, moment.pace, moment.rate_1_s); };
  return mechanics::Reference{paced(r.force_w_n), paced(r.tension_n), paced(r.direction_w), paced(r.length_m),
                              paced(r.position_w_m)};
}

}  // namespace gyre::protocol
