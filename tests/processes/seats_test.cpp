// Programs that meet on one domain, a coordinator that is spoken to, and an agent that is offered too much.

#include <mutex>
#include <optional>

#include "common/dds/clock.hpp"
#include "common/dds/node.hpp"
#include "common/protocol/messages.hpp"
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

/// Nearly slack once in a period, with a length of 63/8 of the cycle's rate: its figures take a minute.
mechanics::CarrierSlice slow_to_judge(CarrierId carrier) {
  mechanics::CarrierSlice slice;
  slice.id = carrier;
  slice.particular_force_w_n = {1.1, 0.1, 0.1};
  slice.incoming = {{1.0, 0.0, 0.0}, 0.0, 1.0, 0.0};
  slice.outgoing = {{0.0, 1.0, 0.0}, 0.0, 0.0, 0.0};
  slice.rate_rad_s = 1.0;
  slice.law = mechanics::LengthLaw::sine({12.0, 0.1, {63, 8}, 0.3});
  return slice;
}

/// What agent 1 says, to one who may offer it plans.
class Offerer {
 public:
  explicit Offerer(int domain) : node_(std::move(dds::Node::open({{}, domain, "127.0.0.1", {}})).value()) {
    offers_ = node_->writer<protocol::PlanOffer>(kCarrier);
    node_->read<protocol::AgentStatus>(
        [this](protocol::AgentStatus s, LocalTime) {
          const std::lock_guard<std::mutex> lock(mutex_);
          status_ = std::move(s);
        },
        kCarrier);
    node_->read<protocol::HeldPlans>(
        [this](const protocol::HeldPlans& held, LocalTime) {
          const std::lock_guard<std::mutex> lock(mutex_);
          keeps_for_a_neighbour_ = !held.neighbour.empty();
        },
        kCarrier);
    node_->read<protocol::Setpoint>(
        [this](const protocol::Setpoint&, LocalTime arrived) {
          const std::lock_guard<std::mutex> lock(mutex_);
          if (setpoints_ > 0) longest_gap_ = std::max(longest_gap_, arrived - last_);
          last_ = arrived;
          ++setpoints_;
        },
        kCarrier);
  }

  void offer(const protocol::PlanOffer& offer) { offers_.write(offer); }
  [[nodiscard]] std::optional<protocol::AgentStatus> status() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return status_;
  }
  [[nodiscard]] bool keeps_for_a_neighbour() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return keeps_for_a_neighbour_;
  }
  [[nodiscard]] int setpoints() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return setpoints_;
  }
  /// Between two of them, the last one and now included.
  [[nodiscard]] Duration longest_gap() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return std::max(longest_gap_, dds::now() - last_);
  }
  void begin_to_measure() {
    const std::lock_guard<std::mutex> lock(mutex_);
    longest_gap_ = {};
    setpoints_ = 0;
    last_ = dds::now();
  }

  static constexpr CarrierId kCarrier = 1;

 private:
  mutable std::mutex mutex_;
  std::optional<protocol::AgentStatus> status_;
  bool keeps_for_a_neighbour_ = false;
  LocalTime last_{};
  Duration longest_gap_{};
  int setpoints_ = 0;
  dds::Writer<protocol::PlanOffer> offers_;
  std::unique_ptr<dds::Node> node_;  // gone first: its handlers write above
};

TEST_F(SeatsTest, AnAgentKeepsItsBeatWhileItJudgesAPlanAndMayEndMeanwhile) {
  Launched first = coordinator();
  std::vector<Launched> agents;
  for (const char* carrier : {"1", "2", "3", "4"}) agents.push_back(agent(carrier));
  Offerer offerer(std::stoi(domain));
  ASSERT_TRUE(holds_within(20.0, [&] { return offerer.setpoints() > 10 && offerer.keeps_for_a_neighbour(); }))
      << agents.front().said();
  const std::uint64_t term = offerer.status()->term;
  offerer.begin_to_measure();
  offerer.offer({Offerer::kCarrier, term, 50, {{{term, 50}, slow_to_judge(Offerer::kCarrier)}}, {}});
  ASSERT_TRUE(holds_within(10.0, [&] { return !offerer.keeps_for_a_neighbour(); })) << "it has heard the offer";
  std::this_thread::sleep_for(std::chrono::seconds(3));
  EXPECT_LT(seconds(offerer.longest_gap()), 0.5);
  EXPECT_GT(offerer.setpoints(), 250);
  EXPECT_EQ(offerer.status()->accepted.size(), 1U) << "there is a verdict already: this machine needs a slower plan";
  EXPECT_TRUE(offerer.status()->refused.none()) << "likewise";
  agents.front().send(SIGTERM);
  EXPECT_EQ(agents.front().end_within(5.0).exit_code, 0);
}

}  // namespace
}  // namespace gyre::test
