#pragma once
// Counters that others tell: believed as far as they grow the way a counter does.
//
// Whoever hears 7 and then believes 2^60 is deaf to 8, 9 and all that follows. So no counter is believed that nobody
// can have counted to, and none that leaps, until others say the same: a lie stands alone, and who was away for a night
// hears three of them in the time of three.

#include <cstdint>
#include <optional>

#include "common/protocol/term.hpp"

namespace gyre::protocol {

/// Nobody has counted further: ten thousand a second for nine hundred years.
inline constexpr std::uint64_t kMostCounted = std::uint64_t{1} << 48;
[[nodiscard]] constexpr bool counted(std::uint64_t count) {
  return count <= kMostCounted;
}
/// Nor is a leap believed so far: from where it ends one has to be able to count on, and others to leap there. No power
/// of two, as numbers are that a flipped bit makes: of one that is just believed, the next would not be.
inline constexpr std::uint64_t kMostLeapt = kMostCounted / 4 * 3;

/// Whether a number that others know of may be so far beyond what is known here.
class LeapJudge {
 public:
  explicit LeapJudge(std::uint64_t furthest, std::uint64_t most = kMostLeapt) : furthest_(furthest), most_(most) {}

  /// What leaps is believed when it is said for the third time in a row, or something near.
  [[nodiscard]] bool believes(std::uint64_t known, std::uint64_t heard) {
    if (heard <= known || heard - known <= furthest_) {
      times_ = 0;
      return true;
    }
    if (heard > most_) return false;
    const std::uint64_t apart = heard > last_ ? heard - last_ : last_ - heard;
    times_ = times_ > 0 && apart <= furthest_ ? times_ + 1 : 1;
    last_ = heard;
    if (times_ < kWitnesses) return false;
    times_ = 0;
    return true;
  }

  static constexpr int kWitnesses = 3;

 private:
  std::uint64_t furthest_, most_;
  std::uint64_t last_ = 0;
  int times_ = 0;
};

/// Of the generations of terms. A coordinator that starts again counts one; not all of them are heard of.
class TermJudge {
 public:
  static constexpr std::uint64_t kFurthest = 4;

  [[nodiscard]] bool believes(std::uint64_t known, std::uint64_t heard) {
    return leaps_.believes(generation(known), generation(heard));
  }

 private:
  LeapJudge leaps_{kFurthest, generation(kMostLeapt)};
};

/// The sequence of one sender's messages, of which some are lost, some come twice and some come late.
class SequenceJudge {
 public:
  /// So many may be missed in a row: two seconds of beacons, ten of statuses. After a longer silence, and after a lie
  /// that was believed, those are heard again that follow on each other.
  static constexpr std::uint64_t kFurthest = 100;
  static constexpr int kAhead = 3;    ///< of them, beyond what is known
  static constexpr int kBehind = 10;  ///< before it: late ones may be some in a row

  enum class Verdict { kNew, kDuplicate, kLate, kLeap };
  Verdict take(std::uint64_t heard) {
    if (!known_) return believe(heard);
    if (heard == *known_) return Verdict::kDuplicate;
    const bool ahead = heard > *known_;
    if (ahead && heard - *known_ <= kFurthest) return believe(heard);
    if (run_ == 0 || heard != last_) {
      run_ = run_ > 0 && heard > last_ && heard - last_ <= kFurthest ? run_ + 1 : 1;
      last_ = heard;
    }
    if (run_ >= (ahead ? kAhead : kBehind)) return believe(heard);
    return ahead ? Verdict::kLeap : Verdict::kLate;
  }

 private:
  Verdict believe(std::uint64_t heard) {
    known_ = heard;
    run_ = 0;
    return Verdict::kNew;
  }

  std::optional<std::uint64_t> known_;
  std::uint64_t last_ = 0;
  int run_ = 0;
};

}  // namespace gyre::protocol
