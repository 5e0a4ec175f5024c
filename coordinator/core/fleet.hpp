#pragma once
// Who is there: what every agent said last, and who has fallen silent.

#include <map>
#include <optional>
#include <vector>

#include "common/protocol/liveness.hpp"
#include "common/protocol/messages.hpp"

namespace gyre::coordinator {

class Fleet {
 public:
  Fleet(const std::vector<CarrierId>& carriers, Duration timeout);

  enum class Verdict { kTaken, kStranger, kDuplicate, kLate };
  Verdict take(LocalTime now, const protocol::AgentStatus& status);
  /// Any other sign of life.
  void heard(LocalTime now, CarrierId carrier);

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
  [[nodiscard]] std::optional<LocalTime> last_heard(CarrierId carrier) const;

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
    explicit Member(Duration timeout) : liveness(timeout) {}
    protocol::Liveness liveness;
    std::optional<protocol::AgentStatus> status;
    std::optional<std::uint64_t> former;  ///< incarnation before this one
    bool known_present = false;
    bool restarted = false;
  };
  std::map<CarrierId, Member> members_;
};

}  // namespace gyre::coordinator
