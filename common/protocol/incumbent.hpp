#pragma once
// Of several who claim one place, the one that is believed: whoever was heard first, until it falls silent.
//
// Intuition: whoever starts again is another life of the same one, told by its incarnation. While the life before it
// still speaks, there are two of them: two agents of one carrier, two simulators of one world. Neither can know that;
// whoever hears both can, and to follow both in turn would be the worst it could do. So the incumbent is believed, and
// its rival not, whichever of them started later: a process that hung for a minute comes back as a rival, too.
//
// Silence is judged by who was awake: who hung, or whose radio was out, may hear the rival first when it is back. So a
// rival has to be heard alone for a while.
//
// Told the time, like Liveness.

#include <algorithm>
#include <cstdint>
#include <optional>

#include "common/protocol/liveness.hpp"

namespace gyre::protocol {

class Incumbent {
 public:
  /// Both are heard for so long: not just the last word of one who died.
  static constexpr Duration kContested = std::chrono::milliseconds(300);
  /// A rival that is not heard for so long is gone.
  static constexpr Duration kGone = std::chrono::seconds(1);

  /// Who is silent for longer than `patience` is succeeded by whoever was heard for `alone` meanwhile.
  explicit Incumbent(Duration patience, Duration alone = std::chrono::milliseconds(300))
      : heard_(patience), alone_(alone) {}

  enum class Verdict { kBelieved, kSucceeds, kRival };
  /// `preferred`: something else tells that this one is it.
  Verdict hear(LocalTime now, std::uint64_t who, bool preferred = false) {
    if (who_ == who) {
      heard_.heard(now);
      return Verdict::kBelieved;
    }
    if (who_) {
      if (!rival_ || now - rival_->last > kGone) rival_ = Rival{who, now, now, now};
      if (rival_->alone_since <= *heard_.last()) rival_->alone_since = now;
      rival_->who = who;
      rival_->last = now;
      if (!preferred && (!heard_.silent(now) || now - rival_->alone_since < alone_)) return Verdict::kRival;
    }
    rival_.reset();
    who_ = who;
    heard_.heard(now);
    return Verdict::kSucceeds;
  }
  /// The same, where nothing hangs on the difference between a life and the next.
  [[nodiscard]] bool believes(LocalTime now, std::uint64_t who) { return hear(now, who) != Verdict::kRival; }

  [[nodiscard]] bool silent(LocalTime now) const { return heard_.silent(now); }
  [[nodiscard]] std::optional<LocalTime> last() const { return heard_.last(); }  ///< word of who is believed
  [[nodiscard]] std::optional<std::uint64_t> who() const { return who_; }        ///< absent: nobody was ever heard
  /// Who was heard lately beside the one that is believed.
  [[nodiscard]] std::optional<std::uint64_t> rival(LocalTime now) const {
    if (!rival_ || now - rival_->last > kGone || silent(now)) return std::nullopt;
    return rival_->who;
  }
  /// Whether two of them speak, beyond doubt.
  [[nodiscard]] bool contested(LocalTime now) const {
    return rival(now) && std::min(*heard_.last(), rival_->last) - rival_->since >= kContested;
  }

 private:
  Liveness heard_;
  Duration alone_;
  std::optional<std::uint64_t> who_;
  struct Rival {
    std::uint64_t who;  ///< the one heard last, if there are many
    LocalTime since, last;
    LocalTime alone_since;  ///< the first word of any since that of the one that is believed
  };
  std::optional<Rival> rival_;
};

/// Of setpoints, which come a hundred times a second and over no radio: no agent that lives is silent for so long, and
/// the next one is not kept waiting.
inline constexpr Duration kSucceeded = std::chrono::milliseconds(250);

}  // namespace gyre::protocol
