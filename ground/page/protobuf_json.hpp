#pragma once
// Protobuf's JSON mapping, as both directions of the page use it (idl/page.proto).

#include <google/protobuf/util/json_util.h>

#include <string>

#include "common/base/result.hpp"

namespace gyre::ground {

inline std::string json_of(const google::protobuf::Message& message) {
  google::protobuf::util::JsonPrintOptions options;
  options.always_print_primitive_fields = true;
  options.preserve_proto_field_names = true;
  std::string json;
  const auto status = google::protobuf::util::MessageToJsonString(message, &json, options);
  GYRE_ENSURE(status.ok(), "a message of ours has a JSON form");
  return json;
}

/// Unknown fields are refused: what a page of another build asks for shall not be half understood.
template <class Message>
Result<Message> message_of(const std::string& json) {
  Message message;
  const auto status = google::protobuf::util::JsonStringToMessage(json, &message);
  if (!status.ok()) return Error{"not the JSON of a " + message.GetTypeName() + ": " + std::string(status.message())};
  return message;
}

}  // namespace gyre::ground
