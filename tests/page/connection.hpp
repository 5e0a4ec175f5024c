#pragma once
// One connection to a server on loopback, byte by byte: what a browser would never send goes through it, too. Whatever
// it waits for, it waits at the socket, and not for ever.

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace gyre::test {

class Connection {
 public:
  static constexpr std::chrono::seconds kPatience{30};  ///< with a server that is broken; a bound, not a measure

  explicit Connection(int port, const char* address = "127.0.0.1") : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in there{};
    there.sin_family = AF_INET;
    there.sin_port = htons(static_cast<std::uint16_t>(port));
    EXPECT_EQ(::inet_pton(AF_INET, address, &there.sin_addr), 1);
    open_ = ::connect(socket_, reinterpret_cast<const sockaddr*>(&there), sizeof there) == 0;
  }
  ~Connection() {
    if (socket_ >= 0) ::close(socket_);
  }
  Connection(Connection&& other) noexcept
      : socket_(std::exchange(other.socket_, -1)), open_(other.open_), got_(std::move(other.got_)) {}
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;
  Connection& operator=(Connection&&) = delete;

  [[nodiscard]] bool open() const { return open_; }

  /// How many bytes the server's side took; fewer than all: it closed, or took no more.
  std::size_t send(std::string_view bytes) {
    std::size_t sent = 0;
    while (sent < bytes.size()) {
      pollfd ready{socket_, POLLOUT, 0};
      if (::poll(&ready, 1, static_cast<int>(std::chrono::milliseconds(kPatience).count())) <= 0) return sent;
      const ssize_t now = ::send(socket_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL | MSG_DONTWAIT);
      if (now <= 0) return sent;
      sent += static_cast<std::size_t>(now);
    }
    return sent;
  }
  /// Nothing more will be sent.
  void finish() { ::shutdown(socket_, SHUT_WR); }

  /// Whether something came within the time: bytes, or the end.
  [[nodiscard]] bool news(std::chrono::milliseconds within = kPatience) const {
    pollfd ready{socket_, POLLIN, 0};
    return ::poll(&ready, 1, static_cast<int>(within.count())) > 0;
  }
  /// Reads until these words are there, or the end; what was read is kept. False: they did not come.
  bool reads(std::string_view words) {
    for (std::size_t known = 0; got_.find(words, known) == std::string::npos;) {
      known = got_.size() - std::min(got_.size(), words.size());
      if (!read_some()) return false;
    }
    return true;
  }
  /// What was read up to the end of these words, which is kept no longer; absent: they did not come.
  std::optional<std::string> takes(std::string_view words) {
    if (!reads(words)) return std::nullopt;
    const std::size_t end = got_.find(words) + words.size();
    std::string taken = got_.substr(0, end);
    got_.erase(0, end);
    return taken;
  }
  /// Reads until the other side closes; false: it does not.
  bool reads_the_end() {
    while (read_some()) {
    }
    return ended_;
  }
  /// Takes what is there, keeps nothing of it; how many bytes that was.
  std::size_t drains() {
    (void)read_some();
    return std::exchange(got_, {}).size();
  }
  /// Whether it was reset, upon which many a system forgets what came before; also if that came after the end.
  [[nodiscard]] bool was_reset() const {
    int error = 0;
    socklen_t length = sizeof error;
    (void)::getsockopt(socket_, SOL_SOCKET, SO_ERROR, &error, &length);
    return reset_ || error != 0;
  }
  [[nodiscard]] const std::string& got() const { return got_; }
  void forget() { got_.clear(); }

 private:
  bool read_some() {
    if (!news()) return false;
    std::array<char, 65536> buffer{};
    const ssize_t count = ::recv(socket_, buffer.data(), buffer.size(), 0);
    ended_ = count <= 0;  // a reset is an end, too
    reset_ = count < 0 && errno == ECONNRESET;
    if (ended_) return false;
    got_.append(buffer.data(), static_cast<std::size_t>(count));
    return true;
  }

  int socket_;
  bool open_ = false;
  bool ended_ = false;
  bool reset_ = false;
  std::string got_;
};

}  // namespace gyre::test
