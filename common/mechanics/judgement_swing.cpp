#include "common/mechanics/judgement.hpp"

// Holds swings against zero: what grows, where, and what would keep it from growing.

#include <algorithm>
#include <cmath>

#include "common/base/text.hpp"

namespace gyre::mechanics {

void judge_swings(const Swings& swings, std::vector<Reason>& reasons) {
  if (swings.worst_1_s <= kNeutralGrowth_1_s) return;
  reasons.push_back(
      {Rule::kSwing, std::nullopt,
       text("a swing of the load grows by %.2g/s in full motion with a rate or moments of inertia within %.0f %% of "
            "the plan's (%.2g/s at exactly these); choose another rate, attach the cables higher above the centre of "
            "mass, choose offsets that pull the attachments apart, or cables with more damping",
            swings.worst_1_s, 100.0 * kSwingMargin, swings.growth_1_s)});
}

void caution_of_swings(const Swings& swings, std::vector<Reason>& cautions) {
  std::string paces;
  double fastest_1_s = 0.0;
  const auto grows = [](const PaceGrowth& p) {
    return p.pace > 0.0 && p.pace < 1.0 && p.growth_1_s > kNeutralGrowth_1_s;
  };
  for (auto first = swings.paces.begin(); first != swings.paces.end();) {
    const auto beyond = std::find_if_not(first, swings.paces.end(), grows);
    if (beyond == first) {
      ++first;
      continue;
    }
    for (auto p = first; p != beyond; ++p) fastest_1_s = std::max(fastest_1_s, p->growth_1_s);
    paces += (paces.empty() ? "" : ", ") + text("%.2f", first->pace);
    if (beyond - first > 1) paces += text(" .. %.2f", std::prev(beyond)->pace);
    first = beyond;
  }
  if (paces.empty()) return;
  cautions.push_back({Rule::kSwing, std::nullopt,
                      text("on the way from rest a swing of the load grows, by up to %.2g/s, at these parts of full "
                           "pace: %s; a ramp that takes T seconds through them multiplies it by e^(growth T), so pass "
                           "them quickly; to stay there is to let it grow",
                           fastest_1_s, paces.c_str())});
}

void caution_of_stiffness(double stiffness_min_1_s2, std::vector<Reason>& cautions) {
  if (stiffness_min_1_s2 > 0.0) return;
  cautions.push_back(
      {Rule::kStiffness, std::nullopt,
       text(
           "at some moments the cables do not pull the load back to its pose, and were it to rest there, a swing would "
           "grow by up to %.2g/s; in motion that is neither needed for a swing to grow nor enough, because it is of "
           "single moments: rest at another phase, attach the cables higher above the centre of mass, shorten them, "
           "or choose offsets that pull the attachments apart",
           std::sqrt(-stiffness_min_1_s2))});
}

}  // namespace gyre::mechanics
