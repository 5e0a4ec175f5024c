// Every field of every message is named: a struct that gains one does not compile here, until it is named and listed.

#include "common/protocol/fields.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <type_traits>

namespace gyre::protocol {
namespace {

template <class... Members>
constexpr std::size_t count(const Members&... /*members*/) {
  return sizeof...(Members);
}

// clang-format off
std::size_t members(PlanNumber& m) { auto& [a, b] = m; return count(a, b); }
std::size_t members(TimedPlan& m) { auto& [a, b] = m; return count(a, b); }
std::size_t members(Transition& m) { auto& [a, b, c] = m; return count(a, b, c); }
std::size_t members(PlanMoment& m) { auto& [a, b, c, d] = m; return count(a, b, c, d); }
std::size_t members(Ramp& m) { auto& [a, b, c, d] = m; return count(a, b, c, d); }
std::size_t members(Pace& m) { auto& [a] = m; return count(a); }
std::size_t members(Wish& m) { auto& [a, b, c] = m; return count(a, b, c); }
std::size_t members(Course& m) { auto& [a, b, c, d, e, f, g, h] = m; return count(a, b, c, d, e, f, g, h); }
std::size_t members(Beacon& m) { auto& [a, b, c, d, e, f] = m; return count(a, b, c, d, e, f); }
std::size_t members(mechanics::EdgePush& m) { auto& [a, b, c, d] = m; return count(a, b, c, d); }
std::size_t members(mechanics::Harmonic& m) { auto& [a, b] = m; return count(a, b); }
std::size_t members(mechanics::Oscillation& m) { auto& [a, b, c, d] = m; return count(a, b, c, d); }
std::size_t members(mechanics::LengthLaw& m) { auto& [a, b, c] = m; return count(a, b, c); }
std::size_t members(mechanics::CarrierSlice& m) { auto& [a, b, c, d, e, f, g, h, i, j] = m; return count(a, b, c, d, e, f, g, h, i, j); }
std::size_t members(NumberedSlice& m) { auto& [a, b] = m; return count(a, b); }
std::size_t members(PlanOffer& m) { auto& [a, b, c, d, e] = m; return count(a, b, c, d, e); }
std::size_t members(HeldPlans& m) { auto& [a, b, c, d] = m; return count(a, b, c, d); }
std::size_t members(TimeRequest& m) { auto& [a, b, c, d] = m; return count(a, b, c, d); }
std::size_t members(TimeReply& m) { auto& [a, b, c, d, e, f, g, h, i] = m; return count(a, b, c, d, e, f, g, h, i); }
std::size_t members(DropCounts& m) { auto& [a, b, c, d] = m; return count(a, b, c, d); }
std::size_t members(AgentStatus& m) { auto& [a, b, c, d, e, f, g, h, i, j, k, l, n, o, p, q, r] = m; return count(a, b, c, d, e, f, g, h, i, j, k, l, n, o, p, q, r); }
std::size_t members(Setpoint& m) { auto& [a, b, c, d, e, f, g, h, i, j, k, l, n] = m; return count(a, b, c, d, e, f, g, h, i, j, k, l, n); }
std::size_t members(CarrierState& m) { auto& [a, b, c, d, e, f, g, h, i, j, k] = m; return count(a, b, c, d, e, f, g, h, i, j, k); }
std::size_t members(LoadState& m) { auto& [a, b, c, d, e, f, g] = m; return count(a, b, c, d, e, f, g); }
std::size_t members(Command& m) { auto& [a, b, c, d, e] = m; return count(a, b, c, d, e); }
std::size_t members(CommandReply& m) { auto& [a, b, c] = m; return count(a, b, c); }
std::size_t members(CoordinatorStatus& m) { auto& [a, b, c, d, e, f, g, h, i] = m; return count(a, b, c, d, e, f, g, h, i); }
std::size_t members(MissionText& m) { auto& [a, b, c] = m; return count(a, b, c); }
std::size_t members(Health& m) { auto& [a, b, c, d, e, f, g] = m; return count(a, b, c, d, e, f, g); }
std::size_t members(Disturbance& m) { auto& [a, b, c, d, e, f] = m; return count(a, b, c, d, e, f); }
std::size_t members(JournalPiece& m) { auto& [a, b, c, d] = m; return count(a, b, c, d); }
// clang-format on

template <class Struct>
class EveryStruct : public testing::Test {};

using Structs = testing::Types<PlanNumber, TimedPlan, Transition, PlanMoment, Ramp, Pace, Wish, Course, Beacon,
                               mechanics::EdgePush, mechanics::Harmonic, mechanics::Oscillation, mechanics::LengthLaw,
                               mechanics::CarrierSlice, NumberedSlice, PlanOffer, HeldPlans, TimeRequest, TimeReply,
                               DropCounts, AgentStatus, Setpoint, CarrierState, LoadState, Command, CommandReply,
                               CoordinatorStatus, MissionText, Health, Disturbance, JournalPiece>;
TYPED_TEST_SUITE(EveryStruct, Structs);

TYPED_TEST(EveryStruct, NamesEachOfItsFieldsOnce) {
  TypeParam message;
  std::set<std::string> names;
  std::set<const void*> places;
  for_each_field<TypeParam>([&](const auto& field) {
    names.insert(field.name);
    places.insert(&(message.*field.member));
  });
  EXPECT_EQ(names.size(), members(message));
  EXPECT_EQ(places.size(), members(message));
}

}  // namespace
}  // namespace gyre::protocol
