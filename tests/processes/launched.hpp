#pragma once
// Real programs, started and watched by a test, bounded in time, and counted: whoever a program leaves behind is found.

#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "ground/flight/child_process.hpp"
#include "ground/flight/flight_directory.hpp"
#include "tests/places.hpp"

namespace gyre::test {

inline std::string built(const std::string& program) {
  return program_directory() + "/" + program;
}

inline std::string quick_mission() {
  return source_directory() + "/tests/processes/missions/quick.textproto";
}

inline std::string shipped_mission(const std::string& name) {
  return source_directory() + "/deploy/missions/" + name + ".textproto";
}

/// Polls until it holds; false when it does not within the limit.
inline bool holds_within(double limit_s, const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(limit_s);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

/// A program that a test has started. What it says, on both streams, is in a file.
class Launched {
 public:
  Launched(const std::vector<std::string>& command, const std::string& log)
      : log_(log), process_(std::move(ground::ChildProcess::start(command, log)).value()) {}

  [[nodiscard]] pid_t pid() const { return process_.pid(); }
  void send(int signal) { process_.send(signal); }

  [[nodiscard]] std::string said() const {
    std::ostringstream text;
    text << std::ifstream(log_).rdbuf();
    return text.str();
  }
  [[nodiscard]] bool says_within(double limit_s, const std::string& words) {
    return holds_within(limit_s, [&] { return said().find(words) != std::string::npos || process_.ended(); }) &&
           said().find(words) != std::string::npos;
  }
  /// Its end, or a killed process and a failed test when it takes longer.
  ground::ProcessEnd end_within(double limit_s) {
    if (!holds_within(limit_s, [&] { return process_.ended().has_value(); })) {
      ADD_FAILURE() << "still running after " << limit_s << " s; it said:\n" << said();
      process_.send(SIGKILL);
      holds_within(5.0, [&] { return process_.ended().has_value(); });
    }
    return process_.ended().value_or(ground::ProcessEnd{});
  }

 private:
  std::string log_;
  ground::ChildProcess process_;
};

/// A test of programs: a directory of its own, and a mark in the environment that they and their children carry.
class ProgramsTest : public testing::Test {
 protected:
  ProgramsTest() {
    ::unsetenv("ROS_DOMAIN_ID");
    ::unsetenv("GYRE_DOMAIN");
    ::setenv("GYRE_TEST_MARK", mark_.c_str(), 1);
    ::setenv("TMPDIR", directory_.path().c_str(), 1);
  }
  ~ProgramsTest() override { ::unsetenv("TMPDIR"); }

  void TearDown() override {
    EXPECT_TRUE(holds_within(2.0, [&] { return marked().empty(); })) << "left behind: " << listed(marked());
  }

  Launched launch(std::vector<std::string> command) {
    return Launched(command, directory_.path() + "/launched-" + std::to_string(++launches_) + ".txt");
  }
  Launched gyre(const std::vector<std::string>& arguments) {
    std::vector<std::string> command{built("gyre")};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return launch(command);
  }

  /// Programs started by this test or by one of those, alive.
  [[nodiscard]] std::vector<pid_t> marked() const {
    std::vector<pid_t> found;
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
      const std::string name = entry.path().filename();
      if (!std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; })) continue;
      // The test program itself set its mark after its start: its own environ does not show it.
      std::ostringstream environment;
      environment << std::ifstream(entry.path() / "environ").rdbuf();
      if (environment.str().find("GYRE_TEST_MARK=" + mark_) != std::string::npos) found.push_back(std::stoi(name));
    }
    return found;
  }
  /// Those whose command line has these words in it.
  [[nodiscard]] std::vector<pid_t> marked(const std::string& words) const {
    std::vector<pid_t> found;
    for (const pid_t pid : marked()) {
      if (command_line(pid).find(words) != std::string::npos) found.push_back(pid);
    }
    return found;
  }

  [[nodiscard]] const std::string& directory() const { return directory_.path(); }
  /// Log directories of flights that were kept.
  [[nodiscard]] int kept_logs() const {
    const std::filesystem::directory_iterator entries(directory());
    return static_cast<int>(std::count_if(begin(entries), end(entries), [](const auto& entry) {
      return entry.path().filename().string().rfind("gyre-flight-", 0) == 0;
    }));
  }

 private:
  static std::string command_line(pid_t pid) {
    std::ostringstream text;
    text << std::ifstream("/proc/" + std::to_string(pid) + "/cmdline").rdbuf();
    std::string line = text.str();
    std::replace(line.begin(), line.end(), '\0', ' ');
    return line;
  }
  static std::string listed(const std::vector<pid_t>& pids) {
    std::string out;
    for (const pid_t pid : pids) out += std::to_string(pid) + " " + command_line(pid) + "; ";
    return out;
  }

  ground::FlightDirectory directory_ = std::move(ground::FlightDirectory::make(std::nullopt)).value();
  std::string mark_ = directory_.path();
  int launches_ = 0;
};

}  // namespace gyre::test
