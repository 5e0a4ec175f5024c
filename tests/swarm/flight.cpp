#include "tests/swarm/flight.hpp"

#include "common/base/text.hpp"

namespace gyre::swarm {
namespace {

constexpr Duration kGlance = std::chrono::milliseconds(100);

/// Runs until `done`, or for `within`. True when it was done.
template <class Done>
bool fly_until(Swarm& swarm, Duration within, Done done) {
  const TrueTime deadline = swarm.now() + within;
  while (swarm.now() < deadline) {
    if (done()) return true;
    swarm.run_until(swarm.now() + kGlance);
  }
  return done();
}

void find_together(Swarm& swarm, FlightReport& report) {
  const TrueTime healed = swarm.now();
  std::string why;
  const bool agreed = fly_until(swarm, kAgreeWithin, [&] {
    swarm.do_as_told();
    return swarm.agrees(kClocksWithin, &why);
  });
  report.agreed_after = swarm.now() - healed;
  if (!agreed) {
    swarm.checkers().report(Finding::Kind::kLiveness, swarm.now(), "agreement",
                            text("after %.0f s without faults: %s", seconds(kAgreeWithin), why.c_str()));
  }
}

/// A swarm that agrees can still be wedged: it has to come to rest when it is told to, and end.
void come_to_rest(Swarm& swarm) {
  swarm.shut_down();
  const bool ended = fly_until(swarm, kRestWithin, [&] { return swarm.coordinators_alive() == 0; });
  swarm.run_until(swarm.now() + kGlance);  // the agents' clocks get there a little later
  const auto outcome = swarm.last_outcome();
  if (!ended) {
    swarm.checkers().report(Finding::Kind::kLiveness, swarm.now(), "rest",
                            text("not at rest %.0f s after it was told to end", seconds(kRestWithin)));
  } else if (!outcome || !outcome->clean) {
    swarm.checkers().report(Finding::Kind::kLiveness, swarm.now(), "rest",
                            "ended badly: " + (outcome ? outcome->text : "no word"));
  } else if (!swarm.at_rest()) {
    swarm.checkers().report(Finding::Kind::kLiveness, swarm.now(), "rest",
                            "the flight has ended, but not every agent rests");
  }
}

void come_back(Swarm& swarm) {
  if (fly_until(swarm, kMergedWithin, [&] { return swarm.merged(); })) return;
  swarm.checkers().report(Finding::Kind::kLiveness, swarm.now(), "merging",
                          text("somebody is not back at its place %.0f s after the end", seconds(kMergedWithin)));
}

}  // namespace

FlightReport fly(const Scenario& scenario, const Sabotage& sabotage, const Swarm::Trace& trace) {
  Swarm swarm(scenario, sabotage, trace);
  FlightReport report;
  report.seed = scenario.seed;
  swarm.run_until(scenario.heal);
  find_together(swarm, report);
  come_to_rest(swarm);
  come_back(swarm);
  report.findings = swarm.checkers().findings();
  report.extremes = swarm.checkers().extremes();
  report.faults = swarm.faults();
  report.flown = swarm.now().time_since_epoch();
  return report;
}

std::string describe(const FlightReport& report) {
  std::string out;
  for (const Finding& f : report.findings) {
    out += text("seed %llu, %8.3f s, %s, %s: ", static_cast<unsigned long long>(report.seed),
                seconds(f.at.time_since_epoch()), f.kind == Finding::Kind::kSafety ? "safety" : "liveness",
                f.rule.c_str()) +
           f.text + "\n";
  }
  return out.empty()
             ? out
             : out + text("replay with: swarm_sweep --seed %llu\n", static_cast<unsigned long long>(report.seed));
}

}  // namespace gyre::swarm
