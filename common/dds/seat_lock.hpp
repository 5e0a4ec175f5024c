#pragma once
// One process per participant id and domain, a name for whoever is there already, and its answer to who asks.
//
// Fast DDS moves on silently when a participant's ports are taken. A listening abstract unix socket per id cannot be
// taken twice, disappears with its process whatever ends it, and tells its owner's pid to whoever connects. It is
// private to its network namespace, like the ports themselves.
//
// The socket is also where a process is asked how it is: its main loop answers, so a process that hangs is found out by
// its silence. No file, no port, no discovery; a container's health check costs a connection.

#include <optional>
#include <string>

#include "common/base/result.hpp"
#include "common/base/time.hpp"

namespace gyre::dds {

/// How a process says it is.
struct SeatAnswer {
  std::string process;    ///< "agent 3"
  std::string complaint;  ///< what keeps it from its work; empty: nothing does
};

class SeatLock {
 public:
  /// Fails when the seat is taken; the error says by whom.
  [[nodiscard]] static Result<SeatLock> take(int domain, int participant);

  ~SeatLock();
  SeatLock(SeatLock&& other) noexcept;
  SeatLock& operator=(SeatLock&&) = delete;
  SeatLock(const SeatLock&) = delete;
  SeatLock& operator=(const SeatLock&) = delete;

  /// Tells everybody who has connected since the last call; never blocks.
  void answer(const SeatAnswer& answer) const;

 private:
  explicit SeatLock(int socket) : socket_(socket) {}
  int socket_;
};

/// "pid 1234 (gyre-coordinator)", or nothing when the seat is free.
[[nodiscard]] std::optional<std::string> seat_owner(int domain, int participant);

/// What became of a question at a seat.
struct SeatCall {
  bool elsewhere = false;            ///< the owner is in another container that shares this network
  std::string owner;                 ///< as seat_owner
  std::optional<SeatAnswer> answer;  ///< absent: none came within the patience
};
/// Nothing when the seat is free. Somebody elsewhere is not waited for.
[[nodiscard]] std::optional<SeatCall> ask_seat(int domain, int participant, Duration patience);

/// The UDP port where a participant is found. Reference: RTPS 2.2, 9.6.1.
[[nodiscard]] int discovery_port(int domain, int participant);

/// Fails when a program that is not Gyre's has one of the participant's two UDP ports; the error names the port.
[[nodiscard]] Result<int> check_ports_free(const std::string& interface, int domain, int participant);

}  // namespace gyre::dds
