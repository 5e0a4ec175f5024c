// What the shell sees of `gyre design`: a mission that `gyre check` admits, or why there is none.

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "tests/ground/gyre_command.hpp"
#include "tests/places.hpp"

namespace gyre::test {
namespace {

class DesignCommand : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  std::string written(const std::string& name, const std::string& text) const {
    std::ofstream(path(name)) << text;
    return "'" + path(name) + "'";
  }
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string folder_ = ::testing::TempDir() + "gyre-design-" + std::to_string(::getpid());
};

const std::string kWings = shipped("wing-trio.requirements");

TEST_F(DesignCommand, WritesAMissionThatIsAdmissible) {
  const std::string mission = path("trio.textproto");
  const Answer designed = gyre("design " + kWings + " -o '" + mission + "'");
  ASSERT_EQ(designed.exit_code, 0) << designed.complaint;
  EXPECT_NE(designed.output.find("What holds it back"), std::string::npos) << designed.output;
  const Answer checked = gyre("check '" + mission + "'");
  EXPECT_EQ(checked.exit_code, 0) << checked.output << checked.complaint;
  EXPECT_EQ(checked.output.rfind("wing-trio: admissible", 0), 0u) << checked.output;
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 1) << "and nothing beside it";
}

TEST_F(DesignCommand, WithoutAFileTheMissionGoesToStandardOutputAndTheReportBesideIt) {
  const Answer designed = gyre("design " + kWings);
  ASSERT_EQ(designed.exit_code, 0) << designed.complaint;
  EXPECT_EQ(designed.output.rfind("# Designed from wing-trio.requirements.textproto with seed 1", 0), 0u)
      << designed.output;
  EXPECT_NE(designed.complaint.find("What holds it back"), std::string::npos) << designed.complaint;
  EXPECT_EQ(gyre("check " + written("again.textproto", designed.output)).exit_code, 0);
}

TEST_F(DesignCommand, TheImpossibleIsNamedAndIsOne) {
  std::ostringstream text;
  text << std::ifstream(source_directory() + "/deploy/missions/wing-trio.requirements.textproto").rdbuf();
  std::string wings = text.str();
  const std::string limit = "length_max_m: 80";
  ASSERT_NE(wings.find(limit), std::string::npos);
  wings.replace(wings.find(limit), limit.size(), "length_max_m: 52");
  const Answer designed = gyre("design " + written("short.textproto", wings));
  EXPECT_EQ(designed.exit_code, 1);
  EXPECT_EQ(designed.output, "");
  EXPECT_NE(designed.complaint.find("IMPOSSIBLE"), std::string::npos) << designed.complaint;
  EXPECT_NE(designed.complaint.find("length_max_m 52 m"), std::string::npos) << designed.complaint;
}

TEST_F(DesignCommand, WhatIsNoRequirementIsTwo) {
  EXPECT_EQ(gyre("design " + shipped("paper")).exit_code, 2);
  EXPECT_EQ(gyre("design nowhere.textproto").exit_code, 2);
  EXPECT_EQ(gyre("design").exit_code, 2);
  EXPECT_EQ(gyre("design " + kWings + " --seconds 0").exit_code, 2);
  EXPECT_EQ(gyre("design " + kWings + " -o " + kWings).exit_code, 2) << "the mission would take their place";
}

TEST_F(DesignCommand, AFileThatCannotBeWrittenIsNamed) {
  const Answer designed = gyre("design " + kWings + " -o '" + path("no/such/folder.textproto") + "'");
  EXPECT_EQ(designed.exit_code, 1);
  EXPECT_NE(designed.complaint.find("no/such/folder.textproto: cannot be written"), std::string::npos)
      << designed.complaint;
}

TEST_F(DesignCommand, WhatIsNoFileIsWrittenIntoAndNotReplaced) {
  const std::string pipe = path("pipe");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const Answer read = gyre("design " + kWings + " -o '" + pipe + "' | cat '" + pipe + "'");
  EXPECT_EQ(read.output.rfind("# Designed from", 0), 0u) << read.output << read.complaint;
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
}

}  // namespace
}  // namespace gyre::test
