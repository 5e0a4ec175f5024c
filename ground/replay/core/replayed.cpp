#include "ground/replay/core/replayed.hpp"

#include <utility>
#include <vector>

#include "common/base/text.hpp"
#include "ground/text_table.hpp"

namespace gyre::ground {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string number(std::uint64_t count) {
  return std::to_string(count);
}

std::string lines(const std::vector<Comparison::Line>& told, LocalTime begin) {
  Rows rows;
  for (const Comparison::Line& line : told) rows.push_back({text("%8.3f s", seconds(line.at - begin)), line.words});
  return aligned(rows);
}

std::string verdict(const Replayed& replayed) {
  const Comparison& comparison = replayed.comparison;
  if (replayed.same()) return "It decides as it did then.\n";
  std::string words = text("It decides otherwise %s, seconds after the journal's beginning:\n",
                           comparison.different() == 1 ? "once" : (number(comparison.different()) + " times").c_str());
  words += lines(comparison.differences(), comparison.first());
  const std::uint64_t more = comparison.different() - comparison.differences().size();
  if (more > 0) words += "  and " + number(more) + " more\n";
  if (comparison.apart_max_m() > 0.0)
    words +=
        text("Setpoints of one number are up to %s mm apart.\n", number_text(1e3 * comparison.apart_max_m()).c_str());
  return words;
}

}  // namespace

std::string replay_text(const Replayed& replayed, const std::string& this_version) {
  const Comparison& comparison = replayed.comparison;
  std::string words = text("%s, from its start for %.1f s, stepped again %s times\n", replayed.process.c_str(),
                           seconds(comparison.last() - comparison.first()), number(comparison.steps()).c_str());
  if (replayed.version != this_version)
    words += "It was gyre " + replayed.version + " and is " + this_version + " now.\n";
  std::string heard;
  for (const auto& [kind, count] : replayed.heard) heard += (heard.empty() ? "" : ", ") + kind + " " + number(count);
  for (const std::string& line : wrapped("told: " + heard, 100)) words += "  " + line + "\n";
  if (!comparison.notices().empty())
    words += "Its log, by seconds:\n" + lines(comparison.notices(), comparison.first());
  Rows rows{{"", "says", "recorded", "the same"}};
  for (const auto& [kind, count] : comparison.counts())
    rows.push_back({kind, number(count.said), number(count.recorded), number(count.same)});
  words += aligned(rows);
  if (!replayed.cut.empty()) words += "The journal ends there: " + replayed.cut + ".\n";
  return words + verdict(replayed);
}

}  // namespace gyre::ground
