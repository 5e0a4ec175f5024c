#include "common/design/conflict.hpp"

#include <algorithm>
#include <cstdio>
#include <set>

namespace gyre::design {
namespace {

constexpr double kPulls[] = {0.0, 1.3, 3.5};
constexpr double kNearWorst = 0.05;  // of the worst residual, and of 1

/// Those that nobody asked for, and those with one of these names.
std::vector<Demand> only(const std::vector<Demand>& all, const std::set<std::string>& names) {
  std::vector<Demand> out;
  std::copy_if(all.begin(), all.end(), std::back_inserter(out), [&](const Demand& demand) {
    return demand.origin == Origin::kNecessary || names.count(demand.name) != 0;
  });
  return out;
}

std::string words(const Demand& demand) {
  char text[96];
  (void)std::snprintf(text, sizeof text, "%s %g %s", demand.name.c_str(), shown_limit(demand), demand.unit);
  return text;
}

}  // namespace

std::vector<std::string> conflict(Workshop& workshop, const Candidate& nearest) {
  const std::vector<Demand> all = workshop.demands();
  const std::vector<double> residuals = workshop.residuals(nearest);
  const std::string doing = "what cannot be met together";
  const auto can_be_met = [&](const std::set<std::string>& names) {
    workshop.demand(only(all, names));
    Candidate again = nearest;
    workshop.meet_demands(again, doing);
    const Order order = order_of(nearest.start.plan);
    for (std::size_t k = 0; k < std::size(kPulls) && !again.meets() && workshop.going(doing); ++k) {
      again = workshop.family(order, kPulls[k]);
      if (!again.meets()) again = workshop.whole(again);
    }
    return again.meets();
  };
  std::set<std::string> every;
  std::set<std::string> names;
  for (std::size_t d = 0; d < all.size(); ++d) {
    if (all[d].origin == Origin::kNecessary) continue;
    every.insert(all[d].name);
    if (residuals[d] > nearest.point.worst - kNearWorst * std::max(1.0, nearest.point.worst)) names.insert(all[d].name);
  }
  // What was interrupted has not shown that it cannot be met: then nothing is left out on its account.
  if (can_be_met(names) || workshop.stopped()) names = every;
  const std::set<std::string> before = names;
  for (const std::string& name : before) {
    std::set<std::string> without = names;
    without.erase(name);
    const bool met = can_be_met(without);
    if (workshop.stopped()) break;
    if (!met) names = without;
  }
  workshop.demand(all);
  std::vector<std::string> out;
  for (const std::string& name : names) {
    const auto demand =
        std::find_if(all.begin(), all.end(), [&](const Demand& candidate) { return candidate.name == name; });
    out.push_back(words(*demand));
  }
  return out;
}

}  // namespace gyre::design
