#pragma once
// Which packets are lost on purpose: each one by a throw of its own, at a share that may change while packets fly.

#include <atomic>
#include <cstdint>
#include <mutex>

#include "common/base/random_stream.hpp"

namespace gyre::dds {

/// Any thread may ask.
class PacketLoss {
 public:
  explicit PacketLoss(std::uint64_t seed) : random_(seed, "packet loss") {}

  /// 0: none; 1: every one.
  void set_share(double share) { share_ = share; }
  [[nodiscard]] bool loses_any() const { return share_ > 0.0; }
  /// Whether the next packet is lost.
  [[nodiscard]] bool loses_next() {
    const double share = share_;
    if (share <= 0.0) return false;
    const std::lock_guard<std::mutex> lock(mutex_);
    return random_.uniform() < share;
  }

 private:
  std::atomic<double> share_{0.0};
  std::mutex mutex_;
  RandomStream random_;
};

}  // namespace gyre::dds
