#pragma once
// A report as one page that stands alone: no script, no other file, for light and for dark screens, and for paper. It
// is written as XML would have it, so that both kinds of readers read it.

#include <string>
#include <vector>

#include "ground/report/core/account.hpp"
#include "ground/report/core/sheets.hpp"

namespace gyre::ground {

[[nodiscard]] std::string report_page(const std::vector<Account>& accounts, const std::vector<Sheet>& sheets);

/// Whether a file that begins so is a page that was written here.
[[nodiscard]] bool is_report_page(const std::string& beginning);
/// As much of a file as this has to see.
inline constexpr std::size_t kPageBeginning = 512;

/// The accounts for a terminal: the table that `gyre fly` prints, and what is missing.
[[nodiscard]] std::string report_text(const std::vector<Account>& accounts);

}  // namespace gyre::ground
