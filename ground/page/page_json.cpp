#include "ground/page/page_json.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/base/angle.hpp"
#include "common/base/text.hpp"
#include "common/protocol/term.hpp"
#include "ground/page/core/utf8.hpp"
#include "ground/page/protobuf_json.hpp"
#include "ground/swarm/core/course_line.hpp"
#include "ground/swarm/core/process_list.hpp"
#include "ground/swarm/core/swarm_picture.hpp"
#include "idl/page.pb.h"

namespace gyre::ground {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kUnknown = -1.0;
constexpr int kOrbitPoints = 128;

using Numbers = google::protobuf::RepeatedField<double>;

/// A micrometre is enough to draw by, and its digits cost every browser.
double drawn(double x) {
  return std::round(x * 1e6) / 1e6;
}

void set(Numbers* numbers, const Eigen::Vector3d& v) {
  numbers->Clear();
  for (const double x : {v.x(), v.y(), v.z()}) numbers->Add(x);
}
void set(Numbers* numbers, const Eigen::Quaterniond& q) {
  numbers->Clear();
  for (const double x : {q.w(), q.x(), q.y(), q.z()}) numbers->Add(x);
}
void add(Numbers* numbers, const std::vector<Eigen::Vector3d>& points) {
  for (const Eigen::Vector3d& p : points) {
    for (const double x : {p.x(), p.y(), p.z()}) numbers->Add(drawn(x));
  }
}

void set(page::Range* range, double min, double max) {
  range->set_min(min);
  range->set_max(max);
}
void set(page::Range* range, const mechanics::Range& figures) {
  set(range, figures.min, figures.max);
}

void set(page::Figures* out, const mechanics::CarrierFigures& figures) {
  set(out->mutable_tension_n(), figures.tension_n);
  set(out->mutable_length_m(), figures.length_m);
  set(out->mutable_speed_m_s(), figures.speed_m_s);
  set(out->mutable_winch_rate_m_s(), figures.winch_rate_m_s);
  set(out->mutable_altitude_m(), figures.altitude_m);
}

void set(page::Figures* out, const mechanics::Limits& limits) {
  const double winch = limits.winch_rate_max_m_s.value_or(kInfinity);
  set(out->mutable_tension_n(), limits.tension_min_n.value_or(0.0), limits.tension_max_n.value_or(kInfinity));
  set(out->mutable_length_m(), limits.length_min_m.value_or(0.0), limits.length_max_m.value_or(kInfinity));
  set(out->mutable_speed_m_s(), limits.speed_min_m_s.value_or(0.0), limits.speed_max_m_s.value_or(kInfinity));
  set(out->mutable_winch_rate_m_s(), -winch, winch);
  set(out->mutable_altitude_m(), -kInfinity, kInfinity);
}

std::string plan_number(const protocol::PlanNumber& plan) {
  return text("%llu.%llu", protocol::generation(plan.term), static_cast<unsigned long long>(plan.revision));
}

/// Without the mission's text: what the agents hold of it.
void set_by_slices(const SwarmView& view, page::Mission& out) {
  const protocol::PlanNumber plan = view.coordinator()->plan;
  for (const CarrierId id : view.carrier_ids()) {
    page::MissionCarrier* const carrier = out.add_carriers();
    carrier->set_id(id);
    const auto known = view.carriers().find(id);
    if (known == view.carriers().end()) continue;
    const auto slice = known->second.slices.find(plan);
    if (slice == known->second.slices.end() || !view.load()) continue;
    const protocol::LoadState& load = *view.load();
    set(carrier->mutable_attachment_b_m(),
        load.orientation_w_b.inverse() * (slice->second.attachment_w_m - load.position_w_m));
    out.set_period_s(2.0 * kPi / slice->second.rate_rad_s);
    std::vector<Eigen::Vector3d> orbit;
    for (int k = 0; k < kOrbitPoints; ++k) {
      orbit.push_back(mechanics::evaluate(slice->second, out.period_s() * k / kOrbitPoints).position_w_m.value);
    }
    add(carrier->mutable_orbit_w_m(), orbit);
  }
}

void set_whole(const KnownMission& known, page::Mission& out) {
  const mission::Mission& mission = known.mission;
  const mechanics::Plan& plan = mission.plan;
  const mechanics::Certificate& certificate = known.certificate;
  out.set_complete(true);
  out.set_name(mission.name);
  out.set_period_s(certificate.period_s);
  out.set_mass_kg(plan.load.mass_kg);
  out.set_gravity_m_s2(plan.gravity_m_s2);
  set(out.mutable_position_w_m(), plan.load.position_w_m);
  set(out.mutable_orientation_w_b(), plan.load.orientation_w_b);
  add(out.mutable_hull_b_m(), plan.load.hull_b_m);
  for (const std::uint32_t corner : hull_faces(plan.load.hull_b_m)) out.add_hull_faces(corner);
  set(out.mutable_limits(), plan.limits);
  out.set_displacement_max_m(mission.load_tolerance.displacement_max_m);
  out.set_rotation_max_deg(mission.load_tolerance.rotation_max_deg);
  out.set_clearance_m(certificate.clearance ? certificate.clearance->min_m : kInfinity);
  if (certificate.clearance) out.set_clearance_between(who(*certificate.clearance));
  for (std::size_t i = 0; i < plan.carriers.size(); ++i) {
    const mechanics::Carrier& carrier = plan.carriers[i];
    page::MissionCarrier* const one = out.add_carriers();
    one->set_id(carrier.id);
    set(one->mutable_attachment_b_m(), carrier.attachment_b_m);
    one->set_radius_m(carrier.radius_m);
    add(one->mutable_orbit_w_m(), orbit_w_m(plan, carrier.id, kOrbitPoints));
    if (i < certificate.carriers.size()) set(one->mutable_certified(), certificate.carriers[i]);
  }
}

void set(page::FrameCarrier& out, const SwarmView& view, CarrierId id, LocalTime now) {
  out.set_id(id);
  const auto known = view.carriers().find(id);
  if (known == view.carriers().end()) return;
  const CarrierView& carrier = known->second;
  const auto swarm_time = view.swarm_time(now);
  const auto planned = swarm_time ? view.planned(id, *swarm_time) : std::nullopt;
  if (planned && planned->position_w_m.value.allFinite()) set(out.mutable_planned_w_m(), planned->position_w_m.value);
  if (!carrier.vehicle) return;
  const protocol::CarrierState& state = *carrier.vehicle;
  out.set_heard(!carrier.vehicles.silent(now));
  set(out.mutable_position_w_m(), state.position_w_m);
  out.set_tension_n(state.tension_n);
  out.set_length_m(state.cable_length_m);
  out.set_speed_m_s(state.velocity_w_m_s.norm());
  out.set_winch_rate_m_s(state.winch_rate_m_s);
  out.set_deviation_m(view.deviation_m(id).value_or(0.0));
}

void set_closest(const SwarmView& view, LocalTime now, page::Frame& out) {
  double closest_m = kInfinity;
  for (auto a = view.carriers().begin(); a != view.carriers().end(); ++a) {
    for (auto b = std::next(a); b != view.carriers().end(); ++b) {
      if (a->second.vehicles.silent(now) || b->second.vehicles.silent(now)) continue;
      const double apart_m = (a->second.vehicle->position_w_m - b->second.vehicle->position_w_m).norm();
      if (apart_m >= closest_m) continue;
      closest_m = apart_m;
      out.clear_closest();
      out.add_closest(a->first);
      out.add_closest(b->first);
    }
  }
  out.set_closest_m(closest_m);
}

void set(page::Dropped* out, const protocol::DropCounts& dropped) {
  out->set_late(dropped.late);
  out->set_duplicate(dropped.duplicate);
  out->set_wrong_term(dropped.wrong_term);
  out->set_nonsense(dropped.nonsense);
}

void set(page::Process& out, const ProcessLine& line, const SwarmView& view, const std::vector<OwnProcess>& own) {
  out.set_name(utf8(line.name));
  out.set_state(line.state);
  out.set_well(line.well);
  out.set_complaint(utf8(line.complaint));
  out.set_address(utf8(line.address));
  out.set_heard_age_s(line.age ? seconds(*line.age) : kUnknown);
  out.set_carrier(line.carrier);
  out.set_clock_uncertainty_s(kUnknown);
  if (line.agent) {
    const protocol::AgentStatus& agent = *line.agent;
    out.set_plan(plan_name(agent.course.base.number, view.coordinator()));
    const bool known = agent.clock_uncertainty < std::chrono::hours(1);
    out.set_clock_uncertainty_s(known ? seconds(agent.clock_uncertainty) : kUnknown);
    out.set_clock_drift_ppm(agent.clock_drift_ppm);
    out.set_beacons_received(agent.beacons_received);
    out.set_beacons_missed(agent.beacons_missed);
    set(out.mutable_dropped(), agent.dropped);
  } else if (line.health) {
    set(out.mutable_dropped(), line.health->dropped);
  }
  if (line.health) out.set_late_s(seconds(line.health->late_max));
  const auto process =
      std::find_if(own.begin(), own.end(), [&](const OwnProcess& one) { return one.name == line.name; });
  if (process == own.end()) return;
  out.set_pid(static_cast<std::uint32_t>(process->pid));
  if (process->pid == 0) out.set_state("ended"), out.set_well(false);
  if (process->stopped) out.set_state("stopped"), out.set_well(false);
}

}  // namespace

std::string hello_json(const PageOwner& owner) {
  page::Hello hello;
  hello.set_server(owner.server);
  hello.set_domain(static_cast<std::uint32_t>(owner.domain));
  hello.set_takes_orders(owner.takes_orders);
  hello.set_owns_processes(owner.owns_processes);
  hello.set_mission_file(owner.mission_file);
  return json_of(hello);
}

std::string mission_json(const Shown& shown) {
  page::Mission out;
  const auto& coordinator = shown.view.coordinator();
  if (coordinator) out.set_name(utf8(coordinator->mission));
  if (coordinator) out.set_plan(plan_number(coordinator->plan));
  set(out.mutable_orientation_w_b(), Eigen::Quaterniond::Identity());
  set(out.mutable_limits(), mechanics::Limits{});
  out.set_clearance_m(kInfinity);
  if (shown.mission) {
    set_whole(*shown.mission, out);
  } else if (coordinator) {
    if (shown.view.load()) set(out.mutable_position_w_m(), shown.view.load()->position_w_m);
    if (shown.view.load()) set(out.mutable_orientation_w_b(), shown.view.load()->orientation_w_b);
    set_by_slices(shown.view, out);
  }
  return json_of(out);
}

std::string frame_json(const Shown& shown, const LoadWindow& window) {
  const SwarmView& view = shown.view;
  page::Frame out;
  out.set_server_time_s(seconds(shown.now - shown.begin));
  out.set_swarm_time_s(kUnknown);
  if (const auto swarm_time = view.swarm_time(shown.now)) {
    const protocol::Course& course = view.beacon()->course;
    const protocol::PlanMoment moment = course.moment(*swarm_time);
    out.set_swarm_time_s(seconds(swarm_time->time_since_epoch()));
    out.set_plan_time_s(seconds(moment.at.time_since_epoch()));
    out.set_pace(moment.pace);
    if (shown.mission) {
      const double period_s = shown.mission->certificate.period_s;
      const double turns = seconds(moment.at - course.base.epoch) / period_s;
      out.set_phase_rad(2.0 * kPi * (turns - std::floor(turns)));
    }
  }
  if (view.load()) {
    set(out.mutable_load_w_m(), view.load()->position_w_m);
    set(out.mutable_load_orientation_w_b(), view.load()->orientation_w_b);
  }
  if (window.samples > 0) set(out.mutable_displacement_w_m(), window.displaced_w_m);
  out.set_rotation_deg(window.rotation_max_deg);
  out.set_residual(window.residual_max);
  for (const CarrierId id : view.carrier_ids()) set(*out.add_carriers(), view, id, shown.now);
  set_closest(view, shown.now, out);
  return json_of(out);
}

std::string status_json(const Shown& shown, const std::optional<std::string>& complaint, const LoadWindow& flown,
                        const std::vector<OwnProcess>& own, const std::optional<HurtOutcome>& hurt) {
  const SwarmView& view = shown.view;
  page::Status out;
  out.set_connected(!view.beacon_heard().silent(shown.now));
  out.set_calm(!complaint);
  out.set_complaint(utf8(complaint.value_or("")));
  out.set_lease_left_s(kInfinity);
  out.set_skew_s(kUnknown);
  if (const auto swarm_time = view.swarm_time(shown.now)) {
    const protocol::Beacon& beacon = *view.beacon();
    out.set_course(course_line(beacon, view.coordinator()));
    out.set_wish(wish_line(beacon.course, *swarm_time));
    if (beacon.course.lease) out.set_lease_left_s(seconds(*beacon.course.lease - *swarm_time));
  }
  if (const auto& coordinator = view.coordinator()) {
    out.set_news(utf8(coordinator->news));
    out.set_term(protocol::generation(coordinator->term));
    if (coordinator->skew < std::chrono::hours(1)) out.set_skew_s(seconds(coordinator->skew));
    out.set_skew_budget_s(seconds(coordinator->skew_budget));
  }
  std::vector<ProcessLine> lines = process_list(view, shown.now);
  for (const OwnProcess& one : own) {
    const auto same = [&one](const ProcessLine& line) { return line.name == one.name; };
    if (std::any_of(lines.begin(), lines.end(), same)) continue;
    lines.emplace_back();  // it has said nothing yet, and may be started again all the same
    lines.back().name = one.name;
    lines.back().state = "not heard";
  }
  for (const ProcessLine& line : lines) set(*out.add_processes(), line, view, own);
  for (const MissingThing& thing : missing(view, shown.now)) {
    page::Missing* const one = out.add_missing();
    one->set_who(utf8(thing.who));
    one->set_what(utf8(thing.what));
  }
  out.set_displacement_max_m(flown.displacement_max_m);
  out.set_rotation_max_deg(flown.rotation_max_deg);
  page::Hurt* const done = out.mutable_hurt();
  done->set_calm_after_s(kUnknown);
  if (hurt) {
    done->set_number(hurt->number);
    done->set_text(hurt->text);
    done->set_since_s(seconds(hurt->since));
    done->set_before_m(hurt->before_m);
    done->set_moved_max_m(hurt->moved_max_m);
    if (hurt->calm_after) done->set_calm_after_s(seconds(*hurt->calm_after));
  }
  return json_of(out);
}

std::string happening_json(const Happening& happening) {
  page::Happening out;
  out.set_number(happening.number);
  out.set_swarm_time_s(happening.at ? seconds(happening.at->time_since_epoch()) : kUnknown);
  out.set_level(happening.level == Notice::Level::kInfo      ? page::Happening::INFO
                : happening.level == Notice::Level::kWarning ? page::Happening::WARNING
                                                             : page::Happening::ERROR);
  out.set_who(utf8(happening.who));
  out.set_text(utf8(happening.text));
  return json_of(out);
}

std::string time_json(double server_time_s) {
  return text("{\"server_time_s\":%.9f}", server_time_s);
}

}  // namespace gyre::ground
