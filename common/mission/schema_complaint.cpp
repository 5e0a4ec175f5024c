#include "common/mission/schema_complaint.hpp"

#include <google/protobuf/descriptor.h>

#include <algorithm>
#include <regex>
#include <vector>

#include "idl/mission.pb.h"

namespace gyre::mission {
namespace {

/// Levenshtein's distance: how many letters to change, add or drop.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

}  // namespace

std::string with_cure(const std::string& parser_message) {
  constexpr std::size_t kMaxMessageBytes = 400;  // std::regex recurses per character
  static const std::regex kUnknownField(R"re(Message type "([\w.]+)" has no field named "(\w+)"\.)re");
  std::smatch match;
  if (parser_message.size() > kMaxMessageBytes || !std::regex_match(parser_message, match, kUnknownField)) {
    return parser_message;
  }
  const auto* type = schema::Mission::descriptor()->file()->pool()->FindMessageTypeByName(match[1]);
  if (type == nullptr) return parser_message;

  std::vector<std::string> names;
  for (int i = 0; i < type->field_count(); ++i) names.push_back(type->field(i)->name());
  const std::string unknown = match[2];
  std::stable_sort(names.begin(), names.end(), [&](const std::string& a, const std::string& b) {
    return edit_distance(unknown, a) < edit_distance(unknown, b);
  });
  std::string out = unknown + ": no such field; the fields here are ";
  for (std::size_t i = 0; i < names.size(); ++i) out += (i == 0 ? "" : ", ") + names[i];
  return out;
}

}  // namespace gyre::mission
