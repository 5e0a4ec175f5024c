// gyre-coordinator MISSION: certifies the mission, beacons the phase, agrees transitions. All decisions are in core/.

#include <map>
#include <memory>
#include <random>

#include "common/base/interrupts.hpp"
#include "common/base/log.hpp"
#include "common/base/text.hpp"
#include "common/dds/health_reporter.hpp"
#include "common/dds/inbox.hpp"
#include "common/mechanics/certificate.hpp"
#include "common/mission/mission.hpp"
#include "common/program/journal.hpp"
#include "common/program/laboratory.hpp"
#include "common/program/mission_argument.hpp"
#include "common/program/program.hpp"
#include "coordinator/core/coordinator.hpp"
#include "coordinator/journal.hpp"
#include "coordinator/judged_job.hpp"
#include "coordinator/retune_worker.hpp"

namespace {

using gyre::LocalTime;
using gyre::coordinator::Coordinator;
using gyre::coordinator::Event;
using gyre::coordinator::Outcome;
using gyre::coordinator::Outputs;
namespace program = gyre::program;
namespace protocol = gyre::protocol;

constexpr gyre::Duration kEvidencePeriod = std::chrono::milliseconds(18);

/// The wire side: what the coordinator hears goes into the inbox, what it says goes out through the writers.
class Wire {
 public:
  Wire(std::unique_ptr<gyre::dds::Node> opened, const gyre::mechanics::Plan& plan,
       const protocol::JournalEntry& beginning, bool laboratory)
      : node_(std::move(opened)),
        health_(*node_, kName),
        journal_(*node_, kName, beginning, kMostJournal),
        laboratory_(*node_, kName, laboratory) {
    gyre::dds::Node& node = *node_;
    beacon_ = node.writer<protocol::Beacon>();
    replies_ = node.writer<protocol::CommandReply>();
    status_ = node.writer<protocol::CoordinatorStatus>();
    mission_ = node.writer<protocol::MissionText>();
    for (const gyre::mechanics::Carrier& carrier : plan.carriers) {
      time_replies_[carrier.id] = node.writer<protocol::TimeReply>(carrier.id);
      offers_[carrier.id] = node.writer<protocol::PlanOffer>(carrier.id);
    }
    node.read<protocol::Beacon>([this](protocol::Beacon b, LocalTime) { inbox_.push(std::move(b)); });
    node.read<protocol::Health>([this](protocol::Health h, LocalTime) { inbox_.push(std::move(h)); });
    node.read<protocol::Command>([this](protocol::Command c, LocalTime) { inbox_.push(std::move(c)); });
    for (const gyre::mechanics::Carrier& carrier : plan.carriers) {
      node.read<protocol::AgentStatus>(
          [this](protocol::AgentStatus s, LocalTime arrived) {
            inbox_.push(gyre::coordinator::StatusArrived{std::move(s), arrived});
          },
          carrier.id);
      node.read<protocol::HeldPlans>([this](protocol::HeldPlans h, LocalTime) { inbox_.push(std::move(h)); },
                                     carrier.id);
      // Evidence is wanted at the beacons' rate; what comes between from the same vehicle is passed over before it
      // wakes anybody.
      node.read<protocol::CarrierState>(
          [this, own = carrier.id, last = LocalTime::min(), from = std::uint64_t{0}](const protocol::CarrierState& s,
                                                                                     LocalTime arrived) mutable {
            if (s.carrier != own) return;
            if (s.incarnation == from && last != LocalTime::min() && arrived - last < kEvidencePeriod) return;
            last = arrived;
            from = s.incarnation;
            inbox_.push(s);
          },
          carrier.id);
      node.read<protocol::TimeRequest>(
          [this](const protocol::TimeRequest& r, LocalTime arrived) {
            inbox_.push(gyre::coordinator::TimeRequestArrived{r, arrived});
          },
          carrier.id);
    }
  }

  [[nodiscard]] const std::deque<Event>& sleep_until(LocalTime deadline) { return inbox_.sleep_until(deadline); }

  void send(const Outputs& out) {
    if (out.time_reply) time_replies_.at(out.time_reply->carrier).write(*out.time_reply);
    for (const protocol::PlanOffer& offer : out.offers) offers_.at(offer.carrier).write(offer);
    if (out.beacon) beacon_.write(*out.beacon);
    if (out.status) status_.write(*out.status);
    if (out.mission) mission_.write(*out.mission);
    for (const protocol::CommandReply& reply : out.replies) replies_.write(reply);
  }

  void keep(LocalTime now, const Event& event, const Outputs& out) {
    journal_.add([&] { return gyre::coordinator::entry_of(now, event, out); });
  }

  /// What is for people: how it is, and what it was told.
  void report(const Coordinator& coordinator) {
    const LocalTime now = gyre::dds::now();
    protocol::DropCounts dropped = coordinator.dropped();
    dropped.nonsense += laboratory_.nonsense();
    health_.step(now, coordinator.complaint(now), dropped, inbox_.dropped(), inbox_.late());
    journal_.send(now);
  }

  void suffer() { laboratory_.perform(); }

 private:
  static constexpr const char* kName = "coordinator";
  static constexpr std::size_t kMostJournal = std::size_t{16} << 20;  // it is told as much as all agents are

  gyre::dds::Inbox<Event> inbox_;  // outlives the node, whose handlers fill it
  std::unique_ptr<gyre::dds::Node> node_;
  gyre::dds::HealthReporter health_;
  program::Journal journal_;
  program::Laboratory laboratory_;
  gyre::dds::Writer<protocol::Beacon> beacon_;
  gyre::dds::Writer<protocol::CommandReply> replies_;
  gyre::dds::Writer<protocol::CoordinatorStatus> status_;
  gyre::dds::Writer<protocol::MissionText> mission_;
  std::map<gyre::CarrierId, gyre::dds::Writer<protocol::TimeReply>> time_replies_;
  std::map<gyre::CarrierId, gyre::dds::Writer<protocol::PlanOffer>> offers_;
};

Outcome conduct(Coordinator& coordinator, Wire& wire) {
  gyre::coordinator::RetuneWorker retunes(gyre::coordinator::judged_job);
  LocalTime next_tick = gyre::dds::now();
  std::optional<Outcome> finished;
  const auto step = [&](const Event& event) {
    const LocalTime now = gyre::dds::now();
    const Outputs out = coordinator.step(now, event);
    wire.send(out);
    wire.keep(now, event, out);
    gyre::log(out.notices);
    next_tick = out.next_tick;
    if (out.finished) finished = out.finished;
  };
  const auto hear = [&](const Event& event) {
    const auto* command = std::get_if<protocol::Command>(&event);
    if (command == nullptr || command->kind != protocol::CommandKind::kRetune) return step(event);
    if (const auto known = retunes.ask(*command)) step(*known);
  };
  for (int interrupts = 0; !finished;) {
    for (const Event& event : wire.sleep_until(next_tick)) hear(event);
    if (const auto retune = retunes.finished()) step(*retune);
    step(gyre::coordinator::Tick{});
    wire.report(coordinator);
    wire.suffer();
    const gyre::Interrupts asked = gyre::take_interrupts();
    // A service that is restarted or moved: the agents fly on, to the end of their lease, and whoever starts next
    // learns all from them.
    if (asked.by_system > 0)
      return {true, "ended as the system asked; the agents fly on, to the end of their lease if the mission has one"};
    for (int more = asked.by_person; more > 0; --more) {
      if (++interrupts > 1) return {false, "interrupted twice: ended at once, the load is left as it is"};
      step(gyre::coordinator::Shutdown{});
    }
  }
  return *finished;
}

int run(const std::string& path, const program::Options& options, bool engage) {
  const auto mission = program::read_mission(path);
  if (!mission) return mission.error();
  const gyre::mechanics::Certificate certificate = gyre::mechanics::certify(mission.value().plan);
  for (const gyre::mechanics::Reason& reason : certificate.reasons) {
    gyre::log_error(gyre::text("refused: %s: %s", name(reason.rule), reason.text.c_str()));
  }
  if (!certificate.admissible()) return program::kFailed;

  auto node = program::open_node(options.network, {gyre::dds::Hub::kCoordinator, std::nullopt}, options.laboratory);
  if (!node) return node.error();
  gyre::coordinator::CoordinatorOptions coordinator_options;
  coordinator_options.nonce = std::random_device{}();
  coordinator_options.engage_when_ready = engage;

  const gyre::coordinator::Job job = gyre::coordinator::job_of(mission.value(), certificate);
  Coordinator coordinator(job, coordinator_options);
  Wire wire(std::move(node).value(), mission.value().plan,
            gyre::coordinator::beginning(gyre::dds::now(), job, coordinator_options), options.laboratory);
  const Outcome outcome = conduct(coordinator, wire);
  gyre::log(outcome.clean ? gyre::Notice::Level::kInfo : gyre::Notice::Level::kError, outcome.text);
  return outcome.clean ? program::kGood : program::kFailed;
}

}  // namespace

int main(int argc, char** argv) {
  gyre::block_interrupts();
  std::string mission;
  bool engage = false;
  program::Options options;
  const auto conduct = [&]() -> int {
    if (const auto answer = program::start("gyre-coordinator", options)) return *answer;
    return run(mission, options, engage);
  };
  return program::run(
      program::Command{
          "gyre-coordinator",
          "Owns the mission: certifies it, keeps swarm time, beacons the phase, agrees transitions.",
          program::with_common_in_flight({program::mission_argument(mission),
                                          {"--engage", &engage, "start the motion as soon as every agent is ready"}},
                                         options),
          conduct},
      argc, argv);
}
