#include "ground/page/core/known_mission.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "common/mechanics/reference.hpp"
#include "common/mechanics/transition.hpp"

namespace gyre::ground {
namespace {

/// Corners of one face in order around it, as a fan of triangles.
void add_face(const std::vector<Eigen::Vector3d>& points, std::vector<std::uint32_t> corners,
              const Eigen::Vector3d& outwards, std::vector<std::uint32_t>& triangles) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const std::uint32_t i : corners) centre += points[i] / static_cast<double>(corners.size());
  const Eigen::Vector3d x = (points[corners.front()] - centre).normalized();
  const Eigen::Vector3d y = outwards.cross(x);
  const auto angle = [&](std::uint32_t i) {
    const Eigen::Vector3d arm = points[i] - centre;
    return std::atan2(arm.dot(y), arm.dot(x));
  };
  std::sort(corners.begin(), corners.end(), [&](std::uint32_t a, std::uint32_t b) { return angle(a) < angle(b); });
  for (std::size_t i = 2; i < corners.size(); ++i) {
    triangles.insert(triangles.end(), {corners[0], corners[i - 1], corners[i]});
  }
}

}  // namespace

std::optional<KnownMission> know(const protocol::MissionText& text) {
  auto mission = mission::parse_mission(text.text, "the swarm's mission");
  if (!mission) return std::nullopt;
  mechanics::Certificate certificate = mechanics::certify(mission.value().plan);
  return KnownMission{text.plan, std::move(mission).value(), std::move(certificate)};
}

std::vector<Eigen::Vector3d> orbit_w_m(const mechanics::Plan& plan, CarrierId carrier, int points) {
  std::vector<Eigen::Vector3d> orbit;
  const double period_s = mechanics::period_s(plan);
  for (const mechanics::CarrierSlice& slice : mechanics::slices(plan)) {
    if (slice.id != carrier) continue;
    for (int k = 0; k < points; ++k) {
      orbit.push_back(mechanics::evaluate(slice, period_s * k / points).position_w_m.value);
    }
  }
  return orbit;
}

std::vector<std::uint32_t> hull_faces(const std::vector<Eigen::Vector3d>& points_m) {
  const auto n = static_cast<std::uint32_t>(points_m.size());
  std::vector<std::uint32_t> triangles;
  std::set<std::vector<std::uint32_t>> known;
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = i + 1; j < n; ++j) {
      for (std::uint32_t k = j + 1; k < n; ++k) {
        Eigen::Vector3d normal = (points_m[j] - points_m[i]).cross(points_m[k] - points_m[i]);
        if (normal.norm() < 1e-12) continue;
        normal.normalize();
        // All on one side: the plane through these three carries a face, and so do others that lie in it.
        double least = 0.0, most = 0.0;
        std::vector<std::uint32_t> face;
        for (std::uint32_t m = 0; m < n; ++m) {
          const double height = normal.dot(points_m[m] - points_m[i]);
          least = std::min(least, height);
          most = std::max(most, height);
          if (std::abs(height) < 1e-9) face.push_back(m);
        }
        const bool inside_below = most<1e-9, inside_above = least> - 1e-9;
        if (inside_below == inside_above || !known.insert(face).second) continue;
        add_face(points_m, face, inside_below ? normal : Eigen::Vector3d(-normal), triangles);
      }
    }
  }
  return triangles;
}

}  // namespace gyre::ground
