#include "coordinator/core/plan_book.hpp"

#include <algorithm>

namespace gyre::coordinator {

using protocol::PlanNumber;

Slices by_carrier(const std::vector<mechanics::CarrierSlice>& slices) {
  Slices out;
  for (const mechanics::CarrierSlice& slice : slices) out.emplace(slice.id, slice);
  return out;
}

PlanNumber PlanBook::add(std::uint64_t term, Slices slices, const std::string& name) {
  const PlanNumber number{term, ++last_revision_};
  plans_[number] = {std::move(slices), name};
  return number;
}

void PlanBook::learn(const PlanNumber& number, Slices slices) {
  plans_[number] = {std::move(slices), "former"};
}

bool PlanBook::complete(CarrierId carrier, const protocol::NumberedSlice& numbered) {
  const auto plan = plans_.find(numbered.number);
  return plan != plans_.end() && plan->second.slices.emplace(carrier, numbered.slice).second;
}

std::optional<PlanNumber> PlanBook::recognise(const Slices& slices, const std::string& name) {
  for (auto& [number, entry] : plans_) {
    const auto same = [&slices](const auto& known) {
      const auto found = slices.find(known.first);
      return found != slices.end() && found->second == known.second;
    };
    if (entry.slices.empty() || !std::all_of(entry.slices.begin(), entry.slices.end(), same)) continue;
    entry = {slices, name};
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

void PlanBook::keep(const std::vector<PlanNumber>& numbers) {
  for (auto it = plans_.begin(); it != plans_.end();) {
    it = std::find(numbers.begin(), numbers.end(), it->first) == numbers.end() ? plans_.erase(it) : std::next(it);
  }
}

protocol::PlanOffer PlanBook::offer(std::uint64_t term, CarrierId carrier,
                                    const std::vector<PlanNumber>& numbers) const {
  protocol::PlanOffer offer{carrier, term, {}};
  for (const PlanNumber& number : numbers) {
    const mechanics::CarrierSlice* known = slice(number, carrier);
    const auto same = [&number](const protocol::NumberedSlice& s) { return s.number == number; };
    if (known == nullptr || std::any_of(offer.slices.begin(), offer.slices.end(), same)) continue;
    if (offer.slices.size() < protocol::kMaxPlans) offer.slices.push_back({number, *known});
  }
  return offer;
}

}  // namespace gyre::coordinator
