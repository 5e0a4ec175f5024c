#include "common/design/prices.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace gyre::design {
namespace {

constexpr double kRelax = 0.05;
constexpr double kReached = 0.01;  // a residual so near to 0
constexpr double kNothing = 1e-4;  // a change of the figure that is none

/// The demand with a limit that is easier to keep, by that share of it.
Demand relaxed(Demand demand) {
  if (is_angle(demand)) {
    demand.limit = std::cos((1.0 + kRelax) * std::acos(demand.limit));
    return demand;
  }
  const double easier = demand.least ? -1.0 : 1.0;
  demand.limit += easier * kRelax * std::abs(demand.limit);
  return demand;
}

}  // namespace

std::vector<Price> prices(Workshop& workshop, const Candidate& candidate) {
  const std::vector<Demand> all = workshop.demands();
  const std::vector<double> residuals = workshop.residuals(candidate);
  const std::vector<std::size_t> raised = workshop.raised();
  std::set<std::string> reached;
  for (std::size_t d = 0; d < all.size(); ++d) {
    if (all[d].origin == Origin::kAsked && std::count(raised.begin(), raised.end(), d) == 0 && residuals[d] > -kReached)
      reached.insert(all[d].name);
  }
  const double figure = workshop.figure(candidate);
  std::vector<Price> out;
  for (const std::string& name : reached) {
    if (!workshop.going("what " + name + " costs")) break;
    std::vector<Demand> eased = all;
    Price price;
    price.name = name;
    for (Demand& demand : eased) {
      if (demand.name != name) continue;
      price.limit = shown_limit(demand);
      demand = relaxed(demand);
      price.relaxed = shown_limit(demand);
      price.unit = demand.unit;
    }
    workshop.demand(eased);
    Candidate again = candidate;
    workshop.settle(again, "what " + name + " costs");
    price.figure = workshop.figure(again);
    const bool something = std::abs(price.figure - figure) > kNothing * std::abs(figure);
    if (again.meets() && something && workshop.better(price.figure, figure)) out.push_back(price);
  }
  workshop.demand(all);
  std::stable_sort(out.begin(), out.end(), [figure](const Price& a, const Price& b) {
    return std::abs(a.figure - figure) > std::abs(b.figure - figure);
  });
  return out;
}

}  // namespace gyre::design
