#include "ground/flight/hurting.hpp"

#include <algorithm>
#include <csignal>
#include <utility>

#include "common/base/text.hpp"
#include "common/protocol/disturbance.hpp"

namespace gyre::ground {
namespace {

/// A link that is cut heals by itself: nobody could tell its process any more that it is over.
constexpr Duration kCutOff = std::chrono::seconds(10);

}  // namespace

Hurting::Hurting(dds::Node& node, Supervisor& supervisor, std::vector<Program> programs)
    : laboratory_(node.writer<protocol::Disturbance>()), supervisor_(supervisor), programs_(std::move(programs)) {}

Answer Hurting::perform(const HurtRequest& wish) {
  switch (wish.kind) {
    case HurtKind::kLose:
    case HurtKind::kShiftClock:
    case HurtKind::kPush:
      return disturb(wish);
    default:
      return to_process(wish);
  }
}

Answer Hurting::disturb(const HurtRequest& wish) {
  protocol::Disturbance disturbance;
  disturbance.process = wish.kind == HurtKind::kPush ? "simulator" : wish.process;
  if (!supervisor_.pid(disturbance.process)) {
    return {false, "no process called \"" + disturbance.process + "\" runs"};
  }
  std::string done;
  if (wish.kind == HurtKind::kLose) {
    disturbance.kind = protocol::DisturbanceKind::kLosePackets;
    disturbance.share = wish.amount / 100.0;
    done = text("%s loses %.0f %% of its packets", wish.process.c_str(), wish.amount);
    if (disturbance.share > protocol::kMostLostForGood) {
      disturbance.duration = kCutOff;
      done += text(" for %.0f s", seconds(kCutOff));
    }
  } else if (wish.kind == HurtKind::kShiftClock) {
    disturbance.kind = protocol::DisturbanceKind::kShiftClock;
    disturbance.shift = from_seconds(wish.amount);
    if (wish.process == "simulator") return {false, "the simulator's clock is the world's time"};
    if (disturbance.shift > protocol::kFurthestShift || disturbance.shift < -protocol::kFurthestShiftBack) {
      return {false, text("a clock is shifted by -%.0f to %.0f s", seconds(protocol::kFurthestShiftBack),
                          seconds(protocol::kFurthestShift))};
    }
    done = text("the clock of %s was shifted by %+.3g s", wish.process.c_str(), wish.amount);
  } else {
    disturbance.kind = protocol::DisturbanceKind::kPushLoad;
    disturbance.force_w_n = wish.force_w_n;
    disturbance.duration = from_seconds(wish.duration_s);
    done = text("the load was pushed with %.3g N for %.2g s", wish.force_w_n.norm(), wish.duration_s);
  }
  laboratory_.write(disturbance);
  return {true, done};
}

Answer Hurting::to_process(const HurtRequest& wish) {
  const auto program =
      std::find_if(programs_.begin(), programs_.end(), [&](const Program& one) { return one.name == wish.process; });
  if (program == programs_.end()) return {false, "this flight has no process called \"" + wish.process + "\""};
  const std::string& name = program->name;
  if (wish.kind == HurtKind::kRestart) return restart(*program);
  if (!supervisor_.pid(name)) return {false, name + " has ended: restart it first"};
  switch (wish.kind) {
    case HurtKind::kKill:
      killed_.insert(name);
      stopped_.erase(name);
      supervisor_.send(name, SIGKILL);
      return {true, name + " was killed"};
    case HurtKind::kStop:
      stopped_.insert(name);
      supervisor_.send(name, SIGSTOP);
      return {true, name + " hangs"};
    case HurtKind::kContinue:
      stopped_.erase(name);
      supervisor_.send(name, SIGCONT);
      return {true, name + " goes on"};
    default:
      return {false, "nobody knows how"};
  }
}

Answer Hurting::restart(const Program& program) {
  killed_.insert(program.name);
  stopped_.erase(program.name);
  const Result<pid_t> started = supervisor_.restart(program);
  if (!started) return {false, started.error().text};
  killed_.erase(program.name);
  return {true, program.name + " was started anew"};
}

std::vector<OwnProcess> Hurting::processes() {
  std::vector<OwnProcess> out;
  for (const Program& program : programs_) {
    const auto pid = supervisor_.pid(program.name);
    out.push_back({program.name, pid.value_or(0), pid && stopped_.count(program.name) > 0});
  }
  return out;
}

}  // namespace gyre::ground
