#include "ground/flight/hurting.hpp"

#include <algorithm>
#include <csignal>
#include <utility>
#include <variant>

namespace gyre::ground {
namespace {

std::vector<std::string> names_of(const std::vector<Program>& programs) {
  std::vector<std::string> names;
  for (const Program& program : programs) names.push_back(program.name);
  return names;
}

int number_of(SignalDeed::Kind kind) {
  switch (kind) {
    case SignalDeed::Kind::kStop:
      return SIGSTOP;
    case SignalDeed::Kind::kContinue:
      return SIGCONT;
    case SignalDeed::Kind::kKill:
      break;
  }
  return SIGKILL;
}

}  // namespace

Hurting::Hurting(dds::Node& node, Supervisor& supervisor, std::vector<Program> programs, double load_weight_n)
    : laboratory_(node.writer<protocol::Disturbance>()),
      supervisor_(supervisor),
      programs_(std::move(programs)),
      judge_(names_of(programs_), load_weight_n) {}

Answer Hurting::perform(LocalTime now, const HurtRequest& wish) {
  FlightSeen seen;
  for (const Program& program : programs_) {
    if (supervisor_.pid(program.name)) seen.running.insert(program.name);
  }
  seen.laboratory_listens = laboratory_.readers() > 0;
  const HurtVerdict verdict = judge_.judge(now, wish, seen);
  if (const auto* signal = std::get_if<SignalDeed>(&verdict.deed)) {
    supervisor_.send(signal->process, number_of(signal->kind));
  } else if (const auto* disturbance = std::get_if<protocol::Disturbance>(&verdict.deed)) {
    laboratory_.write(*disturbance);
  } else if (const auto* again = std::get_if<RestartDeed>(&verdict.deed)) {
    return restart(again->process);
  }
  return verdict.answer;
}

Answer Hurting::restart(const std::string& name) {
  const auto program =
      std::find_if(programs_.begin(), programs_.end(), [&](const Program& one) { return one.name == name; });
  const Result<pid_t> started = supervisor_.restart(*program);
  return judge_.restarted(name, started ? std::nullopt : std::optional<std::string>(started.error().text));
}

std::vector<OwnProcess> Hurting::processes() {
  std::vector<OwnProcess> out;
  for (const Program& program : programs_) {
    const auto pid = supervisor_.pid(program.name);
    out.push_back({program.name, pid.value_or(0), pid && judge_.hangs(program.name)});
  }
  return out;
}

}  // namespace gyre::ground
