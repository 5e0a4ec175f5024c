#pragma once
// The page's stream as a browser reads it: one event after the other, each with its JSON.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "tests/page/connection.hpp"

namespace gyre::test {

struct PageEvent {
  std::string name;  ///< "frame", ...
  nlohmann::json data;
};

class EventStream {
 public:
  explicit EventStream(int port) : connection_(port) {
    connection_.send("GET /api/events HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) + "\r\n\r\n");
  }

  [[nodiscard]] bool open() const { return connection_.open(); }
  /// Absent: the stream has ended.
  std::optional<PageEvent> next() {
    const auto name = connection_.takes("event: ") ? connection_.takes("\n") : std::nullopt;
    const auto data = name && connection_.takes("data: ") ? connection_.takes("\n\n") : std::nullopt;
    if (!data) return std::nullopt;
    return PageEvent{name->substr(0, name->size() - 1), nlohmann::json::parse(*data, nullptr, false)};
  }
  /// The first of this name that is so; absent: the stream has ended, or `most` events have passed without.
  template <class IsSo>
  std::optional<nlohmann::json> until(const std::string& name, IsSo is_so, int most = 1500) {
    for (int i = 0; i < most; ++i) {
      auto event = next();
      if (!event) return std::nullopt;
      if (event->name == name && is_so(event->data)) return std::move(event->data);
    }
    return std::nullopt;
  }

 private:
  Connection connection_;
};

}  // namespace gyre::test
