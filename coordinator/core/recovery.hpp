#pragma once
// What a coordinator that has just started can learn of a swarm that already flies.
//
// Intuition: everything a coordinator ever told, its agents still hold: the course they fly, the plans in it, and swarm
// time. So nothing has to be written to a disk, and no disk can be stale. The newest course any agent holds is the
// course; proposals in it are dropped, because nobody may have been told to go.
//
// Swarm time: an agent's estimate left it before it arrived here, so every status proves that swarm time is at least
// its estimate less its uncertainty. The one that proves most is the best: little delayed, and by a clock that is sure.

#include <map>
#include <optional>

#include "common/protocol/messages.hpp"
#include "coordinator/core/plan_book.hpp"

namespace gyre::coordinator {

class Recovery {
 public:
  void take(LocalTime arrived, const protocol::AgentStatus& status);
  void take(const protocol::HeldPlans& held);

  /// The highest term anybody has followed; 0 when nobody ever followed one.
  [[nodiscard]] std::uint64_t highest_term() const { return highest_term_; }
  /// Whether a swarm flies, and its course.
  [[nodiscard]] const std::optional<protocol::Course>& course() const { return course_; }
  [[nodiscard]] Duration swarm_offset() const { return *swarm_offset_; }  ///< there is one where there is a course
  [[nodiscard]] const std::map<protocol::PlanNumber, Slices>& plans() const { return plans_; }
  /// Why what flies cannot be led with a mission of these slices: another mission's swarm. Absent: it can.
  [[nodiscard]] std::optional<std::string> obstacle_to(const Slices& ours) const;
  /// Every plan of the course is known for this carrier.
  [[nodiscard]] bool complete_for(CarrierId carrier) const;

 private:
  std::uint64_t highest_term_ = 0;
  std::optional<protocol::Course> course_;
  std::optional<Duration> swarm_offset_;
  std::optional<Duration> proven_offset_;  ///< that offset less its uncertainty
  std::map<protocol::PlanNumber, Slices> plans_;
};

}  // namespace gyre::coordinator
