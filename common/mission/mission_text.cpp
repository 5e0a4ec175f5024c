#include <google/protobuf/text_format.h>

#include <algorithm>

#include "common/base/angle.hpp"
#include "common/base/ensure.hpp"
#include "common/mission/mission.hpp"
#include "idl/mission.pb.h"

namespace gyre::mission {
namespace {

namespace pb = ::gyre::mission::schema;

void write(const Eigen::Vector3d& from, pb::Vector* to) {
  to->set_x(from.x());
  to->set_y(from.y());
  to->set_z(from.z());
}

void write_shape(const std::vector<Eigen::Vector3d>& hull, pb::Shape* to) {
  const Eigen::Vector3d centre = 0.5 * (hull.front() + hull.back());
  const Eigen::Vector3d half = 0.5 * (hull.back() - hull.front());
  const std::vector<Eigen::Vector3d> box = mechanics::box_hull(half, centre);
  const auto same = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a.isApprox(b, 1e-14); };
  if (std::equal(box.begin(), box.end(), hull.begin(), hull.end(), same)) {
    to->mutable_box()->set_x_m(2.0 * half.x());
    to->mutable_box()->set_y_m(2.0 * half.y());
    to->mutable_box()->set_z_m(2.0 * half.z());
    write(centre, to->mutable_box()->mutable_centre_m());
    return;
  }
  for (const Eigen::Vector3d& vertex : hull) write(vertex, to->mutable_hull()->add_vertex_m());
}

void write(const mechanics::Load& load, pb::Load* to) {
  to->set_mass_kg(load.mass_kg);
  pb::Inertia* inertia = to->mutable_inertia_kg_m2();
  const Eigen::Matrix3d& matrix = load.inertia_b_kg_m2;
  inertia->set_x(matrix(0, 0));
  inertia->set_y(matrix(1, 1));
  inertia->set_z(matrix(2, 2));
  if (matrix(0, 1) != 0.0) inertia->set_xy(matrix(0, 1));
  if (matrix(0, 2) != 0.0) inertia->set_xz(matrix(0, 2));
  if (matrix(1, 2) != 0.0) inertia->set_yz(matrix(1, 2));
  write(load.position_w_m, to->mutable_position_m());
  pb::Quaternion* orientation = to->mutable_orientation();
  orientation->set_w(load.orientation_w_b.w());
  orientation->set_x(load.orientation_w_b.x());
  orientation->set_y(load.orientation_w_b.y());
  orientation->set_z(load.orientation_w_b.z());
  if (!load.hull_b_m.empty()) write_shape(load.hull_b_m, to->mutable_shape());
}

template <class Message>
void write(const mechanics::Oscillation& oscillation, double cycle_rate_rad_s, Message* to) {
  to->set_mean_m(oscillation.mean);
  to->set_swing_m(oscillation.swing);
  to->set_rate_rad_s(oscillation.harmonic.ratio() * cycle_rate_rad_s);
  to->set_phase_rad(oscillation.phase_rad);
}

void write(const mechanics::Vehicle& vehicle, bool holds, pb::Vehicle* to) {
  if (holds) to->set_on_silence(pb::Vehicle::HOLD);
  if (vehicle.mass_kg) to->set_mass_kg(*vehicle.mass_kg);
  if (vehicle.thrust_max_n) to->set_thrust_max_n(*vehicle.thrust_max_n);
  if (vehicle.bank_max_rad) to->set_bank_max_deg(degrees(*vehicle.bank_max_rad));
  if (vehicle.time_constant_s != 0.0) to->set_time_constant_s(vehicle.time_constant_s);
}

void write(const mechanics::Winch& winch, pb::Winch* to) {
  if (winch.time_constant_s != 0.0) to->set_time_constant_s(winch.time_constant_s);
  if (winch.rate_max_m_s) to->set_rate_max_m_s(*winch.rate_max_m_s);
  if (winch.acceleration_max_m_s2) to->set_acceleration_max_m_s2(*winch.acceleration_max_m_s2);
}

void write(const mechanics::Carrier& carrier, double cycle_rate_rad_s, pb::Carrier* to) {
  to->set_id(carrier.id);
  write(carrier.attachment_b_m, to->mutable_attachment_m());
  if (carrier.radius_m != 0.0) to->set_radius_m(carrier.radius_m);
  switch (carrier.law.kind) {
    case mechanics::LengthLaw::Kind::kLevel:
      to->mutable_level()->set_altitude_m(carrier.law.profile.mean);
      return;
    case mechanics::LengthLaw::Kind::kDirectional:
      write(carrier.law.direction, to->mutable_directional()->mutable_direction());
      write(carrier.law.profile, cycle_rate_rad_s, to->mutable_directional());
      return;
    case mechanics::LengthLaw::Kind::kSine:
      write(carrier.law.profile, cycle_rate_rad_s, to->mutable_sine());
      return;
    case mechanics::LengthLaw::Kind::kFixed:
      to->mutable_fixed()->set_length_m(carrier.law.profile.mean);
      return;
  }
}

void write(const mechanics::Cycle& cycle, pb::Cycle* to) {
  to->set_rate_rad_s(cycle.rate_rad_s);
  for (const mechanics::Edge& edge : cycle.edges) {
    pb::Edge* out = to->add_edge();
    out->set_from(edge.from);
    out->set_to(edge.to);
    out->set_offset_n(edge.offset_n);
    out->set_amplitude_n(edge.amplitude_n);
    out->set_phase_rad(edge.phase_rad);
  }
}

void write(const mechanics::Limits& limits, const LoadTolerance& tolerance, pb::Limits* to) {
  if (limits.tension_min_n) to->set_tension_min_n(*limits.tension_min_n);
  if (limits.tension_max_n) to->set_tension_max_n(*limits.tension_max_n);
  if (limits.length_min_m) to->set_length_min_m(*limits.length_min_m);
  if (limits.length_max_m) to->set_length_max_m(*limits.length_max_m);
  if (limits.winch_rate_max_m_s) to->set_winch_rate_max_m_s(*limits.winch_rate_max_m_s);
  if (limits.speed_min_m_s) to->set_speed_min_m_s(*limits.speed_min_m_s);
  if (limits.speed_max_m_s) to->set_speed_max_m_s(*limits.speed_max_m_s);
  if (limits.acceleration_max_m_s2) to->set_acceleration_max_m_s2(*limits.acceleration_max_m_s2);
  if (limits.separation_min_m) to->set_separation_min_m(*limits.separation_min_m);
  if (limits.clearance_min_m) to->set_clearance_min_m(*limits.clearance_min_m);
  if (limits.vertical_cosine_min) to->set_vertical_cosine_min(*limits.vertical_cosine_min);
  to->set_load_displacement_max_m(tolerance.displacement_max_m);
  to->set_load_rotation_max_deg(tolerance.rotation_max_deg);
}

void write(const Simulation& simulation, pb::Simulation* to) {
  if (simulation.carrier_time_constant_s) to->set_carrier_time_constant_s(*simulation.carrier_time_constant_s);
  if (simulation.lag_error != 0.0) to->set_lag_error(simulation.lag_error);
  if (!simulation.wind) return;
  write(simulation.wind->force_w_n, to->mutable_wind()->mutable_force_n());
  to->mutable_wind()->set_gust_n(simulation.wind->gust_n);
  to->mutable_wind()->set_gust_time_s(simulation.wind->gust_time_s);
  to->mutable_wind()->set_seed(simulation.wind->seed);
}

}  // namespace

std::string to_text(const Mission& mission) {
  pb::Mission out;
  const mechanics::Plan& plan = mission.plan;
  out.set_name(mission.name);
  write(plan.load, out.mutable_load());
  out.set_gravity_m_s2(plan.gravity_m_s2);
  out.mutable_cable()->set_stiffness_n_m(plan.cable.stiffness_n_m);
  out.mutable_cable()->set_damping_n_s_m(plan.cable.damping_n_s_m);
  out.mutable_cable()->set_compensate_stretch(plan.cable.compensate_stretch);
  for (const mechanics::Carrier& carrier : plan.carriers) {
    pb::Carrier* to = out.add_carrier();
    write(carrier, plan.cycle.rate_rad_s, to);
    write(carrier.vehicle, mission.holds.count(carrier.id) != 0, to->mutable_vehicle());
  }
  write(plan.cycle, out.mutable_cycle());
  write(plan.limits, mission.load_tolerance, out.mutable_limits());
  write(plan.winch, out.mutable_winch());
  write(mission.simulation, out.mutable_simulation());
  if (mission.transition_duration_s) out.mutable_transition()->set_duration_s(*mission.transition_duration_s);
  if (mission.silence.stop_after) {
    out.mutable_silence()->set_stop_after_s(seconds(*mission.silence.stop_after));
  } else {
    out.mutable_silence()->mutable_fly_on();
  }

  std::string text;
  google::protobuf::TextFormat::Printer printer;
  const bool printed = printer.PrintToString(out, &text);
  GYRE_ENSURE(printed, "a complete message in memory can be printed");
  return text;
}

}  // namespace gyre::mission
