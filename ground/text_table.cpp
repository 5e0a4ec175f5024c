#include "ground/text_table.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "common/base/text.hpp"

namespace gyre::ground {

std::string aligned(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string out;
  for (const auto& row : rows) {
    std::string line = "  ";
    for (std::size_t i = 0; i < row.size(); ++i) line += row[i] + std::string(widths[i] - row[i].size() + 3, ' ');
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + "\n";
  }
  return out;
}

std::vector<std::string> wrapped(const std::string& words, std::size_t width) {
  std::istringstream stream(words);
  std::vector<std::string> lines;
  for (std::string word; stream >> word;) {
    if (lines.empty() || lines.back().size() + 1 + word.size() > width) {
      lines.push_back(word);
    } else {
      lines.back() += " " + word;
    }
  }
  return lines;
}

std::string number_text(double value, double smallest) {
  if (!std::isfinite(value)) return "unbounded";
  if (std::abs(value) < smallest) return "0";
  return text("%.4g", value);
}

std::string range_text(const mechanics::Range& range, double smallest) {
  const std::string min = number_text(range.min, smallest);
  const std::string max = number_text(range.max, smallest);
  return min == max ? min : min + " .. " + max;
}

}  // namespace gyre::ground
