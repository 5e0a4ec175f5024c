// How far the swarm times of real agents are apart, with clocks made wrong and packets really dropped.
//
// Every eighth of a second an agent stamps a time request with its own clock, and in the same step a setpoint with its
// estimate of swarm time. Its own clock is wrong by what the laboratory's options say, from the moment that its
// incarnation tells; so the true moment of the step is known to the nanosecond, and no delay of a process or a network
// is in the figures. Pairs of agents are compared at the same moment, interpolated between steps.
//
// Beside it the named alternative: taking a beacon's stamp for the time at which it arrives.

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "common/base/text.hpp"
#include "common/dds/clock.hpp"
#include "ground/flight/flight_directory.hpp"
#include "tests/places.hpp"
#include "tests/processes/fault_flight.hpp"
#include "tests/processes/private_network.hpp"

namespace {

using gyre::LocalTime;
using gyre::test::CarrierRecord;
using gyre::test::ClockFault;
using gyre::test::FaultFlight;
using gyre::test::FlightRecord;
using gyre::test::PrivateNetwork;

constexpr int kSettle_s = 5;
constexpr int kMeasure_s = 20;

const std::map<std::string, ClockFault> kClocks{{"coordinator", {0.0, 50.0}},
                                                {"agent 1", {0.5, 100.0}},
                                                {"agent 2", {-0.5, -100.0}},
                                                {"agent 3", {0.5, -100.0}},
                                                {"agent 4", {-0.5, 100.0}}};

/// At a true moment [ns], how far an agent's swarm time is ahead of it [ns].
struct Reading {
  double moment_ns;
  double ahead_ns;
};

std::int64_t ns(LocalTime time) {
  return time.time_since_epoch().count();
}

std::vector<Reading> readings(const CarrierRecord& record, const ClockFault& clock, LocalTime from) {
  std::vector<Reading> out;
  auto setpoint = record.setpoints.begin();
  for (const auto& request : record.time_requests) {
    // The request goes out first, the setpoint next, through one socket.
    while (setpoint != record.setpoints.end() && setpoint->arrived < request.arrived) ++setpoint;
    if (setpoint == record.setpoints.end()) break;
    if (request.arrived < from) continue;
    const auto offset = std::llround(1e9 * clock.offset_s);
    const auto begin = static_cast<std::int64_t>(request.message.incarnation) - offset;
    const double shown_since = static_cast<double>(ns(request.message.sent) - offset - begin);
    const double since = shown_since / (1.0 + 1e-6 * clock.drift_ppm);
    const double swarm_since = static_cast<double>(setpoint->message.swarm_time.time_since_epoch().count() - begin);
    const double ahead = swarm_since - since;
    // A setpoint of another step would be 10 ms off: it is seen, and left out.
    if (!out.empty() && std::abs(ahead - out.back().ahead_ns) > 5e6) continue;
    out.push_back({static_cast<double>(begin) + since, ahead});
  }
  return out;
}

std::optional<double> ahead_at(const std::vector<Reading>& readings, double moment_ns) {
  const auto after = std::lower_bound(readings.begin(), readings.end(), moment_ns,
                                      [](const Reading& r, double moment) { return r.moment_ns < moment; });
  if (after == readings.begin() || after == readings.end()) return std::nullopt;
  const Reading& a = *std::prev(after);
  const double share = (moment_ns - a.moment_ns) / (after->moment_ns - a.moment_ns);
  return a.ahead_ns + share * (after->ahead_ns - a.ahead_ns);
}

std::vector<double> pairwise_us(const FlightRecord& record, LocalTime from) {
  std::vector<std::vector<Reading>> agents;
  for (const auto& [id, carrier] : record.carriers) {
    agents.push_back(readings(carrier, kClocks.at(gyre::test::agent_name(id)), from));
  }
  std::vector<double> apart;
  for (std::size_t i = 0; i < agents.size(); ++i) {
    for (std::size_t j = 0; j < agents.size(); ++j) {
      if (i == j) continue;
      for (const Reading& reading : agents[i]) {
        const auto other = ahead_at(agents[j], reading.moment_ns);
        if (other) apart.push_back(1e-3 * std::abs(reading.ahead_ns - *other));
      }
    }
  }
  return apart;
}

/// Two agents that take a beacon's stamp for the time are apart by as much as its delays differ.
std::vector<double> by_beacon_us(const FlightRecord& record, LocalTime from) {
  std::vector<double> apart;
  std::optional<std::int64_t> last;
  for (const auto& heard : record.beacons) {
    if (heard.arrived < from) continue;
    const std::int64_t delay = ns(heard.arrived) - heard.message.swarm_time.time_since_epoch().count();
    if (last) apart.push_back(1e-3 * std::abs(static_cast<double>(delay - *last)));
    last = delay;
  }
  return apart;
}

void row(const char* what, int lost_percent, std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    return values.empty() ? 0.0 : values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
  };
  std::printf("  %3d %%   %-34s %8.1f %8.1f %8.1f %9zu\n", lost_percent, what, at(0.5), at(0.99), at(1.0),
              values.size());
}

/// Why there is nothing to compare: that is no figure, and least of all a good one.
std::string what_was_heard(const FlightRecord& record, LocalTime from) {
  const auto count = [from](const auto& heards) {
    return std::count_if(heards.begin(), heards.end(), [from](const auto& heard) { return heard.arrived >= from; });
  };
  std::string words = "no two agents can be compared; heard were\n";
  for (const auto& [id, carrier] : record.carriers) {
    words +=
        gyre::text("  agent %u: %td requests, %td setpoints, %zu pairs of them\n", id, count(carrier.time_requests),
                   count(carrier.setpoints), readings(carrier, kClocks.at(gyre::test::agent_name(id)), from).size());
  }
  return words;
}

int fail(const std::string& what) {
  std::fprintf(stderr, "%s\n", what.c_str());
  return 1;
}

}  // namespace

int main() {
  const auto network = PrivateNetwork::enter();
  if (!network) return fail("SKIPPED: " + network.error().text);
  const auto directory = gyre::ground::FlightDirectory::make(std::nullopt);
  if (!directory) return fail(directory.error().text);
  const std::string mission = gyre::test::source_directory() + "/tests/processes/missions/faults.textproto";

  std::printf(
      "Swarm times of 4 agents, pairwise, clocks +-0.5 s and +-100 ppm, over %d s each (aim: p99 below 50 us):\n\n",
      kMeasure_s);
  std::printf("  lost    %-34s %8s %8s %8s %9s\n", "", "p50 us", "p99 us", "max us", "samples");
  for (const int lost_percent : {0, 30, 60}) {
    PrivateNetwork lossy = network.value();
    lossy.heal();
    auto flight =
        FaultFlight::start({mission, directory.value().path(), gyre::test::program_directory(), kClocks, false, false});
    if (!flight) return fail(flight.error().text);
    const auto ready = [&] { return flight.value()->all_ready(); };
    if (!FaultFlight::seconds_until(60.0, ready)) return fail(flight.value()->said_by_all());
    lossy.lose(lost_percent, gyre::test::udp_ports(::getpid()));
    std::this_thread::sleep_for(std::chrono::seconds(kSettle_s));
    const LocalTime from = gyre::dds::now();
    std::this_thread::sleep_for(std::chrono::seconds(kMeasure_s));
    const FlightRecord record = flight.value()->observer().ask([](const FlightRecord& all) { return all; });
    const std::vector<double> apart = pairwise_us(record, from);
    if (apart.empty()) return fail(what_was_heard(record, from) + flight.value()->said_by_all());
    row("two-way exchanges, filtered (Gyre)", lost_percent, apart);
    row("a beacon's stamp at its arrival", lost_percent, by_beacon_us(record, from));
  }
  return 0;
}
