#pragma once
// The fields of every message by name, in the order of their declaration: for whoever has to go through all of them
// without knowing which there are, to compare, to print, to fill.
//
// A struct that gains a field has to name it here: tests/protocol/fields_test holds that all are named.

#include <tuple>

#include "common/protocol/messages.hpp"

namespace gyre::protocol {

template <class Struct, class Type>
struct Field {
  const char* name;
  Type Struct::*member;
};
template <class Struct, class Type>
Field(const char*, Type Struct::*) -> Field<Struct, Type>;

[[nodiscard]] constexpr auto fields(const PlanNumber* /*of*/) {
  using M = PlanNumber;
  return std::make_tuple(Field{"term", &M::term}, Field{"revision", &M::revision});
}
[[nodiscard]] constexpr auto fields(const TimedPlan* /*of*/) {
  using M = TimedPlan;
  return std::make_tuple(Field{"number", &M::number}, Field{"epoch", &M::epoch});
}
[[nodiscard]] constexpr auto fields(const Transition* /*of*/) {
  using M = Transition;
  return std::make_tuple(Field{"to", &M::to}, Field{"start", &M::start}, Field{"duration", &M::duration});
}
[[nodiscard]] constexpr auto fields(const PlanMoment* /*of*/) {
  using M = PlanMoment;
  return std::make_tuple(Field{"at", &M::at}, Field{"pace", &M::pace}, Field{"rate_1_s", &M::rate_1_s},
                         Field{"curvature_1_s2", &M::curvature_1_s2});
}
[[nodiscard]] constexpr auto fields(const Ramp* /*of*/) {
  using M = Ramp;
  return std::make_tuple(Field{"start", &M::start}, Field{"duration", &M::duration}, Field{"from", &M::from},
                         Field{"target", &M::target});
}
[[nodiscard]] constexpr auto fields(const Pace* /*of*/) {
  using M = Pace;
  return std::make_tuple(Field{"ramps", &M::ramps});
}
[[nodiscard]] constexpr auto fields(const Wish* /*of*/) {
  using M = Wish;
  return std::make_tuple(Field{"pace", &M::pace}, Field{"rest_when_changed", &M::rest_when_changed},
                         Field{"by", &M::by});
}
[[nodiscard]] constexpr auto fields(const Course* /*of*/) {
  using M = Course;
  return std::make_tuple(Field{"term", &M::term}, Field{"revision", &M::revision}, Field{"wish", &M::wish},
                         Field{"pace", &M::pace}, Field{"lease", &M::lease}, Field{"stopping", &M::stopping},
                         Field{"base", &M::base}, Field{"transitions", &M::transitions});
}
[[nodiscard]] constexpr auto fields(const Beacon* /*of*/) {
  using M = Beacon;
  return std::make_tuple(Field{"term", &M::term}, Field{"sequence", &M::sequence}, Field{"swarm_time", &M::swarm_time},
                         Field{"course", &M::course}, Field{"proposal", &M::proposal},
                         Field{"skew_budget", &M::skew_budget});
}
[[nodiscard]] constexpr auto fields(const mechanics::EdgePush* /*of*/) {
  using M = mechanics::EdgePush;
  return std::make_tuple(Field{"direction", &M::direction}, Field{"offset_n", &M::offset_n},
                         Field{"amplitude_n", &M::amplitude_n}, Field{"phase_rad", &M::phase_rad});
}
[[nodiscard]] constexpr auto fields(const mechanics::Harmonic* /*of*/) {
  using M = mechanics::Harmonic;
  return std::make_tuple(Field{"numerator", &M::numerator}, Field{"denominator", &M::denominator});
}
[[nodiscard]] constexpr auto fields(const mechanics::Oscillation* /*of*/) {
  using M = mechanics::Oscillation;
  return std::make_tuple(Field{"mean", &M::mean}, Field{"swing", &M::swing}, Field{"harmonic", &M::harmonic},
                         Field{"phase_rad", &M::phase_rad});
}
[[nodiscard]] constexpr auto fields(const mechanics::LengthLaw* /*of*/) {
  using M = mechanics::LengthLaw;
  return std::make_tuple(Field{"kind", &M::kind}, Field{"direction", &M::direction}, Field{"profile", &M::profile});
}
[[nodiscard]] constexpr auto fields(const mechanics::CarrierSlice* /*of*/) {
  using M = mechanics::CarrierSlice;
  return std::make_tuple(Field{"id", &M::id}, Field{"attachment_w_m", &M::attachment_w_m},
                         Field{"particular_force_w_n", &M::particular_force_w_n}, Field{"incoming", &M::incoming},
                         Field{"outgoing", &M::outgoing}, Field{"rate_rad_s", &M::rate_rad_s}, Field{"law", &M::law},
                         Field{"cable_stiffness_n_m", &M::cable_stiffness_n_m}, Field{"winch_lag_s", &M::winch_lag_s},
                         Field{"vehicle_lag_s", &M::vehicle_lag_s});
}
[[nodiscard]] constexpr auto fields(const NumberedSlice* /*of*/) {
  using M = NumberedSlice;
  return std::make_tuple(Field{"number", &M::number}, Field{"slice", &M::slice});
}
[[nodiscard]] constexpr auto fields(const PlanOffer* /*of*/) {
  using M = PlanOffer;
  return std::make_tuple(Field{"carrier", &M::carrier}, Field{"term", &M::term}, Field{"sequence", &M::sequence},
                         Field{"slices", &M::slices}, Field{"neighbour", &M::neighbour});
}
[[nodiscard]] constexpr auto fields(const HeldPlans* /*of*/) {
  using M = HeldPlans;
  return std::make_tuple(Field{"carrier", &M::carrier}, Field{"incarnation", &M::incarnation},
                         Field{"slices", &M::slices}, Field{"neighbour", &M::neighbour});
}
[[nodiscard]] constexpr auto fields(const TimeRequest* /*of*/) {
  using M = TimeRequest;
  return std::make_tuple(Field{"carrier", &M::carrier}, Field{"incarnation", &M::incarnation},
                         Field{"sequence", &M::sequence}, Field{"sent", &M::sent});
}
[[nodiscard]] constexpr auto fields(const TimeReply* /*of*/) {
  using M = TimeReply;
  return std::make_tuple(
      Field{"carrier", &M::carrier}, Field{"incarnation", &M::incarnation}, Field{"sequence", &M::sequence},
      Field{"term", &M::term}, Field{"request_sent", &M::request_sent}, Field{"request_received", &M::request_received},
      Field{"reply_sent", &M::reply_sent}, Field{"believed", &M::believed}, Field{"rival", &M::rival});
}
[[nodiscard]] constexpr auto fields(const DropCounts* /*of*/) {
  using M = DropCounts;
  return std::make_tuple(Field{"late", &M::late}, Field{"duplicate", &M::duplicate},
                         Field{"wrong_term", &M::wrong_term}, Field{"nonsense", &M::nonsense});
}
[[nodiscard]] constexpr auto fields(const AgentStatus* /*of*/) {
  using M = AgentStatus;
  return std::make_tuple(
      Field{"carrier", &M::carrier}, Field{"incarnation", &M::incarnation}, Field{"sequence", &M::sequence},
      Field{"term", &M::term}, Field{"state", &M::state}, Field{"swarm_time", &M::swarm_time},
      Field{"clock_uncertainty", &M::clock_uncertainty}, Field{"clock_drift_ppm", &M::clock_drift_ppm},
      Field{"course", &M::course}, Field{"confirmed", &M::confirmed}, Field{"accepted", &M::accepted},
      Field{"refused", &M::refused}, Field{"refusal", &M::refusal}, Field{"beacons_received", &M::beacons_received},
      Field{"beacons_missed", &M::beacons_missed}, Field{"dropped", &M::dropped}, Field{"address", &M::address});
}
[[nodiscard]] constexpr auto fields(const Setpoint* /*of*/) {
  using M = Setpoint;
  return std::make_tuple(Field{"carrier", &M::carrier}, Field{"incarnation", &M::incarnation},
                         Field{"sequence", &M::sequence}, Field{"swarm_time", &M::swarm_time},
                         Field{"position_w_m", &M::position_w_m}, Field{"velocity_w_m_s", &M::velocity_w_m_s},
                         Field{"acceleration_w_m_s2", &M::acceleration_w_m_s2}, Field{"direction_w", &M::direction_w},
                         Field{"tension_n", &M::tension_n}, Field{"cable_length_m", &M::cable_length_m},
                         Field{"winch_length_m", &M::winch_length_m}, Field{"winch_rate_m_s", &M::winch_rate_m_s},
                         Field{"winch_acceleration_m_s2", &M::winch_acceleration_m_s2});
}
[[nodiscard]] constexpr auto fields(const CarrierState* /*of*/) {
  using M = CarrierState;
  return std::make_tuple(Field{"carrier", &M::carrier}, Field{"incarnation", &M::incarnation},
                         Field{"follows", &M::follows}, Field{"sequence", &M::sequence}, Field{"stamp", &M::stamp},
                         Field{"position_w_m", &M::position_w_m}, Field{"velocity_w_m_s", &M::velocity_w_m_s},
                         Field{"tension_n", &M::tension_n}, Field{"cable_length_m", &M::cable_length_m},
                         Field{"winch_length_m", &M::winch_length_m}, Field{"winch_rate_m_s", &M::winch_rate_m_s});
}
[[nodiscard]] constexpr auto fields(const LoadState* /*of*/) {
  using M = LoadState;
  return std::make_tuple(Field{"incarnation", &M::incarnation}, Field{"sequence", &M::sequence},
                         Field{"stamp", &M::stamp}, Field{"position_w_m", &M::position_w_m},
                         Field{"velocity_w_m_s", &M::velocity_w_m_s}, Field{"orientation_w_b", &M::orientation_w_b},
                         Field{"angular_velocity_b_rad_s", &M::angular_velocity_b_rad_s});
}
[[nodiscard]] constexpr auto fields(const Command* /*of*/) {
  using M = Command;
  return std::make_tuple(Field{"id", &M::id}, Field{"kind", &M::kind}, Field{"pace", &M::pace},
                         Field{"phase_rad", &M::phase_rad}, Field{"mission", &M::mission});
}
[[nodiscard]] constexpr auto fields(const CommandReply* /*of*/) {
  using M = CommandReply;
  return std::make_tuple(Field{"id", &M::id}, Field{"done", &M::done}, Field{"text", &M::text});
}
[[nodiscard]] constexpr auto fields(const CoordinatorStatus* /*of*/) {
  using M = CoordinatorStatus;
  return std::make_tuple(Field{"term", &M::term}, Field{"swarm_time", &M::swarm_time}, Field{"mission", &M::mission},
                         Field{"plan", &M::plan}, Field{"skew_budget", &M::skew_budget}, Field{"skew", &M::skew},
                         Field{"carriers", &M::carriers}, Field{"silent", &M::silent}, Field{"news", &M::news});
}
[[nodiscard]] constexpr auto fields(const MissionText* /*of*/) {
  using M = MissionText;
  return std::make_tuple(Field{"term", &M::term}, Field{"plan", &M::plan}, Field{"text", &M::text});
}
[[nodiscard]] constexpr auto fields(const Health* /*of*/) {
  using M = Health;
  return std::make_tuple(Field{"process", &M::process}, Field{"complaint", &M::complaint},
                         Field{"dropped", &M::dropped}, Field{"undecodable", &M::undecodable},
                         Field{"unsendable", &M::unsendable}, Field{"overrun", &M::overrun},
                         Field{"late_max", &M::late_max});
}
[[nodiscard]] constexpr auto fields(const Disturbance* /*of*/) {
  using M = Disturbance;
  return std::make_tuple(Field{"process", &M::process}, Field{"kind", &M::kind}, Field{"share", &M::share},
                         Field{"shift", &M::shift}, Field{"force_w_n", &M::force_w_n}, Field{"duration", &M::duration});
}
[[nodiscard]] constexpr auto fields(const JournalPiece* /*of*/) {
  using M = JournalPiece;
  return std::make_tuple(Field{"process", &M::process}, Field{"incarnation", &M::incarnation},
                         Field{"offset", &M::offset}, Field{"bytes", &M::bytes});
}

/// each(field) for every field of a struct that is listed above.
template <class Struct, class Each>
constexpr void for_each_field(Each&& each) {
  std::apply([&](const auto&... field) { (each(field), ...); }, fields(static_cast<const Struct*>(nullptr)));
}

}  // namespace gyre::protocol
