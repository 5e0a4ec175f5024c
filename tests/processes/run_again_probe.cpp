// Tests that fail as often as they are told, for run_again_test, each with the processor taken from it by somebody
// else.
//
// They have it before everybody but the one who is to take it: what they see is the same on a busy machine.

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

void compute_for(Clock::duration time) {
  const Clock::time_point end = Clock::now() + time;
  while (Clock::now() < end) {
  }
}

/// Among those who go before all without such a right, the higher first.
void go_before_others(int right) {
  sched_param parameter{};
  parameter.sched_priority = right;
  ASSERT_EQ(::sched_setscheduler(0, SCHED_FIFO, &parameter), 0);
}

class Probe : public testing::Test {
 protected:
  void SetUp() override { go_before_others(2); }
  void TearDown() override {
    go_before_others(1);
    // What a main loop does.
    const Clock::time_point end = Clock::now() + milliseconds(500);
    for (Clock::time_point tick = Clock::now(); tick < end; tick = Clock::now()) {
      compute_for(milliseconds(1));
      std::this_thread::sleep_until(tick + milliseconds(10));
    }
    const std::string runs = std::getenv("PROBE_RUNS");
    std::ofstream(runs, std::ios::app) << '.' << std::flush;
    EXPECT_GT(std::filesystem::file_size(runs), std::stoul(std::getenv("PROBE_FAILS")));
  }

  /// Has the processor for 300 ms when the test goes on.
  static pid_t start_hog() {
    const pid_t hog = ::fork();
    if (hog == 0) {
      compute_for(milliseconds(300));
      ::_exit(0);
    }
    return hog;
  }
};

TEST_F(Probe, Alone) {}

TEST_F(Probe, WithAHogOfItsOwn) {
  start_hog();  // stays a child, and in the account, until this program ends
}

TEST_F(Probe, WithANeighbour) {
  const pid_t parent = ::fork();
  if (parent == 0) {
    start_hog();
    ::_exit(0);  // whose child is nobody's of ours then
  }
  ::waitpid(parent, nullptr, 0);
}

TEST(Other, IsGood) {}

}  // namespace
