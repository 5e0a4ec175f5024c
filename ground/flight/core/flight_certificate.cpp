#include "ground/flight/core/flight_certificate.hpp"

#include <algorithm>

#include "common/mechanics/rest_plan.hpp"
#include "common/mechanics/transition_figures.hpp"
#include "common/protocol/course.hpp"

namespace gyre::ground {
namespace {

using mechanics::CarrierFigures;

constexpr mechanics::CertifyOptions kFiguresOnly{false, false, false};

void widen(CarrierFigures& hull, const CarrierFigures& part) {
  hull.tension_n.include(part.tension_n);
  hull.length_m.include(part.length_m);
  hull.winch_rate_m_s.include(part.winch_rate_m_s);
  hull.speed_m_s.include(part.speed_m_s);
  hull.acceleration_max_m_s2 = std::max(hull.acceleration_max_m_s2, part.acceleration_max_m_s2);
  hull.altitude_m.include(part.altitude_m);
  hull.vertical_cosine.include(part.vertical_cosine);
}

/// From the start of the first transition to the end of the last.
CarrierFigures figures_of(const protocol::Course& course, const protocol::SliceLookup& slice_of) {
  const SwarmTime origin = course.transitions.front().start;
  double begin_s = 0.0;
  double end_s = 0.0;
  for (const protocol::Transition& transition : course.transitions) {
    begin_s = std::min(begin_s, seconds(transition.start - origin));
    end_s = std::max(end_s, seconds(transition.end() - origin));
  }
  return mechanics::transition_figures(protocol::layers(course, origin, slice_of), begin_s, end_s);
}

}  // namespace

FlightCertificate::FlightCertificate(const mechanics::Plan& motion)
    : motion_(mechanics::certify(motion, kFiguresOnly)),
      rest_(mechanics::certify(mechanics::rest_plan(motion), kFiguresOnly)),
      motion_slices_(mechanics::slices(motion)),
      rest_slices_(mechanics::slices(mechanics::rest_plan(motion))) {}

void FlightCertificate::include(const protocol::Course& course) {
  if (!plans_.known()) return;
  protocol::Course flown = course;
  flown.revision = 0;  // a new revision of the same stack is the same motion
  auto& transitions = flown.transitions;
  transitions.erase(std::remove_if(transitions.begin(), transitions.end(),
                                   [](const auto& t) { return t.stage != protocol::Stage::kGo; }),
                    transitions.end());
  if (transitions.empty()) return;
  for (const protocol::PlanNumber& number : protocol::plans_of(flown)) {
    if (number != plans_.rest && number != plans_.motion) {
      knows_all_plans_ = false;
      return;
    }
  }
  if (std::find(courses_.begin(), courses_.end(), flown) == courses_.end()) courses_.push_back(flown);
}

std::vector<FlightCertificate::CarrierBounds> FlightCertificate::bounds() const {
  std::vector<CarrierBounds> bounds;
  for (std::size_t i = 0; i < motion_.carriers.size(); ++i) {
    CarrierBounds carrier{motion_.carriers[i].id, motion_.carriers[i], motion_.carriers[i]};
    widen(carrier.whole, rest_.carriers[i]);
    const auto slice_of = [&](const protocol::PlanNumber& number) {
      return number == plans_.rest ? &rest_slices_[i] : &motion_slices_[i];
    };
    for (const protocol::Course& course : courses_) widen(carrier.whole, figures_of(course, slice_of));
    bounds.push_back(carrier);
  }
  return bounds;
}

}  // namespace gyre::ground
