#include "agent/core/plan_store.hpp"

#include <algorithm>

#include "common/mechanics/judgement.hpp"
#include "common/mechanics/orbit_figures.hpp"

namespace gyre::agent {

using protocol::NumberedSlice;
using protocol::PlanNumber;

bool PlanStore::take(const std::vector<NumberedSlice>& offered, const std::vector<PlanNumber>& in_use) {
  const auto wanted = [&](const NumberedSlice& held) {
    const auto same = [&held](const NumberedSlice& o) { return o.number == held.number; };
    return std::find(in_use.begin(), in_use.end(), held.number) != in_use.end() ||
           std::any_of(offered.begin(), offered.end(), same);
  };
  const std::size_t before = accepted_.size();
  accepted_.erase(std::remove_if(accepted_.begin(), accepted_.end(), [&](const auto& held) { return !wanted(held); }),
                  accepted_.end());
  bool changed = accepted_.size() != before;
  for (const NumberedSlice& numbered : offered) {
    // A plan is immutable: what is held under a number is what the number means.
    if (find(numbered.number) != nullptr || numbered.number == refused_) continue;
    judge(numbered);
    changed = true;
  }
  return changed;
}

void PlanStore::judge(const NumberedSlice& offered) {
  std::vector<mechanics::Reason> reasons;
  mechanics::judge_carrier(mechanics::orbit_figures(offered.slice), vehicle_, moves(offered.slice), reasons);
  if (reasons.empty()) {
    accepted_.push_back(offered);
    return;
  }
  refused_ = offered.number;
  refusal_ = reasons.front().text;
}

const mechanics::CarrierSlice* PlanStore::find(const PlanNumber& number) const {
  const auto found =
      std::find_if(accepted_.begin(), accepted_.end(), [&](const auto& a) { return a.number == number; });
  return found == accepted_.end() ? nullptr : &found->slice;
}

bool PlanStore::flies(const PlanNumber& number, const protocol::Ramp& ramp) const {
  const mechanics::CarrierSlice* slice = find(number);
  if (slice == nullptr) return false;
  if (!vehicle_.acceleration_max_m_s2) return true;
  const mechanics::CarrierFigures figures = mechanics::orbit_figures(*slice);
  const auto peak = protocol::peaks(ramp, figures.speed_m_s.max, figures.acceleration_max_m_s2);
  return peak.acceleration_m_s2 <= *vehicle_.acceleration_max_m_s2 * (1.0 + 1e-4);  // what is at the limit keeps it
}

std::vector<NumberedSlice> PlanStore::held() const {
  const std::size_t told = std::min(accepted_.size(), protocol::kMaxPlans);
  return {accepted_.end() - static_cast<std::ptrdiff_t>(told), accepted_.end()};
}

std::vector<PlanNumber> PlanStore::accepted() const {
  std::vector<PlanNumber> numbers;
  for (const NumberedSlice& told : held()) numbers.push_back(told.number);
  return numbers;
}

}  // namespace gyre::agent
