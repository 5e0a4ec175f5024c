// `gyre report` as a shell sees it: recordings written by our own writer, whole, cut off, foreign; and what it leaves.

#include <gmock/gmock.h>

#include <cstdlib>

#include "tests/ground/gyre_command.hpp"
#include "tests/ground/svg_reader.hpp"
#include "tests/recording/written_recording.hpp"
#include "tests/report/perfect_swarm.hpp"

namespace gyre::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class ReportCommand : public testing::Test {
 protected:
  ReportCommand() {
    std::string pattern = ::testing::TempDir() + "gyre-report-XXXXXX";
    folder_ = ::mkdtemp(pattern.data());
  }
  ~ReportCommand() override { fs::remove_all(folder_); }

  [[nodiscard]] std::string in_folder(const std::string& name) const { return (folder_ / name).string(); }
  [[nodiscard]] std::string out() const { return in_folder("out"); }

  /// What the swarm says, in a file.
  [[nodiscard]] std::string recorded(const PerfectSwarm& swarm, const std::string& name) const {
    WrittenRecording recording(in_folder(name));
    for (const ground::Heard& heard : swarm.flight()) {
      std::visit([&](const auto& message) { recording.add(heard.arrived, message); }, heard.message);
    }
    recording.finish();
    return in_folder(name);
  }

  [[nodiscard]] static std::string content(const std::string& file) {
    std::ostringstream words;
    words << std::ifstream(file, std::ios::binary).rdbuf();
    return words.str();
  }
  [[nodiscard]] Answer report(const std::string& files) const {
    return gyre("report " + files + " -o '" + out() + "'");
  }
  [[nodiscard]] std::size_t files_out() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(out()), fs::directory_iterator()));
  }

  fs::path folder_;
};

TEST_F(ReportCommand, TwoRecordingsBecomeAPageAndItsFigures) {
  const std::string level = recorded(PerfectSwarm(shipped_mission("paper")), "level.mcap");
  const std::string fixed = recorded(PerfectSwarm(shipped_mission("paper-fixed")), "fixed.mcap");
  const Answer answer = gyre("report '" + level + "' '" + fixed + "' -o '" + in_folder("new/out") + "'");
  EXPECT_EQ(answer.exit_code, 0) << answer.complaint;
  EXPECT_EQ(answer.complaint, "");
  EXPECT_THAT(answer.output, HasSubstr("paper-fixed: flown for 8"));
  EXPECT_THAT(answer.output, HasSubstr("GOOD: the flight stayed inside its certificate."));
  EXPECT_THAT(answer.output, HasSubstr("new/out/index.html"));
  const std::string page = content(in_folder("new/out/index.html"));
  EXPECT_THAT(page, HasSubstr("Flight report: paper and paper-fixed"));
  EXPECT_THAT(page, HasSubstr("begun 2026-01-02T03:04:05Z, domain 7"));
  for (const char* name : {"paths", "motion", "cables", "load"}) {
    const std::string figure = content(in_folder("new/out/" + std::string(name) + ".svg"));
    EXPECT_EQ(read_svg(figure).complaint, "") << name;
    EXPECT_THAT(page, HasSubstr(figure)) << "the page stands alone";
  }
}

TEST_F(ReportCommand, AFlightOutsideIsOneAndStillReported) {
  PerfectSwarm swarm(shipped_mission("paper"));
  swarm.spoil = [](double t_s, protocol::CarrierState& state) {
    if (state.carrier == 4 && t_s > 50.0 && t_s < 51.0) state.position_w_m.z() += 0.3;
  };
  const Answer answer = report(recorded(swarm, "a.mcap"));
  EXPECT_EQ(answer.exit_code, 1) << answer.complaint;
  EXPECT_THAT(answer.output, HasSubstr("carrier 4: altitude"));
  EXPECT_TRUE(fs::exists(out() + "/index.html"));
}

TEST_F(ReportCommand, OneThatWasCutOffIsReportedAsFarAsItGoes) {
  const std::string file = recorded(PerfectSwarm(shipped_mission("paper")), "a.mcap");
  fs::resize_file(file, fs::file_size(file) * 6 / 10);
  const Answer answer = report(file);
  EXPECT_EQ(answer.exit_code, 0) << "inside its certificate as far as it goes: " << answer.output << answer.complaint;
  EXPECT_THAT(answer.output, HasSubstr("The file has no end"));
  EXPECT_THAT(answer.output, HasSubstr("cut off"));
  EXPECT_THAT(content(out() + "/index.html"), HasSubstr("The file has no end"));
}

TEST_F(ReportCommand, WithoutAMissionItIsAskedForAndTaken) {
  PerfectSwarm swarm(shipped_mission("paper"));
  swarm.tells_mission = false;
  const std::string file = recorded(swarm, "a.mcap");
  const Answer without = report(file);
  EXPECT_EQ(without.exit_code, 1);
  EXPECT_THAT(without.output, HasSubstr("--mission FILE"));
  const Answer with = report(file + " --mission " + shipped("paper"));
  EXPECT_EQ(with.exit_code, 0) << with.output;
  EXPECT_THAT(with.output, HasSubstr("GOOD"));
}

TEST_F(ReportCommand, WhatIsNoRecordingIsTwoAndLeavesNothing) {
  std::ofstream(in_folder("text.mcap")) << "no recording";
  std::ofstream(in_folder("empty.mcap"));
  PerfectSwarm nobody(shipped_mission("paper"));
  nobody.slices.clear();
  const auto refused = [&](const std::string& files, const std::string& words) {
    const Answer answer = report(files);
    EXPECT_EQ(answer.exit_code, 2) << files;
    EXPECT_THAT(answer.complaint, HasSubstr(words));
    EXPECT_FALSE(fs::exists(out()));
  };
  refused(in_folder("text.mcap"), "text.mcap");
  refused(in_folder("empty.mcap"), "empty.mcap");
  refused(in_folder("missing.mcap"), "missing.mcap: No such file");
  refused(folder_.string(), "this is no file");
  refused(recorded(nobody, "good.mcap") + " " + in_folder("text.mcap"), "text.mcap");
  refused("", "FILE");
  refused("a a a a a a a a a", "at most 8");
  refused(in_folder("good.mcap") + " --mission nowhere", "nowhere");
  EXPECT_EQ(gyre("report " + in_folder("good.mcap")).exit_code, 2) << "no folder is named";
}

TEST_F(ReportCommand, AnotherSwarmsFileOfMcapHasNothingToReport) {
  ground::McapWriter writer({});
  Bytes bytes = writer.begin({"about", {}});
  writer.written();
  const auto channel =
      writer.channel(writer.schema("std_msgs/msg/String", "ros2msg", "string data\n"), "/chat", "cdr", {});
  writer.add({*channel, 1, 1, 1, {0, 1, 0, 0}});
  for (const bool last : {false, true}) {
    const Bytes piece = last ? writer.finish({"last", {}}) : writer.close_chunk();
    writer.written();
    bytes.insert(bytes.end(), piece.begin(), piece.end());
  }
  std::ofstream(in_folder("foreign.mcap"), std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  const Answer answer = report(in_folder("foreign.mcap"));
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.complaint, HasSubstr("nothing of a swarm is recorded in it"));
}

TEST_F(ReportCommand, OnlyAFormerReportIsReplaced) {
  const std::string file = recorded(PerfectSwarm(shipped_mission("paper")), "a.mcap");
  fs::create_directory(out());
  std::ofstream(out() + "/index.html") << "<html>my own page</html>";
  const Answer refused = report(file);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.complaint, HasSubstr("index.html: is there, and is no former report"));
  EXPECT_EQ(content(out() + "/index.html"), "<html>my own page</html>");
  EXPECT_EQ(files_out(), 1U);
  fs::remove(out() + "/index.html");
  std::ofstream(out() + "/load.svg") << "my own picture";
  EXPECT_EQ(report(file).exit_code, 2);
  EXPECT_EQ(content(out() + "/load.svg"), "my own picture");
  EXPECT_EQ(files_out(), 1U);
  fs::remove(out() + "/load.svg");
  std::ofstream(out() + "/notes.txt") << "beside it";
  EXPECT_EQ(report(file).exit_code, 0);
  const std::string first = content(out() + "/index.html");
  EXPECT_EQ(report(file).exit_code, 0) << "a former report is replaced";
  EXPECT_EQ(content(out() + "/index.html"), first) << "the same recording is the same report";
  EXPECT_EQ(content(out() + "/notes.txt"), "beside it");
  EXPECT_EQ(files_out(), 6U);
}

TEST_F(ReportCommand, AFolderThatCannotBeIsSaid) {
  const std::string file = recorded(PerfectSwarm(shipped_mission("pair")), "a.mcap");
  std::ofstream(out()) << "a file";
  const Answer answer = report(file);
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.complaint, HasSubstr("is a file; name a folder"));
  const Answer below = gyre("report '" + file + "' -o '" + out() + "/below'");
  EXPECT_EQ(below.exit_code, 2);
  EXPECT_THAT(below.complaint, HasSubstr("name a folder"));
}

}  // namespace
}  // namespace gyre::test
