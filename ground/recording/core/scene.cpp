#include "ground/recording/core/scene.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "common/mechanics/reference.hpp"

namespace gyre::ground {
namespace {

constexpr Colour kGrey{0.55F, 0.55F, 0.58F, 1.0F};
constexpr Colour kDark{0.15F, 0.18F, 0.22F, 1.0F};
constexpr Colour kPale{0.45F, 0.6F, 0.8F, 0.5F};
constexpr double kCarrierSize_m = 0.12;  // of one whose radius nobody told

Colour between_blue_and_red(double share) {
  const auto warm = static_cast<float>(std::clamp(share, 0.0, 1.0));
  return {0.1F + 0.85F * warm, 0.35F + 0.1F * warm * (1.0F - warm), 0.9F - 0.8F * warm, 1.0F};
}

struct TensionScale {
  double least_n = 0.0;
  double greatest_n = 1.0;

  [[nodiscard]] Colour colour(double tension_n) const {
    const double width = greatest_n - least_n;
    return between_blue_and_red(width > 0.0 ? (tension_n - least_n) / width : 0.0);
  }
};

TensionScale tension_scale(const SwarmView& view, const mission::Mission* mission) {
  TensionScale scale{0.0, 0.0};
  for (const auto& [id, carrier] : view.carriers()) {
    if (carrier.vehicle) scale.greatest_n = std::max(scale.greatest_n, carrier.vehicle->tension_n);
  }
  if (mission) {
    scale.least_n = mission->plan.limits.tension_min_n.value_or(scale.least_n);
    scale.greatest_n = mission->plan.limits.tension_max_n.value_or(scale.greatest_n);
  }
  return scale;
}

Pose pose_of(const protocol::LoadState& load) {
  return {load.position_w_m, load.orientation_w_b};
}

/// Of the plan that is flown; where the carrier does not hold it, or nobody leads, of its newest.
const mechanics::CarrierSlice* slice_of(const SwarmView& view, const CarrierView& carrier) {
  if (carrier.slices.empty()) return nullptr;
  if (view.beacon()) {
    const auto flown = carrier.slices.find(view.beacon()->course.base.number);
    if (flown != carrier.slices.end()) return &flown->second;
  }
  return &carrier.slices.rbegin()->second;
}

std::optional<Eigen::Vector3d> attachment_w_m(const std::optional<Pose>& load, const mechanics::Carrier* known,
                                              const mechanics::CarrierSlice* slice) {
  if (known && load) return load->position_m + load->orientation * known->attachment_b_m;
  if (slice) return slice->attachment_w_m;
  return std::nullopt;
}

/// A box about the load's hull; where no shape is told, a small ball.
Marker load_marker(const Pose& load, const mission::Mission* mission) {
  Marker marker;
  marker.name = "load";
  marker.pose = load;
  marker.colour = kGrey;
  marker.shape = MarkerShape::kSphere;
  marker.size_m = Eigen::Vector3d::Constant(2.0 * kCarrierSize_m);
  if (!mission || mission->plan.load.hull_b_m.empty()) return marker;
  Eigen::Vector3d least = mission->plan.load.hull_b_m.front();
  Eigen::Vector3d greatest = least;
  for (const Eigen::Vector3d& corner : mission->plan.load.hull_b_m) {
    least = least.cwiseMin(corner);
    greatest = greatest.cwiseMax(corner);
  }
  marker.shape = MarkerShape::kCube;
  marker.size_m = greatest - least;
  marker.pose.position_m += load.orientation * (0.5 * (least + greatest));
  return marker;
}

}  // namespace

Scene scene(const SwarmView& view, const mission::Mission* mission) {
  Scene scene;
  if (view.load()) {
    scene.load = pose_of(*view.load());
    scene.frames.push_back({"load", *scene.load});
    scene.markers.push_back(load_marker(*scene.load, mission));
  }
  const TensionScale scale = tension_scale(view, mission);
  Marker cables;
  cables.name = "cables";
  cables.shape = MarkerShape::kLineList;
  cables.size_m = {0.015, 0.0, 0.0};
  for (const auto& [id, carrier] : view.carriers()) {
    if (!carrier.vehicle) continue;
    const Eigen::Vector3d place = carrier.vehicle->position_w_m;
    scene.frames.push_back({"carrier_" + std::to_string(id), {place, Eigen::Quaterniond::Identity()}});
    const mechanics::Carrier* const known = mission ? mechanics::find(mission->plan, id) : nullptr;
    Marker body;
    body.name = "carriers";
    body.number = static_cast<std::int32_t>(id);
    body.shape = MarkerShape::kSphere;
    body.pose.position_m = place;
    body.size_m.setConstant(known && known->radius_m > 0.0 ? 2.0 * known->radius_m : kCarrierSize_m);
    body.colour = kDark;
    scene.markers.push_back(body);
    if (const auto end = attachment_w_m(scene.load, known, slice_of(view, carrier))) {
      const Colour colour = scale.colour(carrier.vehicle->tension_n);
      cables.points_m.insert(cables.points_m.end(), {*end, place});
      cables.colours.insert(cables.colours.end(), {colour, colour});
    }
  }
  if (!cables.points_m.empty()) scene.markers.push_back(std::move(cables));
  return scene;
}

std::vector<Marker> planned_orbits(const SwarmView& view) {
  constexpr int kPoints = 96;
  std::vector<Marker> orbits;
  for (const auto& [id, carrier] : view.carriers()) {
    const mechanics::CarrierSlice* const slice = slice_of(view, carrier);
    if (!slice || !(slice->rate_rad_s > 0.0)) continue;
    // A law of another frequency closes after as many rounds as its denominator says.
    const int rounds = std::max(1, slice->law.profile.harmonic.denominator);
    const double period_s = 2.0 * M_PI / slice->rate_rad_s * rounds;
    Marker orbit;
    orbit.name = "orbits";
    orbit.number = static_cast<std::int32_t>(id);
    orbit.shape = MarkerShape::kLineStrip;
    orbit.size_m = {0.008, 0.0, 0.0};
    orbit.colour = kPale;
    for (int i = 0; i <= kPoints; ++i) {
      const Eigen::Vector3d point = mechanics::evaluate(*slice, period_s * i / kPoints).position_w_m.value;
      if (point.allFinite()) orbit.points_m.push_back(point);
    }
    if (orbit.points_m.size() > 1) orbits.push_back(std::move(orbit));
  }
  return orbits;
}

}  // namespace gyre::ground
