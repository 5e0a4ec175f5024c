#include "ground/report/report.hpp"

#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/program/mission_argument.hpp"
#include "ground/recording/recording_file.hpp"
#include "ground/report/core/page.hpp"
#include "ground/report/core/sheets.hpp"
#include "ground/report/recorded_flight.hpp"
#include "ground/report/report_folder.hpp"

namespace gyre::ground {
namespace {

/// Of more, nobody compares anything on one page.
constexpr std::size_t kMostRecordings = 8;
constexpr const char* kPage = "index.html";

struct ReportOptions {
  std::vector<std::string> recordings;
  std::string folder;
  std::optional<std::string> mission;
};

int complain(const std::string& words) {
  std::fprintf(stderr, "%s\n", words.c_str());
  return program::kBadUsage;
}

int report(const ReportOptions& options) {
  if (options.recordings.empty()) return complain("gyre report: name one recording at least");
  if (options.recordings.size() > kMostRecordings)
    return complain("gyre report: at most " + std::to_string(kMostRecordings) + " recordings go into one report");
  std::optional<mission::Mission> given;
  if (options.mission) {
    auto read = program::read_mission(*options.mission);
    if (!read) return read.error();
    given = std::move(read).value();
  }
  if (const auto refused = judge_folder(options.folder, {kPage})) return complain(refused->text);
  std::vector<Account> accounts;
  for (const std::string& path : options.recordings) {
    const auto source = open_recording(path);
    if (!source) return complain(source.error().text);
    auto flight = read_flight(path, *source.value(), given);
    if (!flight) return complain(flight.error().text);
    accounts.push_back(std::move(flight).value());
  }
  tell_apart(accounts);
  const std::vector<Sheet> drawn = sheets(accounts);
  std::vector<ReportFile> files{{kPage, report_page(accounts, drawn)}};
  for (const Sheet& sheet : drawn) files.push_back({sheet.name + ".svg", sheet.svg});
  if (const auto failed = write_report(options.folder, files)) return complain(failed->text);
  std::printf("%s\n%s/%s\n", report_text(accounts).c_str(), options.folder.c_str(), kPage);
  for (const Account& account : accounts) {
    if (account.standing != Standing::kInside) return program::kFailed;
  }
  return program::kGood;
}

}  // namespace

program::Command report_command() {
  const auto options = std::make_shared<ReportOptions>();
  return {
      "report",
      "Turn recordings into figures and a page: what was flown against what is certified, side by side.",
      {program::own({{"FILE", &options->recordings, "recordings of gyre record; several are held against each other",
                      std::nullopt, program::Take::kByHand},
                     {"-o,--output", &options->folder, "the folder for index.html and its figures", std::nullopt,
                      program::Take::kByHand},
                     {"--mission", &options->mission, "what was flown, for recordings that do not tell it"}})},
      [options] { return report(*options); }};
}

}  // namespace gyre::ground
