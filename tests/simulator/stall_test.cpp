// A simulator that was stopped: what waited for it is stamped with the time at which it woke, and is not the present.

#include <gtest/gtest.h>

#include <cstdio>
#include <deque>

#include "common/mission/mission.hpp"
#include "simulator/core/simulator.hpp"
#include "simulator/core/stall_judge.hpp"
#include "tests/places.hpp"
#include "tests/simulator/agents.hpp"

namespace gyre::simulator {
namespace {

using rigs::Agents;
using std::chrono::milliseconds;
using std::chrono::seconds;

TEST(StallJudge, DoubtsForAWhileAfterAGapAndNeverOtherwise) {
  StallJudge judge;
  const auto at = [](int ms) { return LocalTime(milliseconds(ms)); };
  EXPECT_FALSE(judge.doubts(at(0)));
  for (int ms = 0; ms <= 1000; ms += 500) judge.awake(at(ms));
  EXPECT_FALSE(judge.doubts(at(1000))) << "a beat that is slow is none";
  judge.awake(at(990));
  judge.awake(at(1500));
  EXPECT_FALSE(judge.doubts(at(1500))) << "told in another order";
  judge.awake(at(2001));
  EXPECT_TRUE(judge.doubts(at(2001)));
  judge.awake(at(2100));
  EXPECT_TRUE(judge.doubts(at(2150)));
  EXPECT_FALSE(judge.doubts(at(2151)));
}

/// Multirotors at 1.5 m/s, whose simulator is stopped in full motion.
class Stall {
 public:
  /// Carriers' sockets keep so much: what comes later is lost.
  static constexpr Duration kRoom = milliseconds(300);
  static constexpr Duration kBegins = seconds(9);

  /// `succeeded`: the agent of the first carrier ends 0.1 s into the stall, and is started anew 0.4 s later.
  /// `read_in`: what waited is read from the sockets in so long, and what comes meanwhile waits behind it.
  Stall(const std::string& mission, Duration lasts, bool succeeded, Duration read_in = {})
      : lasts_(lasts),
        succeeded_(succeeded),
        read_in_(read_in),
        plan_(mission::read_mission_file(test::source_directory() + "/deploy/missions/" + mission + ".textproto")
                  .value()
                  .plan) {}

  /// How far the load moves.
  [[nodiscard]] double moved_mm() {
    for (std::size_t i = 0; i < agents_.count(); ++i) {
      (void)simulator_.step(LocalTime{}, agents_.status(i));
      (void)simulator_.step(LocalTime{}, agents_.held(i));
    }
    for (Duration t{}; t < kBegins + lasts_ + seconds(4); t += milliseconds(10)) {
      for (std::size_t i = 0; i < agents_.count(); ++i) {
        if (const auto setpoint = said(i, t)) hear(*setpoint, t);
      }
      if (stopped(t)) continue;
      for (std::size_t left = left_to_read(t); waited_.size() > left; waited_.pop_front()) {
        (void)simulator_.step(LocalTime(t), waited_.front());
      }
      // As a main does: before it looks at the world again, it hears what has arrived.
      (void)simulator_.step(LocalTime(t + milliseconds(5)), Advance{});
      const double moved_m = (simulator_.load().position_w_m - plan_.load.position_w_m).norm();
      furthest_m_ = std::max(furthest_m_, moved_m);
    }
    return 1e3 * furthest_m_;
  }

 private:
  [[nodiscard]] bool stopped(Duration t) const { return t >= kBegins && t < kBegins + lasts_; }

  /// Of what waits by then.
  [[nodiscard]] std::size_t left_to_read(Duration t) const {
    const Duration left = kBegins + lasts_ + read_in_ - t;
    if (left <= Duration::zero()) return 0;
    return waited_.size() - std::min<std::size_t>(waited_.size(), waited_.size() * milliseconds(10) / left + 1);
  }

  [[nodiscard]] std::optional<protocol::Setpoint> said(std::size_t carrier, Duration t) const {
    protocol::Setpoint s = agents_.setpoint(carrier, t);
    s.incarnation = 1;
    if (carrier != 0 || !succeeded_ || t < kBegins + milliseconds(100)) return s;
    if (t < kBegins + milliseconds(500)) return std::nullopt;
    s.incarnation = 2;
    return s;
  }

  void hear(const protocol::Setpoint& setpoint, Duration t) {
    if (!stopped(t) && waited_.empty()) {
      (void)simulator_.step(LocalTime(t), setpoint);
    } else if (!stopped(t) || t < kBegins + kRoom) {
      waited_.push_back(setpoint);
    }
  }

  Duration lasts_;
  bool succeeded_;
  Duration read_in_;
  mechanics::Plan plan_;
  Agents agents_{plan_, 8.0};
  Simulator simulator_ = Simulator::create(plan_, {}, LocalTime{}).value();
  std::deque<protocol::Setpoint> waited_;
  double furthest_m_ = 0.0;
};

TEST(Stalled, DoesNotTakeWhatWaitedForThePresentHoweverLongItLasted) {
  for (const Duration lasts : {milliseconds(200), milliseconds(450), milliseconds(700), milliseconds(1100),
                               milliseconds(3000), milliseconds(6000)}) {
    const double moved_mm = Stall("hex-multirotor", lasts, false).moved_mm();
    const double succeeded_mm = Stall("hex-multirotor", lasts, true).moved_mm();
    std::printf("  stopped for %.2f s: the load moves %.3f mm; %.3f mm where an agent was started anew meanwhile\n",
                gyre::seconds(lasts), moved_mm, succeeded_mm);
    EXPECT_LT(moved_mm, 0.02) << gyre::seconds(lasts);
    EXPECT_LT(succeeded_mm, 0.02) << gyre::seconds(lasts);
  }
}

TEST(Stalled, DoesNotTakeItForThePresentHoweverLongItTakesToReadIt) {
  for (const Duration read_in : {milliseconds(100), milliseconds(200), milliseconds(400), milliseconds(1000)}) {
    const double moved_mm = Stall("hex-multirotor", milliseconds(1200), false, read_in).moved_mm();
    const double succeeded_mm = Stall("hex-multirotor", milliseconds(1200), true, read_in).moved_mm();
    std::printf("  read in %.1f s: the load moves %.3f mm; %.3f mm where an agent was started anew meanwhile\n",
                gyre::seconds(read_in), moved_mm, succeeded_mm);
    EXPECT_LT(moved_mm, 0.02) << gyre::seconds(read_in);
    EXPECT_LT(succeeded_mm, 0.02) << gyre::seconds(read_in);
  }
}

TEST(Stalled, ASetpointThatIsOldOnArrivalLeadsNobodyAstray) {
  // Whose winches and vehicles lag: what is extrapolated over a sixth of a second is off by centimetres.
  const double moved_mm = Stall("multirotor-octet", milliseconds(450), false).moved_mm();
  std::printf("  stopped for 0.45 s, machines that lag: %.3f mm\n", moved_mm);
  EXPECT_LT(moved_mm, 0.2);
}

}  // namespace
}  // namespace gyre::simulator
