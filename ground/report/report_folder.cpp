#include "ground/report/report_folder.hpp"

#include <filesystem>
#include <fstream>
#include <system_error>

#include "ground/report/core/page.hpp"
#include "ground/whole_file.hpp"

namespace gyre::ground {
namespace {

namespace fs = std::filesystem;

bool is_former_report(const fs::path& page) {
  std::ifstream in(page, std::ios::binary);
  std::string beginning(kPageBeginning, '\0');
  in.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  beginning.resize(static_cast<std::size_t>(in.gcount()));
  return is_report_page(beginning);
}

}  // namespace

std::optional<Error> judge_folder(const std::string& folder, const std::vector<std::string>& names) {
  std::error_code problem;
  const fs::file_status there = fs::status(folder, problem);
  if (fs::exists(there) && !fs::is_directory(there)) return Error{folder + ": is a file; name a folder for the report"};
  if (!fs::exists(there) || is_former_report(fs::path(folder) / names.front())) return std::nullopt;
  for (const std::string& name : names) {
    const fs::path file = fs::path(folder) / name;
    if (fs::exists(fs::symlink_status(file, problem)))
      return Error{file.string() + ": is there, and is no former report; name another folder, or move it away"};
  }
  return std::nullopt;
}

std::optional<Error> write_report(const std::string& folder, const std::vector<ReportFile>& files) {
  std::vector<std::string> names;
  for (const ReportFile& file : files) names.push_back(file.name);
  if (auto refused = judge_folder(folder, names)) return refused;
  std::error_code problem;
  fs::create_directories(folder, problem);
  if (problem) return Error{folder + ": cannot be made: " + problem.message() + "; name a folder where you may write"};
  // The page last would leave figures that nobody knows as a report's where one of them cannot be written.
  for (const ReportFile& file : files) {
    if (auto failed = write_whole((fs::path(folder) / file.name).string(), file.content)) return failed;
  }
  return std::nullopt;
}

}  // namespace gyre::ground
