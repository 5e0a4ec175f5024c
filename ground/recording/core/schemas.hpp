#pragma once
// The types of what is recorded, as ROS 2 spells them: the .msg texts of idl/, put into the program when it was built.
//
// A reader of the file needs a type with everything it is made of, in one text: the type's own, then for each type it
// uses, directly or not, a line of eighty '=', a line "MSG: package/Type", and that one's.
//
// Reference: docs/interop.md, MCAP.

#include <optional>
#include <string>
#include <vector>

namespace gyre::ground {

struct EmbeddedText {
  const char* name;  ///< "gyre_msgs/msg/Beacon.msg"
  const char* content;
};
[[nodiscard]] const std::vector<EmbeddedText>& message_texts();

/// By its full name, "gyre_msgs/msg/Beacon". Absent: no such type, or one that it uses is missing.
[[nodiscard]] std::optional<std::string> schema_text(const std::string& type);

/// "gyre_msgs::msg::dds_::Beacon_" -> "gyre_msgs/msg/Beacon". Absent: not how ROS 2 names types on the wire.
[[nodiscard]] std::optional<std::string> type_of_wire_name(const std::string& wire_name);

/// "rt/gyre/phase" -> "/gyre/phase"; anything else stays.
[[nodiscard]] std::string topic_of_wire_name(const std::string& wire_name);

}  // namespace gyre::ground
