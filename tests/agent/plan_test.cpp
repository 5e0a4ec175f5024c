// Plans are judged beside the agent's beat: what it does until the verdict, and with one that comes late.

#include "common/mechanics/orbit_figures.hpp"
#include "tests/agent/one_agent.hpp"

namespace gyre::agent {
namespace {

constexpr PlanNumber kNew{kTerm, 3};

class PlanTest : public AgentTest {
 protected:
  void rest_and_judge_late() {
    rest();
    judges_at_once_ = false;
  }
  [[nodiscard]] bool accepts(const PlanNumber& number) const {
    return std::find(status_->accepted.begin(), status_->accepted.end(), number) != status_->accepted.end();
  }
  /// Number `count` of plans that nobody means.
  [[nodiscard]] static PlanNumber junk(std::uint64_t count) { return {kTerm, 100 + count}; }
  /// One that is slower than kOther cannot fly it.
  void restart_weak() {
    mechanics::Limits weak;
    weak.speed_max_m_s = 1.1 * mechanics::orbit_figures(slice(kMotion)).speed_m_s.max;
    restart(2, weak);
  }
};

TEST_F(PlanTest, FliesOnWhileAPlanIsJudgedAndAnswersWhenItIs) {
  engage();
  judges_at_once_ = false;
  watch_for_steps();
  int setpoints = 0;
  const auto steps = visit_;
  visit_ = [&](const protocol::Setpoint& s) { steps(s), ++setpoints; };
  const Outputs offered = offer({kMotion, kOther, kNew});
  ASSERT_TRUE(offered.question);
  EXPECT_EQ(offered.question->plan.number, kNew);
  EXPECT_FALSE(offered.held) << "nothing new is held yet";
  proposal_ = with_transition(kNew, seconds(3), seconds(2));
  fly(seconds(2));
  EXPECT_EQ(setpoints, 200);
  EXPECT_FALSE(accepts(kNew));
  EXPECT_NE(status_->confirmed, proposal_->revision);
  const Outputs judged = tell(judge(*question_));
  ASSERT_TRUE(judged.held && judged.status) << "its word is waited for";
  EXPECT_EQ(judged.held->slices.back().number, kNew);
  EXPECT_TRUE(accepts(kNew));
  EXPECT_EQ(judged.status->confirmed, proposal_->revision) << "as far as it has heard";
  EXPECT_FALSE(judged.question);
}

TEST_F(PlanTest, AVerdictOnWhatIsNotOfferedAnyMoreIsWorthNothing) {
  rest_and_judge_late();
  offer({kMotion, kOther, kNew});
  offer({kMotion, kOther});
  const Outputs late = tell(judge(*question_));
  EXPECT_FALSE(late.held || late.status || late.question);
  fly(milliseconds(200));
  EXPECT_FALSE(accepts(kNew));
  EXPECT_EQ(offer({kMotion, kOther, kNew}).question->plan.number, kNew) << "offered again, it is asked for again";
}

TEST_F(PlanTest, AVerdictIsForWhatWasJudgedNotForItsNumber) {
  rest_and_judge_late();
  protocol::PlanOffer changed = plans({kMotion, kOther, kNew});
  changed.slices.back().slice = slice(kOther);
  tell(changed);
  EXPECT_FALSE(offer({kMotion, kOther, kNew}).question) << "one at a time";
  const Outputs late = tell(judge(*question_));
  EXPECT_FALSE(late.held);
  ASSERT_TRUE(late.question);
  EXPECT_TRUE(late.question->plan.slice == slice(kNew));
  answer();
  EXPECT_TRUE(held_->slices.back().slice == slice(kNew));
}

TEST_F(PlanTest, OffersAndVerdictsThatComeTwiceCountOnce) {
  rest_and_judge_late();
  const protocol::PlanOffer once = plans({kMotion, kOther, kNew, {kTerm, 4}});
  ASSERT_TRUE(tell(once).question);
  EXPECT_FALSE(tell(once).question);
  const PlanVerdict verdict = judge(*question_);
  EXPECT_TRUE(tell(verdict).question) << "the other one";
  const Outputs again = tell(verdict);
  EXPECT_FALSE(again.held || again.status || again.question);
  answer();
  EXPECT_EQ(status_->accepted.size(), 4U);
  EXPECT_FALSE(tell(once).question);
}

TEST_F(PlanTest, AnHonestPlanIsNextHoweverMuchJunkCameBefore) {
  rest_and_judge_late();
  int questions = 0;
  std::uint64_t count = 0;
  for (int offers = 0; offers < 50; ++offers) {
    std::vector<PlanNumber> numbers;
    while (numbers.size() < protocol::kMaxPlans) numbers.push_back(junk(++count));
    questions += offer(numbers).question ? 1 : 0;
  }
  EXPECT_EQ(questions, 1) << "one at a time";
  offer({kMotion, kOther, kNew});
  const Outputs judged = tell(judge(*question_));
  EXPECT_EQ(judged.question->plan.number, kOther) << "what the flood had washed away";
  answer();
  answer();
  EXPECT_EQ(status_->accepted, (std::vector<PlanNumber>{kMotion, kOther, kNew}));
  EXPECT_FALSE(question_);
}

TEST_F(PlanTest, AnHonestPlanIsNotKeptWaitingByJunkBesideIt) {
  rest_and_judge_late();
  std::uint64_t count = 0;
  for (std::size_t verdicts = 0; verdicts < protocol::kMaxPlans; ++verdicts) {
    std::vector<PlanNumber> numbers;
    while (numbers.size() + 1 < protocol::kMaxPlans) numbers.push_back(junk(++count));
    numbers.push_back(kNew);
    offer(numbers);
    answer();
  }
  EXPECT_TRUE(accepts(kNew)) << "first offered, first judged";
}

TEST_F(PlanTest, ARefusalThatComesLateIsSaidInWordsAndOnce) {
  restart_weak();
  rest_and_judge_late();
  heard_.clear();
  protocol::PlanOffer two = plans({kMotion, kNew, {kTerm, 4}});
  two.slices[1].slice = two.slices[2].slice = slice(kOther);
  tell(two);
  fly(seconds(1));
  EXPECT_EQ(status_->refused, kOther) << "so far";
  const Outputs judged = tell(judge(*question_));
  ASSERT_TRUE(judged.status) << "its word is waited for";
  EXPECT_EQ(judged.status->refused, kNew);
  EXPECT_NE(judged.status->refusal.find("speed"), std::string::npos);
  EXPECT_NE(heard_.find("plan refused"), std::string::npos);
  answer();
  EXPECT_EQ(status_->refused, (PlanNumber{kTerm, 4}));
  EXPECT_FALSE(question_) << "neither is judged again";
  EXPECT_FALSE(tell(two).question);
  EXPECT_FALSE(accepts(kNew));
  two.sequence = plans({}).sequence + 1;
  offer({kMotion});
  EXPECT_TRUE(tell(two).question) << "nothing is kept of what is not offered any more";
}

TEST_F(PlanTest, WhatWasRefusedUnderANumberDoesNotSpoilIt) {
  restart_weak();
  rest();
  protocol::PlanOffer lie = plans({kMotion, kNew});
  lie.slices[1].slice = slice(kOther);
  tell(lie);
  ASSERT_EQ(status_->refused, kNew);
  offer({kMotion, kNew});
  EXPECT_TRUE(accepts(kNew));
  EXPECT_TRUE(status_->refused.none());
}

TEST_F(PlanTest, AVerdictThatComesUnderANewCoordinatorIsToldToThatOne) {
  rest_and_judge_late();
  offer({kMotion, kOther, kNew});
  term_ = 2 * kTerm;
  beacon();
  const Outputs late = tell(judge(*question_));
  ASSERT_TRUE(late.status && late.held) << "it learns the plans from the agents";
  EXPECT_EQ(late.status->term, 2 * kTerm);
  EXPECT_TRUE(accepts(kNew));
  offer({kMotion, kOther, {term_, 5}}, term_);
  EXPECT_FALSE(accepts(kNew)) << "it offers others";
  answer();
  EXPECT_TRUE(accepts({term_, 5}));
}

TEST_F(PlanTest, ItsWinchAndItsThrustAreJudgedAsItsOwnerSays) {
  const mechanics::CarrierFigures figures =
      mechanics::orbit_figures(slice(kMotion), mechanics::VehicleWeight{1.0, 9.80665});
  const auto verdict = [this](const Machines& machines, const mechanics::Limits& limits = {}) {
    return judge({{kMotion, slice(kMotion)}, limits, machines}).figures;
  };
  EXPECT_TRUE(verdict({}));
  const double thrust_n = figures.thrust_max_n.value();
  EXPECT_TRUE(verdict({{}, {0.0, 1.0, 1.01 * thrust_n, std::nullopt}}));
  EXPECT_FALSE(verdict({{}, {0.0, 1.0, 0.99 * thrust_n, std::nullopt}}));
  EXPECT_FALSE(verdict({{}, {0.0, 1.0, std::nullopt, 0.99 * figures.bank_max_rad.value()}}));
  mechanics::Limits shortest;
  shortest.length_min_m = 0.5 * (figures.paid_out_m.min + figures.length_m.min);
  EXPECT_FALSE(verdict({}, shortest)) << "of what is paid out, too";
}

}  // namespace
}  // namespace gyre::agent
