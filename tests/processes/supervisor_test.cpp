// Processes that cannot be left behind: ends are told, bounds are kept, and nobody survives the supervisor.

#include "ground/flight/supervisor.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>

#include "ground/flight/flight_directory.hpp"
#include "ground/flight/flight_programs.hpp"

namespace gyre::ground {
namespace {

class SupervisorTest : public testing::Test {
 protected:
  FlightDirectory directory = std::move(FlightDirectory::make(std::nullopt)).value();
  Supervisor supervisor{directory.path()};

  pid_t start(const std::string& name, const std::vector<std::string>& command) {
    const auto pid = supervisor.start({name, command});
    EXPECT_TRUE(pid) << pid.error().text;
    return pid ? pid.value() : -1;
  }

  std::vector<Supervisor::Ended> wait_for_an_end() {
    for (int i = 0; i < 1000; ++i) {
      auto ended = supervisor.collect();
      if (!ended.empty()) return ended;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return {};
  }
};

bool exists(pid_t pid) {
  return ::kill(pid, 0) == 0;
}

TEST_F(SupervisorTest, AnEndIsToldOnceWithItsExitCode) {
  start("agent 3", {"/bin/sh", "-c", "echo what it said; exit 7"});
  const auto ended = wait_for_an_end();
  ASSERT_EQ(ended.size(), 1U);
  EXPECT_EQ(ended[0].name, "agent 3");
  EXPECT_EQ(ended[0].end.exit_code, 7);
  EXPECT_FALSE(ended[0].end.clean());
  EXPECT_EQ(ended[0].end.text(), "ended with exit code 7");
  EXPECT_TRUE(supervisor.collect().empty());
  EXPECT_EQ(supervisor.log_tail("agent 3"), "what it said\n");
}

TEST_F(SupervisorTest, AnEndBySignalNamesTheSignal) {
  ::kill(start("agent 1", {"/bin/sleep", "60"}), SIGKILL);
  const auto ended = wait_for_an_end();
  ASSERT_EQ(ended.size(), 1U);
  EXPECT_EQ(ended[0].end.text(), "was killed by signal 9 (Killed)");
}

TEST_F(SupervisorTest, TheTailIsTheLastLinesOfBothStreams) {
  start("talker", {"/bin/sh", "-c", "for i in 1 2 3 4 5; do echo $i; done; echo six >&2"});
  wait_for_an_end();
  EXPECT_EQ(supervisor.log_tail("talker", 3), "4\n5\nsix\n");
}

TEST_F(SupervisorTest, AnExecutableThatIsNotThereIsAnErrorWithItsPath) {
  const auto pid = supervisor.start({"simulator", {"/nowhere/gyre-simulator"}});
  ASSERT_FALSE(pid);
  EXPECT_NE(pid.error().text.find("simulator: cannot run /nowhere/gyre-simulator: No such file"), std::string::npos)
      << pid.error().text;
  EXPECT_TRUE(supervisor.collect().empty());
}

TEST_F(SupervisorTest, StopEndsThePoliteAndKillsTheStubborn) {
  const pid_t polite = start("polite", {"/bin/sleep", "60"});
  const pid_t stubborn = start("stubborn", {"/bin/sh", "-c", "trap '' TERM; echo deaf; while :; do sleep 0.05; done"});
  while (supervisor.log_tail("stubborn").empty()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_EQ(supervisor.stop({0.1, 0.3}), std::vector<std::string>{"stubborn"});
  EXPECT_FALSE(exists(polite));
  EXPECT_FALSE(exists(stubborn));
}

TEST_F(SupervisorTest, NobodySurvivesTheSupervisor) {
  pid_t pid = 0;
  {
    Supervisor brief(directory.path());
    pid = brief.start({"sleeper", {"/bin/sleep", "60"}}).value();
    EXPECT_TRUE(exists(pid));
  }
  EXPECT_FALSE(exists(pid));
}

TEST_F(SupervisorTest, AChildHasItsOwnGroupAndTakesSignals) {
  // The parent blocks what it reads in its loop; a child that inherited that could not be asked to end.
  sigset_t term;
  sigset_t before;
  ::sigemptyset(&term);
  ::sigaddset(&term, SIGTERM);
  ::pthread_sigmask(SIG_BLOCK, &term, &before);
  const pid_t pid = start("sleeper", {"/bin/sleep", "60"});
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  EXPECT_EQ(::getpgid(pid), pid);
  supervisor.send("sleeper", SIGTERM);
  const auto ended = wait_for_an_end();
  ASSERT_EQ(ended.size(), 1U);
  EXPECT_EQ(ended[0].end.signal, SIGTERM);
}

TEST_F(SupervisorTest, AChildInheritsNoDescriptor) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);  // without O_CLOEXEC, as a library opens its sockets
  start("lister", {"/bin/sh", "-c", "ls /proc/self/fd | tr '\\n' ' '"});
  wait_for_an_end();
  EXPECT_EQ(supervisor.log_tail("lister"), "0 1 2 3 \n");  // 3 is ls reading the directory
  ::close(ends[0]);
  ::close(ends[1]);
}

TEST_F(SupervisorTest, AKilledParentTakesItsChildrenWithIt) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  const pid_t parent = ::fork();
  if (parent == 0) {
    Supervisor inner(directory.path());
    const pid_t pid = inner.start({"orphan", {"/bin/sleep", "60"}}).value();
    if (::write(ends[1], &pid, sizeof pid) != sizeof pid) ::_exit(1);
    ::pause();
  }
  pid_t orphan = 0;
  ASSERT_EQ(::read(ends[0], &orphan, sizeof orphan), static_cast<ssize_t>(sizeof orphan));
  EXPECT_TRUE(exists(orphan));
  ::kill(parent, SIGKILL);
  ::waitpid(parent, nullptr, 0);
  // Its new parent may leave it unburied: dead is what counts.
  const auto alive = [&] {
    std::error_code failure;
    return std::filesystem::exists("/proc/" + std::to_string(orphan) + "/exe", failure) && !failure;
  };
  for (int i = 0; i < 400 && alive(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_FALSE(alive());
  ::close(ends[0]);
  ::close(ends[1]);
}

TEST(FlightDirectory, AFreshOneGoesAndAChosenOneStays) {
  std::string fresh;
  {
    const auto directory = FlightDirectory::make(std::nullopt);
    ASSERT_TRUE(directory) << directory.error().text;
    fresh = directory.value().path();
    EXPECT_TRUE(std::filesystem::is_directory(fresh));
    const std::string chosen = fresh + "/chosen/logs";
    { ASSERT_TRUE(FlightDirectory::make(chosen)); }
    EXPECT_TRUE(std::filesystem::is_directory(chosen));
  }
  EXPECT_FALSE(std::filesystem::exists(fresh));
}

TEST(FlightDirectory, OneThatCannotBeMadeSaysWhy) {
  const auto directory = FlightDirectory::make("/proc/logs");
  ASSERT_FALSE(directory);
  EXPECT_NE(directory.error().text.find("--logs /proc/logs"), std::string::npos) << directory.error().text;
}

TEST(FlightPrograms, OneAgentForEachCarrierAndAllOnOneNetwork) {
  const FlightDirectory home = std::move(FlightDirectory::make(std::nullopt)).value();
  for (const char* name : {"gyre-simulator", "gyre-coordinator"}) {
    std::filesystem::copy_file("/bin/true", home.path() + "/" + name);
  }
  const auto missing = flight_programs(home.path(), "m", {1}, {});
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().text.find(home.path() + "/gyre-agent is missing"), 0U) << missing.error().text;

  std::filesystem::copy_file("/bin/true", home.path() + "/gyre-agent");
  const auto programs = flight_programs(home.path(), "m.textproto", {2, 7}, {"--domain", "5"});
  ASSERT_TRUE(programs);
  ASSERT_EQ(programs.value().size(), 4U);
  EXPECT_EQ(programs.value()[3].name, "agent 7");
  EXPECT_EQ(programs.value()[3].command,
            (std::vector<std::string>{home.path() + "/gyre-agent", "--carrier", "7", "--domain", "5"}));
  for (const Program& program : programs.value()) EXPECT_EQ(program.command.back(), "5") << program.name;
}

}  // namespace
}  // namespace gyre::ground
