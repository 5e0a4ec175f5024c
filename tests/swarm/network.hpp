#pragma once
// The wire between virtual processes: what happens to one packet that goes from one process to another.
//
// Weather is the same everywhere and changes when a fault begins or ends; distances (delays that differ by direction)
// belong to a process and stay. Every mishap is counted: a fault that never happened proves nothing.

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "common/base/random_stream.hpp"
#include "tests/swarm/virtual_clock.hpp"

namespace gyre::swarm {

struct Weather {
  double loss = 0.0;          ///< share of packets
  double bursts_per_s = 0.0;  ///< on each link: nothing passes for a while
  Duration burst = std::chrono::milliseconds(200);
  double duplicated = 0.0;                              ///< share of packets that arrive twice
  double overtaken = 0.0;                               ///< share of packets that are held back
  Duration held_back = std::chrono::milliseconds(300);  ///< for up to this long
  Duration jitter = std::chrono::microseconds(50);      ///< mean of an exponential delay
  double garbage = 0.0;                                 ///< share of packets that come with a broken copy
  double lies = 0.0;                                    ///< share of time replies with wrong timestamps
};

struct PacketCounts {
  std::uint64_t sent = 0, lost = 0, lost_in_burst = 0, duplicated = 0, held_back = 0, parted = 0, garbage = 0, lies = 0;
};

class Network {
 public:
  Network(std::uint64_t seed, std::size_t processes);

  Weather weather;
  /// group[p]: packets pass only within a group. Empty: no partition.
  std::vector<int> groups;
  /// Nothing passes from the one to the other.
  struct Cut {
    std::size_t from = 0, to = 0;
  };
  std::vector<Cut> cuts;

  /// When the copies of a packet arrive that is sent now: none, one or two.
  struct Fate {
    std::array<Duration, 2> delays{};
    int copies = 0;
  };
  [[nodiscard]] Fate send(TrueTime now, std::size_t from, std::size_t to);
  /// Whether a lost packet of a reliable topic is asked for and sent again this time: three packets have to pass.
  [[nodiscard]] bool asked_again(std::size_t from, std::size_t to);
  [[nodiscard]] bool chance(double share) { return share > 0.0 && random_.uniform() < share; }
  [[nodiscard]] RandomStream& random() { return random_; }

  PacketCounts counts;

 private:
  [[nodiscard]] bool parted(std::size_t from, std::size_t to) const {
    const auto group = [this](std::size_t p) { return p < groups.size() ? groups[p] : 0; };
    if (group(from) != group(to)) return true;
    return std::any_of(cuts.begin(), cuts.end(), [&](const Cut& c) { return c.from == from && c.to == to; });
  }
  [[nodiscard]] Duration delay(std::size_t from, std::size_t to);

  RandomStream random_;
  std::vector<Duration> outward_, inward_;
  struct Link {
    TrueTime burst_until{};
    TrueTime last_sent{};
  };
  std::vector<Link> links_;
};

}  // namespace gyre::swarm
