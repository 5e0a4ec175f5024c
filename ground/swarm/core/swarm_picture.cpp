#include "ground/swarm/core/swarm_picture.hpp"

#include <algorithm>
#include <vector>

#include "common/base/text.hpp"
#include "common/protocol/term.hpp"
#include "ground/swarm/core/course_line.hpp"
#include "ground/text_table.hpp"

namespace gyre::ground {
namespace {

const char* whose(protocol::Wisher by) {
  switch (by) {
    case protocol::Wisher::kNobody:
      return "for nobody has wished anything yet";
    case protocol::Wisher::kStart:
      return "as the coordinator was started to";
    case protocol::Wisher::kPerson:
      return "as a person asked";
    case protocol::Wisher::kSilence:
      return "since somebody fell silent";
    case protocol::Wisher::kEvidence:
      return "since a carrier got stuck";
  }
  return "by whomever";
}

std::string count(std::uint64_t n) {
  return std::to_string(n);
}

std::string dropped(const protocol::DropCounts& d) {
  return count(d.late) + " / " + count(d.duplicate) + " / " + count(d.wrong_term) + " / " + count(d.nonsense);
}

std::string milliseconds(Duration d) {
  return d > std::chrono::hours(1) ? "-" : number_text(1e3 * seconds(d));
}

std::string load_line(const SwarmView& view) {
  if (!view.load()) return "nobody tells where it is";
  const protocol::LoadState& load = *view.load();
  return text("at (%.4f, %.4f, %.4f) m, moving at %.2g m/s", load.position_w_m.x(), load.position_w_m.y(),
              load.position_w_m.z(), load.velocity_w_m_s.norm());
}

std::string clock_line(const protocol::CoordinatorStatus& c) {
  const std::string disagree = "may disagree by " + milliseconds(c.skew) + " ms";
  if (c.skew_budget == Duration::zero()) return disagree + "; the plan in force allows any";
  return disagree + text(", %.2g %% of the %.3g ms the plan in force allows",
                         100.0 * seconds(c.skew) / seconds(c.skew_budget), 1e3 * seconds(c.skew_budget));
}

std::string woke_late(const SwarmView& view, const std::string& name) {
  const auto process = view.processes().find(name);
  return process == view.processes().end() ? "-" : text("%.1f", 1e3 * seconds(process->second.word.late_max));
}

const protocol::AgentStatus* agent_of(const SwarmView& view, CarrierId id) {
  const auto carrier = view.carriers().find(id);
  return carrier == view.carriers().end() || !carrier->second.agent ? nullptr : &*carrier->second.agent;
}

std::vector<std::string> carrier_row(const SwarmView& view, CarrierId id) {
  const protocol::AgentStatus* const s = agent_of(view, id);
  const bool silent = view.named_silent(id);
  if (!s) return {count(id), silent ? "SILENT" : "not heard", "-", "-", "-", "-", "-", "-"};
  return {count(id),
          silent ? "SILENT" : name(s->state),
          plan_name(s->course.base.number, view.coordinator()),
          milliseconds(s->clock_uncertainty),
          text("%+.2f", s->clock_drift_ppm),
          woke_late(view, text("agent %u", id)),
          count(s->beacons_missed) + " of " + count(s->beacons_received + s->beacons_missed),
          dropped(s->dropped)};
}

/// Who refuses, who complains, and what the hubs have dropped.
std::string trouble(const SwarmView& view, LocalTime now) {
  std::string out;
  for (const auto& [id, carrier] : view.carriers()) {
    if (!carrier.agent || carrier.agent->refused.none()) continue;
    out += text("\n  carrier %u refuses ", id) + plan_name(carrier.agent->refused, view.coordinator()) + ": " +
           carrier.agent->refusal;
  }
  const auto complaints = view.complaints(now);
  for (const auto& [name, process] : view.processes()) {
    if (const auto words = complaints.find(name); words != complaints.end()) {
      out += "\n  " + name + " complains: " + words->second;
    }
    if (name.rfind("agent", 0) == 0) continue;  // in the table
    const protocol::Health& h = process.word;
    out += "\n  " + name + " dropped " + dropped(h.dropped) + "; unreadable " + count(h.undecodable) + ", not sent " +
           count(h.unsendable) + ", overrun " + count(h.overrun) + ", woke " + woke_late(view, name) + " ms late";
  }
  return out;
}

}  // namespace

const char* name(protocol::AgentState state) {
  switch (state) {
    case protocol::AgentState::kWaiting:
      return "waiting";
    case protocol::AgentState::kReady:
      return "ready";
    case protocol::AgentState::kFlying:
      return "flying";
    case protocol::AgentState::kAlone:
      return "alone";
  }
  return "unknown";
}

bool complete(const SwarmView& view) {
  if (!view.coordinator() || !view.beacon() || !view.load()) return false;
  const auto& carriers = view.coordinator()->carriers;
  return std::all_of(carriers.begin(), carriers.end(),
                     [&](CarrierId id) { return agent_of(view, id) || view.named_silent(id); });
}

std::string wish_line(const protocol::Course& course, SwarmTime now) {
  const std::string line = pace_name(course.wish.pace) + (course.wish.rest_when_changed ? ", then rest" : "") + ", " +
                           whose(course.wish.by) + text("; the pace is %.3g %%", 100.0 * course.moment(now).pace);
  if (!course.lease) return line + "; no lease, it flies on without a word";
  const double left_s = seconds(*course.lease - now);
  return line + (left_s > 0.0 ? text("; the lease runs for another %.1f s", left_s)
                              : text("; the lease ended %.1f s ago", -left_s));
}

std::string table(const SwarmView& view, LocalTime now) {
  if (!view.coordinator()) return "no coordinator\n";
  const protocol::CoordinatorStatus& c = *view.coordinator();
  const auto& beacon = view.beacon();
  std::string out = text("%s: term %llu, swarm time %.1f s\n", c.mission.c_str(), protocol::generation(c.term),
                         seconds(c.swarm_time.time_since_epoch()));
  out += "  course   " + (beacon ? course_line(*beacon, c) : "no beacon heard") + "\n";
  if (beacon) out += "  wish     " + wish_line(beacon->course, beacon->swarm_time) + "\n";
  out += "  load     " + load_line(view) + "\n";
  out += "  clocks   " + clock_line(c) + "\n";
  out += "  latest   " + c.news + "\n\n";

  std::vector<std::vector<std::string>> rows{
      {"carrier", "state", "plan", "clock uncertain", "drift", "woke late", "beacons missed", "dropped"},
      {"", "", "", "ms", "ppm", "ms", "", "late / twice / old term / nonsense"}};
  for (const CarrierId id : c.carriers) rows.push_back(carrier_row(view, id));
  return out + aligned(rows) + trouble(view, now) + "\n";
}

}  // namespace gyre::ground
