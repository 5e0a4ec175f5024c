#include "ground/swarm_command.hpp"

#include <cstdio>
#include <memory>
#include <optional>
#include <random>
#include <string>

#include "common/dds/inbox.hpp"
#include "common/dds/network_options.hpp"
#include "common/dds/node.hpp"
#include "common/mission/mission.hpp"
#include "common/protocol/messages.hpp"
#include "ground/command.hpp"

namespace gyre::ground {
namespace {

using protocol::CommandKind;

/// To find a coordinator at all.
constexpr Duration kPatience = std::chrono::seconds(5);
/// For its answer: a transition is answered when it is agreed, which takes several rehearsals on a busy machine.
constexpr Duration kPatienceOnceFound = std::chrono::seconds(20);
/// The reply's way back may be found after the command's way there, so the same command is said again, with its id.
constexpr Duration kRepeat = std::chrono::milliseconds(250);

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

std::optional<protocol::CommandReply> ask(dds::Node& node, const protocol::Command& command) {
  const auto inbox = std::make_shared<dds::Inbox<protocol::CommandReply>>();
  node.read<protocol::CommandReply>(
      [inbox](protocol::CommandReply reply, LocalTime) { inbox->push(std::move(reply)); });
  const auto writer = node.writer<protocol::Command>();
  const LocalTime begin = dds::now();
  bool found = false;
  for (LocalTime next = begin; next < begin + (found ? kPatienceOnceFound : kPatience); next += kRepeat) {
    found = found || writer.readers() > 0;
    writer.write(command);
    for (const protocol::CommandReply& reply : inbox->wait_until(next + kRepeat)) {
      if (reply.id == command.id) return reply;
    }
  }
  return std::nullopt;
}

int send(CommandKind kind, const std::string& mission, const dds::NetworkOptions& options) {
  const Result<dds::NodeOptions> chosen = dds::node_options(options, {});
  if (!chosen) {
    std::fprintf(stderr, "%s\n", chosen.error().text.c_str());
    return kExitBadUsage;
  }
  const Result<std::unique_ptr<dds::Node>> node = dds::Node::open(chosen.value());
  if (!node) {
    std::fprintf(stderr, "%s\n", node.error().text.c_str());
    return kExitRefused;
  }
  const auto reply = ask(*node.value(), {fresh_id(), kind, mission});
  if (!reply) {
    std::fprintf(stderr, "No coordinator answered on domain %d within %.0f s.\n%s\n", chosen.value().domain,
                 seconds(kPatience), coordinators_elsewhere().c_str());
    return kExitRefused;
  }
  std::fprintf(reply->done ? stdout : stderr, "%s\n", reply->text.c_str());
  return reply->done ? kExitOk : kExitRefused;
}

/// The mission is read here first: a bad file is answered on the spot, with its lines.
int retune(const std::string& path, const dds::NetworkOptions& options) {
  const Result<mission::Mission> read = mission::read_mission_file(path);
  if (!read) {
    std::fprintf(stderr, "%s\n", read.error().text.c_str());
    return kExitBadUsage;
  }
  const std::string text = mission::to_text(read.value());
  if (text.size() > protocol::kMaxMissionBytes) {
    std::fprintf(stderr, "%s: %zu bytes are more than the %zu a retune can carry; fewer carriers, or a new flight\n",
                 path.c_str(), text.size(), protocol::kMaxMissionBytes);
    return kExitBadUsage;
  }
  return send(CommandKind::kRetune, text, options);
}

void add_retune(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<dds::NetworkOptions>();
  const auto path = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("retune", "Tell the coordinator to go over to another motion, in flight.");
  command->add_option("MISSION", *path, "mission file with the same load and carriers")->required();
  dds::add_network_options(*command, *options);
  command->callback([options, path, &exit_code] { exit_code = retune(*path, *options); });
}

}  // namespace

void add_swarm_commands(CLI::App& app, int& exit_code) {
  struct Word {
    const char* name;
    CommandKind kind;
    const char* help;
  };
  for (const Word& word :
       {Word{"engage", CommandKind::kEngage, "Tell the coordinator to go from rest to the mission's motion."},
        Word{"release", CommandKind::kRelease, "Tell the coordinator to bring every carrier back to rest."},
        Word{"freeze", CommandKind::kFreeze, "Tell the coordinator to hold the load as it is held now."}}) {
    const auto options = std::make_shared<dds::NetworkOptions>();
    CLI::App* command = app.add_subcommand(word.name, word.help);
    dds::add_network_options(*command, *options);
    command->callback([options, kind = word.kind, &exit_code] { exit_code = send(kind, "", *options); });
  }
  add_retune(app, exit_code);
}

}  // namespace gyre::ground
