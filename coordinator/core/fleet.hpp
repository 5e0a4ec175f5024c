#pragma once
// Who is there: what every agent said last, who has fallen silent, and who is there twice.
//
// Of the lives of an agent one is believed (common/protocol/incumbent.hpp): the one that flies. That is the one whose
// setpoints the vehicle says to follow; where no vehicle says so, one that has a course rather than one that has none;
// else the one that was heard first. What the dead still had under way is passed over.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/protocol/counting.hpp"
#include "common/protocol/incumbent.hpp"
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
  /// Whether to believe what a vehicle says of itself: false for another one that tells where this carrier is.
  [[nodiscard]] bool believes(LocalTime now, const protocol::CarrierState& state);

  /// What an agent has to know of its own place.
  struct Standing {
    std::uint64_t believed = 0;  ///< the incarnation that is; 0: none is heard
    std::string rival;           ///< where the other one is; empty: there is none
  };
  [[nodiscard]] Standing standing(LocalTime now, CarrierId carrier, std::uint64_t incarnation) const;

  /// Carriers that two agents claim, and where these are.
  struct Claim {
    CarrierId carrier;
    std::string believed, rival;
  };
  [[nodiscard]] std::vector<Claim> claimed_twice(LocalTime now) const;
  /// Carriers of which two vehicles, or simulators, tell where they are.
  [[nodiscard]] std::vector<CarrierId> told_twice(LocalTime now) const;

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
      if (member.agent.silent(now) || !member.status || !holds(*member.status)) out.push_back(id);
    }
    return out;
  }

 private:
  /// Vehicles are heard over the radio, which may be out for a second; and nobody waits for the next one.
  static constexpr Duration kVehicleSucceeded = std::chrono::seconds(2);

  struct Member {
    explicit Member(Duration timeout) : agent(timeout), hearing(timeout) {}
    /// Whether this one flies, by what is known beside the order in which they were heard.
    [[nodiscard]] bool prefers(LocalTime now, const protocol::AgentStatus& newcomer) const;

    protocol::Incumbent agent;
    protocol::Liveness hearing;
    protocol::SequenceJudge sequences;            ///< of the life that is believed
    std::optional<protocol::AgentStatus> status;  ///< the last one of it
    std::string rival_address;
    protocol::Incumbent vehicle{kVehicleSucceeded};
    std::uint64_t followed = 0;  ///< by the vehicle, as it said last
    bool known_present = false;
    bool restarted = false;
  };
  std::map<CarrierId, Member> members_;
};

}  // namespace gyre::coordinator
