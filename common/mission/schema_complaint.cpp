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

/// "a, b, c".
std::string listed(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : ", ") + name;
  return out;
}

std::string unknown_field(const std::string& parser_message, const std::string& type_name, const std::string& field) {
  const auto* type = schema::Mission::descriptor()->file()->pool()->FindMessageTypeByName(type_name);
  if (type == nullptr) return parser_message;
  if (field == "agent_loss") {
    return "agent_loss: is not read any more; write silence { stop_after_s: 5 } for FREEZE, silence { fly_on {} } for "
           "CONTINUE";
  }
  std::vector<std::string> names;
  for (int i = 0; i < type->field_count(); ++i) names.push_back(type->field(i)->name());
  std::stable_sort(names.begin(), names.end(), [&field](const std::string& a, const std::string& b) {
    return edit_distance(field, a) < edit_distance(field, b);
  });
  return field + ": no such field; the fields here are " + listed(names);
}

std::string listed(const google::protobuf::EnumDescriptor& values) {
  std::vector<std::string> names;
  for (int i = 0; i < values.value_count(); ++i) names.push_back(values.value(i)->name());
  return listed(names);
}

/// What a field with an enumeration may say; the parser tells its name only.
std::string values_of(const std::string& field) {
  for (const auto* values : {schema::Vehicle::OnSilence_descriptor(), schema::Want::Objective_descriptor()}) {
    const auto* owner = values->containing_type()->FindFieldByName(field);
    if (owner != nullptr && owner->enum_type() == values) return listed(*values);
  }
  return "the values that the schema has";
}

}  // namespace

std::string with_cure(const std::string& parser_message) {
  constexpr std::size_t kMaxMessageBytes = 400;  // std::regex recurses per character
  if (parser_message.size() > kMaxMessageBytes) return parser_message;
  static const std::regex kUnknownField(R"re(Message type "([\w.]+)" has no field named "(\w+)"\.)re");
  static const std::regex kUnknownValue(R"re(Unknown enumeration value of (.*) for field "(\w+)"\.)re");
  std::smatch match;
  if (std::regex_match(parser_message, match, kUnknownField)) return unknown_field(parser_message, match[1], match[2]);
  if (std::regex_match(parser_message, match, kUnknownValue)) {
    return match.str(2) + ": is " + match.str(1) + "; give one of " + values_of(match[2]);
  }
  if (parser_message == "Expected identifier, got: ") return "the file ends inside a block; close every { with a }";
  return parser_message;
}

}  // namespace gyre::mission
