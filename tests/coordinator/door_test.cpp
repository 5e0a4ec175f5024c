// Counters from the wire: none makes a coordinator stand down, deaf, or its swarm unleadable.

#include <limits>

#include "common/protocol/term.hpp"
#include "tests/coordinator/flying.hpp"

namespace gyre::coordinator {
namespace {

using namespace test;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr std::uint64_t kLargest = std::numeric_limits<std::uint64_t>::max();

TEST(Door, AStatusOfALargeCountChangesNothing) {
  Flying swarm;
  const auto term = swarm.beacon->term;
  for (const std::uint64_t count : {kLargest, std::uint64_t{1} << 40}) {
    const std::vector<std::function<void(protocol::AgentStatus&)>> breakages = {
        [&](auto& s) { s.sequence = count; },    [&](auto& s) { s.term = count; },
        [&](auto& s) { s.confirmed = count; },   [&](auto& s) { s.course.revision = count; },
        [&](auto& s) { s.course.term = count; }, [&](auto& s) { s.incarnation = count; },
    };
    for (const auto& breakage : breakages) {
      protocol::AgentStatus broken = swarm.statuses.at(1);
      ++broken.sequence;
      breakage(broken);
      swarm.tell(broken);
      swarm.fly(seconds(1));
      ASSERT_FALSE(swarm.finished) << swarm.finished->text;
      EXPECT_FALSE(swarm.coordinator().complaint(swarm.now)) << *swarm.coordinator().complaint(swarm.now);
      EXPECT_EQ(swarm.pace(), 1.0);
    }
  }
  EXPECT_TRUE(says(swarm.command(protocol::CommandKind::kRelease), "done"));
  EXPECT_EQ(swarm.beacon->term, term);
}

TEST(Door, ABeaconOfALargeTermStandsNobodyDownUnlessItIsConfirmed) {
  Flying swarm;
  protocol::Beacon other = *swarm.beacon;
  other.term = other.course.term = kLargest;
  for (int i = 0; i < 20; ++i) swarm.tell(other);
  other.term = other.course.term = std::uint64_t{1} << 40;
  swarm.tell(other);
  swarm.fly(seconds(1));
  ASSERT_FALSE(swarm.finished) << swarm.finished->text;
  for (int i = 0; i < 2; ++i) swarm.tell(other);
  EXPECT_TRUE(swarm.finished) << "somebody really leads";
}

TEST(Door, ATermThatNobodyCanHaveIsNotRecoveredFrom) {
  Flying swarm;
  const auto term = swarm.beacon->term;
  swarm.stop_coordinator();
  swarm.fly(seconds(1));
  swarm.start_coordinator();
  protocol::AgentStatus broken = swarm.statuses.at(1);
  broken.term = kLargest;
  swarm.tell(broken);
  broken.term = std::uint64_t{1} << 40;
  swarm.tell(broken);
  swarm.fly(seconds(3));
  ASSERT_FALSE(swarm.finished) << swarm.finished->text;
  EXPECT_EQ(protocol::generation(swarm.beacon->term), protocol::generation(term) + 1);
}

TEST(Door, ASwarmThatHasSeenManyCoordinatorsIsRecovered) {
  Flying swarm;
  swarm.stop_coordinator();
  swarm.fly(seconds(1));
  const std::uint64_t many = std::uint64_t{5000} << protocol::kTermNonceBits;
  std::uint64_t led = 0;
  swarm.change_status = [&](protocol::AgentStatus& s) { s.term = std::max(s.term, led == 0 ? many : s.term); };
  swarm.start_coordinator();
  swarm.visit = [&] {
    if (swarm.coordinator().term() > 0) led = swarm.coordinator().term();
  };
  swarm.fly(seconds(4));
  ASSERT_FALSE(swarm.finished) << swarm.finished->text;
  EXPECT_EQ(protocol::generation(swarm.beacon->term), 5001U);
  EXPECT_EQ(swarm.statuses.at(1).term, swarm.beacon->term) << "its agents follow";
}

}  // namespace
}  // namespace gyre::coordinator
