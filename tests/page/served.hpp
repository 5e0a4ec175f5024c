#pragma once
// A server of the page on loopback, at any port that is free, and words to ask it with.

#include <gmock/gmock.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <utility>

#include "ground/page/page_server.hpp"
#include "tests/page/connection.hpp"

namespace gyre::test {

inline constexpr const char* kToken = "0123456789abcdef";

/// What came back.
struct Reply {
  int status = 0;  ///< 0: nothing, the connection was closed
  std::string head, body;
};

class PageServerTest : public testing::Test {
 protected:
  /// Without a page of its own unless told otherwise, whatever was built.
  static ground::PageServerOptions options() {
    ground::PageServerOptions options;
    options.port = 0;
    options.token = kToken;
    options.page = {};
    return options;
  }
  void serve(const ground::PageServerOptions& with = options()) {
    auto opened = ground::PageServer::open(with);
    ASSERT_TRUE(opened) << opened.error().text;
    server_ = std::move(opened).value();
    const std::string url = server_->url(false);
    port_ = std::stoi(url.substr(url.rfind(':') + 1));
  }

  [[nodiscard]] std::string host() const { return "127.0.0.1:" + std::to_string(port_); }
  [[nodiscard]] std::string get(const std::string& target, const std::string& more = "") const {
    return "GET " + target + " HTTP/1.1\r\nHost: " + host() + "\r\nConnection: close\r\n" + more + "\r\n";
  }
  [[nodiscard]] std::string post(const std::string& target, const std::string& body,
                                 const std::string& more = std::string("X-Gyre-Token: ") + kToken + "\r\n") const {
    return "POST " + target + " HTTP/1.1\r\nHost: " + host() + "\r\nConnection: close\r\n" + more +
           "Content-Type: application/json\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
  }
  [[nodiscard]] Connection connect() const {
    Connection connection(port_);
    EXPECT_TRUE(connection.open());
    return connection;
  }
  /// One request on a connection of its own, and all that comes back until the server closes.
  [[nodiscard]] Reply ask(const std::string& bytes) const {
    Connection connection = connect();
    connection.send(bytes);
    EXPECT_TRUE(connection.reads_the_end()) << "the connection stays open after " << bytes.substr(0, 80);
    return reply_of(connection.got());
  }
  static Reply reply_of(const std::string& bytes) {
    Reply reply;
    const std::size_t end = bytes.find("\r\n\r\n");
    if (bytes.rfind("HTTP/1.", 0) != 0 || end == std::string::npos) return reply;
    reply.status = std::stoi(bytes.substr(9));
    reply.head = bytes.substr(0, end + 2);
    reply.body = bytes.substr(end + 4);
    return reply;
  }
  static std::string words(const Reply& reply) {
    const auto json = nlohmann::json::parse(reply.body, nullptr, false);
    return json.is_object() && json.contains("text") ? json["text"].get<std::string>() : "no JSON: " + reply.body;
  }
  /// A connection that looks, and has got its hello.
  [[nodiscard]] Connection watch() const {
    Connection watcher = connect();
    watcher.send(get("/api/events"));
    EXPECT_TRUE(watcher.reads("event: hello")) << watcher.got();
    return watcher;
  }
  /// The one request that is to come to the loop.
  [[nodiscard]] ground::PageRequest next_request() {
    const auto end = std::chrono::steady_clock::now() + Connection::kPatience;
    while (std::chrono::steady_clock::now() < end) {
      auto requests = server_->take_requests();
      if (!requests.empty()) return std::move(requests.front());
      std::this_thread::yield();
    }
    ADD_FAILURE() << "no request came";
    return {};
  }

  std::unique_ptr<ground::PageServer> server_;
  int port_ = 0;
};

}  // namespace gyre::test
