#include "common/design/demands.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/angle.hpp"
#include "common/mechanics/segment.hpp"

namespace gyre::design {
namespace {

using mechanics::Limits;
using mechanics::Plan;

/// Where nobody says how slack, how flat and how short a cable may be.
constexpr double kTensionShare = 0.05;  // of a carrier's share of the weight
constexpr double kLeastCosine = 0.2;
constexpr double kLengthShare = 1e-2;
constexpr double kClearanceShare = 1e-2;  // of a length: what must not touch keeps so far apart
constexpr double kSideShare = 0.5;        // of the clearance
constexpr int kDirections = 60;           // that are tried for a side
constexpr double kCircleSlack = 1e-7;     // of a given amplitude

Eigen::Vector3d values(const NumberVector& v) {
  return {v[0].value, v[1].value, v[2].value};
}

/// A limit far below what is usual is no measure of it.
double counted_in(double limit, double size) {
  return std::max(std::abs(limit), 0.1 * size);
}

class Collector {
 public:
  void carrier(Figure figure, bool least, const std::optional<double>& limit, double size, const char* name,
               const char* unit, int carrier = -1) {
    if (!limit) return;
    Demand demand{Kind::kCarrier, figure, least, *limit, counted_in(*limit, size), carrier, name, unit};
    all_.push_back(demand);
  }
  void other(Kind kind, bool least, double limit, double size, const char* name, const char* unit) {
    all_.push_back({kind, Figure::kCount, least, limit, counted_in(limit, size), -1, name, unit});
  }
  [[nodiscard]] std::vector<Demand> take() { return std::move(all_); }

 private:
  std::vector<Demand> all_;
};

void demand_of_vehicles(const Plan& given, const Scales& scales, Collector& out) {
  for (std::size_t i = 0; i < given.carriers.size(); ++i) {
    const mechanics::Vehicle& vehicle = given.carriers[i].vehicle;
    if (!vehicle.mass_kg) continue;
    const int who = static_cast<int>(i);
    out.carrier(Figure::kThrust, false, vehicle.thrust_max_n, scales.force_n, "thrust_max_n", "N", who);
    if (vehicle.bank_max_rad)
      out.carrier(Figure::kUprightness, true, std::cos(*vehicle.bank_max_rad), 1.0, "bank_max_deg", "", who);
  }
}

}  // namespace

std::vector<Demand> demands_of(const Plan& given, const Want& want, const Scales& scales) {
  const Limits& limits = given.limits;
  const double n = scales.force_n, m = scales.length_m, v = scales.speed_m_s;
  Collector out;
  const auto or_else = [](const std::optional<double>& limit, double otherwise) { return limit.value_or(otherwise); };
  const auto named = [](const std::optional<double>& limit, const char* name) { return limit ? name : ""; };
  out.carrier(Figure::kTension, true, or_else(limits.tension_min_n, kTensionShare * n), n,
              named(limits.tension_min_n, "tension_min_n"), "N");
  out.carrier(Figure::kTension, false, limits.tension_max_n, n, "tension_max_n", "N");
  out.carrier(Figure::kLength, true, or_else(limits.length_min_m, kLengthShare * m), m,
              named(limits.length_min_m, "length_min_m"), "m");
  out.carrier(Figure::kLength, false, limits.length_max_m, m, "length_max_m", "m");
  out.carrier(Figure::kVerticalCosine, true, or_else(limits.vertical_cosine_min, kLeastCosine), 1.0,
              named(limits.vertical_cosine_min, "vertical_cosine_min"), "");
  out.carrier(Figure::kDirectionCosine, true, kLeastCosine, 1.0, "", "");
  const auto both_ways = [&](Figure figure, const std::optional<double>& most, double size, const char* name,
                             const char* unit) {
    if (!most) return;
    out.carrier(figure, false, *most, size, name, unit);
    out.carrier(figure, true, -*most, size, name, unit);
  };
  both_ways(Figure::kWinchRate, limits.winch_rate_max_m_s, v, "winch_rate_max_m_s", "m/s");
  both_ways(Figure::kWinchRate, given.winch.rate_max_m_s, v, "winch.rate_max_m_s", "m/s");
  both_ways(Figure::kWinchAcceleration, given.winch.acceleration_max_m_s2, given.gravity_m_s2,
            "winch.acceleration_max_m_s2", "m/s^2");
  if (limits.speed_min_m_s || want.objective == Objective::kGreatestSpeed)
    out.carrier(Figure::kSpeed, true, or_else(limits.speed_min_m_s, 0.0), v, "speed_min_m_s", "m/s");
  out.carrier(Figure::kSpeed, false, limits.speed_max_m_s, v, "speed_max_m_s", "m/s");
  out.carrier(Figure::kAcceleration, false, limits.acceleration_max_m_s2, given.gravity_m_s2, "acceleration_max_m_s2",
              "m/s^2");
  out.carrier(Figure::kAltitude, true, want.altitude_min_m, m, "altitude_min_m", "m");
  out.carrier(Figure::kAltitude, false, want.altitude_max_m, m, "altitude_max_m", "m");
  demand_of_vehicles(given, scales, out);
  if (limits.separation_min_m) out.other(Kind::kSeparation, true, *limits.separation_min_m, m, "separation_min_m", "m");
  out.other(Kind::kClearance, true, or_else(limits.clearance_min_m, kClearanceShare * m), m,
            limits.clearance_min_m ? "clearance_min_m" : "cables that do not touch", "m");
  out.other(Kind::kSide, true, kSideShare * or_else(limits.clearance_min_m, kClearanceShare * m), m,
            "cables that do not braid", "m");
  if (want.amplitude_max_n) out.other(Kind::kAmplitudeMost, false, *want.amplitude_max_n, n, "amplitude_max_n", "N");
  return out.take();
}

Judge::Judge(const Plan& plan, const Unknowns& unknowns, const std::vector<Demand>& demands,
             const SampledMotion& motion)
    : plan_(plan), unknowns_(unknowns), demands_(demands), motion_(motion) {
  choose_sides();
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

double Judge::value(const Row& row, const Eigen::VectorXd& x) const {
  const Demand& demand = demands_[row.demand];
  switch (demand.kind) {
    case Kind::kCarrier:
      return motion_.moment(row.first, row.sample)[demand.figure].value;
    case Kind::kSeparation:
      return separation(row).distance_m;
    case Kind::kClearance:
      return clearance(row).distance_m;
    case Kind::kSide:
      return side(row, chosen(row)).distance_m;
    case Kind::kAmplitudeMost:
    case Kind::kAmplitudeGiven:
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
    if (demand.kind == Kind::kAmplitudeMost || demand.kind == Kind::kAmplitudeGiven) {
      for (std::size_t j = 0; j < plan_.cycle.edges.size(); ++j) look({d, j, 0, 0});
      continue;
    }
    for (std::size_t i = 0; i < n; ++i) {
      if (demand.carrier >= 0 && static_cast<std::size_t>(demand.carrier) != i) continue;
      for (std::size_t k = 0; k < motion_.samples(); ++k) {
        if (demand.kind == Kind::kCarrier) {
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
  const double slope = (demand.least ? -1.0 : 1.0) / demand.scale;
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
