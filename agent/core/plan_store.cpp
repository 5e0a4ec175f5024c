#include "agent/core/plan_store.hpp"

#include <algorithm>
#include <utility>

namespace gyre::agent {

using protocol::NumberedSlice;
using protocol::PlanNumber;

namespace {

/// What has not been judged may change under its number: whoever offered it may have lied.
bool same(const NumberedSlice& a, const NumberedSlice& b) {
  return a.number == b.number && a.slice == b.slice;
}

std::vector<NumberedSlice>::iterator find_in(std::vector<NumberedSlice>& plans, const NumberedSlice& plan) {
  return std::find_if(plans.begin(), plans.end(), [&](const NumberedSlice& p) { return same(p, plan); });
}

void keep_offered(std::vector<NumberedSlice>& plans, const std::vector<NumberedSlice>& offered) {
  const auto gone = [&](const NumberedSlice& plan) {
    return std::none_of(offered.begin(), offered.end(), [&](const NumberedSlice& o) { return same(o, plan); });
  };
  plans.erase(std::remove_if(plans.begin(), plans.end(), gone), plans.end());
}

bool has_number(const std::vector<NumberedSlice>& plans, const PlanNumber& number) {
  return std::any_of(plans.begin(), plans.end(), [&](const NumberedSlice& p) { return p.number == number; });
}

}  // namespace

bool PlanStore::take(const std::vector<NumberedSlice>& offered, const std::vector<PlanNumber>& in_use) {
  const auto unwanted = [&](const Held& held) {
    const PlanNumber& number = held.plan.number;
    return std::find(in_use.begin(), in_use.end(), number) == in_use.end() && !has_number(offered, number);
  };
  const std::size_t before = accepted_.size();
  accepted_.erase(std::remove_if(accepted_.begin(), accepted_.end(), unwanted), accepted_.end());
  keep_offered(waiting_, offered);
  keep_offered(unflyable_, offered);
  for (const NumberedSlice& plan : offered) {
    // A plan is immutable: what is held under a number is what the number means.
    const bool known = held(plan.number) != nullptr || find_in(unflyable_, plan) != unflyable_.end();
    if (!known && !has_number(waiting_, plan.number)) waiting_.push_back(plan);
  }
  return accepted_.size() != before;
}

std::optional<PlanQuestion> PlanStore::question() {
  if (asked_ || waiting_.empty()) return std::nullopt;
  asked_ = waiting_.front();
  return PlanQuestion{*asked_, vehicle_, machines_};
}

bool PlanStore::take(const PlanVerdict& verdict) {
  if (!asked_ || asked_->number != verdict.number) return false;
  const NumberedSlice judged = *std::exchange(asked_, std::nullopt);
  const auto waiting = find_in(waiting_, judged);
  if (waiting == waiting_.end()) return false;
  waiting_.erase(waiting);
  if (verdict.figures) {
    accepted_.push_back({judged, verdict.figures.value()});
    if (refused_ == judged.number) refused_ = {};  // what was refused under it was another one
    return true;
  }
  unflyable_.push_back(judged);
  refused_ = judged.number;
  refusal_ = verdict.figures.error().text;
  return true;
}

const PlanStore::Held* PlanStore::held(const PlanNumber& number) const {
  const auto found =
      std::find_if(accepted_.begin(), accepted_.end(), [&](const Held& held) { return held.plan.number == number; });
  return found == accepted_.end() ? nullptr : &*found;
}

const mechanics::CarrierSlice* PlanStore::find(const PlanNumber& number) const {
  const Held* found = held(number);
  return found == nullptr ? nullptr : &found->plan.slice;
}

bool PlanStore::flies(const PlanNumber& number, const protocol::Ramp& ramp) const {
  const Held* found = held(number);
  if (found == nullptr) return false;
  const auto keeps = [&ramp](double speed_m_s, double acceleration_m_s2, const std::optional<double>& limit) {
    constexpr double kRounding = 1.0 + 1e-4;  // what is at the limit keeps it
    return !limit || protocol::peaks(ramp, speed_m_s, acceleration_m_s2).acceleration_m_s2 <= *limit * kRounding;
  };
  const mechanics::CarrierFigures& f = found->figures;
  return keeps(f.speed_m_s.max, f.acceleration_max_m_s2, vehicle_.acceleration_max_m_s2) &&
         keeps(f.paid_out_rate_max_m_s(), f.winch_acceleration_max_m_s2, machines_.winch.acceleration_max_m_s2);
}

std::vector<NumberedSlice> PlanStore::held() const {
  const std::size_t told = std::min(accepted_.size(), protocol::kMaxPlans);
  std::vector<NumberedSlice> plans;
  for (std::size_t i = accepted_.size() - told; i < accepted_.size(); ++i) plans.push_back(accepted_[i].plan);
  return plans;
}

std::vector<PlanNumber> PlanStore::accepted() const {
  std::vector<PlanNumber> numbers;
  for (const NumberedSlice& told : held()) numbers.push_back(told.number);
  return numbers;
}

}  // namespace gyre::agent
