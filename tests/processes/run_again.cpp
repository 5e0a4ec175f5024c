// The main of every program here: a test that failed on a starved machine runs again, once, and is told of; one that
// failed on a machine that had time fails at once, and so does one that fails again.
//
// While a test runs, a thread reads the kernel's account of this process and all it has started
// (ground/flight/core/starvation.hpp). When every test that failed was starved, the program starts itself anew for them
// alone. Each is a line on the standard output, and in the file that GYRE_RUN_AGAIN names: tests/run counts them.

#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "ground/flight/processor_account.hpp"
#include "tests/processes/hindrance.hpp"

namespace gyre::test {
namespace {

constexpr const char* kSecondRun = "GYRE_SECOND_RUN";

/// A machine that comes later has spoilt a test of this program.
#ifdef GYRE_SPOILT_BY_MS
constexpr Duration kSpoils = std::chrono::milliseconds(GYRE_SPOILT_BY_MS);
#else
constexpr Duration kSpoils = ground::StarvationJudge::kSpoils;
#endif

class MachineWatch {
 public:
  void begin() {
    const std::lock_guard<std::mutex> lock(mutex_);
    judge_ = {};
    look();
  }
  /// Since the last begin().
  [[nodiscard]] ground::StarvationJudge judge() {
    const std::lock_guard<std::mutex> lock(mutex_);
    look();
    return judge_;
  }
  ~MachineWatch() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      over_ = true;
    }
    ended_.notify_one();
    thread_.join();
  }

 private:
  void look() {
    judge_.see(LocalTime(std::chrono::steady_clock::now().time_since_epoch()), ground::processor_account());
  }
  void run() {
    std::unique_lock<std::mutex> lock(mutex_);
    while (!ended_.wait_for(lock, std::chrono::milliseconds(50), [this] { return over_; })) look();
  }

  std::mutex mutex_;
  std::condition_variable ended_;
  bool over_ = false;
  ground::StarvationJudge judge_;
  std::thread thread_{[this] { run(); }};
};

class StarvedTests : public testing::EmptyTestEventListener {
 public:
  struct Test {
    std::string name;
    Duration late{};
  };

  void OnTestStart(const testing::TestInfo&) override {
    Hindrance::begin();
    watch_.begin();
  }
  void OnTestEnd(const testing::TestInfo& test) override {
    const ground::StarvationJudge judge = watch_.judge();
    const bool starved = judge.late_max() >= kSpoils || Hindrance::spoilt();
    const Duration late = std::max(judge.late_max(), Hindrance::longest());
    std::printf("processors came at most %.3f s late through others, the packet filter %.3f s: %s\n",
                seconds(judge.late_max()), seconds(Hindrance::longest()),
                starved ? "the machine was starved" : "the machine had time");
    if (test.result()->Failed() && starved)
      starved_.push_back({std::string(test.test_suite_name()) + "." + test.name(), late});
  }
  [[nodiscard]] const std::vector<Test>& starved() const { return starved_; }

 private:
  MachineWatch watch_;
  std::vector<Test> starved_;
};

/// Returns only when it cannot.
void run_again(std::vector<std::string> arguments, const std::vector<StarvedTests::Test>& tests) {
  const char* const path = std::getenv("GYRE_RUN_AGAIN");
  std::ofstream told(path != nullptr ? path : "/dev/null", std::ios::app);
  std::string filter = "--gtest_filter=";
  for (const auto& [name, late] : tests) {
    char line[256];
    std::snprintf(line, sizeof line, "%s: run again, for the machine was starved: it came %.2f s late", name.c_str(),
                  seconds(late));
    std::puts(line);
    told << line << std::endl;
    filter += name + ":";
  }
  std::fflush(stdout);
  arguments.push_back(filter);
  std::vector<char*> words;
  for (std::string& word : arguments) words.push_back(word.data());
  words.push_back(nullptr);
  ::setenv(kSecondRun, "1", 1);
  for (const char* const variable : {"GTEST_TOTAL_SHARDS", "GTEST_SHARD_INDEX"}) ::unsetenv(variable);  // all of these
  ::execv("/proc/self/exe", words.data());
  std::perror("cannot run again");
}

int run_tests(int argc, char** argv) {
  const bool second_run = std::getenv(kSecondRun) != nullptr;
  const std::vector<std::string> arguments(argv, argv + argc);
  testing::InitGoogleMock(&argc, argv);
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  auto* const listener = new StarvedTests;  // gtest's, with all it knows, when it is appended
  testing::UnitTest::GetInstance()->listeners().Append(listener);
  const int code = RUN_ALL_TESTS();
  const std::vector<StarvedTests::Test>& starved = listener->starved();
  const bool all_starved =
      static_cast<int>(starved.size()) == all.failed_test_count() && !all.ad_hoc_test_result().Failed();
  if (code != 0 && !second_run && !starved.empty() && all_starved) run_again(arguments, starved);
  return code;
}

}  // namespace
}  // namespace gyre::test

int main(int argc, char** argv) {
  return gyre::test::run_tests(argc, argv);
}
