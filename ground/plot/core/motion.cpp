#include "ground/plot/core/motion.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/angle.hpp"
#include "common/mechanics/load_hull.hpp"
#include "common/mechanics/reference.hpp"
#include "common/mechanics/segment.hpp"

namespace gyre::ground {
namespace {

using mechanics::CarrierSlice;

constexpr int kPerSwing = 96, kPerSwingOfMany = 48, kMost = 1536;

Moment moment(const CarrierSlice& slice, double t_s) {
  const mechanics::Reference now = mechanics::evaluate(slice, t_s);
  return {t_s,
          now.position_w_m.value,
          now.tension_n.value,
          now.length_m.value,
          now.position_w_m.first.norm(),
          now.length_m.first};
}

/// So many in a period that the fastest of what swings in it is seen to swing.
int samples(const mechanics::Plan& plan, double period_s) {
  double fastest = 1.0;  // swings in a cycle
  for (const mechanics::Carrier& carrier : plan.carriers) {
    if (!carrier.law.profile.constant()) fastest = std::max(fastest, carrier.law.profile.harmonic.ratio());
  }
  const int per_swing = plan.carriers.size() <= kFewCarriers ? kPerSwing : kPerSwingOfMany;
  const double swings = fastest * period_s * plan.cycle.rate_rad_s / kTwoPi;
  return static_cast<int>(std::clamp(std::round(swings) * per_swing, 1.0 * per_swing, 1.0 * kMost));
}

std::optional<Nearest> nearest(const std::optional<mechanics::Approach>& approach,
                               const std::vector<CarrierSlice>& slices) {
  if (!approach) return std::nullopt;
  const auto side = [&](CarrierId id) {
    const auto slice = std::find_if(slices.begin(), slices.end(), [id](const CarrierSlice& c) { return c.id == id; });
    const Eigen::Vector3d carrier = mechanics::evaluate(*slice, approach->at_s).position_w_m.value;
    return Nearest::Side{static_cast<std::size_t>(slice - slices.begin()), slice->attachment_w_m, carrier, carrier};
  };
  Nearest out{*approach, side(approach->first), side(approach->second)};
  if (approach->what == mechanics::Touch::kCables) {
    const auto cable = [](const Nearest::Side& s) {
      return mechanics::Segment{s.attachment_w_m, s.carrier_w_m - s.attachment_w_m};
    };
    const auto points = mechanics::closest_points(cable(out.first), cable(out.second));
    out.first.closest_w_m = cable(out.first).at(points.s);
    out.second.closest_w_m = cable(out.second).at(points.t);
  }
  return out;
}

}  // namespace

Motion motion(const mechanics::Plan& plan, const mechanics::Certificate& certificate) {
  const std::vector<CarrierSlice> slices = mechanics::slices(plan);
  Motion out;
  out.period_s = certificate.period_s;
  const int count = samples(plan, out.period_s);
  for (std::size_t i = 0; i < slices.size(); ++i) {
    CarrierPath path{slices[i].id, plan.carriers[i].radius_m, slices[i].attachment_w_m, {}};
    for (int k = 0; k <= count; ++k) path.moments.push_back(moment(slices[i], out.period_s * k / count));
    out.carriers.push_back(std::move(path));
  }
  out.places = nearest(certificate.separation, slices);
  out.cables = nearest(certificate.cable_distance, slices);
  out.load_position_w_m = plan.load.position_w_m;
  out.load_w_m = mechanics::hull_w(plan.load);
  if (out.load_w_m.empty()) {
    for (const CarrierSlice& slice : slices) out.load_w_m.push_back(slice.attachment_w_m);
  }
  return out;
}

}  // namespace gyre::ground
