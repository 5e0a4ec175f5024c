#pragma once
// Whether an agent's own clock has leapt, or stood still, between two beats: seen within a beat or two, long before
// enough exchanges contradict what is known of swarm time (protocol/timekeeper.hpp).
//
// Intuition: how old a message seems when it arrives is its way, which hardly varies, and the difference of two clocks,
// which nobody has to know. When the own clock leaps, everything that arrives is older by the leap from then on; when
// it stands still, younger. A machine is suspended, a virtual one is paused or migrated, a hypervisor corrects it.
//
//   age      arrived − stamp, by two clocks                                                      ns
//   usual    among the ages of the last kWindow messages, or no further off than they vary; at least kUnusual
//   step     age − the middle of the usual ones: what the clock has leapt by, if it has          ns
//
// What the naive way gets wrong: an age steps as well when the network gets slower, when the sender's clock leaps or
// when this process was not run. So an age only raises a suspicion, and only the vehicle's does: when the coordinator's
// clock leaps, beacons step, and whoever followed them would take the swarm along. The suspicion is short: the next
// message that is as usual ends it, and the first exchange begun after it proves or refutes it, because no network
// moves an offset by more than half of the exchange's delay.
//
// A leap beyond the beat also shows as a beat that comes late. Nobody can tell it from a process that had to wait, so
// what such a beat shows is not trusted before something that arrived just before it, or after it, was as usual. A
// late beat and a beacon that is strange are a suspicion as well: not every vehicle tells states.
//
// A leap by less than ages vary raises no suspicion. But when an exchange contradicts what is known, the least age of
// the last few messages says whether it is this clock that leapt (lately).
//
// Blind: for the first kEnough messages, to leaps below kUnusual, and where ages vary by more than kSteady; and to
// leaps within a beat where the vehicle stamps by the very clock that leapt, or does not tell.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "common/base/time.hpp"

namespace gyre::agent {

/// The ages of one sender's messages.
class Ages {
 public:
  static constexpr std::size_t kWindow = 32;
  static constexpr std::size_t kEnough = 16;
  static constexpr std::size_t kFew = 4;
  static constexpr Duration kUnusual = std::chrono::milliseconds(2);
  static constexpr Duration kSteady = std::chrono::milliseconds(50);

  enum class Seems { kUnknown, kUsual, kStrange };
  Seems hear(Duration age);

  /// Whether the last ones were steady enough to say of the next one what it is.
  [[nodiscard]] bool known() const { return count_ >= kEnough && greatest_ - least_ <= kSteady; }
  /// How far an age is from the middle of the usual ones. Needs one.
  [[nodiscard]] Duration step(Duration age) const { return age - (least_ + (greatest_ - least_) / 2); }
  [[nodiscard]] bool usual(Duration age) const {
    const Duration margin = std::max(kUnusual, greatest_ - least_);
    return age >= least_ - margin && age <= greatest_ + margin;
  }
  /// How much greater the least of the last few is than the least before them; absent: there are too few. The least
  /// hardly varies even where ages do, but it takes a few to know it.
  [[nodiscard]] std::optional<Duration> lately() const;
  /// The clock here has leapt: so have all ages.
  void shift(Duration by);
  void begin_anew() { *this = Ages(); }

 private:
  /// So many strange ones in a row are what is usual from now on.
  static constexpr int kInARow = 64;

  void keep(Duration age);

  std::array<Duration, kWindow> ages_{};  // a ring
  std::size_t count_ = 0;
  Duration least_{};
  Duration greatest_{};
  int in_a_row_ = 0;
};

class ClockWatch {
 public:
  /// A suspicion that nobody proves or refutes, because no exchange comes through: what the clock says is taken then.
  static constexpr Duration kLongestSuspicion = std::chrono::milliseconds(300);
  /// Steps further apart than a beat and a little: one was late.
  static constexpr Duration kLate = std::chrono::milliseconds(12);
  /// And one that was later is not trusted for so long, where nothing arrives: as long as a vehicle that brakes when it
  /// hears nothing waits, and a beat.
  static constexpr Duration kUnconfirmed = std::chrono::milliseconds(60);

  struct Suspicion {
    LocalTime since;  ///< by the clock as it shows now; an exchange begun from then on can tell
    Duration leap;    ///< ahead; below zero it stood still
  };

  /// At every step, before whatever it is about: steps come at least once per beat.
  void step(LocalTime now);
  void hear_vehicle(LocalTime arrived, std::uint64_t incarnation, LocalTime stamp);
  void hear_beacon(LocalTime arrived, SwarmTime stamp);

  [[nodiscard]] const std::optional<Suspicion>& suspicion() const { return suspicion_; }
  /// Whether what the clock shows may be wrong by a leap.
  [[nodiscard]] bool doubts() const { return suspicion_ || late_at_; }
  /// What the vehicle's messages say that the clock has leapt by lately, suspected or not.
  [[nodiscard]] std::optional<Duration> lately() const;
  /// Until when messages were as usual.
  [[nodiscard]] LocalTime confirmed() const { return confirmed_; }

  /// An exchange has proven it.
  void leapt(Duration by);
  /// An exchange has refuted it: it was the network, or the sender.
  void refuted();

 private:
  enum class Witness { kVehicle, kBeacon };
  void suspect(Witness witness, Duration leap);
  void confirm(LocalTime arrived);

  Ages vehicle_;
  Ages beacons_;
  std::uint64_t vehicle_incarnation_ = 0;
  std::optional<Suspicion> suspicion_;
  Witness witness_ = Witness::kVehicle;
  LocalTime confirmed_ = LocalTime::min();
  std::optional<LocalTime> stepped_at_;
  std::optional<LocalTime> late_at_;
};

}  // namespace gyre::agent
