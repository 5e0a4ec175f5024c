#pragma once
// Who is there: what every agent said last, who has fallen silent, and who is there twice.
//
// An agent that starts again is another life of the same carrier, told by its incarnation. The life that was heard
// first is believed until it falls silent: then the other one is, and what the dead still had under way is passed over.
// While both speak, two agents claim one carrier, and the newcomer is not believed.

#include <map>
#include <optional>
#include <vector>

#include "common/protocol/counting.hpp"
#include "common/protocol/liveness.hpp"
#include "common/protocol/messages.hpp"

namespace gyre::coordinator {

class Fleet {
 public:
  Fleet(const std::vector<CarrierId>& carriers, Duration timeout);

  enum class Verdict { kTaken, kStranger, kDuplicate, kLate, kLeap, kRival };
  Verdict take(LocalTime now, const protocol::AgentStatus& status);
  /// Any other sign of this life.
  void heard(LocalTime now, CarrierId carrier, std::uint64_t incarnation);

  /// Carriers that two agents claim.
  [[nodiscard]] std::vector<CarrierId> claimed_twice(LocalTime now) const;

  struct Change {
    CarrierId carrier;
    bool lost;  ///< false: it is back, or here for the first time
    bool restarted;
  };
  /// What changed since the last call.
  [[nodiscard]] std::vector<Change> changes(LocalTime now);

  /// nullptr until it was heard.
  [[nodiscard]] const protocol::AgentStatus* status(CarrierId carrier) const;
  [[nodiscard]] bool silent(LocalTime now, CarrierId carrier) const;
  /// Whether it is heard, and hears: the beacons it says to have received grow.
  [[nodiscard]] bool in_touch(LocalTime now, CarrierId carrier) const;

  /// Carriers for which `holds` is false, silent ones included.
  template <class Predicate>
  [[nodiscard]] std::vector<CarrierId> missing(LocalTime now, Predicate holds) const {
    std::vector<CarrierId> out;
    for (const auto& [id, member] : members_) {
      if (member.liveness.silent(now) || !member.status || !holds(*member.status)) out.push_back(id);
    }
    return out;
  }

 private:
  struct Member {
    explicit Member(Duration timeout) : liveness(timeout), hearing(timeout) {}
    protocol::Liveness liveness;
    protocol::Liveness hearing;
    protocol::SequenceJudge sequences;  ///< of the life that is believed
    std::optional<protocol::AgentStatus> status;
    struct Rival {
      LocalTime since{}, last{};
    };
    std::optional<Rival> rival;  ///< any lives that are heard beside the one that is believed
    bool known_present = false;
    bool restarted = false;
  };
  std::map<CarrierId, Member> members_;
};

}  // namespace gyre::coordinator
