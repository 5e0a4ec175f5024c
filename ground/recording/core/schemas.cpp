#include "ground/recording/core/schemas.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace gyre::ground {
namespace {

const EmbeddedText* find_text(const std::string& type) {
  const std::vector<EmbeddedText>& texts = message_texts();
  const auto found =
      std::find_if(texts.begin(), texts.end(), [&](const EmbeddedText& text) { return text.name == type + ".msg"; });
  return found == texts.end() ? nullptr : &*found;
}

bool is_primitive(const std::string& type) {
  constexpr std::array<const char*, 13> kPrimitives{"bool",  "byte",   "char",  "float32", "float64", "int8",  "uint8",
                                                    "int16", "uint16", "int32", "uint32",  "int64",   "uint64"};
  return type == "string" || std::find(kPrimitives.begin(), kPrimitives.end(), type) != kPrimitives.end();
}

/// The types that the fields of a text have, as full names, in order.
std::vector<std::string> used_types(const std::string& package, const std::string& content) {
  std::vector<std::string> used;
  for (std::size_t at = 0; at < content.size();) {
    const std::size_t end = std::min(content.find('\n', at), content.size());
    const std::string line = content.substr(at, content.find_first_of(" #\n", at) - at);
    at = end + 1;
    const std::string type = line.substr(0, line.find_first_of("[<"));  // without array and bound
    if (type.empty() || is_primitive(type)) continue;
    const std::size_t slash = type.find('/');
    std::string name = slash == std::string::npos ? package : type.substr(0, slash);
    name += "/msg/";
    name += slash == std::string::npos ? type : type.substr(slash + 1);
    used.push_back(std::move(name));
  }
  return used;
}

}  // namespace

std::optional<std::string> schema_text(const std::string& type) {
  std::string whole;
  std::vector<std::string> types{type};
  for (std::size_t i = 0; i < types.size(); ++i) {
    const std::string name = types[i];
    const EmbeddedText* const text = find_text(name);
    if (!text) return std::nullopt;
    const std::string package = name.substr(0, name.find('/'));
    if (i > 0) whole += std::string(80, '=') + "\nMSG: " + package + name.substr(name.rfind('/')) + "\n";
    whole += text->content;
    for (const std::string& used : used_types(package, text->content)) {
      if (std::find(types.begin(), types.end(), used) == types.end()) types.push_back(used);
    }
  }
  return whole;
}

std::optional<std::string> type_of_wire_name(const std::string& wire_name) {
  const std::string middle = "::msg::dds_::";
  const std::size_t at = wire_name.find(middle);
  if (at == std::string::npos || wire_name.back() != '_') return std::nullopt;
  const std::size_t name = at + middle.size();
  return wire_name.substr(0, at) + "/msg/" + wire_name.substr(name, wire_name.size() - name - 1);
}

std::string topic_of_wire_name(const std::string& wire_name) {
  return wire_name.rfind("rt/", 0) == 0 ? wire_name.substr(2) : wire_name;
}

}  // namespace gyre::ground
