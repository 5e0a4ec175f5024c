// Programs that meet on one domain, and a coordinator that is spoken to.

#include "common/dds/node.hpp"
#include "tests/processes/launched.hpp"

namespace gyre::test {
namespace {

using testing::HasSubstr;

class SeatsTest : public ProgramsTest {
 protected:
  /// A domain that nobody is on; other programs run on this machine.
  std::string domain = [] {
    for (int d = 60; d < dds::kMaxDomain; ++d) {
      const auto taken = [d](dds::Hub hub) { return dds::seat_holder({hub, std::nullopt}, d).taken; };
      if (!taken(dds::Hub::kCoordinator) && !taken(dds::Hub::kGround)) return std::to_string(d);
    }
    return std::string("99");
  }();

  Launched coordinator() { return launch({built("gyre-coordinator"), quick_mission(), "--domain", domain}); }
  Launched agent(const std::string& carrier) {
    return launch({built("gyre-agent"), "--carrier", carrier, "--domain", domain});
  }
  [[nodiscard]] bool seated(const dds::Seat& seat) const {
    return holds_within(10.0, [&] { return dds::seat_holder(seat, std::stoi(domain)).taken; });
  }
};

TEST_F(SeatsTest, TheSecondCoordinatorNamesTheFirst) {
  Launched first = coordinator();
  ASSERT_TRUE(seated({dds::Hub::kCoordinator, std::nullopt})) << first.said();
  Launched second = coordinator();
  EXPECT_EQ(second.end_within(10.0).exit_code, 1);
  EXPECT_THAT(second.said(), HasSubstr("pid " + std::to_string(first.pid()) + " (gyre-coordinator)"));
  first.send(SIGTERM);
  EXPECT_EQ(first.end_within(30.0).exit_code, 0) << first.said();
}

TEST_F(SeatsTest, TheSecondAgentOfACarrierNamesTheFirst) {
  Launched first = agent("3");
  ASSERT_TRUE(seated({std::nullopt, CarrierId{3}})) << first.said();
  Launched second = agent("3");
  EXPECT_EQ(second.end_within(10.0).exit_code, 1);
  EXPECT_THAT(second.said(), HasSubstr("pid " + std::to_string(first.pid()) + " (gyre-agent)"));
  first.send(SIGTERM);
  EXPECT_EQ(first.end_within(10.0).exit_code, 0) << first.said();
}

TEST_F(SeatsTest, AnAgentKeepsItsFlightsDomainFromOthers) {
  Launched lonely = agent("2");
  ASSERT_TRUE(seated({std::nullopt, CarrierId{2}})) << lonely.said();
  Launched flight = gyre({"fly", quick_mission(), "--domain", domain});
  EXPECT_EQ(flight.end_within(10.0).exit_code, 1);
  EXPECT_THAT(flight.said(), HasSubstr("pid " + std::to_string(lonely.pid()) + " (gyre-agent) is the agent 2 there"));
}

TEST_F(SeatsTest, ACommandWithoutACoordinatorSaysSo) {
  Launched release = gyre({"release", "--domain", domain});
  EXPECT_EQ(release.end_within(15.0).exit_code, 1);
  EXPECT_THAT(release.said(), HasSubstr("No coordinator answered on domain " + domain));
}

TEST_F(SeatsTest, ACommandOnTheWrongDomainIsToldTheRightOne) {
  Launched first = coordinator();
  ASSERT_TRUE(seated({dds::Hub::kCoordinator, std::nullopt})) << first.said();
  Launched release = gyre({"release", "--domain", "59"});
  EXPECT_EQ(release.end_within(15.0).exit_code, 1);
  EXPECT_THAT(release.said(), HasSubstr("domain " + domain + ": pid " + std::to_string(first.pid())));
}

TEST_F(SeatsTest, TheCoordinatorRefusesWhatIsRefused) {
  Launched refused = launch({built("gyre-coordinator"), shipped_mission("single"), "--domain", domain});
  EXPECT_EQ(refused.end_within(10.0).exit_code, 1);
  EXPECT_THAT(refused.said(), HasSubstr("one-carrier impossibility"));
  Launched bad = launch({built("gyre-coordinator"), directory() + "/nowhere", "--domain", domain});
  EXPECT_EQ(bad.end_within(10.0).exit_code, 2);
}

}  // namespace
}  // namespace gyre::test
