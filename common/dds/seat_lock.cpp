#include "common/dds/seat_lock.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
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

std::optional<std::string> seat_owner(int domain, int participant) {
  const AbstractAddress seat = seat_address(domain, participant);
  const int visitor = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (visitor < 0) return std::nullopt;
  std::optional<std::string> owner;
  if (::connect(visitor, seat.get(), seat.size) == 0) {
    ucred credentials{};
    socklen_t size = sizeof credentials;
    ::getsockopt(visitor, SOL_SOCKET, SO_PEERCRED, &credentials, &size);
    // A pid of 0 is a process of another pid namespace that shares our network.
    owner = credentials.pid == 0
                ? "a process in another container"
                : "pid " + std::to_string(credentials.pid) + " (" + program_name(credentials.pid) + ")";
  } else if (errno == EAGAIN) {
    owner = "a process that too many have asked for";  // its queue is full: nobody accepts, the kernel keeps them
  }
  ::close(visitor);
  return owner;
}

Result<int> check_ports_free(const std::string& interface, int domain, int participant) {
  // RTPS 9.6.1: discovery at 7400 + 250 domain + 10 + 2 participant, user data at the port behind it.
  const int discovery_port = 7400 + 250 * domain + 10 + 2 * participant;
  for (const int port : {discovery_port, discovery_port + 1}) {
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
  return discovery_port;
}

}  // namespace gyre::dds
