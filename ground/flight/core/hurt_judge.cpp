#include "ground/flight/core/hurt_judge.hpp"

#include <utility>

#include "common/base/text.hpp"
#include "common/protocol/sanity.hpp"

namespace gyre::ground {
namespace {

using protocol::Disturbance;
using protocol::DisturbanceKind;

/// A link that is cut heals by itself: nobody could tell its process any more that it is over.
constexpr Duration kCutOff = std::chrono::seconds(10);

HurtVerdict refused(std::string why) {
  return {{false, std::move(why)}, {}};
}

Disturbance disturbance_of(const HurtRequest& wish, const std::string& process) {
  Disturbance disturbance;
  disturbance.process = process;
  switch (wish.kind) {
    case HurtKind::kLose:
      disturbance.kind = DisturbanceKind::kLosePackets;
      disturbance.share = wish.amount / 100.0;
      if (disturbance.share > protocol::kMostLostForGood) disturbance.duration = kCutOff;
      break;
    case HurtKind::kShiftClock:
      disturbance.kind = DisturbanceKind::kShiftClock;
      disturbance.shift = from_seconds(wish.amount);
      break;
    default:
      disturbance.kind = DisturbanceKind::kPushLoad;
      disturbance.force_w_n = wish.force_w_n;
      disturbance.duration = from_seconds(wish.duration_s);
  }
  return disturbance;
}

std::string words_of(const Disturbance& d) {
  const std::string& who = d.process;
  switch (d.kind) {
    case DisturbanceKind::kLosePackets:
      if (d.share == 0.0) return who + " loses no packet on purpose any more";
      return text("%s loses %.3g %% of its packets", who.c_str(), 100.0 * d.share) +
             (d.duration > Duration::zero() ? text(" for %.0f s", seconds(d.duration)) : "");
    case DisturbanceKind::kShiftClock:
      return text("the clock of %s was shifted by %+.6g s", who.c_str(), seconds(d.shift));
    case DisturbanceKind::kPushLoad:
      break;
  }
  return text("the load was pushed with %.3g N for %.2g s", d.force_w_n.norm(), seconds(d.duration));
}

}  // namespace

HurtJudge::HurtJudge(const std::vector<std::string>& processes, double load_weight_n)
    : order_(processes), load_weight_n_(load_weight_n) {
  for (const std::string& name : processes) processes_[name];
}

HurtVerdict HurtJudge::judge(LocalTime now, const HurtRequest& wish, const FlightSeen& seen) {
  const std::string name = wish.kind == HurtKind::kPush ? "simulator" : wish.process;
  const auto found = processes_.find(name);
  if (found == processes_.end())
    return refused("this flight has no process called \"" + name + "\": it has " + names());
  Process& process = found->second;
  if (wish.kind == HurtKind::kRestart) {
    process = {};
    process.ended = true;
    return {{}, RestartDeed{name}};
  }
  if (process.ended || seen.running.count(name) == 0) return refused(name + " has ended: restart it first");
  switch (wish.kind) {
    case HurtKind::kKill:
    case HurtKind::kStop:
    case HurtKind::kContinue:
      return signal(wish, process);
    default:
      break;
  }
  if (process.hangs) return refused(name + " hangs, and hears nothing: let it go on first");
  if (!seen.laboratory_listens) return refused("no process listens to the laboratory yet: ask again in a moment");
  return disturb(now, wish, name, process);
}

HurtVerdict HurtJudge::signal(const HurtRequest& wish, Process& process) const {
  const std::string& name = wish.process;
  using Kind = SignalDeed::Kind;
  if (wish.kind == HurtKind::kKill) {
    process = {};
    process.ended = true;
    return {{true, name + " was killed"}, SignalDeed{Kind::kKill, name}};
  }
  const bool stop = wish.kind == HurtKind::kStop;
  if (process.hangs == stop) return refused(name + (stop ? " hangs" : " runs") + " as it is: nothing changed");
  process.hangs = stop;
  if (stop) return {{true, name + " hangs"}, SignalDeed{Kind::kStop, name}};
  return {{true, name + " goes on"}, SignalDeed{Kind::kContinue, name}};
}

HurtVerdict HurtJudge::disturb(LocalTime now, const HurtRequest& wish, const std::string& name, Process& process) {
  const Disturbance asked = disturbance_of(wish, name);
  if (const auto why = objection(now, asked, process)) return refused(*why);
  if (asked.kind == DisturbanceKind::kLosePackets) {
    if (process.lossy_until && now >= *process.lossy_until) process.share = 0.0, process.lossy_until.reset();
    if (asked.share == process.share && asked.duration == Duration::zero()) {
      return refused(asked.share > 0.0 ? words_of(asked) + " as it is: nothing changed"
                                       : name + " loses no packet on purpose: nothing changed");
    }
    process.share = asked.share;
    process.lossy_until.reset();
    if (asked.duration > Duration::zero()) process.lossy_until = now + asked.duration;
  } else if (asked.kind == DisturbanceKind::kShiftClock) {
    process.shifted += asked.shift;
    // It counts on its own clock, which stands still for so long; ours goes on.
    if (asked.shift < Duration::zero()) process.stands_until = now - asked.shift + protocol::kBetweenShiftsBack;
  }
  return {{true, words_of(asked)}, asked};
}

std::optional<std::string> HurtJudge::objection(LocalTime now, const Disturbance& disturbance,
                                                const Process& process) const {
  if (!protocol::sane(disturbance)) return "that has a number in it that nothing can be";
  const bool stands_still = process.stands_until && now < *process.stands_until;
  if (auto why = protocol::objection(disturbance, {process.shifted, stands_still})) return why;
  if (disturbance.kind != DisturbanceKind::kPushLoad) return std::nullopt;
  return protocol::objection_to_push(disturbance.force_w_n, disturbance.duration, load_weight_n_);
}

Answer HurtJudge::restarted(const std::string& process, const std::optional<std::string>& failure) {
  if (failure) return {false, *failure + "; " + process + " has ended: restart it when that is mended"};
  processes_[process] = {};
  return {true, process + " was started anew"};
}

bool HurtJudge::meant(const std::string& process) const {
  const auto found = processes_.find(process);
  return found != processes_.end() && found->second.ended;
}

bool HurtJudge::hangs(const std::string& process) const {
  const auto found = processes_.find(process);
  return found != processes_.end() && found->second.hangs;
}

std::string HurtJudge::names() const {
  std::string all;
  for (const std::string& name : order_) all += (all.empty() ? "" : ", ") + name;
  return all.empty() ? "none" : all;
}

}  // namespace gyre::ground
