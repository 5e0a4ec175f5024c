#include "ground/swarm/core/swarm_picture.hpp"

#include <algorithm>
#include <vector>

#include "common/base/text.hpp"
#include "common/protocol/term.hpp"
#include "ground/swarm/core/course_line.hpp"
#include "ground/text_table.hpp"

namespace gyre::ground {
namespace {

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

}  // namespace

void SwarmPicture::see(const protocol::LoadState& load) {
  load_ = load;
}

bool SwarmPicture::complete() const {
  if (!coordinator_ || !beacon_ || !load_) return false;
  const auto& silent = coordinator_->silent;
  return std::all_of(coordinator_->carriers.begin(), coordinator_->carriers.end(), [&](CarrierId id) {
    return agents_.count(id) > 0 || std::find(silent.begin(), silent.end(), id) != silent.end();
  });
}

std::string SwarmPicture::wish_line() const {
  const protocol::Course& course = beacon_->course;
  const SwarmTime now = beacon_->swarm_time;
  const std::string line = pace_name(course.wish.pace) + (course.wish.rest_when_changed ? ", then rest" : "") + ", " +
                           whose(course.wish.by) + text("; the pace is %.3g %%", 100.0 * course.moment(now).pace);
  if (!course.lease) return line + "; no lease, it flies on without a word";
  const double left_s = seconds(*course.lease - now);
  return line + (left_s > 0.0 ? text("; the lease runs for another %.1f s", left_s)
                              : text("; the lease ended %.1f s ago", -left_s));
}

std::string SwarmPicture::load_line() const {
  if (!load_) return "nobody tells where it is";
  return text("at (%.4f, %.4f, %.4f) m, moving at %.2g m/s", load_->position_w_m.x(), load_->position_w_m.y(),
              load_->position_w_m.z(), load_->velocity_w_m_s.norm());
}

std::string SwarmPicture::clock_line() const {
  const auto& c = *coordinator_;
  const std::string disagree = "may disagree by " + milliseconds(c.skew) + " ms";
  if (c.skew_budget == Duration::zero()) return disagree + "; the plan in force allows any";
  return disagree + text(", %.2g %% of the %.3g ms the plan in force allows",
                         100.0 * seconds(c.skew) / seconds(c.skew_budget), 1e3 * seconds(c.skew_budget));
}

std::string SwarmPicture::woke_late(const std::string& process) const {
  const auto health = health_.find(process);
  return health == health_.end() ? "-" : text("%.1f", 1e3 * seconds(health->second.late_max));
}

std::string SwarmPicture::table() const {
  if (!coordinator_) return "no coordinator\n";
  const protocol::CoordinatorStatus& c = *coordinator_;
  std::string out = text("%s: term %llu, swarm time %.1f s\n", c.mission.c_str(), protocol::generation(c.term),
                         seconds(c.swarm_time.time_since_epoch()));
  out += "  course   " + (beacon_ ? course_line(*beacon_, coordinator_) : "no beacon heard") + "\n";
  if (beacon_) out += "  wish     " + wish_line() + "\n";
  out += "  load     " + load_line() + "\n";
  out += "  clocks   " + clock_line() + "\n";
  out += "  latest   " + c.news + "\n\n";

  std::vector<std::vector<std::string>> rows{
      {"carrier", "state", "plan", "clock uncertain", "drift", "woke late", "beacons missed", "dropped"},
      {"", "", "", "ms", "ppm", "ms", "", "late / twice / old term / nonsense"}};
  for (const CarrierId id : c.carriers) {
    const auto agent = agents_.find(id);
    const bool silent = std::find(c.silent.begin(), c.silent.end(), id) != c.silent.end();
    if (agent == agents_.end()) {
      rows.push_back({count(id), silent ? "SILENT" : "not heard", "-", "-", "-", "-", "-", "-"});
      continue;
    }
    const protocol::AgentStatus& s = agent->second;
    rows.push_back(
        {count(id), silent ? "SILENT" : name(s.state), plan_name(s.course.base.number, coordinator_),
         milliseconds(s.clock_uncertainty), text("%+.2f", s.clock_drift_ppm), woke_late(text("agent %u", id)),
         count(s.beacons_missed) + " of " + count(s.beacons_received + s.beacons_missed), dropped(s.dropped)});
  }
  out += aligned(rows);
  for (const auto& [id, s] : agents_) {
    if (!s.refused.none())
      out += text("\n  carrier %u refuses ", id) + plan_name(s.refused, coordinator_) + ": " + s.refusal;
  }
  for (const auto& [process, h] : health_) {
    if (!h.complaint.empty()) out += "\n  " + process + " complains: " + h.complaint;
    if (process.rfind("agent", 0) == 0) continue;  // in the table above
    out += "\n  " + process + " dropped " + dropped(h.dropped) + "; unreadable " + count(h.undecodable) +
           ", not sent " + count(h.unsendable) + ", overrun " + count(h.overrun) + ", woke " + woke_late(process) +
           " ms late";
  }
  return out + "\n";
}

}  // namespace gyre::ground
