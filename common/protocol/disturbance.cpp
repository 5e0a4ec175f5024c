#include "common/protocol/disturbance.hpp"

#include <cstdlib>

#include "common/base/text.hpp"
#include "common/protocol/sanity.hpp"

namespace gyre::protocol {
namespace {

constexpr const char* kSimulator = "simulator";
constexpr Duration kComplaintPeriod = std::chrono::seconds(1);

std::optional<std::string> objection_to_loss(const Disturbance& d) {
  if (d.duration > kLongestLoss) return text("packets are lost for %.0f s at most", seconds(kLongestLoss));
  if (d.share > kMostLostForGood && d.duration == Duration::zero()) {
    return text("more than %.0f %% of the packets are lost for a while only: give a duration, %.0f s at most",
                100.0 * kMostLostForGood, seconds(kLongestLoss));
  }
  return std::nullopt;
}

std::optional<std::string> objection_to_push_time(Duration duration) {
  if (duration > Duration::zero() && duration <= kLongestPush) return std::nullopt;
  return text("a push of %.4g s; the load is pushed for more than 0 and at most %.0f s", seconds(duration),
              seconds(kLongestPush));
}

}  // namespace

bool names_process(const std::string& name) {
  if (name == "coordinator" || name == kSimulator) return true;
  // Written back and compared: "agent 03" and "agent 3 " are nobody.
  const std::string agent = "agent ";
  if (name.compare(0, agent.size(), agent) != 0 || name.size() > agent.size() + 3) return false;
  const int carrier = std::atoi(name.c_str() + agent.size());
  return carrier >= 1 && carrier <= static_cast<int>(kMaxCarrierId) && name == agent + std::to_string(carrier);
}

std::optional<std::string> objection(const Disturbance& d, const Suffered& so_far) {
  const bool simulator = d.process == kSimulator;
  switch (d.kind) {
    case DisturbanceKind::kLosePackets:
      return objection_to_loss(d);
    case DisturbanceKind::kShiftClock:
      if (simulator) return "the simulator's clock is the world's time; shift an agent's or the coordinator's";
      if (d.shift == Duration::zero() || d.shift > kFurthestShift || d.shift < -kFurthestShiftBack) {
        return text("a clock is shifted by %.0f s back to %.0f s on, and not by nothing", seconds(kFurthestShiftBack),
                    seconds(kFurthestShift));
      }
      if (so_far.shifted + d.shift > kFurthestClock || so_far.shifted + d.shift < -kFurthestClock) {
        return text("this clock has been shifted by %.0f s already; start the process again", seconds(so_far.shifted));
      }
      if (d.shift < Duration::zero() && so_far.stands_still) {
        return "this clock stands still as it is; shift it again when it goes";
      }
      return std::nullopt;
    case DisturbanceKind::kPushLoad:
      if (!simulator) return "only the simulator has a load to push";
      return objection_to_push_time(d.duration);
  }
  return "there is no such disturbance";
}

std::optional<std::string> objection_to_push(const Eigen::Vector3d& force_w_n, Duration duration, double weight_n) {
  // Not a > b, which would let through what is no number.
  if (!(force_w_n.norm() <= weight_n)) {
    return text("a push of %.4g N; the load weighs %.4g N, and is pushed by no more", force_w_n.norm(), weight_n);
  }
  return objection_to_push_time(duration);
}

Suffered DisturbanceJudge::suffered(LocalTime now) const {
  return {shifted_, shifted_back_at_ && now - *shifted_back_at_ < kBetweenShiftsBack};
}

Disturbing DisturbanceJudge::take(LocalTime now, const Disturbance& d) {
  Disturbing out;
  const auto refuse = [&](const std::string& why) {
    ++nonsense_;
    if (complained_at_ && now - *complained_at_ < kComplaintPeriod) return;
    complained_at_ = now;
    out.notices.push_back({Notice::Level::kWarning, "laboratory: a disturbance was dropped: " + why});
  };
  if (!sane(d) || !names_process(d.process)) {
    refuse("it names no process or has a number in it that nothing can be");
    return out;
  }
  if (d.process != process_) return out;
  if (const auto why = objection(d, suffered(now))) {
    refuse(*why);
    return out;
  }
  const auto say = [&](std::string words) { out.notices.push_back({Notice::Level::kWarning, std::move(words)}); };
  if (d.kind == DisturbanceKind::kLosePackets) {
    out.share = d.share;
    lossy_until_.reset();
    if (d.duration > Duration::zero()) lossy_until_ = now + d.duration;
    say(text("laboratory: %.4g %% of the packets are lost ", 100.0 * d.share) +
        (lossy_until_ ? text("for %.3g s", seconds(d.duration)) : "from now on"));
  } else if (d.kind == DisturbanceKind::kShiftClock) {
    out.shift = d.shift;
    shifted_ += d.shift;
    const bool back = d.shift < Duration::zero();
    if (back) shifted_back_at_ = now;
    // What is remembered as a time on this clock is as far away as it was.
    if (!back && lossy_until_) *lossy_until_ += d.shift;
    say(back ? text("laboratory: this process's clock stands still for %.6g s", seconds(-d.shift))
             : text("laboratory: this process's clock leaps by %.6g s", seconds(d.shift)));
  } else {
    out.push = d;  // the simulator says whether it is performed
  }
  return out;
}

Disturbing DisturbanceJudge::at(LocalTime now) {
  Disturbing out;
  if (!lossy_until_ || now < *lossy_until_) return out;
  lossy_until_.reset();
  out.share = 0.0;
  out.notices.push_back({Notice::Level::kWarning, "laboratory: no packet is lost on purpose any more"});
  return out;
}

}  // namespace gyre::protocol
