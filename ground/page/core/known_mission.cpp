#include "ground/page/core/known_mission.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "common/mechanics/reference.hpp"
#include "common/mechanics/transition.hpp"

namespace gyre::ground {
namespace {

constexpr double kFlat_m = 1e-9;      ///< as high above a face is in it
constexpr double kSliver_m2 = 1e-12;  ///< so large a triangle is none

/// The corners of one face in order around it, counter-clockwise as `outwards` sees it (Andrew's monotone chain): what
/// lies on an edge or inside the face is no corner.
std::vector<std::uint32_t> around(const std::vector<Eigen::Vector3d>& points, const std::vector<std::uint32_t>& face,
                                  const Eigen::Vector3d& outwards) {
  const Eigen::Vector3d x = outwards.unitOrthogonal(), y = outwards.cross(x);
  const auto flat = [&](std::uint32_t i) { return Eigen::Vector2d(points[i].dot(x), points[i].dot(y)); };
  std::vector<std::uint32_t> sorted = face;
  std::sort(sorted.begin(), sorted.end(), [&](std::uint32_t a, std::uint32_t b) {
    const Eigen::Vector2d p = flat(a), q = flat(b);
    return p.x() != q.x() ? p.x() < q.x() : p.y() < q.y();
  });
  std::vector<std::uint32_t> ring;
  const auto add = [&](std::uint32_t next, std::size_t least) {
    while (ring.size() >= least + 2) {
      const Eigen::Vector2d a = flat(ring[ring.size() - 2]), b = flat(ring.back()), c = flat(next);
      if ((b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x()) > kSliver_m2) break;
      ring.pop_back();
    }
    ring.push_back(next);
  };
  for (const std::uint32_t i : sorted) add(i, 0);
  const std::size_t below = ring.size() - 1;  // and back along the other side
  for (auto i = std::next(sorted.rbegin()); i != sorted.rend(); ++i) add(*i, below);
  ring.pop_back();  // it began there
  return ring;
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
        if (normal.norm() < kSliver_m2) continue;
        normal.normalize();
        // All on one side: the plane through these three carries a face, and so do others that lie in it.
        double least = 0.0, most = 0.0;
        std::vector<std::uint32_t> face;
        for (std::uint32_t m = 0; m < n; ++m) {
          const double height = normal.dot(points_m[m] - points_m[i]);
          least = std::min(least, height);
          most = std::max(most, height);
          if (std::abs(height) < kFlat_m) face.push_back(m);
        }
        const bool inside_below = most < kFlat_m;
        const bool inside_above = -least < kFlat_m;
        if (inside_below == inside_above || !known.insert(face).second) continue;
        const auto ring = around(points_m, face, inside_below ? normal : Eigen::Vector3d(-normal));
        for (std::size_t c = 2; c < ring.size(); ++c)
          triangles.insert(triangles.end(), {ring[0], ring[c - 1], ring[c]});
      }
    }
  }
  return triangles;
}

}  // namespace gyre::ground
