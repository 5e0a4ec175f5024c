// gyre-agent --carrier N: one carrier's process. All decisions are in core/.

#include <memory>

#include "agent/core/agent.hpp"
#include "agent/journal.hpp"
#include "agent/vehicle/vehicle_options.hpp"
#include "common/base/ensure.hpp"
#include "common/base/interrupts.hpp"
#include "common/base/log.hpp"
#include "common/base/text.hpp"
#include "common/dds/health_reporter.hpp"
#include "common/dds/inbox.hpp"
#include "common/program/journal.hpp"
#include "common/program/laboratory.hpp"
#include "common/program/program.hpp"
#include "common/program/worker.hpp"

namespace {

using gyre::LocalTime;
using gyre::agent::Agent;
using gyre::agent::Event;
using gyre::agent::Heard;
using gyre::agent::Outputs;
using gyre::agent::PlanQuestion;
using gyre::agent::PlanVerdict;
namespace program = gyre::program;
namespace protocol = gyre::protocol;

/// The wire side: what the agent hears goes into the inbox, what it says goes out through the writers.
class Wire {
 public:
  Wire(std::unique_ptr<gyre::dds::Node> opened, const gyre::agent::AgentOptions& options, bool laboratory)
      : node_(std::move(opened)),
        health_(*node_, name(options.carrier)),
        journal_(*node_, name(options.carrier), gyre::agent::beginning(gyre::dds::now(), options)),
        laboratory_(*node_, name(options.carrier), laboratory) {
    gyre::dds::Node& node = *node_;
    const gyre::CarrierId carrier = options.carrier;
    setpoint_ = node.writer<protocol::Setpoint>(carrier);
    status_ = node.writer<protocol::AgentStatus>(carrier);
    time_request_ = node.writer<protocol::TimeRequest>(carrier);
    held_ = node.writer<protocol::HeldPlans>(carrier);
    node.read<protocol::Beacon>([this](protocol::Beacon b, LocalTime arrived) {
      inbox_.push(Heard<protocol::Beacon>{std::move(b), arrived});
    });
    node.read<protocol::PlanOffer>([this](protocol::PlanOffer p, LocalTime) { inbox_.push(std::move(p)); }, carrier);
    node.read<protocol::TimeReply>(
        [this](const protocol::TimeReply& r, LocalTime arrived) {
          inbox_.push(gyre::agent::TimeReplyArrived{r, arrived});
        },
        carrier);
    node.read<protocol::CarrierState>(
        [this](const protocol::CarrierState& s, LocalTime arrived) {
          inbox_.push(Heard<protocol::CarrierState>{s, arrived});
        },
        carrier);
  }

  [[nodiscard]] const std::deque<Event>& sleep_until(LocalTime deadline) { return inbox_.sleep_until(deadline); }

  [[nodiscard]] std::uint64_t undecodable() const { return node_->counters().undecodable; }

  void send(const Outputs& out) {
    if (out.time_request) time_request_.write(*out.time_request);
    if (out.setpoint) setpoint_.write(*out.setpoint);
    if (out.held) held_.write(*out.held);
    if (out.status) status_.write(*out.status);
  }

  void keep(LocalTime now, const Event& event, const Outputs& out) {
    journal_.add([&] { return gyre::agent::entry_of(now, event, out); });
  }

  /// What is for people: how it is, and what it was told.
  void report(const Agent& agent) {
    const LocalTime now = gyre::dds::now();
    protocol::DropCounts dropped = agent.dropped();
    dropped.nonsense += laboratory_.nonsense();
    health_.step(now, agent.complaint(now), dropped, inbox_.dropped(), inbox_.late());
    journal_.send(now);
  }

  void suffer() { laboratory_.perform(); }

 private:
  static std::string name(gyre::CarrierId carrier) { return "agent " + std::to_string(carrier); }

  gyre::dds::Inbox<Event> inbox_;  // outlives the node, whose handlers fill it
  std::unique_ptr<gyre::dds::Node> node_;
  gyre::dds::HealthReporter health_;
  program::Journal journal_;
  program::Laboratory laboratory_;
  gyre::dds::Writer<protocol::Setpoint> setpoint_;
  gyre::dds::Writer<protocol::AgentStatus> status_;
  gyre::dds::Writer<protocol::TimeRequest> time_request_;
  gyre::dds::Writer<protocol::HeldPlans> held_;
};

int run(gyre::agent::AgentOptions options, const program::Options& common) {
  auto node = program::open_node(common.network, {std::nullopt, options.carrier}, common.laboratory);
  if (!node) return node.error();
  options.incarnation = node.value()->incarnation();
  options.address = node.value()->address();
  Agent agent(options);
  gyre::log_info(
      gyre::text("carrier %u: waiting for a coordinator on domain %d", options.carrier, node.value()->domain()));
  Wire wire(std::move(node).value(), options, common.laboratory);

  program::Worker<PlanQuestion, PlanVerdict> judge(gyre::agent::judge);
  LocalTime next_tick = gyre::dds::now();
  const auto step = [&](const Event& event) {
    const LocalTime now = gyre::dds::now();
    const Outputs out = agent.step(now, event);
    wire.send(out);
    wire.keep(now, event, out);
    gyre::log(out.notices);
    if (out.question) GYRE_ENSURE(judge.begin(*out.question), "an agent asks one question at a time");
    next_tick = out.next_tick;
  };
  while (gyre::take_interrupts().total() == 0) {
    for (const Event& event : wire.sleep_until(next_tick)) step(event);
    if (const auto verdict = judge.finished()) step(*verdict);
    step(gyre::agent::Tick{wire.undecodable()});
    wire.report(agent);
    wire.suffer();
  }
  gyre::log_info(gyre::text("carrier %u: ended on request", options.carrier));
  return program::kGood;
}

}  // namespace

int main(int argc, char** argv) {
  gyre::block_interrupts();
  gyre::agent::AgentOptions options;
  gyre::agent::VehicleOptions vehicle;
  program::Options common;
  std::vector<program::OptionGroup> groups =
      program::with_common_in_flight({{"--carrier", &options.carrier, "this carrier's id in the mission",
                                       program::Bounds{1, gyre::kMaxCarrierId}, program::Take::kRequired}},
                                     common);
  groups.push_back(gyre::agent::vehicle_options(vehicle));
  const auto fly = [&]() -> int {
    if (const auto answer = program::start("gyre-agent " + std::to_string(options.carrier), common)) return *answer;
    if (const auto objection = vehicle.objection()) {
      gyre::log_error(*objection);
      return program::kBadUsage;
    }
    options.vehicle = vehicle.limits;
    options.machines = vehicle.machines();
    return run(options, common);
  };
  return program::run(
      program::Command{"gyre-agent",
                       "Flies one carrier: keeps swarm time, evaluates its own setpoint, refuses what it cannot fly.",
                       std::move(groups), fly},
      argc, argv);
}
