#include "common/mission/complaints.hpp"

namespace gyre::mission {
namespace {

/// A file full of garbage must not reach a terminal as garbage, nor as one endless line.
std::string printable(const std::string& text) {
  constexpr std::size_t kMaxShown = 400;
  std::string out;
  for (const char c : text.substr(0, kMaxShown)) {
    out += c >= 0x20 && c <= 0x7e ? c : '?';
  }
  if (text.size() > kMaxShown) out += "...";
  return out;
}

}  // namespace

void Complaints::add(int line, int column, const std::string& field, const std::string& text) {
  if (++count_ > kMaxListed) return;
  std::string out = source_name_ + ":";
  if (line >= 0) out += std::to_string(line + 1) + ":" + std::to_string(column + 1) + ":";
  out += " ";
  if (!field.empty()) out += field + ": ";
  listed_.push_back(out + printable(text));
}

Error Complaints::error() const {
  std::string out;
  for (const std::string& line : listed_) out += (out.empty() ? "" : "\n") + line;
  if (count_ > listed_.size()) out += "\n... and " + std::to_string(count_ - listed_.size()) + " more";
  return Error{out};
}

}  // namespace gyre::mission
