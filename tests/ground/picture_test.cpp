// What a person reads of a swarm at a glance: what it flies, what it is to do, who wished it, and how long it runs on.

#include <gtest/gtest.h>

#include <sstream>

#include "ground/swarm/core/course_line.hpp"
#include "ground/swarm/core/swarm_picture.hpp"

namespace gyre::ground {
namespace {

using protocol::Wisher;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr protocol::PlanNumber kMission{0x30000, 2}, kOther{0x30000, 7};
constexpr SwarmTime kNow{seconds(5000)};

class PictureTest : public testing::Test {
 protected:
  PictureTest() {
    beacon_.swarm_time = kNow;
    beacon_.course.base.number = kMission;
    status_.plan = kMission;
  }
  void pace(double pace) {
    beacon_.course.pace = {{{SwarmTime{}, Duration{}, {PlanTime(seconds(100)), pace, 0.0, 0.0}, pace}}};
  }
  void ramp(Duration from_now, Duration duration, double target) {
    beacon_.course.pace = beacon_.course.pace.with_ramp(kNow + from_now, duration, target);
  }
  [[nodiscard]] std::string course() const { return course_line(beacon_, status_); }
  [[nodiscard]] std::string line(const std::string& start) const {
    SwarmView view;
    view.step(LocalTime{}, status_);
    view.step(LocalTime{}, beacon_);
    std::istringstream lines(table(view, LocalTime{}));
    for (std::string line; std::getline(lines, line);) {
      if (line.rfind(start, 0) == 0) return line.substr(start.size());
    }
    return "no such line";
  }
  [[nodiscard]] std::string wish() const { return line("  wish     "); }

  protocol::Beacon beacon_;
  protocol::CoordinatorStatus status_;
};

TEST_F(PictureTest, APaceHasAName) {
  EXPECT_EQ(course(), "rest");
  pace(0.25);
  EXPECT_EQ(course(), "motion at 25 %");
  pace(1.0);
  EXPECT_EQ(course(), "motion");
}

TEST_F(PictureTest, ARampIsToldFromWhereToWhereAndHowFar) {
  ramp(seconds(-1), seconds(4), 1.0);
  EXPECT_EQ(course(), "rest -> motion (25 %)");
  pace(1.0);
  ramp(seconds(1), seconds(4), 0.5);
  EXPECT_EQ(course(), "motion -> motion at 50 % (0 %)") << "announced, and not begun";
  beacon_.swarm_time += seconds(9);
  EXPECT_EQ(course(), "motion at 50 %");
}

TEST_F(PictureTest, TheEndOfALeaseIsARampToRest) {
  pace(1.0);
  beacon_.course.lease = kNow - milliseconds(500);
  beacon_.course.stopping = seconds(2);
  EXPECT_EQ(course(), "motion -> rest (25 %)");
  beacon_.swarm_time += seconds(2);
  EXPECT_EQ(course(), "rest");
}

TEST_F(PictureTest, ATransitionCountsInPlanTime) {
  pace(0.5);
  const PlanTime at = beacon_.course.moment(kNow).at;
  beacon_.course.transitions = {{{kOther, PlanTime{}}, at, seconds(4)}};
  beacon_.swarm_time += seconds(2);
  EXPECT_EQ(course(), "motion at 50 %, going over to plan 3.7 (25 %)");
  beacon_.course.base.number = kOther;
  beacon_.course.transitions.front().to.number = kMission;
  EXPECT_EQ(course(), "motion at 50 % by plan 3.7, going over to the mission's (25 %)");
}

TEST_F(PictureTest, AProposalIsOnlyProposed) {
  beacon_.proposal = beacon_.course;
  EXPECT_EQ(course(), "rest, a change is proposed");
}

TEST_F(PictureTest, TellsWhatIsWishedAndByWhom) {
  const auto with = [this](const protocol::Wish& wished) {
    beacon_.course.wish = wished;
    return wish().substr(0, wish().find(';'));
  };
  EXPECT_EQ(with({0.0, false, Wisher::kNobody}), "rest, for nobody has wished anything yet");
  EXPECT_EQ(with({1.0, false, Wisher::kStart}), "motion, as the coordinator was started to");
  EXPECT_EQ(with({0.5, false, Wisher::kPerson}), "motion at 50 %, as a person asked");
  EXPECT_EQ(with({1.0, true, Wisher::kPerson}), "motion, then rest, as a person asked");
  EXPECT_EQ(with({0.0, false, Wisher::kSilence}), "rest, since somebody fell silent");
}

TEST_F(PictureTest, TellsThePaceAndHowLongTheLeaseRuns) {
  beacon_.course.wish = {1.0, false, Wisher::kPerson};
  pace(0.5);
  EXPECT_EQ(wish(), "motion, as a person asked; the pace is 50 %; no lease, it flies on without a word");
  beacon_.course.lease = kNow + milliseconds(4900);
  EXPECT_EQ(wish(), "motion, as a person asked; the pace is 50 %; the lease runs for another 4.9 s");
  beacon_.swarm_time += seconds(9);
  EXPECT_EQ(wish(), "motion, as a person asked; the pace is 0 %; the lease ended 4.1 s ago");
}

TEST_F(PictureTest, WithoutABeaconNothingIsWished) {
  SwarmView view;
  view.step(LocalTime{}, status_);
  EXPECT_EQ(table(view, LocalTime{}).find("wish"), std::string::npos) << table(view, LocalTime{});
}

}  // namespace
}  // namespace gyre::ground
