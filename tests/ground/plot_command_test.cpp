// What the shell sees of `gyre plot`: exit codes, messages, and what is in the file afterwards.

#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/ground/gyre_command.hpp"
#include "tests/ground/svg_reader.hpp"
#include "tests/places.hpp"

namespace gyre::test {
namespace {

namespace fs = std::filesystem;

class PlotCommand : public testing::Test {
 protected:
  PlotCommand() {
    std::string pattern = ::testing::TempDir() + "gyre-plot-XXXXXX";
    folder_ = ::mkdtemp(pattern.data());
  }
  ~PlotCommand() override { fs::remove_all(folder_); }

  [[nodiscard]] std::string in_folder(const std::string& name) const { return (folder_ / name).string(); }
  [[nodiscard]] static Answer plot(const std::string& mission, const std::string& file) {
    return gyre("plot " + mission + " -o '" + file + "'");
  }
  [[nodiscard]] static std::string content(const std::string& file) {
    std::ostringstream out;
    out << std::ifstream(file).rdbuf();
    return out.str();
  }
  [[nodiscard]] std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
};

TEST_F(PlotCommand, WritesThePictureAndNothingElse) {
  const std::string file = in_folder("out.svg");
  std::ofstream(file) << "what was there before";
  const Answer answer = plot(shipped("paper"), file);
  EXPECT_EQ(answer.exit_code, 0) << answer.complaint;
  EXPECT_EQ(answer.output + answer.complaint, "");
  const SvgFile picture = read_svg(content(file));
  EXPECT_EQ(picture.complaint, "");
  EXPECT_TRUE(picture.says("paper"));
  EXPECT_EQ(files(), 1u);
}

TEST_F(PlotCommand, DrawsARefusedMission) {
  const Answer answer = plot(shipped("pair-level"), in_folder("out.svg"));
  EXPECT_EQ(answer.exit_code, 0) << answer.complaint;
  EXPECT_TRUE(read_svg(content(in_folder("out.svg"))).says("refused"));
}

TEST_F(PlotCommand, AMotionWithoutBoundsIsOneAndNoFile) {
  const std::string mission = in_folder("unbounded.textproto");
  std::string text = content(source_directory() + "/deploy/missions/single.textproto");
  const std::size_t law = text.find("sine {");
  text.replace(law, text.find('}', law) + 1 - law, "directional { direction { x: 1 } mean_m: 1 }");
  std::ofstream(mission) << text;
  const Answer answer = plot("'" + mission + "'", in_folder("out.svg"));
  EXPECT_EQ(answer.exit_code, 1) << answer.complaint;
  EXPECT_NE(answer.complaint.find("no bounded motion"), std::string::npos) << answer.complaint;
  EXPECT_FALSE(fs::exists(in_folder("out.svg")));
}

TEST_F(PlotCommand, WhatCannotBeWrittenIsSaidWithItsCure) {
  const Answer nowhere = plot(shipped("paper"), in_folder("no/such/folder/out.svg"));
  EXPECT_EQ(nowhere.exit_code, 2);
  EXPECT_NE(nowhere.complaint.find("cannot be written; name a file in a folder"), std::string::npos);
  const Answer folder = plot(shipped("paper"), folder_.string());
  EXPECT_EQ(folder.exit_code, 2);
  EXPECT_NE(folder.complaint.find("is a directory"), std::string::npos);
  const Answer full = plot(shipped("paper"), "/dev/full");
  EXPECT_EQ(full.exit_code, 2);
  EXPECT_NE(full.complaint.find("/dev/full: cannot be written"), std::string::npos);
  EXPECT_EQ(files(), 0u);
}

TEST_F(PlotCommand, GoesWhereALinkLeadsAndToAPipe) {
  std::ofstream(in_folder("real.svg")) << "";
  fs::create_symlink("real.svg", in_folder("link.svg"));
  EXPECT_EQ(plot(shipped("pair"), in_folder("link.svg")).exit_code, 0);
  EXPECT_TRUE(fs::is_symlink(in_folder("link.svg")));
  EXPECT_EQ(read_svg(content(in_folder("real.svg"))).complaint, "");
  EXPECT_EQ(read_svg(plot(shipped("pair"), "/dev/stdout").output).complaint, "");
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(PlotCommand, NeverWritesOverTheMission) {
  const std::string mission = in_folder("mine.textproto");
  fs::copy_file(source_directory() + "/deploy/missions/pair.textproto", mission);
  const std::string before = content(mission);
  const Answer answer = plot("'" + mission + "'", mission);
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_NE(answer.complaint.find("is the mission itself"), std::string::npos);
  EXPECT_EQ(content(mission), before);
}

TEST_F(PlotCommand, BadUsageIsTwo) {
  EXPECT_EQ(gyre("plot " + shipped("paper")).exit_code, 2);
  EXPECT_EQ(plot("no-such-file", in_folder("out.svg")).exit_code, 2);
  EXPECT_EQ(files(), 0u);
}

}  // namespace
}  // namespace gyre::test
