// A failed test runs again, once, where a neighbour had the processor, and fails at once where it was free or taken by
// a process of its own. This program has gtest's own main: nobody judges the judge.

#include <sched.h>

#include "tests/processes/launched.hpp"

namespace gyre::test {
namespace {

using testing::HasSubstr;

class RunAgainTest : public ProgramsTest {
 protected:
  void SetUp() override {
    const auto may_be = [](int policy, int right) {
      sched_param parameter{};
      parameter.sched_priority = right;
      return ::sched_setscheduler(0, policy, &parameter) == 0;
    };
    if (!may_be(SCHED_FIFO, 1)) GTEST_SKIP() << "may not have a processor before others: run it as root";
    ASSERT_TRUE(may_be(SCHED_OTHER, 0));
  }

  /// Its exit code. One processor is given to all of it, so that one hog can take it.
  int probe(const std::string& test, int fails) {
    Launched probe = launch({"/usr/bin/taskset", "--cpu-list", std::to_string(::sched_getcpu()), "env",
                             "GYRE_RUN_AGAIN=" + told_, "PROBE_RUNS=" + runs_, "PROBE_FAILS=" + std::to_string(fails),
                             PROBE, "--gtest_filter=Probe." + test + ":Other.*"});
    const int code = probe.end_within(60.0).exit_code.value_or(-1);
    said_ = probe.said();
    return code;
  }
  [[nodiscard]] std::size_t runs() const { return content(runs_).size(); }
  [[nodiscard]] std::string told() const { return content(told_); }

  std::string said_;

 private:
  static std::string content(const std::string& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
  }

  std::string told_ = directory() + "/told";
  std::string runs_ = directory() + "/runs";
};

TEST_F(RunAgainTest, StarvedByANeighbourItRunsAgainAndIsTold) {
  EXPECT_EQ(probe("WithANeighbour", 1), 0) << said_;
  EXPECT_EQ(runs(), 2U) << said_;
  EXPECT_THAT(told(), HasSubstr("Probe.WithANeighbour: run again, for the machine was starved"));
  EXPECT_EQ(told().find('\n') + 1, told().size()) << "one line:\n" << told();
  EXPECT_THAT(said_, HasSubstr("1 test from 1 test suite ran")) << "those that were good do not run again";
}

TEST_F(RunAgainTest, ButOnlyOnce) {
  EXPECT_EQ(probe("WithANeighbour", 9), 1) << said_;
  EXPECT_EQ(runs(), 2U) << said_;
}

TEST_F(RunAgainTest, WithTheProcessorToItselfItFailsAtOnce) {
  EXPECT_EQ(probe("Alone", 1), 1) << said_;
  EXPECT_EQ(runs(), 1U) << said_;
  EXPECT_EQ(told(), "");
}

TEST_F(RunAgainTest, HeldUpByItsOwnItFailsAtOnce) {
  EXPECT_EQ(probe("WithAHogOfItsOwn", 1), 1) << said_;
  EXPECT_EQ(runs(), 1U) << said_;
  EXPECT_EQ(told(), "");
}

TEST_F(RunAgainTest, WhatIsGoodRunsOnce) {
  EXPECT_EQ(probe("WithANeighbour", 0), 0) << said_;
  EXPECT_EQ(runs(), 1U) << said_;
  EXPECT_EQ(told(), "");
}

}  // namespace
}  // namespace gyre::test
