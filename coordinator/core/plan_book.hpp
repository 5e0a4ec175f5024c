#pragma once
// Every plan the coordinator may refer to, by number: what each carrier has to know of it, and what it is called.

#include <map>
#include <string>
#include <vector>

#include "common/mechanics/carrier_slice.hpp"
#include "common/mechanics/certificate.hpp"
#include "common/protocol/messages.hpp"

namespace gyre::coordinator {

using Slices = std::map<CarrierId, mechanics::CarrierSlice>;

/// By carrier id.
[[nodiscard]] Slices by_carrier(const std::vector<mechanics::CarrierSlice>& slices);

class PlanBook {
 public:
  /// Under the next revision of this term.
  protocol::PlanNumber add(std::uint64_t term, Slices slices, const std::string& name);
  /// A plan learned back from the agents, under the number they know it by.
  void learn(const protocol::PlanNumber& number, Slices slices);
  /// What a plan lacked for a carrier, one that is not known at all if `wanted`; true if it did.
  bool complete(const protocol::NumberedSlice& numbered, bool wanted);
  /// The number of a learned plan that is this one, carrier by carrier; it takes the name, and what it lacked.
  [[nodiscard]] std::optional<protocol::PlanNumber> recognise(const Slices& slices, const std::string& name);

  /// nullptr when not known, or not known for this carrier.
  [[nodiscard]] const mechanics::CarrierSlice* slice(const protocol::PlanNumber& number, CarrierId carrier) const;
  [[nodiscard]] std::vector<mechanics::CarrierSlice> slices(const protocol::PlanNumber& number) const;
  [[nodiscard]] const char* name(const protocol::PlanNumber& number) const;
  /// What its carriers do at their worst at full pace, as far as they are known.
  [[nodiscard]] const std::vector<mechanics::CarrierFigures>& figures(const protocol::PlanNumber& number) const;

  /// Forgets all others.
  void keep(const std::vector<protocol::PlanNumber>& numbers);
  /// What is known of these for a carrier, the first kMaxPlans of them.
  [[nodiscard]] std::vector<protocol::NumberedSlice> told(CarrierId carrier,
                                                          const std::vector<protocol::PlanNumber>& numbers) const;

 private:
  struct Entry {
    Slices slices;
    std::string name;
    mutable std::vector<mechanics::CarrierFigures> figures;  // worked out when they are first asked for
  };
  std::map<protocol::PlanNumber, Entry> plans_;
  std::uint64_t last_revision_ = 0;
};

}  // namespace gyre::coordinator
