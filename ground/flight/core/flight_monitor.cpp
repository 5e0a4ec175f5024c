#include "ground/flight/core/flight_monitor.hpp"

#include <algorithm>

#include "common/base/text.hpp"
#include "common/protocol/course.hpp"

namespace gyre::ground {
const char* name(FlightPhase phase) {
  switch (phase) {
    case FlightPhase::kStarting:
      return "starting";
    case FlightPhase::kMatching:
      return "matching";
    case FlightPhase::kEngaging:
      return "engaging";
    case FlightPhase::kFlying:
      return "flying";
    case FlightPhase::kSlowed:
      return "slowed";
    case FlightPhase::kReleasing:
      return "releasing";
    case FlightPhase::kDeviated:
      return "deviated";
  }
  return "unknown";
}

FlightMonitor::FlightMonitor(const SwarmView& view, const std::vector<CarrierId>& carriers, LocalTime now,
                             const FlightPatience& patience)
    : view_(view), carriers_(carriers), patience_(patience), begin_(now) {}

void FlightMonitor::look(LocalTime now) {
  if (view_.coordinator()) plan_.learn(*view_.coordinator());
  if (!plan_.known()) return;
  if (view_.beacon()) remember_motion();
  if (!all_ready_ && agents_ready() == agents()) all_ready_ = now;
}

const protocol::AgentStatus* FlightMonitor::agent(CarrierId id) const {
  const auto carrier = view_.carriers().find(id);
  return carrier == view_.carriers().end() || !carrier->second.agent ? nullptr : &*carrier->second.agent;
}

bool FlightMonitor::ready(CarrierId id) const {
  const protocol::AgentStatus* const status = agent(id);
  if (!status || !plan_.known()) return false;
  return std::find(status->accepted.begin(), status->accepted.end(), plan_.number) != status->accepted.end();
}

int FlightMonitor::agents_ready() const {
  return static_cast<int>(std::count_if(carriers_.begin(), carriers_.end(), [&](CarrierId id) { return ready(id); }));
}

/// One simulator stands for all vehicles: the last word of any of them.
std::optional<LocalTime> FlightMonitor::simulator_heard() const {
  std::optional<LocalTime> last;
  for (const auto& [id, carrier] : view_.carriers()) last = std::max(last, carrier.vehicle_heard);
  return last;
}

bool FlightMonitor::silent(std::optional<LocalTime> heard, LocalTime now) const {
  return !heard || now - *heard > patience_.silence;
}

FlightPhase FlightMonitor::phase(LocalTime now) const {
  if (!view_.beacon() || !plan_.known() || !simulator_heard()) return FlightPhase::kStarting;
  switch (place(now)) {
    case Place::kTowardsMotion:
      return FlightPhase::kEngaging;
    case Place::kMotion:
      return FlightPhase::kFlying;
    case Place::kSlowed:
      return FlightPhase::kSlowed;
    case Place::kTowardsRest:
      return FlightPhase::kReleasing;
    case Place::kElsewhere:
      return FlightPhase::kDeviated;
    case Place::kRest:
      break;
  }
  if (motion_left_) return FlightPhase::kReleasing;
  return all_ready_ ? FlightPhase::kEngaging : FlightPhase::kMatching;
}

Duration FlightMonitor::flown(LocalTime now) const {
  if (!motion_complete_) return Duration::zero();
  const SwarmTime until = std::min(*view_.swarm_time(now), motion_left_.value_or(SwarmTime::max()));
  return std::max(Duration::zero(), until - *motion_complete_);
}

bool FlightMonitor::under_way(LocalTime now) const {
  return place(now) != Place::kRest;
}

std::optional<std::string> FlightMonitor::complaint(LocalTime now) const {
  for (const CarrierId id : carriers_) {
    const protocol::AgentStatus* const status = agent(id);
    if (status && plan_.known() && status->refused == plan_.number) {
      return text("agent %u refuses the motion: ", id) + status->refusal;
    }
  }
  const auto waited = [](Duration patience) { return text(" within %.0f s", seconds(patience)); };
  switch (phase(now)) {
    case FlightPhase::kStarting:
      if (now - begin_ <= patience_.starting) return std::nullopt;
      if (view_.beacon() && !plan_.known()) {
        return "the coordinator did not tell which plan is the mission's" + waited(patience_.starting);
      }
      return std::string(view_.beacon() ? "the simulator" : "the coordinator") + " was not heard" +
             waited(patience_.starting);
    case FlightPhase::kMatching: {
      if (now - begin_ <= patience_.matching) return std::nullopt;
      std::vector<CarrierId> missing;
      for (const CarrierId id : carriers_) {
        if (!ready(id)) missing.push_back(id);
      }
      return listed("agent", missing) + " did not accept the motion" + waited(patience_.matching);
    }
    case FlightPhase::kEngaging:
      if (place(now) == Place::kRest && now - *all_ready_ > patience_.engaging) {
        return "every agent has accepted, but the coordinator did not begin the motion" + waited(patience_.engaging);
      }
      break;
    case FlightPhase::kDeviated:
      return "the swarm left the motion by itself: the coordinator's log says why";
    case FlightPhase::kFlying:
    case FlightPhase::kSlowed:
    case FlightPhase::kReleasing:
      break;
  }
  return somebody_silent(now);
}

std::optional<std::string> FlightMonitor::somebody_silent(LocalTime now) const {
  const std::string how = text(" silent for more than %.0f s", seconds(patience_.silence));
  std::vector<CarrierId> agents;
  for (const CarrierId id : carriers_) {
    const auto carrier = view_.carriers().find(id);
    if (carrier == view_.carriers().end() || silent(carrier->second.agent_heard, now)) agents.push_back(id);
  }
  if (silent(view_.beacon_heard().last(), now)) return "the coordinator was" + how;
  if (silent(simulator_heard(), now)) return "the simulator was" + how;
  if (!agents.empty()) return listed("agent", agents) + (agents.size() == 1 ? " was" : " were") + how;
  return std::nullopt;
}

FlightMonitor::Place FlightMonitor::place(LocalTime now) const {
  if (!plan_.known() || !view_.beacon()) return Place::kRest;
  const SwarmTime at = *view_.swarm_time(now);
  const protocol::Course& course = view_.beacon()->course;
  const auto plans = protocol::plans_of(course);
  if (std::any_of(plans.begin(), plans.end(), [this](const auto& p) { return p != plan_.number; })) {
    return Place::kElsewhere;
  }
  const protocol::Pace pace = course.flown_pace(at);
  if (course.wish.by == protocol::Wisher::kSilence || course.wish.by == protocol::Wisher::kEvidence)
    return Place::kElsewhere;
  // The last one that has begun counts: what is only announced changes nothing yet.
  const auto passing =
      std::find_if(pace.ramps.rbegin(), pace.ramps.rend(), [at](const auto& r) { return r.start <= at; });
  const bool changing = passing != pace.ramps.rend() && at < passing->end();
  const double towards = changing ? passing->target : pace.at(at).pace;
  if (towards == 0.0) return changing ? Place::kTowardsRest : Place::kRest;
  if (towards == 1.0) return changing ? Place::kTowardsMotion : Place::kMotion;
  return Place::kSlowed;
}

void FlightMonitor::remember_motion() {
  const protocol::Ramp& last = view_.beacon()->course.pace.ramps.back();
  if (last.duration > Duration::zero()) transition_duration_ = last.duration;
  if (last.target == 1.0) {
    if (!motion_complete_ || motion_left_) motion_complete_ = last.end();
    motion_left_.reset();
  } else if (motion_complete_ && !motion_left_) {
    motion_left_ = last.start;
  }
}

}  // namespace gyre::ground
