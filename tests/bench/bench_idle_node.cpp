// The floor beside a real gyre-agent: a bare Fast DDS process that sends and receives what an agent in steady flight
// does, the same samples at the same rates to as many readers in as many processes, and computes nothing.
//
//   bench_idle_node agent SECONDS DOMAIN CARRIER   what is measured, and the same for the other carriers
//   bench_idle_node coordinator SECONDS DOMAIN     company: sends phase 50 Hz, replies 8 Hz; reads all but setpoints
//   bench_idle_node simulator SECONDS DOMAIN       company: sends states 100 Hz; reads setpoints, status, held
//   bench_idle_node ground SECONDS DOMAIN          company: reads status, states, health
//
// Run all, with an agent for each carrier; each prints what it cost. Written against Fast DDS itself, so that nothing
// of common/dds but its names is in the floor.

#include <sys/resource.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "common/dds/fastdds_version.hpp"
#include "tests/bench/bare_participant.hpp"

namespace {

using gyre::bench::open_bare_participant;
namespace fast = gyre::dds::fast::api;
namespace idl = gyre::dds::fast::idl;
using gyre::dds::fast::kOk;
using Clock = std::chrono::steady_clock;

constexpr int kCarriers = 4;
constexpr int kTicksPerSecond = 100;
constexpr int kTicksPerStatus = 10;
constexpr int kTicksPerRequest = 13;

template <class Qos>
Qos with_delivery(Qos qos, bool reliable) {
  qos.reliability().kind = reliable ? fast::RELIABLE_RELIABILITY_QOS : fast::BEST_EFFORT_RELIABILITY_QOS;
  qos.data_sharing().off();
  return qos;
}

/// Takes every sample, as whoever wants it would, and counts it.
template <class Support>
class Counter final : public fast::DataReaderListener {
 public:
  explicit Counter(std::string name) : name_(std::move(name)) {}
  ~Counter() override { std::printf("  received %6d of %s\n", count_.load(), name_.c_str()); }

  void on_data_available(fast::DataReader* reader) override {
    typename Support::type sample;
    fast::SampleInfo info;
    while (reader->take_next_sample(&sample, &info) == kOk) ++count_;
  }

 private:
  std::string name_;
  std::atomic<int> count_{0};
};

class Node {
 public:
  explicit Node(fast::DomainParticipant& participant)
      : participant_(participant),
        publisher_(*participant.create_publisher(fast::PUBLISHER_QOS_DEFAULT)),
        subscriber_(*participant.create_subscriber(fast::SUBSCRIBER_QOS_DEFAULT)) {}
  ~Node() {
    for (fast::DataReader* reader : readers_) reader->set_listener(nullptr);
    participant_.delete_contained_entities();
    fast::DomainParticipantFactory::get_instance()->delete_participant(&participant_);
  }
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  template <class Support>
  fast::DataWriter* write(const std::string& name, bool reliable = false) {
    fast::DataWriterQos qos = with_delivery(fast::DATAWRITER_QOS_DEFAULT, reliable);
    gyre::dds::fast::heartbeat_period(qos) = {0, 30'000'000};
    return publisher_.create_datawriter(topic<Support>(name), qos);
  }
  template <class Support>
  void read(const std::string& name, bool reliable = false) {
    listeners_.push_back(std::make_unique<Counter<Support>>(name));
    readers_.push_back(subscriber_.create_datareader(
        topic<Support>(name), with_delivery(fast::DATAREADER_QOS_DEFAULT, reliable), listeners_.back().get()));
  }

 private:
  template <class Support>
  fast::Topic* topic(const std::string& name) {
    if (auto* known = participant_.lookup_topicdescription(name)) return dynamic_cast<fast::Topic*>(known);
    const fast::TypeSupport type(new Support);
    type.register_type(&participant_);
    return participant_.create_topic(name, type.get_type_name(), fast::TOPIC_QOS_DEFAULT);
  }

  fast::DomainParticipant& participant_;
  fast::Publisher& publisher_;
  fast::Subscriber& subscriber_;
  std::vector<fast::DataReader*> readers_;
  std::vector<std::unique_ptr<fast::DataReaderListener>> listeners_;
};

std::string of_carrier(int carrier, const char* name) {
  return "carrier_" + std::to_string(carrier) + "/" + name;
}

/// Calls `tick(n)` at 100 Hz; a tick that comes late is not made up for.
template <class Tick>
void run(int seconds, Tick tick) {
  const Clock::time_point start = Clock::now();
  for (int n = 0; n < seconds * kTicksPerSecond; ++n) {
    std::this_thread::sleep_until(start + n * std::chrono::milliseconds(1000 / kTicksPerSecond));
    tick(n);
  }
}

long kilobytes(const char* file, const std::string& key) {
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind(key, 0) == 0) return std::strtol(line.c_str() + key.size(), nullptr, 10);
  }
  return -1;
}

double cpu_s() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

// CPU of the whole process, start and discovery included.
void report(const std::string& role, int seconds) {
  std::printf("%s: %.2f %% of a core, RSS %ld kB, PSS %ld kB, %ld threads\n", role.c_str(), 100.0 * cpu_s() / seconds,
              kilobytes("/proc/self/status", "VmRSS:"), kilobytes("/proc/self/smaps_rollup", "Pss:"),
              kilobytes("/proc/self/status", "Threads:"));
}

/// A plan at one pace under a lease: what a course is in steady flight, and what travels of it.
idl::Course steady_course() {
  idl::Course course;
  course.pace().resize(1);
  course.swarm_lease_ns().resize(1);
  return course;
}

void be_agent(Node& node, int carrier, int seconds) {
  node.read<idl::BeaconPubSubType>("phase");
  node.read<idl::CarrierStatePubSubType>(of_carrier(carrier, "state"));
  node.read<idl::TimeReplyPubSubType>(of_carrier(carrier, "time_reply"));
  node.read<idl::PlanOfferPubSubType>(of_carrier(carrier, "plan"), true);
  auto* const setpoints = node.write<idl::CarrierSetpointPubSubType>(of_carrier(carrier, "setpoint"));
  auto* const statuses = node.write<idl::AgentStatusPubSubType>(of_carrier(carrier, "status"), true);
  auto* const requests = node.write<idl::TimeRequestPubSubType>(of_carrier(carrier, "time_request"));
  auto* const healths = node.write<idl::HealthPubSubType>("health");
  node.write<idl::HeldPlansPubSubType>(of_carrier(carrier, "held"), true);
  idl::CarrierSetpoint setpoint;
  idl::TimeRequest request;
  idl::AgentStatus status;
  status.course() = steady_course();
  status.accepted().resize(1);
  idl::Health health;
  health.process("agent " + std::to_string(carrier));
  run(seconds, [&](int n) {
    setpoints->write(&setpoint);
    if (n % kTicksPerStatus == 0) statuses->write(&status);
    if (n % kTicksPerRequest == 0) requests->write(&request);
    if (n % kTicksPerSecond == 0) healths->write(&health);
  });
}

void be_coordinator(Node& node, int seconds) {
  auto* const phase = node.write<idl::BeaconPubSubType>("phase");
  node.read<idl::HealthPubSubType>("health");
  std::vector<fast::DataWriter*> replies;
  for (int carrier = 1; carrier <= kCarriers; ++carrier) {
    replies.push_back(node.write<idl::TimeReplyPubSubType>(of_carrier(carrier, "time_reply")));
    node.write<idl::PlanOfferPubSubType>(of_carrier(carrier, "plan"), true);
    node.read<idl::AgentStatusPubSubType>(of_carrier(carrier, "status"), true);
    node.read<idl::HeldPlansPubSubType>(of_carrier(carrier, "held"), true);
    node.read<idl::TimeRequestPubSubType>(of_carrier(carrier, "time_request"));
    node.read<idl::CarrierStatePubSubType>(of_carrier(carrier, "state"));
  }
  idl::Beacon beacon;
  beacon.course() = steady_course();
  idl::TimeReply reply;
  run(seconds, [&](int n) {
    if (n % 2 == 0) phase->write(&beacon);
    if (n % kTicksPerRequest != 0) return;
    for (fast::DataWriter* writer : replies) writer->write(&reply);
  });
}

void be_simulator(Node& node, int seconds) {
  std::vector<fast::DataWriter*> states;
  for (int carrier = 1; carrier <= kCarriers; ++carrier) {
    states.push_back(node.write<idl::CarrierStatePubSubType>(of_carrier(carrier, "state")));
    node.read<idl::CarrierSetpointPubSubType>(of_carrier(carrier, "setpoint"));
    node.read<idl::AgentStatusPubSubType>(of_carrier(carrier, "status"), true);
    node.read<idl::HeldPlansPubSubType>(of_carrier(carrier, "held"), true);
  }
  idl::CarrierState state;
  run(seconds, [&](int) {
    for (fast::DataWriter* writer : states) writer->write(&state);
  });
}

void be_ground(Node& node, int seconds) {
  node.read<idl::HealthPubSubType>("health");
  for (int carrier = 1; carrier <= kCarriers; ++carrier) {
    node.read<idl::AgentStatusPubSubType>(of_carrier(carrier, "status"), true);
    node.read<idl::CarrierStatePubSubType>(of_carrier(carrier, "state"));
  }
  run(seconds, [](int) {});
}

struct Seat {
  int participant;
  void (*role)(Node&, int seconds);
};
const std::map<std::string, Seat> kHubs{
    {"coordinator", {0, be_coordinator}}, {"simulator", {2, be_simulator}}, {"ground", {3, be_ground}}};
constexpr int kFirstAgent = 4;

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const auto number = [&](std::size_t i) { return arguments.size() > i ? std::atoi(arguments[i].c_str()) : 0; };
  const std::string role = arguments.empty() ? "" : arguments[0];
  const int seconds = number(1);
  const int domain = number(2);
  const int carrier = number(3);
  const auto hub = kHubs.find(role);
  const bool agent = role == "agent" && carrier >= 1 && carrier <= kCarriers;
  if (seconds < 1 || domain < 0 || domain > 100 || (hub == kHubs.end() && !agent)) {
    std::fprintf(stderr,
                 "usage: bench_idle_node coordinator|simulator|ground SECONDS DOMAIN | agent SECONDS DOMAIN 1..%d, "
                 "all at the same time\n",
                 kCarriers);
    return 2;
  }
  auto* const participant = open_bare_participant(domain, agent ? kFirstAgent + carrier - 1 : hub->second.participant);
  if (!participant) return 1;
  Node node(*participant);
  if (agent) {
    be_agent(node, carrier, seconds);
  } else {
    hub->second.role(node, seconds);
  }
  report(role, seconds);
  return 0;
}
