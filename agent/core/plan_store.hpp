#pragma once
// The plans an agent holds: what it was offered, and whether its vehicle can fly it.
//
// A slice is certified on arrival against the vehicle's own limits with the same exact figures the coordinator used for
// the whole (mechanics/orbit_figures.hpp): whoever made the plan, this vehicle flies nothing it cannot.

#include <string>
#include <vector>

#include "common/mechanics/plan.hpp"
#include "common/protocol/messages.hpp"

namespace gyre::agent {

class PlanStore {
 public:
  /// `vehicle`: what this carrier can do; absent limits are not judged. Its speed_min holds for plans that move.
  explicit PlanStore(mechanics::Limits vehicle) : vehicle_(vehicle) {}

  /// Takes in what is new; keeps what is offered or `in_use`, forgets the rest. True if anything changed.
  bool take(const std::vector<protocol::NumberedSlice>& offered, const std::vector<protocol::PlanNumber>& in_use);

  /// nullptr when not held or refused.
  [[nodiscard]] const mechanics::CarrierSlice* find(const protocol::PlanNumber& number) const;
  /// The newest kMaxPlans of them. An agent that missed changes holds what it flies besides what is offered, which can
  /// be more than a message takes; the old ones are of no use to anybody else.
  [[nodiscard]] std::vector<protocol::NumberedSlice> held() const;
  /// Whether this vehicle can change its pace like that, by a plan that is held.
  [[nodiscard]] bool flies(const protocol::PlanNumber& number, const protocol::Ramp& ramp) const;
  [[nodiscard]] std::vector<protocol::PlanNumber> accepted() const;
  /// The newest plan this vehicle cannot fly and why; number none() when there is none.
  [[nodiscard]] const protocol::PlanNumber& refused() const { return refused_; }
  [[nodiscard]] const std::string& refusal() const { return refusal_; }

 private:
  void judge(const protocol::NumberedSlice& offered);

  mechanics::Limits vehicle_;
  std::vector<protocol::NumberedSlice> accepted_;
  protocol::PlanNumber refused_;
  std::string refusal_;
};

}  // namespace gyre::agent
