#include "ground/flight/hurting.hpp"

#include <algorithm>
#include <csignal>
#include <utility>

namespace gyre::ground {

Hurting::Hurting(dds::Node& /*node*/, Supervisor& supervisor, std::vector<Program> programs)
    : supervisor_(supervisor), programs_(std::move(programs)) {}

Answer Hurting::perform(const HurtRequest& wish) {
  return to_process(wish);
}

Answer Hurting::to_process(const HurtRequest& wish) {
  const auto program =
      std::find_if(programs_.begin(), programs_.end(), [&](const Program& one) { return one.name == wish.process; });
  if (program == programs_.end()) return {false, "this flight has no process called \"" + wish.process + "\""};
  const std::string& name = program->name;
  if (wish.kind == HurtKind::kRestart) return restart(*program);
  if (!supervisor_.pid(name)) return {false, name + " has ended: restart it first"};
  switch (wish.kind) {
    case HurtKind::kKill:
      killed_.insert(name);
      stopped_.erase(name);
      supervisor_.send(name, SIGKILL);
      return {true, name + " was killed"};
    case HurtKind::kStop:
      stopped_.insert(name);
      supervisor_.send(name, SIGSTOP);
      return {true, name + " hangs"};
    case HurtKind::kContinue:
      stopped_.erase(name);
      supervisor_.send(name, SIGCONT);
      return {true, name + " goes on"};
    default:
      return {false, "nobody knows how"};
  }
}

Answer Hurting::restart(const Program& program) {
  killed_.insert(program.name);
  stopped_.erase(program.name);
  const Result<pid_t> started = supervisor_.restart(program);
  if (!started) return {false, started.error().text};
  killed_.erase(program.name);
  return {true, program.name + " was started anew"};
}

std::vector<OwnProcess> Hurting::processes() {
  std::vector<OwnProcess> out;
  for (const Program& program : programs_) {
    const auto pid = supervisor_.pid(program.name);
    out.push_back({program.name, pid.value_or(0), pid && stopped_.count(program.name) > 0});
  }
  return out;
}

}  // namespace gyre::ground
