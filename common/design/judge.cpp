#include "common/design/judge.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/angle.hpp"
#include "common/base/ensure.hpp"
#include "common/mechanics/segment.hpp"

namespace gyre::design {
namespace {

using mechanics::Plan;

constexpr int kDirections = 60;  // that are tried for a side

Eigen::Vector3d values(const NumberVector& v) {
  return {v[0].value, v[1].value, v[2].value};
}

}  // namespace

Judge::Judge(const Plan& plan, const Unknowns& unknowns, const std::vector<Demand>& demands,
             const SampledMotion& motion)
    : plan_(plan), unknowns_(unknowns), demands_(demands), motion_(motion) {
  choose_sides();
  const std::vector<Eigen::Vector3d> hull = mechanics::hull_w(plan.load);
  for (std::size_t i = 0; i < motion.carriers() && !hull.empty(); ++i) {
    const std::optional<mechanics::LoadCone> cone = mechanics::LoadCone::seen_from(motion.attachment_w_m(i), hull);
    GYRE_ENSURE(cone.has_value(), "a valid plan's attachments are on its load or outside");
    cones_.push_back(*cone);
  }
}

Judge::Side Judge::side(const Row& row, const Eigen::Vector3d& along) const {
  const Eigen::Vector3d places[2] = {values(motion_.moment(row.first, row.sample).position_w_m),
                                     values(motion_.moment(row.second, row.sample).position_w_m)};
  const bool second_is_higher = places[1].z() > places[0].z();
  const std::size_t low = second_is_higher ? 0 : 1;
  const Eigen::Vector3d& foot = motion_.attachment_w_m(second_is_higher ? row.second : row.first);
  const Eigen::Vector3d cable = places[1 - low] - foot;
  // y of the higher one: foot + share · cable, share = (z_low − z_foot) / cable_z
  const double share = (places[low].z() - foot.z()) / cable.z();
  const Eigen::Vector3d apart = places[low] - (foot + share * cable);
  const double sign = second_is_higher ? -1.0 : 1.0;  // from the first to the second
  const Eigen::Vector3d tilt = (along.dot(cable) / cable.z()) * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d by_low = sign * (along - tilt);
  const Eigen::Vector3d by_high = -share * by_low;
  return {sign * along.dot(apart), low == 0 ? by_low : by_high, low == 0 ? by_high : by_low};
}

void Judge::choose_sides() {
  const std::size_t n = motion_.carriers();
  sides_.assign(n * n, Eigen::Vector3d::UnitX());
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      double furthest = -std::numeric_limits<double>::infinity();
      for (int direction = 0; direction < kDirections; ++direction) {
        const double angle = kTwoPi * direction / kDirections;
        const Eigen::Vector3d along(std::cos(angle), std::sin(angle), 0.0);
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < motion_.samples() && least > furthest; ++k)
          least = std::min(least, side({0, i, j, k}, along).distance_m);
        if (least <= furthest) continue;
        furthest = least;
        sides_[i * n + j] = along;
      }
    }
  }
}

Judge::Gap Judge::separation(const Row& row) const {
  Gap gap;
  const Eigen::Vector3d apart = values(motion_.moment(row.second, row.sample).position_w_m) -
                                values(motion_.moment(row.first, row.sample).position_w_m);
  gap.distance_m = apart.norm();
  if (gap.distance_m > 0.0) gap.along = apart / gap.distance_m;
  return gap;
}

/// The least of: cable and the ray of places to which the other carrier may stray, both ways; vehicle and cable; both
/// vehicles.
Judge::Gap Judge::clearance(const Row& row) const {
  Gap least = separation(row);
  const std::size_t carriers[2] = {row.first, row.second};
  const double radii[2] = {plan_.carriers[row.first].radius_m, plan_.carriers[row.second].radius_m};
  least.distance_m -= radii[0] + radii[1];
  for (std::size_t a = 0; a < 2; ++a) {
    const std::size_t i = carriers[a];
    const std::size_t j = carriers[1 - a];
    const Eigen::Vector3d place = values(motion_.moment(i, row.sample).position_w_m);
    const Eigen::Vector3d& foot = motion_.attachment_w_m(j);
    const mechanics::Segment cable{foot, values(motion_.moment(j, row.sample).position_w_m) - foot};
    const mechanics::Segment strays{place, motion_.attachment_w_m(i) - foot, std::numeric_limits<double>::infinity()};
    const mechanics::Segment stays{place, Eigen::Vector3d::Zero()};
    for (const bool straying : {true, false}) {
      const mechanics::ClosestPoints closest = mechanics::closest_points(straying ? strays : stays, cable);
      const double distance = closest.apart.norm();
      const double net = distance - (straying ? 0.0 : radii[a]);
      if (net >= least.distance_m) continue;
      least.distance_m = net;
      if (distance > 0.0) least.along = (a == 0 ? -1.0 : 1.0) * closest.apart / distance;
      (a == 0 ? least.first_share : least.second_share) = 1.0;
      (a == 0 ? least.second_share : least.first_share) = closest.t;
    }
  }
  return least;
}

Judge::Gap Judge::off_load(const Row& row) const {
  const Eigen::Vector3d place = values(motion_.moment(row.first, row.sample).position_w_m);
  const Eigen::Vector3d off = cones_[row.first].off(place - motion_.attachment_w_m(row.first));
  Gap gap;
  gap.distance_m = off.norm();
  gap.along = gap.distance_m > 0.0 ? Eigen::Vector3d(off / gap.distance_m) : Eigen::Vector3d::UnitZ();
  return gap;
}

double Judge::value(const Row& row, const Eigen::VectorXd& x) const {
  const Demand& demand = demands_[row.demand];
  switch (demand.kind) {
    case Kind::kCarrier:
      return motion_.moment(row.first, row.sample)[demand.figure].value;
    case Kind::kSeparation:
      return separation(row).distance_m;
    case Kind::kClearance:
      return clearance(row).distance_m;
    case Kind::kLoad:
      return off_load(row).distance_m;
    case Kind::kSide:
      return side(row, chosen(row)).distance_m;
    case Kind::kAmplitude:
      break;
  }
  return std::hypot(unknowns_.edges[row.first].sine_n.at(x), unknowns_.edges[row.first].cosine_n.at(x));
}

Judge::Findings Judge::find(const Eigen::VectorXd& x, double least) const {
  Findings out;
  out.worst = -std::numeric_limits<double>::infinity();
  const auto look = [&](const Row& row) {
    double residual = demands_[row.demand].residual(value(row, x));
    if (!std::isfinite(residual)) residual = std::numeric_limits<double>::max();
    out.worst = std::max(out.worst, residual);
    if (residual > least) out.rows.push_back({row, residual});
  };
  const std::size_t n = motion_.carriers();
  for (std::size_t d = 0; d < demands_.size(); ++d) {
    const Demand& demand = demands_[d];
    const std::size_t subjects = demand.kind == Kind::kAmplitude ? plan_.cycle.edges.size() : n;
    for (std::size_t i = 0; i < subjects; ++i) {
      if (demand.who >= 0 && static_cast<std::size_t>(demand.who) != i) continue;
      if (demand.kind == Kind::kAmplitude) {
        look({d, i, 0, 0});
        continue;
      }
      for (std::size_t k = 0; k < motion_.samples(); ++k) {
        if (demand.kind == Kind::kCarrier || demand.kind == Kind::kLoad) {
          look({d, i, 0, k});
        } else {
          for (std::size_t j = i + 1; j < n; ++j) look({d, i, j, k});
        }
      }
    }
  }
  return out;
}

double Judge::residual(const Row& row, const Eigen::VectorXd& x, Eigen::Ref<Eigen::VectorXd> gradient) const {
  const Demand& demand = demands_[row.demand];
  const double slope = demand.slope();
  gradient.setZero();
  if (demand.kind == Kind::kCarrier) {
    const Number& figure = motion_.moment(row.first, row.sample)[demand.figure];
    motion_.scatter(row.first, figure.slope, slope, gradient);
    return demand.residual(figure.value);
  }
  const auto pull = [&](std::size_t carrier, const Eigen::Vector3d& by) {
    const NumberVector& place = motion_.moment(carrier, row.sample).position_w_m;
    for (int axis = 0; axis < 3; ++axis) motion_.scatter(carrier, place[axis].slope, slope * by[axis], gradient);
  };
  if (demand.kind == Kind::kLoad) {
    const Gap gap = off_load(row);
    pull(row.first, gap.along);
    return demand.residual(gap.distance_m);
  }
  if (demand.kind == Kind::kSide) {
    const Side apart = side(row, chosen(row));
    pull(row.first, apart.by_first);
    pull(row.second, apart.by_second);
    return demand.residual(apart.distance_m);
  }
  if (demand.kind == Kind::kSeparation || demand.kind == Kind::kClearance) {
    const Gap gap = demand.kind == Kind::kSeparation ? separation(row) : clearance(row);
    pull(row.first, -gap.first_share * gap.along);
    pull(row.second, gap.second_share * gap.along);
    return demand.residual(gap.distance_m);
  }
  const EdgeSlots& edge = unknowns_.edges[row.first];
  const double sine = edge.sine_n.at(x);
  const double cosine = edge.cosine_n.at(x);
  const double amplitude = std::hypot(sine, cosine);
  for (const auto& [slot, value] : {std::pair{edge.sine_n, sine}, std::pair{edge.cosine_n, cosine}}) {
    if (slot.index >= 0 && amplitude > 0.0) gradient[slot.index] += slope * slot.factor * value / amplitude;
  }
  return demand.residual(amplitude);
}

}  // namespace gyre::design
