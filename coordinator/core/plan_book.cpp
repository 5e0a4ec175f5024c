#include "coordinator/core/plan_book.hpp"

#include <algorithm>

#include "common/mechanics/orbit_figures.hpp"

namespace gyre::coordinator {

using protocol::PlanNumber;

Slices by_carrier(const std::vector<mechanics::CarrierSlice>& slices) {
  Slices out;
  for (const mechanics::CarrierSlice& slice : slices) out.emplace(slice.id, slice);
  return out;
}

PlanNumber PlanBook::add(std::uint64_t term, Slices slices, const std::string& name) {
  const PlanNumber number{term, ++last_revision_};
  plans_[number] = {std::move(slices), name, {}};
  return number;
}

void PlanBook::learn(const PlanNumber& number, Slices slices) {
  plans_[number] = {std::move(slices), "former", {}};
}

bool PlanBook::complete(const protocol::NumberedSlice& numbered, bool wanted) {
  if (wanted && plans_.count(numbered.number) == 0) learn(numbered.number, {});
  const auto plan = plans_.find(numbered.number);
  return plan != plans_.end() && plan->second.slices.emplace(numbered.slice.id, numbered.slice).second;
}

std::optional<PlanNumber> PlanBook::recognise(const Slices& slices, const std::string& name) {
  for (auto& [number, entry] : plans_) {
    const auto same = [&slices](const auto& known) {
      const auto found = slices.find(known.first);
      return found != slices.end() && mechanics::alike(found->second, known.second);
    };
    if (entry.slices.empty() || !std::all_of(entry.slices.begin(), entry.slices.end(), same)) continue;
    entry = {slices, name, {}};
    return number;
  }
  return std::nullopt;
}

const mechanics::CarrierSlice* PlanBook::slice(const PlanNumber& number, CarrierId carrier) const {
  const auto plan = plans_.find(number);
  if (plan == plans_.end()) return nullptr;
  const auto found = plan->second.slices.find(carrier);
  return found == plan->second.slices.end() ? nullptr : &found->second;
}

std::vector<mechanics::CarrierSlice> PlanBook::slices(const PlanNumber& number) const {
  std::vector<mechanics::CarrierSlice> out;
  const auto plan = plans_.find(number);
  if (plan == plans_.end()) return out;
  for (const auto& [carrier, slice] : plan->second.slices) out.push_back(slice);
  return out;
}

const char* PlanBook::name(const PlanNumber& number) const {
  const auto plan = plans_.find(number);
  return plan == plans_.end() ? "unknown" : plan->second.name.c_str();
}

const std::vector<mechanics::CarrierFigures>& PlanBook::figures(const PlanNumber& number) const {
  static const std::vector<mechanics::CarrierFigures> kNone;
  const auto plan = plans_.find(number);
  if (plan == plans_.end()) return kNone;
  const Entry& entry = plan->second;
  if (entry.figures.size() != entry.slices.size()) {
    entry.figures.clear();
    for (const auto& [carrier, slice] : entry.slices) entry.figures.push_back(mechanics::orbit_figures(slice));
  }
  return entry.figures;
}

void PlanBook::keep(const std::vector<PlanNumber>& numbers) {
  for (auto it = plans_.begin(); it != plans_.end();) {
    it = std::find(numbers.begin(), numbers.end(), it->first) == numbers.end() ? plans_.erase(it) : std::next(it);
  }
}

std::vector<protocol::NumberedSlice> PlanBook::told(CarrierId carrier, const std::vector<PlanNumber>& numbers) const {
  std::vector<protocol::NumberedSlice> out;
  for (const PlanNumber& number : numbers) {
    const mechanics::CarrierSlice* known = slice(number, carrier);
    const auto same = [&number](const protocol::NumberedSlice& s) { return s.number == number; };
    if (known == nullptr || std::any_of(out.begin(), out.end(), same)) continue;
    if (out.size() < protocol::kMaxPlans) out.push_back({number, *known});
  }
  return out;
}

}  // namespace gyre::coordinator
