#pragma once
// What came of it when somebody hurt a flight on purpose: how far the load moved, and how long it took until all was
// calm again.

#include <deque>
#include <optional>
#include <string>

#include "common/base/time.hpp"
#include "ground/swarm/core/load_gauge.hpp"

namespace gyre::ground {

struct HurtOutcome {
  std::uint64_t number = 0;  ///< from 1 on
  std::string text;          ///< "agent 3 was killed"
  Duration since{};
  double before_m = 0.0;     ///< the load's greatest displacement in the second before
  double moved_max_m = 0.0;  ///< the greatest since, until somebody hurts it again
  std::optional<Duration> calm_after;
};

class HurtGauge {
 public:
  void hurt(LocalTime now, const std::string& text);
  /// The load since the last call, and whether nothing is complained of.
  void see(LocalTime now, const LoadWindow& load, bool calm);
  /// Of the newest; absent: nobody has hurt it yet.
  [[nodiscard]] std::optional<HurtOutcome> outcome(LocalTime now) const;

 private:
  /// What is hurt shows after a while: silence is named within half a second.
  static constexpr Duration kSettling = std::chrono::milliseconds(1500);
  static constexpr Duration kBefore = std::chrono::seconds(1);

  struct Moment {
    LocalTime at;
    double displacement_m;
  };
  std::deque<Moment> lately_;
  LocalTime begun_{};
  std::optional<HurtOutcome> outcome_;
};

}  // namespace gyre::ground
