#include "ground/swarm/core/process_list.hpp"

#include <algorithm>

#include "common/base/text.hpp"
#include "ground/swarm/core/swarm_picture.hpp"

namespace gyre::ground {
namespace {

const CarrierView* carrier_of(const SwarmView& view, CarrierId id) {
  const auto found = view.carriers().find(id);
  return found == view.carriers().end() ? nullptr : &found->second;
}

void add_health(const SwarmView& view, LocalTime now, ProcessLine& line) {
  const auto found = view.processes().find(line.name);
  if (found == view.processes().end()) return;
  line.health = &found->second.word;
  const Duration age = now - *found->second.heard.last();
  line.age = line.age ? std::min(*line.age, age) : age;
  if (!found->second.heard.silent(now)) line.complaint = line.health->complaint;
}

/// Of one that says nothing but how it is: healthy, complains, silent, not heard.
ProcessLine line_of(const SwarmView& view, LocalTime now, const std::string& name, std::optional<LocalTime> heard,
                    Duration silence) {
  ProcessLine line;
  line.name = name;
  if (heard) line.age = now - *heard;
  add_health(view, now, line);
  line.well = line.age && *line.age <= silence && line.complaint.empty();
  if (!line.age) {
    line.state = "not heard";
  } else if (*line.age > silence) {
    line.state = "silent";
  } else {
    line.state = line.complaint.empty() ? "healthy" : "complains";
  }
  return line;
}

ProcessLine agent_line(const SwarmView& view, LocalTime now, CarrierId id) {
  const CarrierView* const carrier = carrier_of(view, id);
  ProcessLine line =
      line_of(view, now, text("agent %u", id), carrier ? carrier->agent_heard : std::nullopt, kStreamSilence);
  line.carrier = id;
  if (!carrier || !carrier->agent) return line;
  line.agent = &*carrier->agent;
  line.address = line.agent->address;
  if (view.named_silent(id)) line.state = "silent", line.well = false;
  if (line.state == "healthy" || line.state == "complains") line.state = name(line.agent->state);
  return line;
}

/// The simulator, or whoever else tells where the load is.
std::optional<LocalTime> world_heard(const SwarmView& view) {
  std::optional<LocalTime> last = view.load_heard().last();
  for (const auto& [id, carrier] : view.carriers()) last = std::max(last, carrier.vehicle_heard);
  return last;
}

}  // namespace

std::vector<ProcessLine> process_list(const SwarmView& view, LocalTime now) {
  std::vector<ProcessLine> lines{line_of(view, now, "coordinator", view.beacon_heard().last(), kStreamSilence)};
  if (view.processes().count("simulator") > 0) {
    lines.push_back(line_of(view, now, "simulator", world_heard(view), kStreamSilence));
  }
  for (const CarrierId id : view.carrier_ids()) lines.push_back(agent_line(view, now, id));
  for (const auto& [name, process] : view.processes()) {
    const auto same = [&name = name](const ProcessLine& line) { return line.name == name; };
    if (std::any_of(lines.begin(), lines.end(), same)) continue;
    lines.push_back(line_of(view, now, name, std::nullopt, kWordSilence));
  }
  return lines;
}

std::vector<MissingThing> missing(const SwarmView& view, LocalTime now) {
  if (view.beacon_heard().silent(now)) {
    return {{"coordinator", view.beacon() ? "is not heard any more" : "is not heard yet"}};
  }
  if (!view.coordinator()) return {{"coordinator", "has not said yet which mission it leads"}};
  const protocol::CoordinatorStatus& leads = *view.coordinator();
  std::vector<MissingThing> out;
  for (const CarrierId id : leads.carriers) {
    const CarrierView* const carrier = carrier_of(view, id);
    const std::string who = text("agent %u", id);
    if (!carrier || !carrier->agent || now - *carrier->agent_heard > kStreamSilence) {
      out.push_back({who, "is not heard"});
      continue;
    }
    const protocol::AgentStatus& agent = *carrier->agent;
    const auto& accepted = agent.accepted;
    if (agent.refused == leads.plan && !agent.refused.none()) {
      out.push_back({who, "refuses the plan: " + agent.refusal});
    } else if (agent.clock_uncertainty > std::chrono::hours(1)) {
      out.push_back({who, "does not know swarm time yet"});
    } else if (std::find(accepted.begin(), accepted.end(), leads.plan) == accepted.end()) {
      out.push_back({who, "has not accepted the plan yet"});
    }
    if (!carrier->vehicle_heard || now - *carrier->vehicle_heard > kStreamSilence) {
      out.push_back({text("vehicle %u", id), "does not tell where it is"});
    }
  }
  if (view.load_heard().silent(now)) out.push_back({"load", "nobody tells where it is"});
  if (leads.skew_budget > Duration::zero() && leads.skew > leads.skew_budget) {
    const bool known = leads.skew < std::chrono::hours(1);
    out.push_back({"clocks", known ? text("may disagree by %.3g ms, the plan allows %.3g ms", 1e3 * seconds(leads.skew),
                                          1e3 * seconds(leads.skew_budget))
                                   : "nobody knows yet how far they disagree"});
  }
  for (const auto& [process, complaint] : view.complaints(now)) out.push_back({process, complaint});
  return out;
}

}  // namespace gyre::ground
