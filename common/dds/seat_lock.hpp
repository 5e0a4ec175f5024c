#pragma once
// One process per participant id and domain, and a name for whoever is there already.
//
// Fast DDS moves on silently when a participant's ports are taken. A listening abstract unix socket per id cannot be
// taken twice, disappears with its process whatever ends it, and tells its owner's pid to whoever connects.

#include <optional>
#include <string>

#include "common/base/result.hpp"

namespace gyre::dds {

class SeatLock {
 public:
  /// Fails when the seat is taken; the error says by whom.
  [[nodiscard]] static Result<SeatLock> take(int domain, int participant);

  ~SeatLock();
  SeatLock(SeatLock&& other) noexcept;
  SeatLock& operator=(SeatLock&&) = delete;
  SeatLock(const SeatLock&) = delete;
  SeatLock& operator=(const SeatLock&) = delete;

 private:
  explicit SeatLock(int socket) : socket_(socket) {}
  int socket_;
};

/// "pid 1234 (gyre-coordinator)", or nothing when the seat is free.
[[nodiscard]] std::optional<std::string> seat_owner(int domain, int participant);

/// Fails when a program that is not Gyre's has one of the participant's two UDP ports; the error names the port.
[[nodiscard]] Result<int> check_ports_free(const std::string& interface, int domain, int participant);

}  // namespace gyre::dds
