#include "ground/page/bounded_server.hpp"

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <string>
#include <utility>

namespace gyre::ground {
namespace {

using Clock = std::chrono::steady_clock;

/// Whether the socket is ready for `events` before `deadline`.
bool ready_by(int socket, short events, Clock::time_point deadline) {
  while (true) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left < 0) return false;
    pollfd waiting{socket, events, 0};
    const int count = ::poll(&waiting, 1, static_cast<int>(left));
    if (count > 0) return true;
    if (count == 0 || errno != EINTR) return false;
  }
}

LocalTime local(Clock::time_point time) {
  return LocalTime(std::chrono::duration_cast<Duration>(time.time_since_epoch()));
}

/// Of the request that this thread is at.
thread_local bool last_of_connection = false;

}  // namespace

/// Whoever is taken in is at the door until a thread is free for him.
class BoundedServer::Queue final : public httplib::TaskQueue {
 public:
  explicit Queue(BoundedServer& server) : server_(server), threads_(server.bounds_.places) {}

  // It tells something since 0.18.
  using Told = decltype(std::declval<httplib::TaskQueue&>().enqueue(std::function<void()>()));
  Told enqueue(std::function<void()> task) override {
    server_.come();
    return threads_.enqueue(std::move(task));
  }
  void shutdown() override { threads_.shutdown(); }

 private:
  BoundedServer& server_;
  httplib::ThreadPool threads_;
};

class BoundedServer::Stream final : public httplib::Stream {
 public:
  Stream(socket_t socket, BoundedServer& server) : socket_(socket), server_(server), bounds_(server.bounds_) {}

  /// Whether another request begins before the connection counts as idle; from then on its bounds count. Where the one
  /// before was not read to its end, nobody knows where the next begins.
  bool begin_request() {
    begin_ = Clock::now();
    if (broken_ || (at_ == end_ && !comes_by(begin_ + bounds_.idle_time))) return false;
    bytes_left_ = bounds_.request_bytes;
    deadline_ = Clock::now() + bounds_.request_time;
    return true;
  }

  /// Who still sends would not read what closes upon him, as an answer to what was not read; so it is waited for that
  /// he ends, or notices. Not for long.
  void part() {
    if (!broken_ && !last_of_connection) return;
    ::shutdown(socket_, SHUT_WR);
    deadline_ = Clock::now() + bounds_.last_words;
    for (std::size_t left = bounds_.request_bytes; left > 0 && fill() && end_ > 0; left -= std::min(left, end_)) {
    }
  }

  bool is_readable() const override { return at_ < end_ || ready_by(socket_, POLLIN, deadline_); }
  bool is_writable() const override { return ready_by(socket_, POLLOUT, Clock::now() + bounds_.write_time); }

  ssize_t read(char* into, size_t size) override {
    broken_ = broken_ || (at_ == end_ && !fill());
    if (broken_) return -1;
    const std::size_t taken = std::min({size, end_ - at_, bytes_left_});
    if (taken == 0) {  // the other side is done, or the request is too long
      broken_ = true;
      return at_ == end_ ? 0 : -1;
    }
    std::copy_n(buffer_.begin() + static_cast<std::ptrdiff_t>(at_), taken, into);
    at_ += taken;
    bytes_left_ -= taken;
    return static_cast<ssize_t>(taken);
  }

  ssize_t write(const char* from, size_t size) override {
    // Some of it fits, or it would not be writable: without the flag the kernel would wait for room for all of it.
    if (!is_writable()) return -1;
    return ::send(socket_, from, size, MSG_NOSIGNAL | MSG_DONTWAIT);
  }

  void get_remote_ip_and_port(std::string& ip, int& port) const override { name(::getpeername, ip, port); }
  void get_local_ip_and_port(std::string& ip, int& port) const override { name(::getsockname, ip, port); }
  socket_t socket() const override { return socket_; }

 private:
  /// Meanwhile he may have to leave for somebody else.
  bool comes_by(Clock::time_point deadline) {
    server_.wait(socket_, local(begin_));
    const bool came = ready_by(socket_, POLLIN, deadline);
    server_.go_on(socket_);
    return came;
  }

  /// False: nothing came in time, or the connection broke. An end leaves the buffer empty.
  bool fill() {
    if (!comes_by(deadline_)) return false;
    const ssize_t got = ::recv(socket_, buffer_.data(), buffer_.size(), 0);
    if (got < 0) return false;
    at_ = 0;
    end_ = static_cast<std::size_t>(got);
    return true;
  }

  template <class Ask>
  void name(Ask ask, std::string& ip, int& port) const {
    sockaddr_in address{};
    socklen_t length = sizeof address;
    if (ask(socket_, reinterpret_cast<sockaddr*>(&address), &length) != 0 || address.sin_family != AF_INET) return;
    std::array<char, INET_ADDRSTRLEN> text{};
    if (::inet_ntop(AF_INET, &address.sin_addr, text.data(), text.size())) ip = text.data();
    port = ntohs(address.sin_port);
  }

  const socket_t socket_;
  BoundedServer& server_;
  const ServerBounds& bounds_;
  std::array<char, 4096> buffer_{};
  std::size_t at_ = 0, end_ = 0;
  std::size_t bytes_left_ = 0;
  bool broken_ = false;
  Clock::time_point begin_{}, deadline_{};
};

BoundedServer::BoundedServer(const ServerBounds& bounds) : bounds_(bounds), book_(bounds.places) {
  set_payload_max_length(bounds.request_bytes);
  new_task_queue = [this] { return new Queue(*this); };
}

void BoundedServer::close_after_this() {
  last_of_connection = true;
}

void BoundedServer::come() {
  const std::lock_guard<std::mutex> lock(mutex_);
  book_.come();
  make_room();
}

void BoundedServer::wait(socket_t socket, LocalTime since) {
  const std::lock_guard<std::mutex> lock(mutex_);
  book_.wait(socket, since);
  make_room();
}

void BoundedServer::go_on(socket_t socket) {
  const std::lock_guard<std::mutex> lock(mutex_);
  book_.go_on(socket);
}

/// Who is sent away finds that nothing more comes; what he is owed he still gets.
void BoundedServer::make_room() {
  for (const int socket : book_.send_away()) ::shutdown(socket, SHUT_RD);
}

bool BoundedServer::admit(socket_t socket) {
  const std::lock_guard<std::mutex> lock(mutex_);
  book_.enter(socket);
  if (!ended_) open_.insert(socket);
  return !ended_;
}

void BoundedServer::leave(socket_t socket) {
  const std::lock_guard<std::mutex> lock(mutex_);
  open_.erase(socket);
  book_.leave(socket);
  ::shutdown(socket, SHUT_RDWR);
  ::close(socket);  // within the lock: from now on another connection may have its number
  left_.notify_all();
}

void BoundedServer::end() {
  stop();
  std::unique_lock<std::mutex> lock(mutex_);
  ended_ = true;
  for (const socket_t socket : open_) ::shutdown(socket, SHUT_RD);
  left_.wait_for(lock, bounds_.last_words, [this] { return open_.empty(); });
  for (const socket_t socket : open_) ::shutdown(socket, SHUT_RDWR);
}

bool BoundedServer::process_and_close_socket(socket_t socket) {
  const bool good = admit(socket) && serve(socket);
  leave(socket);
  return good;
}

bool BoundedServer::serve(socket_t socket) {
  Stream stream(socket, *this);
  bool good = false;
  last_of_connection = false;
  for (int left = bounds_.requests_per_connection; left > 0 && is_running() && stream.begin_request(); --left) {
    bool closed = false;
#ifdef CPPHTTPLIB_SERVER_READ_TIMEOUT_SECOND  // 0.18, Debian 13; before that it asked the stream for the addresses
                                              // itself
    std::string remote, local;
    int remote_port = 0, local_port = 0;
    stream.get_remote_ip_and_port(remote, remote_port);
    stream.get_local_ip_and_port(local, local_port);
    good = process_request(stream, remote, remote_port, local, local_port, left == 1, closed, nullptr);
#else
    good = process_request(stream, left == 1, closed, nullptr);
#endif
    if (!good || closed || last_of_connection) break;
  }
  stream.part();
  return good;
}

}  // namespace gyre::ground
