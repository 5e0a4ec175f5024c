#include "common/design/demands.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/angle.hpp"
#include "common/mechanics/clearance.hpp"
#include "common/mechanics/load_hull.hpp"

namespace gyre::design {
namespace {

using mechanics::Plan;

/// Where nobody says how slack, how flat and how short a cable may be.
constexpr double kTensionShare = 0.05;  // of a carrier's share of the weight
constexpr double kLeastCosine = 0.2;
constexpr double kLengthShare = 1e-2;
constexpr double kClearanceShare = 1e-2;  // of a length: what must not touch keeps so far apart
constexpr double kSideShare = 0.5;        // of the clearance
constexpr double kCircleWidth = 5e-3;     // of a given amplitude whose phase is open; the certificate's is exact

/// A limit far below what is usual is no measure of it.
double counted_in(double limit, double size) {
  return std::max(std::abs(limit), 0.1 * size);
}

class Collector {
 public:
  Collector(const Requirements& requirements, const Scales& scales)
      : given_(requirements.given),
        limits_(given_.limits),
        want_(requirements.want),
        open_(requirements.open),
        scales_(scales) {}

  std::vector<Demand> collect() {
    const double weight = scales_.force_n;
    const double size = scales_.length_m;
    least_or(Figure::kTension, limits_.tension_min_n, kTensionShare * weight, weight, "tension_min_n", "N");
    most(Figure::kTension, limits_.tension_max_n, weight, "tension_max_n", "N");
    least_or(Figure::kPaidOut, limits_.length_min_m, kLengthShare * size, size, "length_min_m", "m");
    most(Figure::kLength, limits_.length_max_m, size, "length_max_m", "m");
    least_or(Figure::kVerticalCosine, limits_.vertical_cosine_min, kLeastCosine, 1.0, "vertical_cosine_min", "");
    least_or(Figure::kDirectionCosine, std::nullopt, kLeastCosine, 1.0, "", "");
    both_ways(Figure::kWinchRate, limits_.winch_rate_max_m_s, scales_.speed_m_s, "winch_rate_max_m_s", "m/s");
    both_ways(Figure::kPaidOutRate, given_.winch.rate_max_m_s, scales_.speed_m_s, "winch.rate_max_m_s", "m/s");
    both_ways(Figure::kPaidOutAcceleration, given_.winch.acceleration_max_m_s2, given_.gravity_m_s2,
              "winch.acceleration_max_m_s2", "m/s^2");
    motion();
    most(Figure::kAltitude, want_.altitude_max_m, size, "altitude_max_m", "m");
    if (want_.altitude_min_m) least_or(Figure::kAltitude, want_.altitude_min_m, 0.0, size, "altitude_min_m", "m");
    vehicles();
    distances();
    amplitudes();
    return std::move(all_);
  }

 private:
  void motion() {
    const double speed = scales_.speed_m_s;
    if (limits_.speed_min_m_s || want_.objective == Objective::kGreatestSpeed)
      least_or(Figure::kSpeed, limits_.speed_min_m_s, 0.0, speed, "speed_min_m_s", "m/s");
    most(Figure::kSpeed, limits_.speed_max_m_s, speed, "speed_max_m_s", "m/s");
    most(Figure::kAcceleration, limits_.acceleration_max_m_s2, given_.gravity_m_s2, "acceleration_max_m_s2", "m/s^2");
  }

  void vehicles() {
    for (std::size_t i = 0; i < given_.carriers.size(); ++i) {
      const mechanics::Vehicle& vehicle = given_.carriers[i].vehicle;
      if (!vehicle.mass_kg) continue;
      const std::size_t before = all_.size();
      for (const Figure thrust : {Figure::kThrust, Figure::kThrustAtRest})
        most(thrust, vehicle.thrust_max_n, scales_.force_n, "thrust_max_n", "N");
      if (vehicle.bank_max_rad) {
        for (const Figure uprightness : {Figure::kUprightness, Figure::kUprightnessAtRest})
          least_or(uprightness, std::cos(*vehicle.bank_max_rad), 0.0, 1.0, "bank_max_deg", "deg");
      }
      for (std::size_t d = before; d < all_.size(); ++d) all_[d].who = static_cast<int>(i);
    }
  }

  void distances() {
    const double size = scales_.length_m;
    if (limits_.separation_min_m)
      add({Kind::kSeparation, Figure::kCount, true, *limits_.separation_min_m, size, -1, "separation_min_m", "m"});
    const bool asked = limits_.clearance_min_m.has_value();
    const double clearance = limits_.clearance_min_m.value_or(kClearanceShare * size);
    const char* name = asked ? "clearance_min_m" : "nothing touches, clearance";
    const auto apart = [&](Kind kind, double limit, const char* of, Origin origin) {
      add({kind, Figure::kCount, true, limit, size, -1, of, "m", origin, 1.0 - mechanics::kClearanceSlack});
    };
    apart(Kind::kClearance, clearance, name, asked ? Origin::kAsked : Origin::kAlways);
    apart(Kind::kSide, kSideShare * clearance, "no cables braid, apart by", Origin::kAlways);
    if (given_.load.hull_b_m.empty()) return;
    apart(Kind::kLoad, clearance, name, asked ? Origin::kAsked : Origin::kAlways);
    double top = -std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3d& corner : mechanics::hull_w(given_.load)) top = std::max(top, corner.z());
    for (std::size_t i = 0; i < given_.carriers.size(); ++i) {
      const double altitude = top + given_.carriers[i].radius_m + clearance;
      add({Kind::kCarrier, Figure::kAltitude, true, altitude, size, static_cast<int>(i), "vehicles above the load, at",
           "m", Origin::kAlways});
    }
  }

  void amplitudes() {
    if (want_.amplitude_max_n)
      add({Kind::kAmplitude, Figure::kCount, false, *want_.amplitude_max_n, scales_.force_n, -1, "amplitude_max_n",
           "N"});
    for (std::size_t j = 0; j < open_.edges.size(); ++j) {
      if (open_.edges[j].amplitude || !open_.edges[j].phase) continue;
      const double given = std::abs(given_.cycle.edges[j].amplitude_n);
      for (const bool least : {false, true}) {
        const double limit = given * (1.0 + (least ? -kCircleWidth : kCircleWidth));
        add({Kind::kAmplitude, Figure::kCount, least, limit, scales_.force_n, static_cast<int>(j), "amplitude_n", "N",
             Origin::kNecessary});
      }
    }
  }

  /// `scale` is a usual size here; the limit's own counts if it is greater.
  void add(Demand demand) {
    demand.scale = counted_in(demand.limit, demand.scale);
    all_.push_back(std::move(demand));
  }
  void most(Figure figure, const std::optional<double>& limit, double size, const char* name, const char* unit) {
    if (limit) add({Kind::kCarrier, figure, false, *limit, size, -1, name, unit});
  }
  void least_or(Figure figure, const std::optional<double>& limit, double otherwise, double size, const char* name,
                const char* unit) {
    add({Kind::kCarrier, figure, true, limit.value_or(otherwise), size, -1, name, unit,
         limit ? Origin::kAsked : Origin::kNecessary});
  }
  void both_ways(Figure figure, const std::optional<double>& limit, double size, const char* name, const char* unit) {
    if (!limit) return;
    most(figure, limit, size, name, unit);
    least_or(figure, -*limit, 0.0, size, name, unit);
  }

  const Plan& given_;
  const mechanics::Limits& limits_;
  const Want& want_;
  const Open& open_;
  const Scales& scales_;
  std::vector<Demand> all_;
};

}  // namespace

std::vector<Demand> demands_of(const Requirements& requirements, const Scales& scales) {
  return Collector(requirements, scales).collect();
}

bool is_angle(const Demand& demand) {
  return demand.figure == Figure::kUprightness || demand.figure == Figure::kUprightnessAtRest;
}

double shown_limit(const Demand& demand) {
  if (is_angle(demand)) return degrees(std::acos(demand.limit));
  return std::abs(demand.limit);
}

}  // namespace gyre::design
