#include "ground/page/metrics.hpp"

#include <prometheus/gauge.h>
#include <prometheus/registry.h>
#include <prometheus/text_serializer.h>

#include <algorithm>
#include <cmath>

#include "common/base/text.hpp"
#include "common/protocol/term.hpp"
#include "ground/swarm/core/process_list.hpp"

namespace gyre::ground {

namespace {

/// Made anew for each text: a figure that was not told again is not there.
struct Figures {
  using Family = prometheus::Family<prometheus::Gauge>;

  Family& family(const char* name, const char* help) {
    return prometheus::BuildGauge().Name(name).Help(help).Register(registry);
  }

  prometheus::Registry registry;
  Family& calm = family("gyre_calm", "1 while nothing is complained of");
  Family& pace = family("gyre_pace", "share of full motion, now");
  Family& swarm_time = family("gyre_swarm_time_seconds", "the coordinator's beacons carried on");
  Family& term = family("gyre_coordinator_term", "how many coordinators have led this swarm");
  Family& revision = family("gyre_plan_revision", "of the plan that is flown, within its term");
  Family& skew = family("gyre_clock_skew_seconds", "how far clocks may disagree");
  Family& skew_budget = family("gyre_clock_skew_budget_seconds", "how far the plan lets them; 0: any");
  Family& displacement =
      family("gyre_load_displacement_meters", "of the load from its pose, the greatest in the last second");
  Family& rotation = family("gyre_load_rotation_degrees", "the same of its rotation");
  Family& residual = family("gyre_load_residual_ratio", "share of the weight that cables leave unbalanced, at most");
  Family& tension = family("gyre_cable_tension_newtons", "of a carrier's cable");
  Family& margin = family("gyre_cable_tension_margin_newtons", "to the nearer of the mission's limits");
  Family& deviation = family("gyre_carrier_deviation_meters", "of a carrier from where it should be");
  Family& clock = family("gyre_agent_clock_uncertainty_seconds", "of an agent's estimate of swarm time");
  Family& drift = family("gyre_agent_clock_drift_ppm", "of an agent's clock against swarm time");
  Family& missed = family("gyre_agent_beacons_missed", "beacons an agent did not get, since it began");
  Family& dropped = family("gyre_process_dropped", "messages a process dropped, by reason");
  Family& well = family("gyre_process_well", "1: heard, and complains of nothing");
  Family& late = family("gyre_process_late_seconds", "how late its main loop woke, lately");
};

double margin_n(double tension_n, const mechanics::Limits& limits) {
  const double low = limits.tension_min_n ? tension_n - *limits.tension_min_n : tension_n;
  return limits.tension_max_n ? std::min(low, *limits.tension_max_n - tension_n) : low;
}

/// Who does not know it yet says a time longer than any flight.
bool is_known(Duration error) {
  return error < std::chrono::hours(1);
}

}  // namespace

std::string metrics_text(const SwarmView& view, const KnownMission* mission, const LoadWindow& load,
                         const std::optional<std::string>& complaint, LocalTime now) {
  Figures m;
  m.calm.Add({}).Set(complaint ? 0.0 : 1.0);
  if (const auto swarm_time = view.swarm_time(now)) {
    const protocol::Course& course = view.beacon()->course;
    m.swarm_time.Add({}).Set(seconds(swarm_time->time_since_epoch()));
    m.pace.Add({}).Set(course.moment(*swarm_time).pace);
    m.revision.Add({}).Set(static_cast<double>(course.base.number.revision));
  }
  if (const auto& coordinator = view.coordinator()) {
    m.term.Add({}).Set(static_cast<double>(protocol::generation(coordinator->term)));
    if (is_known(coordinator->skew)) m.skew.Add({}).Set(seconds(coordinator->skew));
    m.skew_budget.Add({}).Set(seconds(coordinator->skew_budget));
  }
  if (load.samples > 0) {
    m.displacement.Add({}).Set(load.displacement_max_m);
    m.rotation.Add({}).Set(load.rotation_max_deg);
    m.residual.Add({}).Set(load.residual_max);
  }
  for (const auto& [id, carrier] : view.carriers()) {
    const prometheus::Labels labels{{"carrier", std::to_string(id)}};
    if (carrier.agent && !carrier.agents.silent(now)) {
      const Duration uncertainty = carrier.agent->clock_uncertainty;
      if (is_known(uncertainty)) m.clock.Add(labels).Set(seconds(uncertainty));
      m.drift.Add(labels).Set(carrier.agent->clock_drift_ppm);
      m.missed.Add(labels).Set(static_cast<double>(carrier.agent->beacons_missed));
    }
    if (carrier.vehicles.silent(now)) continue;
    m.tension.Add(labels).Set(carrier.vehicle->tension_n);
    if (mission) m.margin.Add(labels).Set(margin_n(carrier.vehicle->tension_n, mission->mission.plan.limits));
    if (const auto off_m = view.deviation_m(id)) m.deviation.Add(labels).Set(*off_m);
  }
  for (const ProcessLine& line : process_list(view, now)) {
    const prometheus::Labels labels{{"process", line.name}};
    m.well.Add(labels).Set(line.well ? 1.0 : 0.0);
    if (!line.health) continue;
    m.late.Add(labels).Set(seconds(line.health->late_max));
    const protocol::DropCounts& d = line.health->dropped;
    const auto set = [&](const char* reason, std::uint64_t number) {
      m.dropped.Add({{"process", line.name}, {"reason", reason}}).Set(static_cast<double>(number));
    };
    set("late", d.late);
    set("duplicate", d.duplicate);
    set("old_term", d.wrong_term);
    set("nonsense", d.nonsense);
    set("undecodable", line.health->undecodable);
    set("overrun", line.health->overrun);
  }
  return prometheus::TextSerializer().Serialize(m.registry.Collect());
}

}  // namespace gyre::ground
