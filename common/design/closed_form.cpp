#include "common/design/closed_form.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "common/base/angle.hpp"
#include "common/base/random_stream.hpp"
#include "common/mechanics/grasp.hpp"

namespace gyre::design {
namespace {

using mechanics::Edge;
using mechanics::LengthLaw;
using mechanics::Plan;

constexpr std::size_t kAllOrdersUpTo = 6;
constexpr std::size_t kDrawnOrders = 40;
constexpr double kLeastTurn = 0.05;        // sine of the angle between the edges of a carrier
constexpr double kSteepness = 0.25;        // of a cable's swing: least radius over height
constexpr double kFlattest = 0.6;          // cosine to the vertical, at first
constexpr double kUpright = 0.85;          // of what a limit allows, at first
constexpr double kTurnAcceleration = 0.6;  // of what is allowed, or of gravity
constexpr double kHeights = 3.0;           // first height, in sizes of the motion
constexpr double kMostHeights = 30.0;
constexpr double kMostForces = 8.0;  // an edge's greatest force in carriers' shares of the weight, and per carrier

/// The greatest distance of two attachments.
double spread_of(const std::vector<Eigen::Vector3d>& arms) {
  double spread = 0.0;
  for (const Eigen::Vector3d& a : arms)
    for (const Eigen::Vector3d& b : arms) spread = std::max(spread, (a - b).norm());
  return spread;
}

double heading(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return std::atan2(to.y() - from.y(), to.x() - from.x());
}

std::vector<Eigen::Vector3d> arms_in(const Plan& plan, const Order& order) {
  const std::vector<Eigen::Vector3d> arms = lever_arms(plan);
  std::vector<Eigen::Vector3d> out;
  for (const CarrierId id : order)
    for (std::size_t i = 0; i < arms.size(); ++i)
      if (plan.carriers[i].id == id) out.push_back(arms[i]);
  return out;
}

/// The least |sin| between the headings of a carrier's edges.
double least_turn(const std::vector<Eigen::Vector3d>& arms) {
  const std::size_t n = arms.size();
  double least = 1.0;
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector3d in = arms[i] - arms[(i + n - 1) % n];
    const Eigen::Vector3d out = arms[(i + 1) % n] - arms[i];
    if (!(in.norm() > 1e-6 && out.norm() > 1e-6)) return 0.0;
    least = std::min(least, in.cross(out).norm() / (in.norm() * out.norm()));
  }
  return least;
}

/// From the first carrier on, and to the lesser of its neighbours first: one of the 2n ways to write the same cycle.
Order canonical(Order order) {
  std::rotate(order.begin(), std::min_element(order.begin(), order.end()), order.end());
  if (order.size() > 2 && order.back() < order[1]) std::reverse(order.begin() + 1, order.end());
  return order;
}

/// Around the middle of the attachments, seen from above.
Order angular(const Plan& plan) {
  const std::vector<Eigen::Vector3d> arms = lever_arms(plan);
  const Eigen::Vector3d middle = std::accumulate(arms.begin(), arms.end(), Eigen::Vector3d(Eigen::Vector3d::Zero())) /
                                 static_cast<double>(arms.size());
  std::vector<std::pair<double, CarrierId>> angles;
  for (std::size_t i = 0; i < arms.size(); ++i) angles.emplace_back(heading(middle, arms[i]), plan.carriers[i].id);
  std::sort(angles.begin(), angles.end());
  Order out;
  for (const auto& [angle, id] : angles) out.push_back(id);
  return out;
}

struct Circle {
  double radius_m;
  double height_m;  ///< above `ground_m`
};

/// The first circle: as wide as the speed asks for, as high as its cables may be flat with its middle pulled aside.
Circle first_circle(const Requirements& requirements, const Scales& scales, const Bounds& bounds, double ground_m,
                    double pull) {
  const Plan& plan = requirements.given;
  const mechanics::Limits& limits = plan.limits;
  const double lowest = std::max({1e-3, bounds.altitude_min_m - ground_m, limits.length_min_m.value_or(0.0)});
  const double highest =
      std::max(lowest, std::min(bounds.altitude_max_m - ground_m, kUpright * limits.length_max_m.value_or(1e9)));
  const double cosine = std::clamp(limits.vertical_cosine_min.value_or(kFlattest), kFlattest, 0.999);
  // radius and pull together, over the height
  const double steepest = kUpright * std::sqrt(1.0 / (cosine * cosine) - 1.0) / (1.0 + pull);

  const double turning =
      kTurnAcceleration * std::min(plan.gravity_m_s2, limits.acceleration_max_m_s2.value_or(plan.gravity_m_s2));
  double radius = scales.speed_m_s * scales.speed_m_s / turning;
  if (!requirements.open.rate && limits.speed_min_m_s) radius = scales.speed_m_s / plan.cycle.rate_rad_s;
  const double height = std::clamp(std::max(kHeights * scales.length_m, radius / steepest), lowest, highest);
  if (requirements.open.rate) radius = std::max(radius, kSteepness * height);
  return {std::min(radius, steepest * height), height};
}

}  // namespace

Scales scales_of(const Requirements& requirements) {
  const Plan& plan = requirements.given;
  const mechanics::Limits& limits = plan.limits;
  const double spread = std::max(spread_of(lever_arms(plan)), 1e-3);
  Scales out;
  out.force_n = plan.load.mass_kg * plan.gravity_m_s2 / static_cast<double>(plan.carriers.size());
  const bool raises = requirements.want.objective == Objective::kGreatestSpeed || !limits.speed_min_m_s;
  const double spare = std::sqrt(plan.gravity_m_s2 * spread);
  out.speed_m_s = raises ? std::min(limits.speed_max_m_s.value_or(spare), spare) : *limits.speed_min_m_s;
  if (raises && !requirements.open.rate) out.speed_m_s = std::min(out.speed_m_s, plan.cycle.rate_rad_s * spread);
  out.speed_m_s = std::max(out.speed_m_s, 1e-3 * spare);
  out.length_m = out.speed_m_s * out.speed_m_s / plan.gravity_m_s2 + spread;
  return out;
}

Bounds bounds_of(const Requirements& requirements, const Scales& scales) {
  const Plan& plan = requirements.given;
  const Want& want = requirements.want;
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -lowest;
  for (const Eigen::Vector3d& arm : lever_arms(plan)) {
    lowest = std::min(lowest, plan.load.position_w_m.z() + arm.z());
    highest = std::max(highest, plan.load.position_w_m.z() + arm.z());
  }
  // Without a greatest length: more than enough for the sizes here, and for what is asked of height and clearance.
  const double asked =
      std::max(want.altitude_min_m.value_or(lowest) - lowest, plan.limits.clearance_min_m.value_or(0.0));
  const double reach = plan.limits.length_max_m.value_or(std::max(kMostHeights * scales.length_m, 3.0 * asked));
  const double rate = scales.speed_m_s / scales.length_m;
  return {1e-3 * rate,
          want.rate_max_rad_s.value_or(1e3 * rate),
          (kMostForces + static_cast<double>(plan.carriers.size())) * scales.force_n,
          want.altitude_min_m.value_or(lowest),
          want.altitude_max_m.value_or(highest + reach),
          reach};
}

Order order_of(const Plan& plan) {
  Order out;
  for (const Edge& edge : plan.cycle.edges) out.push_back(edge.from);
  if (plan.cycle.edges.size() == 1) out.push_back(plan.cycle.edges.front().to);
  if (out.empty())
    for (const mechanics::Carrier& carrier : plan.carriers) out.push_back(carrier.id);
  return out;
}

std::vector<Order> orders_of(const Requirements& requirements, std::uint64_t seed) {
  const Plan& plan = requirements.given;
  const std::size_t n = plan.carriers.size();
  if (!requirements.open.order || n < 3) return {order_of(plan)};
  const Order around = angular(plan);
  std::vector<Order> candidates{around};
  for (std::size_t step = 2; 2 * step < n; ++step) {  // stars, where one stroke visits all
    if (std::gcd(step, n) != 1) continue;
    Order star;
    for (std::size_t k = 0; k < n; ++k) star.push_back(around[k * step % n]);
    candidates.push_back(star);
  }
  if (n <= kAllOrdersUpTo) {
    Order order = around;
    std::sort(order.begin(), order.end());
    do candidates.push_back(order);
    while (std::next_permutation(order.begin() + 1, order.end()));
  } else {
    RandomStream stream(seed, "orders");
    for (std::size_t drawn = 0; drawn < kDrawnOrders; ++drawn) {
      Order order = around;
      for (std::size_t k = n - 1; k > 0; --k) std::swap(order[k], order[stream.next() % (k + 1)]);
      candidates.push_back(order);
    }
  }
  std::vector<Order> out;
  std::set<Order> seen;
  for (const Order& order : candidates) {
    if (!seen.insert(canonical(order)).second || least_turn(arms_in(plan, order)) < kLeastTurn) continue;
    out.push_back(order);
  }
  return out;
}

Start start_of(const Requirements& requirements, const Order& order, const Scales& scales, const Bounds& bounds,
               double pull) {
  Start out{requirements.given, requirements.open};
  Plan& plan = out.plan;
  const std::size_t n = plan.carriers.size();
  if (out.open.order || (plan.cycle.edges.empty() && n > 1)) {
    plan.cycle.edges.clear();
    const std::size_t edges = n == 2 ? 1 : n;
    for (std::size_t j = 0; j < edges; ++j) plan.cycle.edges.push_back({order[j], order[(j + 1) % n], 0.0, 0.0, 0.0});
    out.open.edges.assign(edges, {true, true, true});
    out.open.order = false;
  }

  const std::vector<Eigen::Vector3d> arms = lever_arms(plan);
  double top = -std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& arm : arms) top = std::max(top, plan.load.position_w_m.z() + arm.z());
  const auto [radius, height] = first_circle(requirements, scales, bounds, top, pull);
  if (out.open.rate)
    plan.cycle.rate_rad_s = std::clamp(scales.speed_m_s / radius, bounds.rate_min_rad_s, bounds.rate_max_rad_s);

  for (std::size_t i = 0; i < n; ++i) {
    LengthLaw& law = plan.carriers[i].law;
    OpenLaw& open = out.open.laws[i];
    if (open.kind) {
      law = n == 2 ? LengthLaw::sine({}) : LengthLaw::level(0.0);
      open = {false, true, n == 2, n == 2};
    }
    if (open.mean) law.profile.mean = law.kind == LengthLaw::Kind::kLevel ? top + height : height;
    if (open.swing) law.profile.swing = kSteepness * height;
    if (open.phase) law.profile.phase_rad = 0.0;
  }

  const mechanics::ParticularForce particular =
      mechanics::particular_force(arms, mechanics::holding_wrench(plan.load.mass_kg, plan.gravity_m_s2));
  const std::vector<Eigen::Vector3d> in_order = arms_in(plan, order);
  const double turn = n > 2 ? std::max(least_turn(in_order), 0.2) : 1.0;
  double amplitude = radius / height * scales.force_n / turn;
  if (requirements.want.amplitude_max_n) amplitude = std::min(amplitude, 0.9 * *requirements.want.amplitude_max_n);
  for (std::size_t j = 0; j < plan.cycle.edges.size(); ++j) {
    Edge& edge = plan.cycle.edges[j];
    const OpenEdge& open = out.open.edges[j];
    if (open.phase) edge.phase_rad = n == 2 ? 0.5 * kPi : heading(in_order[j], in_order[(j + 1) % n]);
    if (open.amplitude) edge.amplitude_n = amplitude;
    if (open.offset) edge.offset_n = pull * amplitude;
  }
  return out;
}

}  // namespace gyre::design
