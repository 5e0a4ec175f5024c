#include "common/mechanics/plan.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/base/angle.hpp"

namespace gyre::mechanics {

LengthLaw LengthLaw::level(double altitude_m) {
  return {Kind::kLevel, Eigen::Vector3d::UnitZ(), Oscillation{altitude_m, 0.0, {}, 0.0}};
}

LengthLaw LengthLaw::directional(const Eigen::Vector3d& direction, const Oscillation& profile_m) {
  return {Kind::kDirectional, direction.normalized(), profile_m};
}

LengthLaw LengthLaw::sine(const Oscillation& length_m) {
  return {Kind::kSine, Eigen::Vector3d::UnitZ(), length_m};
}

LengthLaw LengthLaw::fixed(double length_m) {
  return {Kind::kFixed, Eigen::Vector3d::UnitZ(), Oscillation{length_m, 0.0, {}, 0.0}};
}

const char* name(LengthLaw::Kind kind) {
  switch (kind) {
    case LengthLaw::Kind::kLevel:
      return "level";
    case LengthLaw::Kind::kDirectional:
      return "directional";
    case LengthLaw::Kind::kSine:
      return "sine";
    case LengthLaw::Kind::kFixed:
      return "fixed";
  }
  return "unknown";
}

std::vector<Eigen::Vector3d> box_hull(const Eigen::Vector3d& half_edges_m, const Eigen::Vector3d& centre_b_m) {
  std::vector<Eigen::Vector3d> corners;
  corners.reserve(8);
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      for (const double z : {-1.0, 1.0})
        corners.emplace_back(centre_b_m + Eigen::Vector3d(x, y, z).cwiseProduct(half_edges_m));
    }
  }
  return corners;
}

const Carrier* find(const Plan& plan, CarrierId id) {
  const auto found =
      std::find_if(plan.carriers.begin(), plan.carriers.end(), [id](const Carrier& c) { return c.id == id; });
  return found == plan.carriers.end() ? nullptr : &*found;
}

std::vector<Eigen::Vector3d> lever_arms(const Plan& plan) {
  const Eigen::Matrix3d rotation = plan.load.orientation_w_b.toRotationMatrix();
  std::vector<Eigen::Vector3d> arms;
  arms.reserve(plan.carriers.size());
  for (const Carrier& carrier : plan.carriers) arms.emplace_back(rotation * carrier.attachment_b_m);
  return arms;
}

double period_s(const Plan& plan) {
  int turns = 1;
  for (const Carrier& carrier : plan.carriers) {
    if (!carrier.law.profile.constant()) turns = std::lcm(turns, carrier.law.profile.harmonic.denominator);
  }
  return turns * kTwoPi / plan.cycle.rate_rad_s;
}

}  // namespace gyre::mechanics
