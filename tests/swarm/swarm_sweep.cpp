// swarm_sweep --flights N --first-seed S: flights by the million. swarm_sweep --seed S: one flight, told.

#include <cstdio>
#include <ctime>
#include <map>

#include "common/program/command_line.hpp"
#include "tests/swarm/flight.hpp"

namespace {

using gyre::seconds;
namespace swarm = gyre::swarm;

int replay(std::uint64_t seed) {
  const swarm::Scenario scenario = swarm::scenario(seed);
  std::printf("seed %llu: load %zu with %zu carriers, transitions of %.2f s, silence: %s\n",
              static_cast<unsigned long long>(seed), scenario.load, swarm::loads()[scenario.load].size(),
              seconds(scenario.transition), scenario.silence.stop_after ? "stop" : "fly on");
  const auto trace = [](swarm::TrueTime at, const std::string& what) {
    std::printf("%9.4f  %s\n", seconds(at.time_since_epoch()), what.c_str());
  };
  const swarm::FlightReport report = swarm::fly(scenario, {}, trace);
  std::printf("residual %.3g of the weight, of %.3g allowed; agreed after %.2f s\n%s", report.extremes.residual_share,
              scenario.residual_budget, seconds(report.agreed_after), describe(report).c_str());
  return report.good() ? 0 : 1;
}

/// Of this process: other programs on the machine are not its fault.
double processor_s() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

int sweep(std::uint64_t first, std::uint64_t flights, int shown) {
  std::map<std::string, std::uint64_t> broken;
  double flown_s = 0.0, agreed_s = 0.0, four_flown_s = 0.0, four_took_s = 0.0, of_budget = 0.0, step = 0.0;
  std::uint64_t bad = 0;
  (void)swarm::loads();
  const double began_s = processor_s();
  for (std::uint64_t seed = first; seed < first + flights; ++seed) {
    const swarm::Scenario scenario = swarm::scenario(seed);
    const double before_s = processor_s();
    const swarm::FlightReport report = swarm::fly(scenario);
    if (swarm::loads()[scenario.load].size() == 4) {
      four_flown_s += seconds(report.flown);
      four_took_s += processor_s() - before_s;
    }
    flown_s += seconds(report.flown);
    agreed_s = std::max(agreed_s, seconds(report.agreed_after));
    of_budget = std::max(of_budget, report.extremes.residual_of_budget);
    step = std::max(step, report.extremes.step_of_bound);
    if (report.good()) continue;
    ++bad;
    for (const swarm::Finding& f : report.findings) {
      if (broken[f.rule]++ < static_cast<std::uint64_t>(shown))
        std::printf("seed %llu: %s: %s; at most %.3g in this flight\n", static_cast<unsigned long long>(seed),
                    f.rule.c_str(), f.text.c_str(), report.extremes.residual_share);
    }
  }
  const double took_s = processor_s() - began_s;
  std::printf("%llu flights, %llu with findings\n", static_cast<unsigned long long>(flights),
              static_cast<unsigned long long>(bad));
  for (const auto& [rule, count] : broken)
    std::printf("  %-14s %llu\n", rule.c_str(), static_cast<unsigned long long>(count));
  std::printf("longest agreement %.2f s, residual %.3g of its budget, step %.3g of its bound\n", agreed_s, of_budget,
              step);
  std::printf("%.0f s flown in %.1f s of one core: %.0f times faster than real time; n = 4: %.0f times\n", flown_s,
              took_s, flown_s / took_s, four_flown_s / four_took_s);
  return bad == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  namespace program = gyre::program;
  std::optional<std::uint64_t> seed;
  std::uint64_t first = 1;
  std::uint64_t flights = 1000;
  int shown = 5;
  return program::run(
      program::Command{"swarm_sweep",
                       "Flies whole swarms on virtual time with faults drawn from seeds, and judges them.",
                       {program::own({{"--seed", &seed, "fly this one and tell what happens"},
                                      {"--first-seed", &first, "the first of many"},
                                      {"--flights", &flights, "how many"},
                                      {"--shown", &shown, "findings of one kind that are printed"}})},
                       [&] { return seed ? replay(*seed) : sweep(first, flights, shown); }},
      argc, argv);
}
