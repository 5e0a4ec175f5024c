#include "common/dds/seat_lock.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <utility>

namespace gyre::dds {
namespace {

struct AbstractAddress {
  sockaddr_un address{};
  socklen_t size = 0;

  [[nodiscard]] const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&address); }
};

AbstractAddress seat_address(int domain, int participant) {
  // A leading NUL puts the name outside the file system: nothing is left behind.
  const std::string name = "gyre/domain/" + std::to_string(domain) + "/participant/" + std::to_string(participant);
  AbstractAddress result;
  result.address.sun_family = AF_UNIX;
  std::memcpy(result.address.sun_path + 1, name.data(), name.size());
  result.size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  return result;
}

std::string program_name(pid_t pid) {
  // cmdline rather than comm, which the kernel cuts at 15 characters.
  std::ifstream file("/proc/" + std::to_string(pid) + "/cmdline");
  std::string path;
  std::getline(file, path, '\0');
  const std::string name = path.substr(path.find_last_of('/') + 1);
  return name.empty() ? "unknown program" : name;
}

}  // namespace

Result<SeatLock> SeatLock::take(int domain, int participant) {
  const AbstractAddress seat = seat_address(domain, participant);
  SeatLock lock(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (lock.socket_ >= 0 && ::bind(lock.socket_, seat.get(), seat.size) == 0 && ::listen(lock.socket_, SOMAXCONN) == 0) {
    return lock;
  }
  if (errno == EADDRINUSE) return Error{seat_owner(domain, participant).value_or("a process that is just ending")};
  return Error{std::string("the seat's socket failed: ") + std::strerror(errno)};
}

SeatLock::~SeatLock() {
  if (socket_ >= 0) ::close(socket_);
}

SeatLock::SeatLock(SeatLock&& other) noexcept : socket_(std::exchange(other.socket_, -1)) {}

void SeatLock::answer(const SeatAnswer& answer) const {
  // Hardly ever does anybody ask, and to accept nobody is not cheap: the kernel makes the socket first.
  pollfd waiting{socket_, POLLIN, 0};
  if (::poll(&waiting, 1, 0) <= 0) return;
  const std::string words = answer.process + "\n" + answer.complaint;
  constexpr int kMostAtOnce = 16;  // the rest next time: a crowd must not hold up a flight
  for (int i = 0; i < kMostAtOnce; ++i) {
    const int caller = ::accept4(socket_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
    if (caller < 0) return;
    // A few hundred bytes always fit into a fresh socket; who has left already is no matter.
    (void)::send(caller, words.data(), words.size(), MSG_NOSIGNAL);
    ::close(caller);
  }
}

namespace {

/// A connection to a seat's socket, on which somebody may answer.
class Visit {
 public:
  Visit(int domain, int participant) : socket_(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {
    const AbstractAddress seat = seat_address(domain, participant);
    connected_ = socket_ >= 0 && ::connect(socket_, seat.get(), seat.size) == 0;
    crowded_ = !connected_ && errno == EAGAIN;  // its queue is full: nobody accepts, the kernel keeps them
    ucred credentials{};
    socklen_t size = sizeof credentials;
    if (connected_) ::getsockopt(socket_, SOL_SOCKET, SO_PEERCRED, &credentials, &size);
    pid_ = credentials.pid;
  }
  ~Visit() {
    if (socket_ >= 0) ::close(socket_);
  }
  Visit(const Visit&) = delete;
  Visit& operator=(const Visit&) = delete;

  [[nodiscard]] bool somebody_there() const { return connected_ || crowded_; }
  /// A pid of 0 is a process of another pid namespace that shares our network.
  [[nodiscard]] bool elsewhere() const { return connected_ && pid_ == 0; }
  [[nodiscard]] std::string owner() const {
    if (crowded_) return "a process that too many have asked for";
    return elsewhere() ? "a process in another container"
                       : "pid " + std::to_string(pid_) + " (" + program_name(pid_) + ")";
  }

  /// All that is said until the other side closes; nothing when that does not come within the patience.
  [[nodiscard]] std::optional<std::string> listen(Duration patience) const {
    if (!connected_) return std::nullopt;
    const auto until = std::chrono::steady_clock::now() + patience;
    std::string words;
    for (;;) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - std::chrono::steady_clock::now());
      pollfd readable{socket_, POLLIN, 0};
      if (left.count() <= 0 || ::poll(&readable, 1, static_cast<int>(left.count())) <= 0) return std::nullopt;
      std::array<char, 1024> part{};
      const ssize_t count = ::recv(socket_, part.data(), part.size(), 0);
      if (count < 0) return std::nullopt;
      if (count == 0) return words;
      words.append(part.data(), static_cast<std::size_t>(count));
    }
  }

 private:
  int socket_;
  bool connected_ = false;
  bool crowded_ = false;
  pid_t pid_ = 0;
};

}  // namespace

int discovery_port(int domain, int participant) {
  return 7400 + 250 * domain + 10 + 2 * participant;
}

std::optional<std::string> seat_owner(int domain, int participant) {
  const Visit visit(domain, participant);
  if (!visit.somebody_there()) return std::nullopt;
  return visit.owner();
}

std::optional<SeatCall> ask_seat(int domain, int participant, Duration patience) {
  const Visit visit(domain, participant);
  if (!visit.somebody_there()) return std::nullopt;
  SeatCall call{visit.elsewhere(), visit.owner(), std::nullopt};
  if (call.elsewhere) return call;
  if (const auto words = visit.listen(patience)) {
    const std::size_t line = words->find('\n');
    if (line != std::string::npos) call.answer = SeatAnswer{words->substr(0, line), words->substr(line + 1)};
  }
  return call;
}

Result<int> check_ports_free(const std::string& interface, int domain, int participant) {
  const int discovery = discovery_port(domain, participant);
  for (const int port : {discovery, discovery + 1}) {  // user data arrive at the port behind
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    ::inet_pton(AF_INET, interface.c_str(), &address.sin_addr);
    const int probe = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    const bool free = ::bind(probe, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
    const int reason = errno;
    ::close(probe);
    if (free) continue;
    if (reason == EADDRNOTAVAIL) {
      return Error{"no network interface of this machine has the address " + interface +
                   "; see `ip address` and give one of those with --interface"};
    }
    return Error{"UDP port " + std::to_string(port) + " at " + interface + " cannot be had (" + std::strerror(reason) +
                 "); another DDS program may use domain " + std::to_string(domain) + ": choose another with --domain"};
  }
  return discovery;
}

}  // namespace gyre::dds
