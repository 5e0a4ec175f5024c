#pragma once
// A network that belongs to one test: a namespace with a loopback and nothing else, where packets can be dropped for
// real without anybody else on the machine noticing.
//
// Intuition: the process moves itself there (unshare), and what it starts follows. The kernel removes the namespace
// with its last process, so nothing is left behind whatever ends the test.

#include <sys/types.h>

#include <cstdint>
#include <vector>

#include "common/base/result.hpp"

namespace gyre::test {

class PrivateNetwork {
 public:
  /// For a process whose other threads use no network; this thread, and what it starts, stays there for good. Fails
  /// without the right to do so or without nftables; the error names the cure.
  [[nodiscard]] static Result<PrivateNetwork> enter();

  /// From now on drops `percent` of the UDP packets that neither come from nor go to one of the `spared` ports.
  void lose(int percent, const std::vector<std::uint16_t>& spared);
  /// From now on drops every UDP packet from or to one of `ports`, unless its other end is one of the `spared`.
  void cut(const std::vector<std::uint16_t>& ports, const std::vector<std::uint16_t>& spared);
  void heal() { lose(0, {}); }
  /// Packets dropped since the last lose() or cut(): a fault that did not happen proves nothing.
  [[nodiscard]] std::uint64_t lost() const;
};

/// The UDP ports that a process has open now, of this network.
[[nodiscard]] std::vector<std::uint16_t> udp_ports(pid_t pid);

}  // namespace gyre::test
