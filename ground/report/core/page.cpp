#include "ground/report/core/page.hpp"

#include <algorithm>

#include "common/base/text.hpp"
#include "ground/flight/core/flight_table.hpp"
#include "ground/plot/core/palette.hpp"
#include "ground/plot/core/svg.hpp"

namespace gyre::ground {
namespace {

constexpr const char* kMark = "<meta name=\"generator\" content=\"gyre report\"/>";

/// On paper: light whatever the screen prefers, a flight's account not torn apart, a figure never.
std::string styles() {
  return style_sheet() +
         "html{background:var(--paper);color:var(--ink)}"
         "body{font:15px/1.5 system-ui,-apple-system,'Segoe UI',Roboto,'Helvetica Neue',Arial,sans-serif;"
         "max-width:1000px;margin:0 auto;padding:24px 20px}"
         "h1{font-size:26px;margin:0}h2{font-size:19px;margin:34px 0 6px}p{margin:6px 0}"
         "p.about,figcaption{color:var(--muted);font-size:13px}"
         ".verdict{font-weight:600}ul{margin:6px 0;padding-left:22px}"
         "figure{margin:10px 0}figure svg{width:100%;height:auto;display:block}"
         ".table{overflow-x:auto}table{border-collapse:collapse;font-variant-numeric:tabular-nums;font-size:13px}"
         "th,td{padding:3px 16px 3px 0;text-align:left;white-space:nowrap}"
         "thead tr+tr th{color:var(--muted);font-weight:400;padding-top:0}tr.first td,tr.first th{border-top:1px solid "
         "var(--grid)}"
         "td.out{color:var(--bad);font-weight:600}"
         "@page{size:A4;margin:14mm 12mm}"
         "@media print{html:root{color-scheme:light;" +
         light_tones() +
         "}"
         "body{max-width:none;padding:0;font-size:10.5pt}section,figure,tr{break-inside:avoid}"
         "h2{break-after:avoid}.table{overflow:visible}th,td{padding-right:9pt;font-size:8.5pt}}\n";
}

std::string tagged(const std::string& tag, const std::string& words, const std::string& attributes = "") {
  const std::string opening = attributes.empty() ? tag : tag + " " + attributes;
  return "<" + opening + ">" + escaped(words) + "</" + tag + ">";
}

std::string heading(const std::vector<Account>& accounts) {
  std::string names;
  for (std::size_t k = 0; k < accounts.size(); ++k) {
    names += (k == 0 ? "" : k + 1 == accounts.size() ? " and " : ", ") + accounts[k].name;
  }
  return names;
}

std::string word_of(const FileFacts& file, const char* key, const char* before) {
  const auto word = file.begin.find(key);
  return word == file.begin.end() ? "" : before + word->second;
}

std::string about(const Account& account) {
  const auto& recorded = account.digest->recorded_s();
  const double recorded_s = recorded.min <= recorded.max ? recorded.span() : 0.0;
  return account.file.path + ": " +
         text("%.1f s recorded, %.1f s of them at full pace; %llu messages of the swarm", recorded_s,
              account.digest->flown_s(), static_cast<unsigned long long>(account.file.messages)) +
         word_of(account.file, "begin", "; begun ") + word_of(account.file, "domain", ", domain ") +
         word_of(account.file, "version", ", gyre ") + ".";
}

/// The first two rows are names and units; then two for each carrier.
std::string table(const std::vector<std::vector<std::string>>& rows) {
  constexpr std::size_t kHead = 2;
  std::string out = "<div class=\"table\"><table>\n<thead>\n";
  for (std::size_t row = 0; row < rows.size(); ++row) {
    if (row == kHead) out += "</thead>\n<tbody>\n";
    const bool first = row >= kHead && row % 2 == 0;
    out += first ? "<tr class=\"first\">" : "<tr>";
    for (std::size_t column = 0; column < rows[row].size(); ++column) {
      const std::string& words = rows[row][column];
      const bool outside = row >= kHead && words.size() > 1 && words.back() == '!';
      out += row < kHead || column == 0 ? tagged("th", words) : tagged("td", words, outside ? "class=\"out\"" : "");
    }
    out += "</tr>\n";
  }
  return out + (rows.size() <= kHead ? "</thead>\n" : "</tbody>\n") + "</table></div>\n";
}

std::string list(const std::vector<std::string>& items) {
  if (items.empty()) return "";
  std::string out = "<ul>\n";
  for (const std::string& item : items) out += tagged("li", item) + "\n";
  return out + "</ul>\n";
}

const char* sign(Standing standing) {
  return standing == Standing::kInside ? "\u2713 " : standing == Standing::kOutside ? "\u2717 " : "? ";
}

const char* tone(Standing standing) {
  return standing == Standing::kInside ? "good" : standing == Standing::kOutside ? "bad" : "muted";
}

std::string section(const Account& account) {
  std::string out = "<section>\n" + tagged("h2", account.name) + "\n";
  out += tagged("p", sign(account.standing) + account.standing_words,
                std::string("class=\"verdict ") + tone(account.standing) + "\"") +
         "\n";
  out += tagged("p", about(account), "class=\"about\"") + "\n";
  if (account.verdict) {
    const FlightWords words = flight_words(*account.verdict);
    out += table(words.rows) + tagged("p", "Load: " + words.load + ".") + "\n" +
           tagged("p", "Timing: " + words.timing + ".", "class=\"about\"") + "\n" + list(account.verdict->violations);
  }
  return out + list(account.remarks) + "</section>\n";
}

/// One for all accounts: what stands beside each other is not said twice.
std::string figure(const Sheet& sheet) {
  return "<figure>\n" + tagged("h2", sheet.title) + "\n" + sheet.svg + tagged("figcaption", sheet.caption) +
         "\n</figure>\n";
}

}  // namespace

std::string report_page(const std::vector<Account>& accounts, const std::vector<Sheet>& sheets) {
  const std::string names = heading(accounts);
  std::string out =
      std::string("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n") + kMark +
      "\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n" +
      tagged("title", "Flight report: " + names) + "\n<style>\n" + styles() + "</style>\n</head>\n<body>\n" +
      tagged("h1", "Flight report: " + names) + "\n" +
      tagged("p", "What was flown, by the recording, against what is certified of the mission for all time.",
             "class=\"about\"") +
      "\n";
  for (const Account& account : accounts) out += section(account);
  for (const Sheet& sheet : sheets) out += figure(sheet);
  return out + "</body>\n</html>\n";
}

bool is_report_page(const std::string& beginning) {
  return beginning.find(kMark) != std::string::npos;
}

std::string report_text(const std::vector<Account>& accounts) {
  std::string out;
  for (const Account& account : accounts) {
    if (!out.empty()) out += "\n";
    out += about(account) + "\n";
    out += account.verdict ? flight_table(*account.verdict) : account.name + ": " + account.standing_words + ".\n";
    for (const std::string& remark : account.remarks) out += "  - " + remark + "\n";
  }
  return out;
}

}  // namespace gyre::ground
