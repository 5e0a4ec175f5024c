#include "ground/plot/core/view.hpp"

#include <algorithm>

namespace gyre::ground {
namespace {

using mechanics::Range;

constexpr double kGap = 32.0, kLeft = 44.0, kTop = 26.0;  // between frames; what axes and titles need
constexpr double kLeastHeight = 190.0, kMostHeight = 410.0;
constexpr double kRim = 30.0;                            // inside a frame, for labels
constexpr double kPoint_m = 1e-6, kPointOfPlace = 1e-9;  // what extends less is a point

/// The ground is in the picture where it is near: else it would make everything else small. Where the load's own place
/// is not above it, altitudes count from elsewhere.
Range with_ground(Range altitude) {
  constexpr double kNear = 0.35;
  if (altitude.min > 0.0 && altitude.min < kNear * altitude.span()) altitude.include(0.0);
  return altitude;
}

/// A range as wide as so many px are, about the middle of another.
Scale centred(const Range& range, double px_per_m, double at_min, double at_max) {
  const double middle = 0.5 * (range.min + range.max);
  const double half = 0.5 * std::abs(at_max - at_min) / px_per_m;
  return {{middle - half, middle + half}, at_min, at_max};
}

double cross(const Point& o, const Point& a, const Point& b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

}  // namespace

void Extents::include(const Eigen::Vector3d& place_w_m, double radius_m) {
  const auto widen = [radius_m](Range& range, double place) { range.include({place - radius_m, place + radius_m}); };
  widen(x, place_w_m.x());
  widen(y, place_w_m.y());
  widen(z, place_w_m.z());
}

void Extents::include(const Extents& other) {
  x.include(other.x);
  y.include(other.y);
  z.include(other.z);
}

Extents extents(const Motion& motion) {
  Extents out;
  out.include(motion.load_position_w_m);
  for (const Eigen::Vector3d& corner : motion.load_w_m) out.include(corner);
  for (const CarrierPath& path : motion.carriers) {
    out.include(path.attachment_w_m);
    for (const Moment& moment : path.moments) out.include(moment.position_w_m, path.radius_m);
  }
  return out;
}

Frames frames(const Extents& extents, Point top_left, double width) {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(), z = Eigen::Vector3d::UnitZ();
  const View above{"From above", "x", "y", x, y};
  const Range& across_x = extents.x;
  const Range& across_y = extents.y;
  const View side = across_x.span() >= across_y.span() ? View{"From the side, along +y", "x", "altitude", x, z}
                                                       : View{"From the side, along \u2212x", "y", "altitude", y, z};
  const Range across = across_x.span() >= across_y.span() ? across_x : across_y;
  const Range altitude = with_ground(extents.z);

  const double plot_width = 0.5 * (width - kGap) - kLeft;
  double wide = across.span(), high = std::max(across_y.span(), altitude.span());
  for (const Range& range : {across_x, across_y, altitude}) {
    const double point = std::max(kPoint_m, kPointOfPlace * std::max(std::abs(range.min), std::abs(range.max)));
    wide = std::max(wide, point);
    high = std::max(high, point);
  }
  const double px_per_m = std::min((plot_width - 2.0 * kRim) / wide, (kMostHeight - 2.0 * kRim) / high);
  const double height = std::clamp(px_per_m * high + 2.0 * kRim, kLeastHeight, kMostHeight);

  const auto frame = [&](const View& view, double left, const Range& right, const Range& up) {
    const Box plot{left + kLeft, top_left.y + kTop, left + kLeft + plot_width, top_left.y + kTop + height};
    return Frame{view, plot, centred(right, px_per_m, plot.left, plot.right),
                 centred(up, px_per_m, plot.bottom, plot.top)};
  };
  Frames out{frame(above, top_left.x, across_x, across_y),
             frame(side, top_left.x + kLeft + plot_width + kGap, across, altitude)};
  out.side.shows_ground = extents.z.min > 0.0 && out.side.up.shown.min < 0.0;
  return out;
}

std::vector<Point> hull_of(std::vector<Point> points) {
  std::sort(points.begin(), points.end(),
            [](const Point& a, const Point& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  if (points.size() < 3) return points;
  // Andrew's chain: along the one side, and back along the other
  std::vector<Point> out;
  for (int side = 0; side < 2; ++side) {
    const std::size_t begin = out.size();
    for (const Point& point : points) {
      while (out.size() >= begin + 2 && cross(out[out.size() - 2], out.back(), point) <= 0.0) out.pop_back();
      out.push_back(point);
    }
    out.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return out;
}

}  // namespace gyre::ground
