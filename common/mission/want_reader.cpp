#include "common/mission/want_reader.hpp"

#include <algorithm>

#include "common/mission/spans.hpp"

namespace gyre::mission {
namespace {

namespace pb = ::gyre::mission::schema;

design::Objective objective_of(pb::Want::Objective objective) {
  switch (objective) {
    case pb::Want::LEAST_EVERYTHING:
      break;
    case pb::Want::GREATEST_SPEED:
      return design::Objective::kGreatestSpeed;
    case pb::Want::LEAST_WINCH_WORK:
      return design::Objective::kLeastWinchWork;
    case pb::Want::GREATEST_CLEARANCE:
      return design::Objective::kGreatestClearance;
  }
  return design::Objective::kLeastEverything;
}

/// A wish for at least so much: it becomes the limit, unless that is stricter.
void want_at_least(const Located& want, const char* field, const Span& span, std::optional<double>& limit) {
  const std::optional<double> wish = want.optional_number(field, span);
  if (wish) limit = std::max(*wish, limit.value_or(0.0));
}

bool bounded_speed(const design::Want& want, const design::Open& open, const mechanics::Plan& plan) {
  return !open.rate || want.rate_max_rad_s || plan.limits.speed_max_m_s || plan.limits.acceleration_max_m_s2;
}

bool bounded_height(const design::Want& want, const mechanics::Plan& plan) {
  return want.altitude_max_m || plan.limits.length_max_m;
}

}  // namespace

design::Want read_want(const pb::Want& message, const Located& want, mechanics::Plan& plan) {
  design::Want out;
  out.objective = objective_of(message.objective());
  want_at_least(want, "speed_min_m_s", kSpeed, plan.limits.speed_min_m_s);
  want_at_least(want, "clearance_min_m", kLengthM, plan.limits.clearance_min_m);
  out.amplitude_max_n = want.optional_number("amplitude_max_n", kPositiveForceN);
  out.rate_max_rad_s = want.optional_number("rate_max_rad_s", kRate);
  out.altitude_min_m = want.optional_number("altitude_min_m", kPlaceM);
  out.altitude_max_m = want.optional_number("altitude_max_m", kPlaceM);
  return out;
}

void judge_want(const Located& place, const design::Want& want, const design::Open& open, const mechanics::Plan& plan) {
  using design::Objective;
  const bool moves = plan.limits.speed_min_m_s.value_or(0.0) > 0.0;
  if (!moves && want.objective != Objective::kGreatestSpeed) {
    place.complain("speed_min_m_s", std::string(place.has("speed_min_m_s") ? "is no speed" : "is missing") +
                                        ", and standing still costs least; give the speed that no carrier may fall "
                                        "below, or objective: GREATEST_SPEED");
  }
  if (want.objective == Objective::kGreatestSpeed && !bounded_speed(want, open, plan)) {
    place.complain("objective",
                   "nothing bounds the speed; give want.rate_max_rad_s, limits.acceleration_max_m_s2, "
                   "limits.speed_max_m_s or cycle.rate_rad_s");
  }
  if (want.objective == Objective::kGreatestClearance && !bounded_height(want, plan)) {
    place.complain("objective", "nothing bounds the clearance; give limits.length_max_m or want.altitude_max_m");
  }
  const auto above = [&](const char* low_field, const std::optional<double>& low, const std::string& high_name,
                         const std::optional<double>& high) {
    if (!low || !high || *low <= *high) return;
    place.complain(low_field, "is " + show(*low) + ", above " + high_name + ", " + show(*high) +
                                  "; nothing can be inside: raise the one or lower the other");
  };
  above("altitude_min_m", want.altitude_min_m, "altitude_max_m", want.altitude_max_m);
  above("speed_min_m_s", plan.limits.speed_min_m_s, "limits.speed_max_m_s", plan.limits.speed_max_m_s);
  if (!open.rate && want.rate_max_rad_s && plan.cycle.rate_rad_s > *want.rate_max_rad_s) {
    place.complain("rate_max_rad_s", "is " + show(*want.rate_max_rad_s) + ", below cycle.rate_rad_s, " +
                                         show(plan.cycle.rate_rad_s) + "; leave one of them out");
  }
}

void judge_open_attachments(const Located& root, const mechanics::Load& load, const std::vector<Located>& edges) {
  if (load.hull_b_m.empty()) {
    root.child("load").complain("shape",
                                "is missing, and so are the attachments; give the shape that they are to be on, "
                                "or every carrier's attachment_m");
  }
  if (!edges.empty()) edges.front().complain("has no direction without attachments; leave the edges out, or give them");
}

}  // namespace gyre::mission
