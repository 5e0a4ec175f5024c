#include "ground/flight/fly.hpp"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "common/base/interrupts.hpp"
#include "common/base/text.hpp"
#include "common/mechanics/certificate.hpp"
#include "common/program/mission_argument.hpp"
#include "common/program/program.hpp"
#include "ground/check/certificate_table.hpp"
#include "ground/flight/core/flight_table.hpp"
#include "ground/flight/flight.hpp"
#include "ground/flight/flight_directory.hpp"
#include "ground/flight/flight_programs.hpp"
#include "ground/flight/hurting.hpp"
#include "ground/page/page.hpp"

namespace gyre::ground {
namespace {

struct FlyOptions {
  std::string mission;
  std::optional<double> duration_s;
  std::optional<std::string> logs;
  bool keep_logs = false;
  std::optional<std::string> record;
  bool page = false;
  PageOptions page_options;
  program::NetworkOptions network;
};

int say(int exit_code, const std::string& text) {
  std::fprintf(stderr, "%s\n", text.c_str());
  return exit_code;
}

std::vector<CarrierId> carrier_ids(const mission::Mission& mission) {
  std::vector<CarrierId> ids;
  for (const mechanics::Carrier& carrier : mission.plan.carriers) ids.push_back(carrier.id);
  return ids;
}

/// What a person should know before he looks for a defect.
void excuse(const StarvationJudge& starvation) {
  if (!starvation.starved()) return;
  const double late_s = seconds(starvation.late_max());
  say(program::kFailed, text("The machine was starved: a processor came %.2f s late because others had it.", late_s));
}

int report_failure(const FlightFailure& failure, const Supervisor& supervisor, FlightDirectory& directory) {
  directory.keep();
  std::string text = "The flight failed: " + failure.text + ".\n";
  if (failure.culprit) {
    const std::string tail = supervisor.log_tail(*failure.culprit);
    text += "The end of " + supervisor.log_path(*failure.culprit) + ":\n" + (tail.empty() ? "(empty)\n" : tail);
  }
  return say(program::kFailed, text + "All logs: " + directory.path());
}

int conclude(const Flight& flight, FlightDirectory& directory) {
  const std::optional<FlightReport> report = flight.report();
  if (!report) return say(program::kGood, "Ended as asked, before the motion had begun: nothing to judge.");
  const Verdict verdict = flight.by_hand().empty() ? Verdict::kShown : Verdict::kLeftOut;
  std::printf("%s", flight_table(*report, verdict).c_str());
  for (const std::string& what : flight.by_hand()) std::printf("by hand: %s\n", what.c_str());
  const bool written = std::fflush(stdout) == 0;
  if (!flight.by_hand().empty()) {
    return say(written ? program::kGood : program::kFailed,
               "A person had a hand in it: what it came to stands above, and no verdict.");
  }
  if (report->good()) return written ? program::kGood : program::kFailed;
  directory.keep();
  excuse(flight.starvation());
  return say(program::kFailed, "All logs: " + directory.path());
}

std::string how_long(double duration_s) {
  return std::isfinite(duration_s) ? text("for %.1f s", duration_s) : "until ctrl-c";
}

/// Where the flight is shown, if it is to be: the address goes to standard output.
Result<std::unique_ptr<Page>> open_page(const FlyOptions& options, const FlightNetwork& net, Flight& flight,
                                        Hurting& hurting) {
  if (!options.page) return std::unique_ptr<Page>();
  PageOwner owner;
  owner.domain = net.domain;
  owner.owns_processes = true;
  owner.mission_file = std::filesystem::path(options.mission).filename().string();  // not where it lies here
  auto page = Page::open(options.page_options, owner, net.node.get(), flight.view());
  if (!page) return page;
  flight.show_at(*page.value(), hurting);
  std::printf("\nThe page: %s\n\n", page.value()->url().c_str());
  std::fflush(stdout);
  return page;
}

/// Before all others, and waited for: the recording has every word from the first one on.
std::optional<FlightFailure> begin_recording(const FlyOptions& options, const FlightNetwork& net,
                                             const std::string& home, Supervisor& supervisor) {
  if (!options.record) return std::nullopt;
  const std::string recorder = "recorder";
  std::vector<std::string> command{home + "/gyre", "record", "-o", *options.record, "--mission", options.mission};
  for (const std::string& word : net.arguments()) command.push_back(word);
  const Result<pid_t> started = supervisor.start({recorder, std::move(command)});
  if (!started) return FlightFailure{started.error().text, {}};
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (supervisor.log_tail(recorder).find("recording to") == std::string::npos) {
    if (!supervisor.pid(recorder)) return FlightFailure{"it cannot be recorded", recorder};
    if (std::chrono::steady_clock::now() > deadline) return FlightFailure{"the recorder did not begin", recorder};
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return std::nullopt;
}

int fly_certified(const FlyOptions& options, const mission::Mission& mission) {
  block_interrupts();  // before the node starts its threads
  const Result<std::string> home = own_directory();
  if (!home) return say(program::kFailed, home.error().text);
  Result<FlightNetwork, FlightNetworkError> network = open_flight_network(options.network, carrier_ids(mission));
  if (!network) return say(network.error().bad_usage ? program::kBadUsage : program::kFailed, network.error().text);
  const FlightNetwork& net = network.value();
  std::vector<std::string> arguments = net.arguments();
  if (options.page) arguments.emplace_back("--laboratory");  // who looks may also hurt it
  const auto programs = flight_programs(home.value(), options.mission, carrier_ids(mission), arguments);
  if (!programs) return say(program::kFailed, programs.error().text);
  Result<FlightDirectory> made = FlightDirectory::make(options.logs);
  if (!made) return say(program::kFailed, made.error().text);
  FlightDirectory directory = std::move(made).value();
  if (options.keep_logs) directory.keep();

  // Somebody who looks decides how long.
  const double otherwise_s = options.page ? std::numeric_limits<double>::infinity() : mechanics::period_s(mission.plan);
  const double duration_s = options.duration_s.value_or(otherwise_s);
  std::fprintf(stderr, "Flying %s %s on domain %d, logs in %s\n", mission.name.c_str(), how_long(duration_s).c_str(),
               net.domain, directory.path().c_str());
  FlightDisplay display;
  Supervisor supervisor(directory.path());
  Flight flight(mission, duration_s, *net.node, supervisor, display);
  Hurting hurting(*net.node, supervisor, programs.value(), mission.plan.load.mass_kg * mission.plan.gravity_m_s2);
  const auto page = open_page(options, net, flight, hurting);
  if (!page) return say(program::kFailed, page.error().text);
  if (const auto unrecorded = begin_recording(options, net, home.value(), supervisor)) {
    return report_failure(*unrecorded, supervisor, directory);
  }
  for (const Program& program : programs.value()) {
    const Result<pid_t> started = supervisor.start(program);
    if (!started) return report_failure({started.error().text, {}}, supervisor, directory);
  }
  const std::optional<FlightFailure> failure = flight.run();
  display.finish();
  for (const std::string& name : supervisor.stop()) {
    say(program::kGood, name + " did not end when asked, and was killed.");
  }
  if (!failure) return conclude(flight, directory);
  const int code = report_failure(*failure, supervisor, directory);
  excuse(flight.starvation());
  return code;
}

/// What is wrong with the options, and what would be right.
std::optional<std::string> objection_to(const FlyOptions& options) {
  if (options.record && std::filesystem::exists(*options.record)) {
    return *options.record + " is there already: record into another file, or move it away";
  }
  if (!options.page && options.page_options.any()) {
    return "--address, --port, --token and --host are the page's: give --page, too, or leave them out (and "
           "GYRE_PORT and the like in the environment)";
  }
  return objection(options.page_options);
}

int fly(const FlyOptions& options) {
  const auto mission = program::read_mission(options.mission);
  if (!mission) return mission.error();
  if (const auto why = objection_to(options)) return say(program::kBadUsage, *why);
  const mechanics::Certificate certificate = mechanics::certify(mission.value().plan);
  if (!certificate.admissible()) {
    std::printf(
        "%s", certificate_table(mission.value().name, mission.value().plan.limits, certificate, mission.value().silence)
                  .c_str());
    return program::kFailed;
  }
  return fly_certified(options, mission.value());
}

}  // namespace

program::Command fly_command() {
  const auto options = std::make_shared<FlyOptions>();
  return {"fly",
          "Fly a mission on this machine: coordinator, simulator and one agent per carrier, and a verdict.",
          {program::own({program::mission_argument(options->mission),
                         {"--duration", &options->duration_s, "seconds of full motion (else one period of the mission)",
                          program::Bounds{0.1, 7.0 * 86400.0}},
                         {"--logs", &options->logs, "directory for one log per process; kept (else a temporary one)"},
                         {"--keep-logs", &options->keep_logs, "keep the logs of a good flight too"},
                         {"--record", &options->record, "record all that is said into this new file, as gyre record"},
                         {"--page", &options->page, "serve the page of the flight, and fly until ctrl-c"}}),
           {"The page", page_options(options->page_options)},
           program::network_options(options->network, "the first that is free")},
          [options] { return fly(*options); }};
}

}  // namespace gyre::ground
