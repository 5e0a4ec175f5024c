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

/// Absent: this is the name of nobody who carries.
std::optional<CarrierId> carrier_called(const std::string& name, const std::vector<CarrierId>& ids) {
  const auto found = std::find_if(ids.begin(), ids.end(), [&](CarrierId id) { return agent_name(id) == name; });
  return found == ids.end() ? std::nullopt : std::optional<CarrierId>(*found);
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
    if (const auto id = carrier_called(name, view_.carrier_ids())) {
      agents_[*id].wordless = silent;
      tell_silence(now, *id, agents_[*id]);
      continue;
    }
    tell(now, silent ? Level::kWarning : Level::kInfo, name, silent ? "is not heard" : "is heard again");
  }
}

void Happenings::on(LocalTime now, const protocol::CoordinatorStatus& status) {
  if (status.term != term_) {
    tell(now, Level::kInfo, "coordinator",
         text("leads \"%s\" in term %llu", status.mission.c_str(), protocol::generation(status.term)));
    term_ = status.term;
  }
  const bool news = status.news != news_ && !status.news.empty() && !told_otherwise(status.news);
  if (news) tell(now, Level::kInfo, "coordinator", status.news);
  news_ = status.news;
  for (const CarrierId id : view_.carrier_ids()) {
    Agent& agent = agents_[id];
    agent.named_silent = view_.named_silent(id);
    tell_silence(now, id, agent);
  }
}

void Happenings::tell_silence(LocalTime now, CarrierId id, Agent& agent) {
  const bool silent = agent.named_silent || agent.wordless;
  if (silent == agent.told_silent) return;
  agent.told_silent = silent;
  tell(now, silent ? Level::kWarning : Level::kInfo, agent_name(id), silent ? "is silent" : "is heard again");
}

/// Who comes, goes and begins anew is seen here as well, by who speaks and by whom the coordinator names silent.
bool Happenings::told_otherwise(const std::string& news) const {
  const std::vector<CarrierId> ids = view_.carrier_ids();
  return std::any_of(ids.begin(), ids.end(), [&](CarrierId id) {
    const std::string who = agent_name(id);
    return news == who + " is silent" || news == who + " is here" || news == who + " was restarted";
  });
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
