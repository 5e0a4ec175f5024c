// What an agent does with the lease: it stops by it when it hears nothing more, exactly as all the others do.

#include <gtest/gtest.h>

#include "tests/agent/one_agent.hpp"

namespace gyre::agent {
namespace {

class LeaseTest : public AgentTest {
 protected:
  void grant(Duration ahead) { course_->lease = swarm() + ahead; }

  /// At full pace, and nothing beside the plan.
  [[nodiscard]] bool in_full_motion() const {
    return off_the_plan_m() < 1e-9 && (setpoint_->velocity_w_m_s - planned().position_w_m.first).norm() < 1e-8 &&
           agent_->course().moment(setpoint_->swarm_time).pace == 1.0;
  }
};

TEST_F(LeaseTest, EndsInAStopWithoutACoordinator) {
  engage();
  grant(seconds(2));
  beacon();
  watch_for_steps();
  fly(milliseconds(1990), false);
  EXPECT_EQ(agent_->course().moment(setpoint_->swarm_time).pace, 1.0);
  fly(milliseconds(2100), false);
  EXPECT_EQ(setpoint_->velocity_w_m_s.norm(), 0.0);
  EXPECT_EQ(status_->state, AgentState::kAlone);
  // As if everybody had agreed to stop then, to the nanosecond.
  const protocol::Pace stopped = course_->pace.with_ramp(*course_->lease, course_->stopping, 0.0);
  for (SwarmTime t = *course_->lease; t < *course_->lease + seconds(3); t += milliseconds(7)) {
    EXPECT_LE(std::abs((agent_->course().moment(t).at - stopped.at(t).at).count()), 1);
  }
  const auto r =
      mechanics::evaluate(slice(kMotion), gyre::seconds(stopped.at(setpoint_->swarm_time).at - course_->base.epoch));
  EXPECT_LT((setpoint_->position_w_m - r.position_w_m.value).norm(), 1e-8);
}

TEST_F(LeaseTest, ExtendedInTimeChangesNothing) {
  engage();
  watch_for_steps();
  for (int i = 0; i < 100; ++i) {
    grant(milliseconds(500));
    fly(milliseconds(100));
    ASSERT_TRUE(in_full_motion()) << i;
  }
}

TEST_F(LeaseTest, MayGoBackAndIsThenTheEarlierOne) {
  engage();
  grant(seconds(3));
  beacon();
  grant(seconds(1));
  beacon();
  EXPECT_EQ(agent_->course().lease, course_->lease);
  fly(milliseconds(3100), false);
  EXPECT_EQ(setpoint_->velocity_w_m_s.norm(), 0.0);
}

TEST_F(LeaseTest, IsConfirmedAtOnce) {
  engage();
  grant(seconds(5));
  Outputs out = beacon();
  ASSERT_TRUE(out.status) << "the coordinator extends it only when all have said that they hold it";
  EXPECT_EQ(out.status->course.lease, course_->lease);
  now_ += milliseconds(1);
  EXPECT_FALSE(beacon().status) << "nothing is new";
}

TEST_F(LeaseTest, OfAnOlderCourseIsNotTaken) {
  engage();
  grant(seconds(5));
  beacon();
  const std::optional<SwarmTime> held = agent_->course().lease;
  const Course older = [this] {
    Course course = *course_;
    --course.revision;
    course.lease = swarm() + seconds(1);
    return course;
  }();
  tell(Beacon{kTerm, ++sequence_, swarm(), older, {}, {}});
  EXPECT_EQ(agent_->course().lease, held);
}

TEST_F(LeaseTest, StopsTwoAgentsIdenticallyHoweverTheyCameToKnowIt) {
  engage();
  // The one heard every word since the start, ramps and all. The other was started in flight, and had only a moment.
  const std::unique_ptr<Agent> other = new_agent(2);
  const Outputs offered = other->step(now_, plans({kMotion}));
  other->step(now_, judge(*offered.question));
  for (int i = 0; i < 100; ++i, now_ += milliseconds(10)) {
    grant(seconds(2));
    beacon();
    Course settled = *course_;
    protocol::settle(settled, swarm());
    if (i > 30) other->step(now_, Beacon{kTerm, sequence_, swarm(), settled, {}, {}});
    for (Agent* agent : {agent_.get(), other.get()}) {
      const Outputs out = agent->step(now_, Tick{});
      if (out.time_request) agent->step(now_, TimeReplyArrived{reply_to(*out.time_request), now_});
    }
  }
  ASSERT_EQ(agent_->course().lease, other->course().lease);
  ASSERT_TRUE(agent_->course().lease);
  const SwarmTime end = *agent_->course().lease;
  for (; swarm() < end + seconds(3); now_ += milliseconds(10)) {
    std::vector<protocol::Setpoint> flown;
    for (Agent* agent : {agent_.get(), other.get()}) {
      if (const Outputs out = agent->step(now_, Tick{}); out.setpoint) flown.push_back(*out.setpoint);
    }
    ASSERT_EQ(flown.size(), 2U);
    const SwarmTime now = swarm();
    EXPECT_LE(std::abs((agent_->course().moment(now).at - other->course().moment(now).at).count()), 1);
    EXPECT_LT((flown[0].position_w_m - flown[1].position_w_m).norm(), 1e-5) << "their clocks may differ a little";
  }
  EXPECT_TRUE(agent_->course().rests(swarm()));
  EXPECT_TRUE(other->course().rests(swarm()));
}

}  // namespace
}  // namespace gyre::agent
