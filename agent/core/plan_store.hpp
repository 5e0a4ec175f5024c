#pragma once
// The plans an agent holds: what it was offered, and whether its vehicle can fly it.
//
// A plan that is new waits for its verdict (plan_judge.hpp), one at a time, and is held or refused from then on. Only
// what the newest offer says waits, each in the order in which it was first offered: junk that is not offered any more
// is not judged any more, and a plan that stays offered waits for no more than kMaxPlans verdicts, whatever is offered
// beside it. A verdict on what nobody offers any more is worth nothing.

#include <optional>
#include <string>
#include <vector>

#include "agent/core/plan_judge.hpp"
#include "common/mechanics/plan.hpp"
#include "common/protocol/messages.hpp"

namespace gyre::agent {

class PlanStore {
 public:
  /// What this carrier can do.
  PlanStore(mechanics::Limits vehicle, Machines machines) : vehicle_(vehicle), machines_(machines) {}

  /// Keeps what is offered or `in_use`, forgets the rest; what is new waits. True if one that was held is not any more.
  bool take(const std::vector<protocol::NumberedSlice>& offered, const std::vector<protocol::PlanNumber>& in_use);
  /// What is to be judged now; absent while the last one is, or when nothing waits.
  [[nodiscard]] std::optional<PlanQuestion> question();
  /// The answer. True if its plan is still offered: from now on it is held, or refused.
  bool take(const PlanVerdict& verdict);

  /// nullptr when not held: unknown, refused, or not judged yet.
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
  struct Held {
    protocol::NumberedSlice plan;
    mechanics::CarrierFigures figures;
  };
  [[nodiscard]] const Held* held(const protocol::PlanNumber& number) const;

  mechanics::Limits vehicle_;
  Machines machines_;
  std::vector<Held> accepted_;
  std::vector<protocol::NumberedSlice> waiting_;    ///< offered and not judged yet; first offered, first judged
  std::vector<protocol::NumberedSlice> unflyable_;  ///< offered and refused
  std::optional<protocol::NumberedSlice> asked_;    ///< whose verdict is still to come
  protocol::PlanNumber refused_;
  std::string refusal_;
};

}  // namespace gyre::agent
