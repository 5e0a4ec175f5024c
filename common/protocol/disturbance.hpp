#pragma once
// What a person may do to a process on purpose, to see that the load does not care: judged, bounded, put into words.
//
// Intuition: a disturbance is a fault that is asked for, so it is no worse than a real one. Packets are lost whole, in
// and out alike. A clock that is shifted forwards leaps, as that of a machine that was suspended and counted it; one
// that is shifted back stands still for so long, because a steady clock never runs backwards, and one falls behind only
// by standing still. The load is pushed at its centre of mass.
//
// What is not granted: the loss of nearly everything for good, since nobody could be told any more that it is over; a
// clock that stands still for so long that its process answers nobody; another clock for the simulator, whose clock is
// the world's time: a world that leaps holds no load.
//
// Whether a push is too strong for the load is for who knows its weight: the simulator, and who asks a person for it.
// What decides is here once, so that nobody is promised what its process then refuses.

#include <cstdint>
#include <optional>
#include <string>

#include "common/base/notice.hpp"
#include "common/base/time.hpp"
#include "common/protocol/messages.hpp"

namespace gyre::protocol {

/// Until told otherwise; what is more heals by itself.
inline constexpr double kMostLostForGood = 0.9;
inline constexpr Duration kLongestLoss = std::chrono::seconds(60);
inline constexpr Duration kFurthestShift = std::chrono::hours(1);
inline constexpr Duration kFurthestShiftBack = std::chrono::seconds(5);
/// What all shifts of one process may come to.
inline constexpr Duration kFurthestClock = std::chrono::hours(100);
/// A clock that stands still is not shifted back again before it has passed this much.
inline constexpr Duration kBetweenShiftsBack = std::chrono::seconds(1);
inline constexpr Duration kLongestPush = std::chrono::seconds(10);

/// Whether there can be such a process: "coordinator", "simulator", "agent N".
[[nodiscard]] bool names_process(const std::string& name);

/// What has been done to a process so far, as far as the next disturbance depends on it.
struct Suffered {
  Duration shifted{};         ///< of its clock, by all shifts since it began
  bool stands_still = false;  ///< its clock was shifted back, and has not gone on by kBetweenShiftsBack since
};

/// What is wrong with one for the process that it names, and what would be right. Numbers as sane() demands them.
[[nodiscard]] std::optional<std::string> objection(const Disturbance& disturbance, const Suffered& so_far);

/// Nothing stronger than the load's weight: it would lift the load out of its cables, or tear it to where no path was
/// certified.
[[nodiscard]] std::optional<std::string> objection_to_push(const Eigen::Vector3d& force_w_n, Duration duration,
                                                           double weight_n);

/// To be performed at once, between two beats of the main loop.
struct Disturbing {
  std::optional<double> share;      ///< of the packets that are lost from now on
  std::optional<Duration> shift;    ///< of the clock
  std::optional<Disturbance> push;  ///< for the simulator
  Notices notices;
};

class DisturbanceJudge {
 public:
  /// `process` is its name as people know it: "agent 3".
  explicit DisturbanceJudge(std::string process) : process_(std::move(process)) {}

  [[nodiscard]] Disturbing take(LocalTime now, const Disturbance& disturbance);
  /// A loss that was asked for a while ends with it; call it as often as the main loop turns.
  [[nodiscard]] Disturbing at(LocalTime now);

  /// Disturbances that nobody can mean, and those that this process cannot suffer.
  [[nodiscard]] std::uint64_t nonsense() const { return nonsense_; }

 private:
  [[nodiscard]] Suffered suffered(LocalTime now) const;

  std::string process_;
  std::optional<LocalTime> lossy_until_;
  Duration shifted_{};
  std::optional<LocalTime> shifted_back_at_;
  std::optional<LocalTime> complained_at_;
  std::uint64_t nonsense_ = 0;
};

}  // namespace gyre::protocol
