#include "tests/processes/fault_flight.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <sstream>
#include <thread>

#include "common/base/text.hpp"
#include "common/dds/clock.hpp"
#include "common/mechanics/carrier_slice.hpp"

namespace gyre::test {
namespace {

std::vector<std::string> command_of(const FaultFlight::Options& options, const std::string& name) {
  const std::string bin = options.program_directory;
  if (name == "coordinator") return {bin + "/gyre-coordinator", options.mission};
  if (name == "simulator") return {bin + "/gyre-simulator", options.mission};
  return {bin + "/gyre-agent", "--carrier", name.substr(name.find(' ') + 1)};
}

}  // namespace

std::string agent_name(CarrierId carrier) {
  return "agent " + std::to_string(carrier);
}

FaultFlight::FaultFlight(Options options, mission::Mission mission, std::unique_ptr<FlightObserver> observer)
    : options_(std::move(options)), mission_(std::move(mission)), observer_(std::move(observer)) {
  for (const mechanics::Carrier& carrier : mission_.plan.carriers) carriers_.push_back(carrier.id);
}

Result<std::unique_ptr<FaultFlight>> FaultFlight::start(const Options& options) {
  auto mission = mission::read_mission_file(options.mission);
  if (!mission) return mission.error();
  std::vector<CarrierId> carriers;
  for (const mechanics::Carrier& carrier : mission.value().plan.carriers) carriers.push_back(carrier.id);
  auto observer = FlightObserver::open(carriers, options.watch);
  if (!observer) return observer.error();
  std::unique_ptr<FaultFlight> flight(
      new FaultFlight(options, std::move(mission).value(), std::move(observer).value()));
  if (options.simulator) flight->start_process("simulator");
  for (const CarrierId id : carriers) flight->start_process(agent_name(id));
  flight->start_process("coordinator",
                        options.engage ? std::vector<std::string>{"--engage"} : std::vector<std::string>{});
  return flight;
}

void FaultFlight::start_process(const std::string& name, const std::vector<std::string>& more) {
  std::vector<std::string> command = command_of(options_, name);
  command.insert(command.end(), {"--domain", "0"});
  if (const auto clock = options_.clocks.find(name); clock != options_.clocks.end()) {
    command.insert(command.end(), {"--clock-offset-s", text("%.9f", clock->second.offset_s), "--clock-drift-ppm",
                                   text("%.9f", clock->second.drift_ppm)});
  }
  if (options_.laboratory) command.emplace_back("--laboratory");
  command.insert(command.end(), more.begin(), more.end());
  ++lives_[name];
  auto process = ground::ChildProcess::start(
      command, options_.log_directory + "/" + name + "-" + std::to_string(lives_[name]) + ".txt");
  GYRE_ENSURE(process.ok(), "the programs were built and can be started");
  processes_.erase(name);
  processes_.emplace(name, std::move(process).value());
}

void FaultFlight::kill(const std::string& name) {
  processes_.erase(name);  // a child process is killed, and waited for, when its object goes
}

std::string FaultFlight::said(const std::string& name) const {
  std::ostringstream words;
  words << std::ifstream(options_.log_directory + "/" + name + "-" + std::to_string(lives_.at(name)) + ".txt").rdbuf();
  return words.str();
}

std::string FaultFlight::said_by_all() const {
  std::string words;
  for (const auto& [name, lives] : lives_) words += "-- " + name + "\n" + said(name);
  return words;
}

std::optional<double> FaultFlight::seconds_until(double limit_s, const std::function<bool()>& condition) {
  const LocalTime begin = dds::now();
  while (!condition()) {
    if (seconds(dds::now() - begin) > limit_s) return std::nullopt;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return seconds(dds::now() - begin);
}

bool FaultFlight::every_agent(const std::function<bool(const protocol::AgentStatus&)>& is_so) const {
  constexpr Duration kFresh = std::chrono::milliseconds(300);
  return observer_->ask([&](const FlightRecord& record) {
    return std::all_of(record.carriers.begin(), record.carriers.end(), [&](const auto& entry) {
      const auto& statuses = entry.second.statuses;
      return !statuses.empty() && dds::now() - statuses.back().arrived < kFresh && is_so(statuses.back().message);
    });
  });
}

bool FaultFlight::all_flying() const {
  return every_agent([](const protocol::AgentStatus& s) {
    const protocol::Pace pace = s.course.flown_pace(s.swarm_time);
    return s.state == protocol::AgentState::kFlying && s.course.transitions.empty() && pace.constant(s.swarm_time) &&
           pace.target() == 1.0;
  });
}

bool FaultFlight::all_ready() const {
  return every_agent([](const protocol::AgentStatus& s) { return s.state == protocol::AgentState::kReady; });
}

bool FaultFlight::all_at_rest() const {
  return every_agent([](const protocol::AgentStatus& s) { return s.course.rests(s.swarm_time); });
}

std::optional<protocol::Beacon> FaultFlight::beacon() const {
  return observer_->ask([](const FlightRecord& record) -> std::optional<protocol::Beacon> {
    if (record.beacons.empty()) return std::nullopt;
    return record.beacons.back().message;
  });
}

std::optional<protocol::CommandReply> FaultFlight::reply(std::uint64_t command) const {
  return observer_->ask([command](const FlightRecord& record) -> std::optional<protocol::CommandReply> {
    for (const auto& heard : record.replies) {
      if (heard.message.id == command) return heard.message;
    }
    return std::nullopt;
  });
}

std::uint64_t FaultFlight::term() const {
  return observer_->ask([](const FlightRecord& record) -> std::uint64_t {
    return record.beacons.empty() ? 0 : record.beacons.back().message.term;
  });
}

}  // namespace gyre::test
