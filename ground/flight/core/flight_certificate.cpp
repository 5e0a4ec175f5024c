#include "ground/flight/core/flight_certificate.hpp"

#include <algorithm>

#include "common/protocol/course.hpp"

namespace gyre::ground {
namespace {

constexpr mechanics::CertifyOptions kFiguresOnly{false, false, false};

}  // namespace

FlightCertificate::FlightCertificate(const mechanics::Plan& motion)
    : motion_(mechanics::certify(motion, kFiguresOnly)) {}

void FlightCertificate::include(const protocol::Course& course) {
  if (!plan_.known()) return;
  const auto plans = protocol::plans_of(course);
  if (std::any_of(plans.begin(), plans.end(), [this](const auto& p) { return p != plan_.number; }))
    knows_all_plans_ = false;
}

std::vector<FlightCertificate::CarrierBounds> FlightCertificate::bounds() const {
  std::vector<CarrierBounds> bounds;
  for (const mechanics::CarrierFigures& figures : motion_.carriers) {
    CarrierBounds carrier{figures.id, figures, figures};
    carrier.whole.speed_m_s.include(0.0);
    carrier.whole.winch_rate_m_s.include(0.0);
    bounds.push_back(carrier);
  }
  return bounds;
}

}  // namespace gyre::ground
