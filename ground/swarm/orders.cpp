#include "ground/swarm/orders.hpp"

#include <cstdio>
#include <memory>
#include <optional>
#include <random>
#include <string>

#include "common/base/angle.hpp"
#include "common/dds/inbox.hpp"
#include "common/dds/node.hpp"
#include "common/program/mission_argument.hpp"
#include "common/program/program.hpp"
#include "common/protocol/messages.hpp"
#include "ground/swarm/core/order_desk.hpp"

namespace gyre::ground {
namespace {

using protocol::CommandKind;

/// Between two looks at what has come.
constexpr Duration kLook = std::chrono::milliseconds(50);

/// Two senders at once must not take each other's answer.
std::uint64_t fresh_id() {
  std::random_device source;
  return (static_cast<std::uint64_t>(source()) << 32) | source();
}

/// Where else on this machine a coordinator is: the usual reason for silence is another domain.
std::string coordinators_elsewhere() {
  std::string found;
  for (int domain = 0; domain <= dds::kMaxDomain; ++domain) {
    const dds::SeatHolder holder = dds::seat_holder({dds::Hub::kCoordinator, std::nullopt}, domain);
    if (holder.taken) found += "\n  domain " + std::to_string(domain) + ": " + holder.holder;
  }
  return found.empty() ? "No coordinator runs on this machine; start one with gyre-coordinator or `gyre fly`."
                       : "Coordinators on this machine (choose with --domain):" + found;
}

OrderAnswer ask(dds::Node& node, const protocol::Command& command) {
  const auto inbox = std::make_shared<dds::Inbox<protocol::CommandReply>>();
  node.read<protocol::CommandReply>(
      [inbox](protocol::CommandReply reply, LocalTime) { inbox->push(std::move(reply)); });
  const auto writer = node.writer<protocol::Command>();
  OrderDesk desk;
  desk.ask(dds::now(), command);
  while (true) {
    const OrderDesk::Outputs out = desk.step(dds::now(), writer.readers() > 0);
    if (!out.answers.empty()) return out.answers.front();
    for (const protocol::Command& word : out.send) writer.write(word);
    for (const protocol::CommandReply& reply : inbox->wait_until(dds::now() + kLook)) desk.see(reply);
  }
}

int send(protocol::Command command, const program::NetworkOptions& options) {
  const auto node = program::open_node(options, {});
  if (!node) return node.error();
  command.id = fresh_id();
  const OrderAnswer answer = ask(*node.value(), command);
  if (!answer.reply) {
    std::fprintf(stderr, "No coordinator answered on domain %d within %.0f s.\n%s\n", node.value()->domain(),
                 seconds(answer.found ? OrderDesk::kPatienceOnceFound : OrderDesk::kPatience),
                 coordinators_elsewhere().c_str());
    return program::kFailed;
  }
  std::fprintf(answer.reply->done ? stdout : stderr, "%s\n", answer.reply->text.c_str());
  return answer.reply->done ? program::kGood : program::kFailed;
}

/// The mission is read here first: a bad file is answered on the spot, with its lines.
int retune(const std::string& path, const program::NetworkOptions& options) {
  const auto read = program::read_mission(path);
  if (!read) return read.error();
  const std::string text = mission::to_text(read.value());
  if (text.size() > protocol::kMaxMissionBytes) {
    std::fprintf(stderr, "%s: %zu bytes are more than the %zu a retune can carry; fewer carriers, or a new flight\n",
                 path.c_str(), text.size(), protocol::kMaxMissionBytes);
    return program::kBadUsage;
  }
  protocol::Command command;
  command.kind = CommandKind::kRetune;
  command.mission = text;
  return send(command, options);
}

program::Command order(const char* name, const char* purpose, CommandKind kind) {
  const auto options = std::make_shared<program::NetworkOptions>();
  return {name, purpose, {program::network_options(*options)}, [options, kind] {
            protocol::Command command;
            command.kind = kind;
            return send(command, *options);
          }};
}

}  // namespace

program::Command engage_command() {
  return order("engage", "Tell the coordinator to bring the motion to its full pace.", CommandKind::kEngage);
}

program::Command release_command() {
  struct Options {
    std::optional<double> phase_deg;
    program::NetworkOptions network;
  };
  const auto options = std::make_shared<Options>();
  return {
      "release",
      "Tell the coordinator to bring every carrier to rest, gently, and to keep it so.",
      {program::own({{"--phase", &options->phase_deg, "degrees of the cycle at which to stop (else the next moment)",
                      program::Bounds{-360.0, 360.0}}}),
       program::network_options(options->network)},
      [options] {
        protocol::Command command;
        command.kind = CommandKind::kRelease;
        if (options->phase_deg) command.phase_rad = *options->phase_deg * kPi / 180.0;
        return send(command, options->network);
      }};
}

program::Command freeze_command() {
  return order("freeze", "Tell the coordinator to stop every carrier where it is, as fast as its limits allow.",
               CommandKind::kFreeze);
}

program::Command pace_command() {
  struct Options {
    double pace = 1.0;
    program::NetworkOptions network;
  };
  const auto options = std::make_shared<Options>();
  return {"pace",
          "Tell the coordinator how fast the motion is to run: 1 is full, 0.5 half, 0 rest.",
          {program::own({{"PACE", &options->pace, "0 .. 1", program::Bounds{0.0, 1.0}, program::Take::kByHand}}),
           program::network_options(options->network)},
          [options] {
            protocol::Command command;
            command.kind = CommandKind::kPace;
            command.pace = options->pace;
            return send(command, options->network);
          }};
}

program::Command retune_command() {
  struct Options {
    std::string mission;
    program::NetworkOptions network;
  };
  const auto options = std::make_shared<Options>();
  return {"retune",
          "Tell the coordinator to go over to another motion, in flight.",
          // By hand: a container that knows its own mission would otherwise retune to it.
          {program::own({program::mission_argument(options->mission, program::Take::kByHand)}),
           program::network_options(options->network)},
          [options] { return retune(options->mission, options->network); }};
}

}  // namespace gyre::ground
