#include "common/mechanics/clearance.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "common/mechanics/load_hull.hpp"
#include "common/mechanics/segment.hpp"

namespace gyre::mechanics {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A gap at the middle of a cell, and what it is at least all over it.
struct Gap {
  double now_m, least_m;
};

/// A carrier in the middle of a cell.
struct Moment {
  const Hanging* carrier;
  TaylorVector<double> p;

  [[nodiscard]] Segment cable() const { return {carrier->attachment_w_m, p.value - carrier->attachment_w_m}; }
  [[nodiscard]] Segment place() const { return {p.value, Eigen::Vector3d::Zero()}; }
};

struct Corner {
  Eigen::Vector3d at;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  double acceleration_max = 0.0;
};

Corner moving(const Moment& m) {
  return {m.p.value, m.p.first, m.carrier->acceleration_max_m_s2};
}
Corner fixed(const Moment& m) {
  return {m.carrier->attachment_w_m};
}

/// Of two convex sets with these corners, `apart` from the closest point of the second to that of the first.
Gap gap(const Eigen::Vector3d& apart, std::initializer_list<Corner> first, std::initializer_list<Corner> second,
        double h) {
  const double distance = apart.norm();
  if (!(distance > kTouch_m)) return {0.0, 0.0};
  const Eigen::Vector3d n = apart / distance;
  Gap out{distance, kInfinity};
  for (const Corner& x : first) {
    for (const Corner& y : second) {
      // n·(x − y) − |n·(x' − y')| h − (a_x + a_y) h² / 2
      const double bound = n.dot(x.at - y.at) - std::abs(n.dot(x.velocity - y.velocity)) * h -
                           0.5 * (x.acceleration_max + y.acceleration_max) * h * h;
      out.least_m = std::min(out.least_m, bound);
    }
  }
  return out;
}

Gap less(const Gap& gap, double radii_m) {
  return {gap.now_m - radii_m, gap.least_m - radii_m};
}

Gap of_places(const Moment& i, const Moment& j, double h) {
  return gap(i.p.value - j.p.value, {moving(i)}, {moving(j)}, h);
}

Gap of_cables(const Moment& i, const Moment& j, double h) {
  return gap(closest_points(i.cable(), j.cable()).apart, {fixed(i), moving(i)}, {fixed(j), moving(j)}, h);
}

/// How far i may stray before its cable touches that of j: cable j from { p_i + s (B_i − B_j), s >= 0 }.
Gap of_stray(const Moment& i, const Moment& j, double h) {
  const Segment ray{i.p.value, i.carrier->attachment_w_m - j.carrier->attachment_w_m, kInfinity};
  return gap(closest_points(ray, j.cable()).apart, {moving(i)}, {fixed(j), moving(j)}, h);
}

Gap of_vehicle_and_cable(const Moment& i, const Moment& j, double h) {
  return less(gap(closest_points(i.place(), j.cable()).apart, {moving(i)}, {fixed(j), moving(j)}, h),
              i.carrier->radius_m);
}

Gap of_load(const Moment& i, const LoadCone& cone, double h) {
  return gap(cone.off(i.p.value - i.carrier->attachment_w_m), {moving(i)}, {fixed(i)}, h);
}

/// One thing that may come close to another.
struct Pair {
  Touch what;
  std::size_t i, j;  ///< carriers; of a cable and the load i alone counts
};

class Search {
 public:
  Search(const std::vector<Hanging>& carriers, double begin_s, double end_s, double slack, double slack_m)
      : carriers_(carriers), half_s_(0.5 * (end_s - begin_s) / kCells), slack_(slack), slack_m_(slack_m) {
    for (int c = 0; c < kCells; ++c) {
      const double middle_s = begin_s + half_s_ * (2 * c + 1);
      for (const Hanging& carrier : carriers) grid_.push_back(moment(carrier, middle_s));
      middles_s_.push_back(middle_s);
    }
  }
  void see_load(std::vector<LoadCone> cones) { cones_ = std::move(cones); }

  Approach run(const std::vector<Pair>& pairs) {
    struct Open {
      Pair pair;
      double middle_s, least_m;
    };
    std::vector<Open> open;
    for (const Pair& pair : pairs) {
      for (std::size_t c = 0; c < middles_s_.size(); ++c) {
        const Moment* at = &grid_[c * carriers_.size()];
        const Gap gap = measure(pair, at[pair.i], at[pair.j], half_s_);
        include(pair, middles_s_[c], gap.now_m);
        if (is_open(gap.least_m)) open.push_back({pair, middles_s_[c], gap.least_m});
      }
    }
    // From the most promising on, or a cell that is met first would be cut finer than it has to be.
    std::sort(open.begin(), open.end(), [](const Open& a, const Open& b) { return a.least_m < b.least_m; });
    for (const Open& cell : open) {
      if (is_open(cell.least_m)) halve(cell.pair, cell.middle_s, half_s_);
    }
    nearest_.min_m = floor_m_;
    return nearest_;
  }

 private:
  static constexpr int kCells = 64;

  static Moment moment(const Hanging& carrier, double t_s) { return {&carrier, carrier.position_w_m(t_s)}; }

  [[nodiscard]] Gap measure(const Pair& pair, const Moment& i, const Moment& j, double h) const {
    switch (pair.what) {
      case Touch::kPlaces:
        return of_places(i, j, h);
      case Touch::kCables:
        return of_cables(i, j, h);
      case Touch::kStrayingCable:
        return of_stray(i, j, h);
      case Touch::kVehicleAndCable:
        return of_vehicle_and_cable(i, j, h);
      case Touch::kVehicles:
        return less(of_places(i, j, h), i.carrier->radius_m + j.carrier->radius_m);
      case Touch::kCableAndLoad:
        return of_load(i, cones_[pair.i], h);
    }
    return {0.0, 0.0};
  }

  /// The least gap met so far says what has to be proven to be done: nothing is closer than the floor.
  void include(const Pair& pair, double t_s, double gap_m) {
    if (!(gap_m < attained_m_)) return;
    attained_m_ = gap_m;
    floor_m_ = std::max(0.0, gap_m - std::max(slack_m_, slack_ * gap_m));
    const CarrierId other = pair.what == Touch::kCableAndLoad ? 0 : carriers_[pair.j].id;
    nearest_ = {0.0, pair.what, carriers_[pair.i].id, other, t_s};
  }

  /// Where something touches there is nothing left to find.
  [[nodiscard]] bool is_open(double least_m) const { return floor_m_ > 0.0 && least_m < floor_m_; }

  void halve(const Pair& pair, double middle_s, double h) {
    h *= 0.5;
    for (const double t_s : {middle_s - h, middle_s + h}) {
      const Gap gap = measure(pair, moment(carriers_[pair.i], t_s), moment(carriers_[pair.j], t_s), h);
      include(pair, t_s, gap.now_m);
      if (is_open(gap.least_m)) halve(pair, t_s, h);
    }
  }

  const std::vector<Hanging>& carriers_;
  double half_s_, slack_, slack_m_;
  std::vector<double> middles_s_;
  std::vector<Moment> grid_;  // cell by cell, carrier by carrier
  std::vector<LoadCone> cones_;
  double attained_m_ = kInfinity;
  double floor_m_ = kInfinity;
  Approach nearest_;
};

/// Accelerations and altitudes are of this world.
bool bounded(const std::vector<Hanging>& carriers) {
  return std::all_of(carriers.begin(), carriers.end(),
                     [](const Hanging& carrier) { return std::isfinite(carrier.acceleration_max_m_s2); });
}

void add_pairs(std::vector<Pair>& pairs, Touch what, std::size_t n) {
  const bool ordered = what == Touch::kStrayingCable || what == Touch::kVehicleAndCable;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = ordered ? 0 : i + 1; j < n; ++j) {
      if (i != j) pairs.push_back({what, i, j});
    }
  }
}

std::optional<Approach> nearest(Touch what, const std::vector<Hanging>& carriers, double begin_s, double end_s,
                                double slack, double slack_m) {
  if (carriers.size() < 2 || !bounded(carriers)) return std::nullopt;
  std::vector<Pair> pairs;
  add_pairs(pairs, what, carriers.size());
  return Search(carriers, begin_s, end_s, slack, slack_m).run(pairs);
}

}  // namespace

std::optional<Approach> separation(const std::vector<Hanging>& carriers, double begin_s, double end_s) {
  constexpr double kRounding = 1e-9;  // at kilometres
  return nearest(Touch::kPlaces, carriers, begin_s, end_s, kRounding, kSeparationSlack_m);
}

std::optional<Approach> cable_distance(const std::vector<Hanging>& carriers, double begin_s, double end_s) {
  return nearest(Touch::kCables, carriers, begin_s, end_s, kClearanceSlack, kTouch_m);
}

std::optional<Approach> clearance(const std::vector<Hanging>& carriers, const std::vector<Eigen::Vector3d>& hull_w_m,
                                  double begin_s, double end_s) {
  if (!bounded(carriers)) return std::nullopt;
  Search search(carriers, begin_s, end_s, kClearanceSlack, kTouch_m);
  std::vector<Pair> pairs;
  if (!hull_w_m.empty()) {
    std::vector<LoadCone> cones;
    for (std::size_t i = 0; i < carriers.size(); ++i) {
      auto cone = LoadCone::seen_from(carriers[i].attachment_w_m, hull_w_m);
      if (!cone) return Approach{0.0, Touch::kCableAndLoad, carriers[i].id, 0, begin_s};
      cones.push_back(std::move(*cone));
      pairs.push_back({Touch::kCableAndLoad, i, i});
    }
    search.see_load(std::move(cones));
  }
  add_pairs(pairs, Touch::kStrayingCable, carriers.size());
  const auto has_radius = [](const Hanging& carrier) { return carrier.radius_m > 0.0; };
  if (std::any_of(carriers.begin(), carriers.end(), has_radius)) {
    add_pairs(pairs, Touch::kVehicleAndCable, carriers.size());
    add_pairs(pairs, Touch::kVehicles, carriers.size());
  }
  if (pairs.empty()) return std::nullopt;
  return search.run(pairs);
}

std::optional<double> above_load(const std::vector<Hanging>& carriers, const std::vector<Eigen::Vector3d>& hull_w_m) {
  if (hull_w_m.empty()) return std::nullopt;
  Range corners;
  Range edges;
  for (const Eigen::Vector3d& corner : hull_w_m) corners.include(corner.z());
  for (const Hanging& carrier : carriers) edges.include(carrier.altitude_min_m - carrier.radius_m);
  return edges.min - corners.max;
}

}  // namespace gyre::mechanics
