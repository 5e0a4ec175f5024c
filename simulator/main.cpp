// gyre-simulator MISSION: stands where the vehicles and the load would stand. The motion is in core/; this performs.

#include <cinttypes>
#include <memory>
#include <vector>

#include "common/base/interrupts.hpp"
#include "common/base/log.hpp"
#include "common/base/text.hpp"
#include "common/dds/health_reporter.hpp"
#include "common/dds/inbox.hpp"
#include "common/program/laboratory.hpp"
#include "common/program/mission_argument.hpp"
#include "common/program/program.hpp"
#include "simulator/core/simulator.hpp"

namespace {

using gyre::LocalTime;
using gyre::simulator::Outputs;
using gyre::simulator::SimulationSettings;
using gyre::simulator::Simulator;
namespace program = gyre::program;
namespace protocol = gyre::protocol;

struct Arrived {
  gyre::simulator::Event event;
  LocalTime at;
};

/// The wire side: what agents say goes into the inbox with the time it arrived, states go out through the writers.
class Wire {
 public:
  Wire(std::unique_ptr<gyre::dds::Node> opened, const gyre::mechanics::Plan& plan, bool laboratory)
      : node_(std::move(opened)), health_(*node_, "simulator"), laboratory_(*node_, "simulator", laboratory) {
    gyre::dds::Node& node = *node_;
    load_ = node.writer<protocol::LoadState>();
    for (const gyre::mechanics::Carrier& carrier : plan.carriers) {
      carriers_.push_back(node.writer<protocol::CarrierState>(carrier.id));
    }
    for (const gyre::mechanics::Carrier& carrier : plan.carriers) {
      node.read<protocol::Setpoint>(
          [this, own = carrier.id](const protocol::Setpoint& setpoint, LocalTime arrived) {
            protocol::Setpoint own_setpoint = setpoint;
            // A topic belongs to one carrier. Id 0 is nobody's, so the core drops, counts and reports it.
            if (setpoint.carrier != own) own_setpoint.carrier = 0;
            inbox_.push({own_setpoint, arrived});
          },
          carrier.id);
      const auto learn = [this, own = carrier.id](auto message, LocalTime arrived) {
        if (message.carrier == own) inbox_.push({std::move(message), arrived});
      };
      node.read<protocol::AgentStatus>(learn, carrier.id);
      node.read<protocol::HeldPlans>(learn, carrier.id);
    }
  }

  [[nodiscard]] const std::deque<Arrived>& sleep_until(LocalTime deadline) { return inbox_.sleep_until(deadline); }

  void send(const Outputs& out) {
    for (std::size_t i = 0; i < out.carriers.size(); ++i) carriers_[i].write(out.carriers[i]);
    if (out.load) load_.write(*out.load);
  }

  void report_health(const Simulator& simulator) {
    const LocalTime now = gyre::dds::now();
    protocol::DropCounts dropped = simulator.dropped();
    dropped.nonsense += laboratory_.nonsense();
    health_.step(now, simulator.complaint(now), dropped, inbox_.dropped(), inbox_.late());
  }

  [[nodiscard]] std::vector<program::AskedPush> suffer() { return laboratory_.perform(); }

 private:
  gyre::dds::Inbox<Arrived> inbox_;  // outlives the node, whose handlers fill it
  std::unique_ptr<gyre::dds::Node> node_;
  gyre::dds::HealthReporter health_;
  program::Laboratory laboratory_;
  gyre::dds::Writer<protocol::LoadState> load_;
  std::vector<gyre::dds::Writer<protocol::CarrierState>> carriers_;  // in the plan's order
};

SimulationSettings settings_of(const gyre::mission::Mission& mission) {
  SimulationSettings settings;
  settings.carrier_lag_s = mission.simulation.carrier_time_constant_s;
  settings.lag_error = mission.simulation.lag_error;
  settings.holds = mission.holds;
  if (const auto& wind = mission.simulation.wind) {
    settings.wind = {wind->force_w_n, wind->gust_n, wind->gust_time_s};
    settings.seed = wind->seed;
  }
  return settings;
}

void report(const Outputs& out) {
  gyre::log(out.notices);
  if (out.lag) {
    const double skipped_s = gyre::seconds(out.lag->skipped);
    gyre::log_warning(gyre::text("cannot keep real time: %.3f s behind", gyre::seconds(out.lag->behind)) +
                      (skipped_s > 0.0 ? gyre::text("; %.3f s are skipped, the world stood still", skipped_s) : ""));
  }
  if (out.dropped) {
    const protocol::DropCounts& counts = out.dropped->counts;
    gyre::log_warning(gyre::text("dropped so far: %" PRIu64 " nonsense, %" PRIu64 " late, %" PRIu64
                                 " twice; the latest: %s",
                                 counts.nonsense, counts.late, counts.duplicate, out.dropped->latest.c_str()));
  }
  if (out.failure) gyre::log_error(out.failure->text + "; the load is held still meanwhile");
}

void simulate(Simulator& simulator, Wire& wire) {
  while (gyre::take_interrupts().total() == 0) {
    for (const Arrived& arrived : wire.sleep_until(simulator.next_due())) {
      report(simulator.step(arrived.at, arrived.event));
    }
    const LocalTime now = gyre::dds::now();
    if (now < simulator.next_due()) continue;
    const Outputs out = simulator.step(now, gyre::simulator::Advance{});
    wire.send(out);
    report(out);
    wire.report_health(simulator);
    for (const program::AskedPush& asked : wire.suffer()) {
      report(simulator.step(asked.arrived, gyre::simulator::Pushed{asked.push.force_w_n, asked.push.duration}));
    }
  }
}

int run(const std::string& path, const program::Options& options) {
  const auto mission = program::read_mission(path);
  if (!mission) return mission.error();
  auto node = program::open_node(options.network, {gyre::dds::Hub::kSimulator, std::nullopt}, options.laboratory);
  if (!node) return node.error();
  const gyre::mechanics::Plan& plan = mission.value().plan;
  SimulationSettings settings = settings_of(mission.value());
  settings.incarnation = node.value()->incarnation();
  Wire wire(std::move(node).value(), plan, options.laboratory);
  auto simulator = Simulator::create(plan, settings, gyre::dds::now());
  if (!simulator) {
    gyre::log_error(simulator.error().text);
    return program::kFailed;
  }
  gyre::log_info(gyre::text("\"%s\": the load hangs at rest from %zu carriers", mission.value().name.c_str(),
                            plan.carriers.size()));
  Simulator world = std::move(simulator).value();
  simulate(world, wire);
  gyre::log_info(gyre::text("interrupted; ended after %.1f s", gyre::seconds(world.simulated())));
  return program::kGood;
}

}  // namespace

int main(int argc, char** argv) {
  gyre::block_interrupts();
  std::string mission;
  program::Options options;
  const auto simulate = [&]() -> int {
    if (const auto answer = program::start("gyre-simulator", options)) return *answer;
    return run(mission, options);
  };
  return program::run(
      program::Command{"gyre-simulator",
                       "Simulates the load, its cables, winches and carriers, which follow the agents' setpoints.",
                       program::with_common_in_flight({program::mission_argument(mission)}, options), simulate},
      argc, argv);
}
