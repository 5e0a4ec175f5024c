#pragma once
// Whom the coordinator leads, and the judge of them: who is there, who hears, who refuses, how far clocks may disagree.
// Told the time, pure; what follows from it is decided in leading.hpp.

#include <optional>
#include <string>
#include <vector>

#include "coordinator/core/fleet.hpp"
#include "coordinator/core/readiness.hpp"

namespace gyre::coordinator {

struct Swarm {
  Swarm(const std::vector<CarrierId>& ids, Duration timeout) : carriers(ids), fleet(ids, timeout), readiness(ids) {}

  std::vector<CarrierId> carriers;
  Fleet fleet;
  Readiness readiness;  ///< what they complain of themselves

  [[nodiscard]] bool has(CarrierId carrier) const;
  /// Who is not heard.
  [[nodiscard]] std::vector<CarrierId> silent(LocalTime now) const;
  /// Those, and who is heard but does not hear.
  [[nodiscard]] std::vector<CarrierId> out_of_touch(LocalTime now) const;
  /// The same in words, "carrier 3 is silent"; absent: nobody.
  [[nodiscard]] std::optional<std::string> why_out_of_touch(LocalTime now) const;
  /// "carrier 3: two agents claim it, A, which is believed, and B; end one of them", or two vehicles; absent: nobody.
  [[nodiscard]] std::optional<std::string> why_claimed_twice(LocalTime now) const;

  /// Why an agent cannot fly this plan, in its own words; absent: none has said so.
  [[nodiscard]] std::optional<std::string> refusal_of(const protocol::PlanNumber& plan) const;
  /// Who has not said that it can fly this plan.
  [[nodiscard]] std::vector<CarrierId> not_accepted(LocalTime now, const protocol::PlanNumber& plan) const;
  /// How far the clocks of those who are heard may disagree.
  [[nodiscard]] Duration skew(LocalTime now) const;
};

/// Those that are not among these.
[[nodiscard]] std::vector<CarrierId> without(std::vector<CarrierId> carriers, const std::vector<CarrierId>& these);

/// Clocks that may disagree by `skew` where `budget` is allowed (0: any), in words; absent: they may not.
[[nodiscard]] std::optional<std::string> beyond_budget(Duration skew, Duration budget);

}  // namespace gyre::coordinator
