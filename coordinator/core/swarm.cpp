#include "coordinator/core/swarm.hpp"

#include <algorithm>

#include "common/base/text.hpp"

namespace gyre::coordinator {

std::vector<CarrierId> without(std::vector<CarrierId> carriers, const std::vector<CarrierId>& these) {
  const auto among = [&these](CarrierId c) { return std::find(these.begin(), these.end(), c) != these.end(); };
  carriers.erase(std::remove_if(carriers.begin(), carriers.end(), among), carriers.end());
  return carriers;
}

std::optional<std::string> beyond_budget(Duration skew, Duration budget) {
  if (budget <= Duration::zero() || skew <= budget) return std::nullopt;
  return text("the clocks may disagree by %.3g ms, the plan allows %.3g ms", 1e3 * seconds(skew),
              1e3 * seconds(budget));
}

bool Swarm::has(CarrierId carrier) const {
  return std::find(carriers.begin(), carriers.end(), carrier) != carriers.end();
}

std::vector<CarrierId> Swarm::silent(LocalTime now) const {
  return fleet.missing(now, [](const protocol::AgentStatus&) { return true; });
}

std::vector<CarrierId> Swarm::out_of_touch(LocalTime now) const {
  return fleet.missing(now, [&](const protocol::AgentStatus& s) { return fleet.in_touch(now, s.carrier); });
}

std::optional<std::string> Swarm::why_out_of_touch(LocalTime now) const {
  if (const auto who = silent(now); !who.empty()) {
    return listed("carrier", who) + (who.size() == 1 ? " is silent" : " are silent");
  }
  const auto who = out_of_touch(now);
  if (who.empty()) return std::nullopt;
  return listed("carrier", who) + (who.size() == 1 ? " does" : " do") + " not hear the beacons";
}

std::optional<std::string> Swarm::why_claimed_twice(LocalTime now) const {
  const auto claims = fleet.claimed_twice(now);
  if (claims.empty()) {
    const auto told = fleet.told_twice(now);
    if (told.empty()) return std::nullopt;
    return listed("carrier", told) + ": two vehicles, or simulators, tell where it is; end one of them";
  }
  const Fleet::Claim& first = claims.front();
  std::string others;
  if (claims.size() > 1) others = text("; and %zu more carriers", claims.size() - 1);
  return text("carrier %u: two agents claim it, %s, which is believed, and %s; end one of them", first.carrier,
              first.believed.c_str(), first.rival.c_str()) +
         others;
}

std::optional<std::string> Swarm::refusal_of(const protocol::PlanNumber& plan) const {
  for (const CarrierId id : carriers) {
    const protocol::AgentStatus* status = fleet.status(id);
    if (status != nullptr && status->refused == plan) return "refused: " + status->refusal;
  }
  return std::nullopt;
}

std::vector<CarrierId> Swarm::not_accepted(LocalTime now, const protocol::PlanNumber& plan) const {
  return fleet.missing(now, [&plan](const protocol::AgentStatus& s) {
    return std::find(s.accepted.begin(), s.accepted.end(), plan) != s.accepted.end();
  });
}

Duration Swarm::skew(LocalTime now) const {
  Duration worst{};
  for (const CarrierId id : carriers) {
    const protocol::AgentStatus* s = fleet.status(id);
    if (s != nullptr && !fleet.silent(now, id)) {
      worst = std::max(worst, std::min(s->clock_uncertainty, Duration::max() / 4));
    }
  }
  return 2 * worst;  // one early, another late
}

}  // namespace gyre::coordinator
