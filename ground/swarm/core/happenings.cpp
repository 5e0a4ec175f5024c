#include "ground/swarm/core/happenings.hpp"

#include <algorithm>

#include "common/base/angle.hpp"
#include "common/base/text.hpp"
#include "common/protocol/term.hpp"
#include "ground/swarm/core/swarm_picture.hpp"

namespace gyre::ground {
namespace {

using Level = Notice::Level;

std::string agent_name(CarrierId id) {
  return text("agent %u", id);
}

/// Persons who ask at once say their words in turns, so the last one is not enough to know.
bool first_time(std::deque<std::uint64_t>& told, std::uint64_t id) {
  constexpr std::size_t kAtOnce = 64;
  if (std::find(told.begin(), told.end(), id) != told.end()) return false;
  told.push_back(id);
  if (told.size() > kAtOnce) told.pop_front();
  return true;
}

}  // namespace

std::string order_words(const protocol::Command& command) {
  switch (command.kind) {
    case protocol::CommandKind::kEngage:
      return "engage";
    case protocol::CommandKind::kRelease:
      return command.phase_rad ? text("release, to rest at %.3g degrees", degrees(*command.phase_rad)) : "release";
    case protocol::CommandKind::kFreeze:
      return "freeze";
    case protocol::CommandKind::kRetune:
      return "retune to another motion";
    case protocol::CommandKind::kPace:
      return text("pace %.3g", command.pace);
  }
  return "something";
}

void Happenings::tell(LocalTime now, Level level, const std::string& who, const std::string& text) {
  all_.push_back({++last_number_, view_.swarm_time(now), level, who, text});
  if (all_.size() > kKept) all_.pop_front();
}

void Happenings::look(LocalTime now, const SwarmMessage& message) {
  std::visit([&](const auto& one) { on(now, one); }, message);
}

void Happenings::look(LocalTime now) {
  const bool leaderless = view_.beacon_heard().ever_heard() && view_.beacon_heard().silent(now);
  if (leaderless != leaderless_) {
    leaderless_ = leaderless;
    tell(now, leaderless ? Level::kError : Level::kInfo, "coordinator", leaderless ? "is not heard" : "is heard again");
  }
  for (const auto& [name, process] : view_.processes()) {
    Process& known = processes_[name];
    const bool silent = process.heard.silent(now);
    if (silent == known.silent) continue;
    known.silent = silent;
    if (name == "coordinator") continue;  // told above, and sooner
    tell(now, silent ? Level::kWarning : Level::kInfo, name, silent ? "is not heard" : "is heard again");
  }
}

void Happenings::on(LocalTime now, const protocol::CoordinatorStatus& status) {
  if (status.term != term_) {
    tell(now, Level::kInfo, "coordinator",
         text("leads \"%s\" in term %llu", status.mission.c_str(), protocol::generation(status.term)));
    term_ = status.term;
  }
  if (status.news != news_ && !status.news.empty()) tell(now, Level::kInfo, "coordinator", status.news);
  news_ = status.news;
  for (const CarrierId id : view_.carrier_ids()) {
    Agent& agent = agents_[id];
    const bool silent = view_.named_silent(id);
    if (silent == agent.silent) continue;
    agent.silent = silent;
    tell(now, silent ? Level::kWarning : Level::kInfo, "coordinator",
         agent_name(id) + (silent ? " is silent" : " is heard again"));
  }
}

void Happenings::on(LocalTime now, const protocol::AgentStatus& status) {
  Agent& agent = agents_[status.carrier];
  const std::string who = agent_name(status.carrier);
  if (status.incarnation != agent.incarnation) {
    tell(now, Level::kInfo, who,
         agent.incarnation == 0 ? "is here: " + status.address : "began anew: " + status.address);
    agent.incarnation = status.incarnation;
    agent.state = protocol::AgentState::kWaiting;
  }
  if (status.state != agent.state) {
    agent.state = status.state;
    const bool alone = status.state == protocol::AgentState::kAlone;
    tell(now, alone ? Level::kWarning : Level::kInfo, who,
         alone ? "flies on alone" : text("is %s", name(status.state)));
  }
  if (status.refused != agent.refused) {
    agent.refused = status.refused;
    if (!status.refused.none()) tell(now, Level::kError, who, "refuses a plan: " + status.refusal);
  }
}

void Happenings::on(LocalTime now, const protocol::Health& health) {
  Process& process = processes_[health.process];
  const bool complains = !health.complaint.empty();
  if (complains == process.complained) return;
  process.complained = complains;
  tell(now, complains ? Level::kWarning : Level::kInfo, health.process,
       complains ? health.complaint : "has nothing to complain of any more");
}

void Happenings::on(LocalTime now, const protocol::Command& command) {
  if (!first_time(commands_, command.id)) return;
  tell(now, Level::kInfo, "a person", "asks: " + order_words(command));
}

void Happenings::on(LocalTime now, const protocol::CommandReply& reply) {
  if (!first_time(replies_, reply.id)) return;
  tell(now, reply.done ? Level::kInfo : Level::kWarning, "coordinator", "answers: " + reply.text);
}

}  // namespace gyre::ground
