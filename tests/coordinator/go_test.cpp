// Nobody is heard at the moment of a go: what nobody has begun is as if it had never been, and what all have is not
// turned back.

#include <gtest/gtest.h>

#include "common/protocol/follow.hpp"
#include "tests/coordinator/flying.hpp"

namespace gyre::coordinator {
namespace {

using protocol::CommandKind;
using protocol::Wisher;
using std::chrono::milliseconds;
using std::chrono::seconds;
using test::flies_on;
using test::Flying;
using test::heal;
using test::job;
using test::says;
using test::SwarmOfAgents;

protocol::Command release() {
  protocol::Command command;
  command.id = 77;
  command.kind = CommandKind::kRelease;
  return command;
}

/// From now on, of any setpoint, and all fly one phase.
void expect_no_leaps(SwarmOfAgents& swarm) {
  swarm.visit = [&swarm, last = swarm.setpoints]() mutable {
    for (const auto& [id, s] : swarm.setpoints) {
      const double dt = gyre::seconds(s.swarm_time - last[id].swarm_time);
      EXPECT_LT((s.position_w_m - last[id].position_w_m - dt * s.velocity_w_m_s).norm(), 1e-3);
      last[id] = s;
    }
    swarm.expect_one_phase(seconds(2));
  };
}

TEST(Go, ThatNobodyHearsMakesTheChangeOneThatNeverWas) {
  for (const bool for_ever : {true, false}) {
    SCOPED_TRACE(for_ever);
    Flying swarm(for_ever ? flies_on() : job());
    const std::uint64_t before = swarm.statuses[1].confirmed;
    swarm.tell(release());
    swarm.fly_until([&] { return swarm.statuses[4].confirmed > before; });
    swarm.mute = swarm.deaf = {1, 2, 3, 4};
    swarm.fly(seconds(4));
    EXPECT_FALSE(swarm.rests()) << "nobody heard of it: it is not said any more";
    EXPECT_EQ(swarm.pace(), 1.0);
    swarm.fly(seconds(for_ever ? 20 : 0));
    expect_no_leaps(swarm);
    heal(swarm);
    swarm.fly(milliseconds(400));
    EXPECT_TRUE(swarm.moves());
    swarm.fly(seconds(12));
    EXPECT_TRUE(swarm.rests()) << "it is wished for, and agreed anew";
    EXPECT_FALSE(swarm.moves());
    EXPECT_EQ(swarm.course().wish.by, Wisher::kPerson);
    for (const protocol::CommandReply& r : swarm.replies) EXPECT_FALSE(r.id == release().id && r.done) << r.text;
  }
}

TEST(Go, ThatNobodyHearsIsNoPlaceToBeginAnotherChangeFrom) {
  for (const CommandKind kind : {CommandKind::kFreeze, CommandKind::kPace}) {
    Flying swarm(flies_on());
    const std::uint64_t before = swarm.statuses[1].confirmed;
    swarm.tell(release());
    swarm.fly_until([&] { return swarm.statuses[4].confirmed > before; });
    swarm.mute = swarm.deaf = {1, 2, 3, 4};
    swarm.fly(seconds(20));
    expect_no_leaps(swarm);
    heal(swarm);
    swarm.fly(milliseconds(300));  // they are heard again, and it is still to be seen who began
    protocol::Command next;
    next.id = 78;
    next.kind = kind;
    next.pace = 0.5;
    swarm.tell(next);
    swarm.fly(seconds(15));
  }
}

TEST(Go, AfterWhichNobodyIsHeardLeavesWhatAllHaveBegun) {
  Flying swarm(flies_on());
  const std::uint64_t before = swarm.statuses[1].confirmed;
  const std::uint64_t revision = swarm.course().revision;
  swarm.tell(release());
  swarm.fly_until([&] { return swarm.statuses[4].confirmed > before; });
  swarm.mute = {1, 2, 3, 4};  // they hear the go, and nobody hears that they do
  swarm.fly_until([&] { return swarm.agent(4).course().revision > revision; });
  swarm.deaf = {1, 2, 3, 4};
  swarm.fly(seconds(3));
  for (const CarrierId id : {1U, 2U, 3U, 4U}) {
    swarm.mute.erase(id);  // one after the other
    swarm.fly(milliseconds(80));
  }
  heal(swarm);
  expect_no_leaps(swarm);
  swarm.fly(seconds(6));
  EXPECT_FALSE(says(swarm.news, "turning back")) << swarm.news;
  EXPECT_TRUE(swarm.rests());
  EXPECT_FALSE(swarm.moves());
}

TEST(Go, ThatAnAgentDiesBeforeIsNoReasonToTakeItsVehicleForStuck) {
  Job slow = job();
  slow.plan.cycle.rate_rad_s *= 0.3;
  Flying swarm(slow);
  const auto slices = mechanics::slices(slow.plan);
  std::optional<protocol::Course> last;  // of agent 3, which its vehicle goes on along
  const auto tell = [&](CarrierId id, const Eigen::Vector3d& position, const Eigen::Vector3d& velocity) {
    protocol::CarrierState state;
    state.carrier = id;
    state.incarnation = 1;
    state.position_w_m = position;
    state.velocity_w_m_s = velocity;
    swarm.tell(state);
  };
  swarm.visit = [&, confirmed = swarm.statuses[3].confirmed] {
    if (!last && swarm.statuses[3].confirmed > confirmed) {
      last = swarm.agent(3).course();
      swarm.stop_agent(3);
    }
    for (const auto& [id, s] : swarm.setpoints) {
      if (id != 3 || !last) tell(id, s.position_w_m, s.velocity_w_m_s);
    }
    if (!last) return;
    const auto r = protocol::reference(*last, swarm.beacon->swarm_time, [&](const auto&) { return &slices.at(2); });
    tell(3, r->position_w_m.value, r->position_w_m.first);
  };
  Job quick = job();  // by which the others make more than twice the way, before they turn back
  quick.transition = seconds(1);
  EXPECT_TRUE(says(swarm.retune(quick, milliseconds(1800)), "turning back"));
  swarm.fly(seconds(12));
  EXPECT_FALSE(says(swarm.news, "has left its path")) << swarm.news;
  EXPECT_TRUE(says(swarm.news, "the lease ended")) << swarm.news;
}

}  // namespace
}  // namespace gyre::coordinator
