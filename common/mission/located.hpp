#pragma once
// One message of a mission file while it is judged: its values, where each stands in the text, and who hears
// complaints.
//
// Reading a value and judging it are one call, so no value can be used unjudged; a value that is wrong is complained
// about and replaced by something harmless, so that judging goes on and finds everything.

#include <google/protobuf/message.h>
#include <google/protobuf/text_format.h>

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/mission/complaints.hpp"

namespace gyre::mission {

/// What a number may be. The ends belong to it.
struct Span {
  double min;
  double max;
  const char* unit;
};

class Located {
 public:
  using Locations = google::protobuf::TextFormat::ParseInfoTree;

  Located(const google::protobuf::Message& message, const Locations& locations, Complaints& complaints)
      : message_(&message), locations_(&locations), complaints_(&complaints) {}

  [[nodiscard]] bool has(const char* field) const;
  [[nodiscard]] int count(const char* field) const;

  /// The message in a field. An absent one reads as empty, and stands where its parent stands.
  [[nodiscard]] Located child(const char* field) const;
  [[nodiscard]] std::vector<Located> children(const char* field) const;
  /// As child(), and complains when it is absent, with the cure.
  [[nodiscard]] Located required_child(const char* field, const std::string& cure) const;

  /// Whether number() would find nothing to complain about.
  [[nodiscard]] bool sound(const char* field, const Span& span) const;
  /// A finite number inside the span. Absent and `absent` not given: required, and complained about.
  [[nodiscard]] double number(const char* field, const Span& span, std::optional<double> absent = std::nullopt) const;
  [[nodiscard]] std::optional<double> optional_number(const char* field, const Span& span) const;
  /// The components x, y, z of a message in a field; absent components are 0, an absent field is 0.
  [[nodiscard]] Eigen::Vector3d vector(const char* field, const Span& span) const;
  [[nodiscard]] bool flag(const char* field, bool absent) const;
  /// 0 if it is wrong, so `min` is at least 1.
  [[nodiscard]] std::uint32_t whole_number(const char* field, std::uint32_t min, std::uint32_t max) const;

  /// About this message, or about one of its fields, at its place in the text.
  void complain(const std::string& text) const;
  void complain(const char* field, const std::string& text) const;

 private:
  [[nodiscard]] const google::protobuf::FieldDescriptor& descriptor(const char* field) const;
  [[nodiscard]] std::string path_to(const char* field) const;
  [[nodiscard]] Located nested(const char* field, int index) const;

  const google::protobuf::Message* message_;
  const Locations* locations_;  // of a message that is not in the text: null
  Complaints* complaints_;
  std::string path_;
  int line_ = -1;
  int column_ = -1;
};

/// A number as a person would write it: 9 digits at most, no trailing zeros.
[[nodiscard]] std::string show(double value);

}  // namespace gyre::mission
