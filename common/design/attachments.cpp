#include "common/design/attachments.hpp"

#include <cmath>

#include "common/base/angle.hpp"
#include "common/base/ensure.hpp"
#include "common/mechanics/range.hpp"

namespace gyre::design {
namespace {

constexpr double kShares[] = {1.0, 0.75};
constexpr double kLevel = 1e-3;  // corners so little below the highest belong to the upper face, in heights of the load

struct Face {
  mechanics::Range x, y;
  double z = 0.0;
};

Face upper_face(const std::vector<Eigen::Vector3d>& hull_b_m) {
  mechanics::Range height;
  for (const Eigen::Vector3d& corner : hull_b_m) height.include(corner.z());
  Face out;
  out.z = height.max;
  for (const Eigen::Vector3d& corner : hull_b_m) {
    if (corner.z() < height.max - kLevel * (height.max - height.min)) continue;
    out.x.include(corner.x());
    out.y.include(corner.y());
  }
  return out;
}

}  // namespace

std::vector<Requirements> attached(const Requirements& requirements) {
  if (!requirements.open.attachments) return {requirements};
  GYRE_ENSURE(!requirements.given.load.hull_b_m.empty(), "a load without attachments has a shape");
  const Face face = upper_face(requirements.given.load.hull_b_m);
  const double step = kTwoPi / static_cast<double>(requirements.given.carriers.size());
  std::vector<Requirements> out;
  for (const double share : kShares) {
    for (const double turn : {0.0, 0.5}) {
      Requirements placed = requirements;
      placed.open.attachments = false;
      for (std::size_t i = 0; i < placed.given.carriers.size(); ++i) {
        const double angle = step * (static_cast<double>(i) + turn);
        placed.given.carriers[i].attachment_b_m = {
            0.5 * (face.x.min + face.x.max + share * (face.x.max - face.x.min) * std::cos(angle)),
            0.5 * (face.y.min + face.y.max + share * (face.y.max - face.y.min) * std::sin(angle)), face.z};
      }
      out.push_back(std::move(placed));
    }
  }
  return out;
}

}  // namespace gyre::design
