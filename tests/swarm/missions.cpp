#include "tests/swarm/missions.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/angle.hpp"
#include "common/base/random_stream.hpp"
#include "common/mechanics/certificate.hpp"

namespace gyre::swarm {
namespace {

using mechanics::LengthLaw;
using mechanics::Plan;

constexpr std::size_t kLoads = 16;
constexpr int kMotionsPerLoad = 3;
/// What is tried is what a swarm agrees on, on loads that hang as they are held.
constexpr mechanics::CertifyOptions kWithoutSwings{true, true, true, false};

class Draw {
 public:
  explicit Draw(RandomStream& random) : random_(random) {}
  double operator()(double low, double high) { return low + (high - low) * random_.uniform(); }

 private:
  RandomStream& random_;
};

Plan paper() {
  Plan plan;
  plan.load.mass_kg = 0.3;
  plan.load.inertia_b_kg_m2 = 0.01 * Eigen::Matrix3d::Identity();
  plan.cable = {1e4, 1e3};
  plan.carriers = {{1, {-0.036, 1.2, 0.256}, LengthLaw::level(0.627)},
                   {2, {-1.183, -0.201, 0.254}, LengthLaw::level(0.67)},
                   {3, {0.195, -1.184, 0.244}, LengthLaw::level(0.606)},
                   {4, {1.18, 0.222, 0.35}, LengthLaw::level(0.807)}};
  plan.cycle.rate_rad_s = 0.08;
  plan.cycle.edges = {
      {1, 2, 0.0, 1.2, 1.77}, {2, 3, 0.0, 1.2, kPi / 2}, {3, 4, 0.0, 1.2, 1.77}, {4, 1, 0.0, 1.2, kPi / 2}};
  return plan;
}

/// The two-carrier construction: the lengths swing a quarter of a period off the force, whose offset keeps each carrier
/// on its own side, or their cables would cross.
Plan pair(Draw& draw) {
  Plan plan;
  plan.load.mass_kg = draw(0.5, 4.0);
  plan.load.inertia_b_kg_m2 = Eigen::Vector3d(0.1, 0.7, 0.7).asDiagonal();
  plan.cable = {1e4, 1e3};
  const double phase_rad = draw(-kPi, kPi);
  plan.carriers = {{1, {1.0, 0.0, 0.2}, LengthLaw::sine({3.0, 0.8, {}, phase_rad})},
                   {2, {-1.0, 0.0, 0.2}, LengthLaw::sine({3.0, -0.8, {}, phase_rad})}};
  plan.cycle.rate_rad_s = draw(0.2, 0.8);
  plan.cycle.edges = {{1, 2, 4.0 * plan.load.mass_kg, 3.0 * plan.load.mass_kg, phase_rad + kPi / 2}};
  return plan;
}

/// Attachments around the centre of mass, so that no cable would have to push.
Plan polygon(Draw& draw, std::size_t n) {
  Plan plan;
  plan.load.mass_kg = draw(0.3, 10.0);
  plan.load.inertia_b_kg_m2 = Eigen::Vector3d(draw(0.01, 1.0), draw(0.01, 1.0), draw(0.01, 1.0)).asDiagonal();
  plan.load.position_w_m = {draw(-5.0, 5.0), draw(-5.0, 5.0), draw(0.0, 5.0)};
  plan.load.orientation_w_b =
      Eigen::AngleAxisd(draw(-0.2, 0.2), Eigen::Vector3d(1.0, draw(-1.0, 1.0), 0.0).normalized());
  plan.cable = {1e4, 1e3};
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = 2.0 * kPi * (static_cast<double>(i) + draw(-0.1, 0.1)) / static_cast<double>(n);
    const double radius = draw(1.8, 2.2);
    plan.carriers.push_back(
        {static_cast<CarrierId>(i + 1), {radius * std::cos(angle), radius * std::sin(angle), draw(0.1, 0.4)}, {}});
  }
  return plan;
}

/// Another motion of the same load: rate, amplitudes, phases, lengths.
void set_in_motion(Plan& plan, Draw& draw) {
  const std::size_t n = plan.carriers.size();
  const auto arms = lever_arms(plan);
  plan.cycle = {draw(0.1, 1.2), {}};
  const double amplitude_n = draw(0.15, 0.5) * plan.load.mass_kg * plan.gravity_m_s2 / static_cast<double>(n);
  const double spread_rad = draw(0.0, 0.3);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = (i + 1) % n;
    const Eigen::Vector3d travelled = arms[next] - arms[i];
    const double heading_rad = std::atan2(travelled.y(), travelled.x());
    plan.cycle.edges.push_back({plan.carriers[i].id, plan.carriers[next].id, 0.0, amplitude_n * draw(0.8, 1.2),
                                heading_rad + spread_rad * draw(-1.0, 1.0)});
  }
  const double height_m = draw(3.0, 5.0);
  for (std::size_t i = 0; i < n; ++i) {
    const double z = plan.load.position_w_m.z() + arms[i].z();
    const double kind = draw(0.0, 1.0);
    plan.carriers[i].law = kind < 0.7    ? LengthLaw::level(z + height_m + draw(-0.3, 0.3))
                           : kind < 0.85 ? LengthLaw::fixed(height_m)
                                         : LengthLaw::sine({height_m, 0.3, {}, draw(-kPi, kPi)});
  }
}

/// What vehicles for these motions can do: twice of what each asks for, and enough for transitions of
/// a few seconds, which are not rehearsed.
mechanics::Limits room_for(const std::vector<Plan>& motions) {
  mechanics::Limits limits;
  double tension_n = 0.0, rate_m_s = 2.0, speed_m_s = 2.5, acceleration_m_s2 = 5.0;
  for (const Plan& plan : motions) {
    for (const mechanics::CarrierFigures& figures : mechanics::certify(plan, kWithoutSwings).carriers) {
      tension_n = std::max(tension_n, figures.tension_n.max);
      rate_m_s = std::max(rate_m_s, figures.winch_rate_max_m_s());
      speed_m_s = std::max(speed_m_s, figures.speed_m_s.max);
      acceleration_m_s2 = std::max(acceleration_m_s2, figures.acceleration_max_m_s2);
    }
  }
  limits.tension_min_n = 1e-3 * tension_n;
  limits.tension_max_n = 2.0 * tension_n;
  limits.length_min_m = 0.05;
  limits.winch_rate_max_m_s = 2.0 * rate_m_s;
  limits.speed_max_m_s = 2.0 * speed_m_s;
  limits.acceleration_max_m_s2 = 2.0 * acceleration_m_s2;
  return limits;
}

LoadWithMotions with_room(std::vector<Plan> motions) {
  LoadWithMotions out;
  out.vehicle = room_for(motions);
  for (Plan& plan : motions) plan.limits = out.vehicle;
  out.motions = std::move(motions);
  return out;
}

std::vector<LoadWithMotions> make_loads() {
  RandomStream random(1, "loads");
  Draw draw(random);
  const auto admissible = [](const Plan& plan) { return mechanics::certify(plan, kWithoutSwings).admissible(); };

  std::vector<LoadWithMotions> out;
  Plan slow = paper();
  Plan wide = slow;
  wide.cycle.rate_rad_s = 0.2;
  for (mechanics::Carrier& carrier : wide.carriers) carrier.law.profile.mean += 0.4;
  out.push_back(with_room({slow, wide}));
  while (out.size() < kLoads) {
    const std::size_t n = 2 + out.size() % 7;
    Plan plan = n == 2 ? pair(draw) : polygon(draw, n);
    std::vector<Plan> motions;
    for (int i = 0; i < 10 * kMotionsPerLoad && motions.size() < kMotionsPerLoad; ++i) {
      if (n == 2) {
        plan.cycle.rate_rad_s = draw(0.2, 0.8);
        plan.cycle.edges.front().amplitude_n = draw(1.5, 3.0) * plan.load.mass_kg;
      } else {
        set_in_motion(plan, draw);
      }
      if (admissible(plan)) motions.push_back(plan);
    }
    if (motions.size() >= 2) out.push_back(with_room(std::move(motions)));
  }
  // Some of their winches lag, and some of their vehicles, as a machine does: the same in all motions.
  for (std::size_t i = 0; i < out.size(); ++i) {
    for (Plan& motion : out[i].motions) {
      motion.winch.time_constant_s = 0.02 * static_cast<double>(i % 3);
      for (mechanics::Carrier& carrier : motion.carriers)
        carrier.vehicle.time_constant_s = 0.05 * static_cast<double>((i + carrier.id) % 4);
    }
  }
  return out;
}

}  // namespace

Plan too_fast(const Plan& plan) {
  Plan fast = plan;
  fast.cycle.rate_rad_s *= 60.0;
  return fast;
}

const std::vector<LoadWithMotions>& loads() {
  static const std::vector<LoadWithMotions> kLoads = make_loads();
  return kLoads;
}

}  // namespace gyre::swarm
