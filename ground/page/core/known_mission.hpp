#pragma once
// The mission that a swarm says it flies, read and certified: what there is to draw beside what moves.

#include <optional>
#include <string>
#include <vector>

#include "common/mechanics/certificate.hpp"
#include "common/mission/mission.hpp"
#include "common/protocol/messages.hpp"

namespace gyre::ground {

struct KnownMission {
  protocol::PlanNumber plan;
  mission::Mission mission;
  mechanics::Certificate certificate;
};

/// Takes as long as certifying does, for many carriers a second: not for a loop with a beat.
/// Absent: the text is no mission, which an honest coordinator does not say.
[[nodiscard]] std::optional<KnownMission> know(const protocol::MissionText& text);

/// One carrier's path over one period, W, so many points evenly in time.
[[nodiscard]] std::vector<Eigen::Vector3d> orbit_w_m(const mechanics::Plan& plan, CarrierId carrier, int points);

/// The faces of the convex hull of these points as triangles of their indices, seen from outside counter-clockwise.
/// Empty: they lie in a plane. For the few corners of a load: its cost grows with the fourth power.
[[nodiscard]] std::vector<std::uint32_t> hull_faces(const std::vector<Eigen::Vector3d>& points_m);

}  // namespace gyre::ground
