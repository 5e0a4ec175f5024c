#pragma once
// The folder that a report is written to. What stands there is replaced only where it is a former report.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/base/result.hpp"

namespace gyre::ground {

struct ReportFile {
  std::string name;
  std::string content;
};

/// Made, with the folders above it, where it is not there. The first file is the page: by it a former report is known.
/// Absent: all was written. Otherwise nothing was replaced that is not ours, and the error says what to do.
[[nodiscard]] std::optional<Error> write_report(const std::string& folder, const std::vector<ReportFile>& files);

/// The same without writing: whether it could be, before anybody waits for hours of recordings to be read.
[[nodiscard]] std::optional<Error> judge_folder(const std::string& folder, const std::vector<std::string>& names);

}  // namespace gyre::ground
