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

FlightMonitor::FlightMonitor(const std::vector<CarrierId>& carriers, LocalTime now, const FlightPatience& patience)
    : patience_(patience), begin_(now), simulator_(patience.silence), coordinator_(patience.silence) {
  for (const CarrierId id : carriers) agents_.emplace(id, Agent{protocol::Liveness(patience.silence), false, {}});
}

void FlightMonitor::see(const protocol::Beacon& beacon, LocalTime arrived) {
  coordinator_.heard(arrived);
  beacon_ = beacon;
  beacon_arrived_ = arrived;
  if (plan_.known()) remember_motion();
}

void FlightMonitor::see(const protocol::AgentStatus& status, LocalTime arrived) {
  const auto found = agents_.find(status.carrier);
  if (found == agents_.end()) return;
  Agent& agent = found->second;
  agent.heard.heard(arrived);
  if (!plan_.known()) return;
  const auto& accepted = status.accepted;
  agent.ready = std::find(accepted.begin(), accepted.end(), plan_.number) != accepted.end();
  if (status.refused == plan_.number) agent.refusal = status.refusal;
  if (!all_ready_ && agents_ready() == agents()) all_ready_ = arrived;
}

void FlightMonitor::see(const protocol::CarrierState&, LocalTime arrived) {
  simulator_.heard(arrived);
}

int FlightMonitor::agents_ready() const {
  return static_cast<int>(
      std::count_if(agents_.begin(), agents_.end(), [](const auto& entry) { return entry.second.ready; }));
}

FlightPhase FlightMonitor::phase(LocalTime now) const {
  if (!coordinator_.ever_heard() || !plan_.known() || !simulator_.ever_heard()) return FlightPhase::kStarting;
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
  const SwarmTime until = std::min(swarm_time(now), motion_left_.value_or(SwarmTime::max()));
  return std::max(Duration::zero(), until - *motion_complete_);
}

bool FlightMonitor::under_way(LocalTime now) const {
  return coordinator_.ever_heard() && place(now) != Place::kRest;
}

std::optional<std::string> FlightMonitor::complaint(LocalTime now) const {
  for (const auto& [id, agent] : agents_) {
    if (!agent.refusal.empty()) return text("agent %u refuses the motion: ", id) + agent.refusal;
  }
  const auto waited = [](Duration patience) { return text(" within %.0f s", seconds(patience)); };
  switch (phase(now)) {
    case FlightPhase::kStarting:
      if (now - begin_ <= patience_.starting) return std::nullopt;
      if (coordinator_.ever_heard() && !plan_.known()) {
        return "the coordinator did not tell which plan is the mission's" + waited(patience_.starting);
      }
      return std::string(coordinator_.ever_heard() ? "the simulator" : "the coordinator") + " was not heard" +
             waited(patience_.starting);
    case FlightPhase::kMatching: {
      if (now - begin_ <= patience_.matching) return std::nullopt;
      std::vector<CarrierId> missing;
      for (const auto& [id, agent] : agents_) {
        if (!agent.ready) missing.push_back(id);
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
  const std::string silent = text(" silent for more than %.0f s", seconds(patience_.silence));
  std::vector<CarrierId> agents;
  for (const auto& [id, agent] : agents_) {
    if (agent.heard.silent(now)) agents.push_back(id);
  }
  if (coordinator_.silent(now)) return "the coordinator was" + silent;
  if (simulator_.silent(now)) return "the simulator was" + silent;
  if (!agents.empty()) return listed("agent", agents) + (agents.size() == 1 ? " was" : " were") + silent;
  return std::nullopt;
}

SwarmTime FlightMonitor::swarm_time(LocalTime now) const {
  return beacon_.swarm_time + (now - beacon_arrived_);
}

FlightMonitor::Place FlightMonitor::place(LocalTime now) const {
  if (!plan_.known()) return Place::kRest;
  const SwarmTime at = swarm_time(now);
  const protocol::Course& course = beacon_.course;
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
  const protocol::Ramp& last = beacon_.course.pace.ramps.back();
  if (last.duration > Duration::zero()) transition_duration_ = last.duration;
  if (last.target == 1.0) {
    if (!motion_complete_ || motion_left_) motion_complete_ = last.end();
    motion_left_.reset();
  } else if (motion_complete_ && !motion_left_) {
    motion_left_ = last.start;
  }
}

}  // namespace gyre::ground
