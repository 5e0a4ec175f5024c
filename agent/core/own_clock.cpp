// What an agent does about its own clock: watches it by whatever arrives, and goes on where it was when it leapt.

#include <algorithm>

#include "agent/core/agent.hpp"
#include "common/base/text.hpp"
#include "common/protocol/sanity.hpp"

namespace gyre::agent {

namespace {

/// Longer than that led by a clock that had leapt, a vehicle is where it was led.
constexpr Duration kMisled = std::chrono::milliseconds(50);

}  // namespace

void Agent::on(LocalTime now, const Heard<protocol::Beacon>& heard, Outputs& out) {
  const protocol::Beacon& beacon = heard.message;
  // Of one coordinator only: two keep the same time no better than they learned it.
  if (sane(beacon) && beacon.term == term_ && heard.arrived <= now) {
    watch_.hear_beacon(heard.arrived, beacon.swarm_time);
  }
  on(now, beacon, out);
}

void Agent::on(LocalTime now, const Heard<protocol::CarrierState>& heard, Outputs& out) {
  const protocol::CarrierState& state = heard.message;
  if (sane(state) && state.carrier == options_.carrier && usable(state.stamp) && heard.arrived <= now &&
      !vehicles_.contested(now)) {
    watch_.hear_vehicle(heard.arrived, state.incarnation, state.stamp);
  }
  on(now, state, out);
}

bool Agent::doubts_clock(LocalTime now) const {
  return (doubted_at_ && now - *doubted_at_ <= options_.doubt) || watch_.doubts();
}

std::optional<Duration> Agent::suspected_before(const protocol::Exchange& exchange) const {
  const auto& suspicion = watch_.suspicion();
  if (suspicion && exchange.request_sent < suspicion->since) return std::nullopt;
  return watch_.lately();
}

/// It would have to be the network's asymmetry that hides a leap.
bool Agent::refutes(const protocol::Exchange& exchange, SwarmTime arrived, Duration leap) {
  const Duration off = exchange.reply_sent + exchange.delay() / 2 - arrived;
  return 2 * std::max(off, -off) < std::max(leap, -leap);
}

void Agent::leapt(LocalTime now, Duration by, const std::optional<Command>& flown, Outputs& out) {
  out.notices.push_back(
      {Notice::Level::kWarning, text("this clock leapt by %.4g ms: swarm time was found anew", 1e3 * seconds(by))});
  // What was sent since is as little as can be undone; else it is the path by now, and left as any other.
  const bool misled = flown_at_ && *flown_at_ > watch_.confirmed() + kMisled;
  if (misled && flown && reference(course_, clock_.at(now))) merge_.begin(clock_.at(now), *flown, path(course_));
  coordinator_.heard(now);  // it answered just now; by this clock all it said before is as old as the leap is long
  doubted_at_.reset();
  vehicle_ages_ = {};  // by this clock its next word would be as old as the leap is long, too
  watch_.leapt(by);
}

}  // namespace gyre::agent
