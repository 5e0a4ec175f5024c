// The floor beside a real gyre-agent: a bare Fast DDS process that sends and receives what an agent does, at the same
// rates over the same transport, and computes nothing.
//
//   bench_idle_node agent SECONDS [DOMAIN]   sends setpoint 100 Hz, status 10 Hz, request 8 Hz; reads phase, state,
//   reply bench_idle_node world SECONDS [DOMAIN]   the other side: sends phase 50 Hz, state 100 Hz, reply 8 Hz; reads
//   the rest
//
// Run both; each prints what it cost. Written against Fast DDS itself, so that nothing of common/dds but its names is
// in the floor.

#include <sys/resource.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "common/dds/fastdds_version.hpp"
#include "tests/bench/bare_participant.hpp"

namespace {

using gyre::bench::open_bare_participant;
namespace fast = gyre::dds::fast::api;
namespace idl = gyre::dds::fast::idl;
using gyre::dds::fast::kOk;
using Clock = std::chrono::steady_clock;

constexpr int kTicksPerSecond = 100;

template <class Support>
fast::Topic* topic(fast::DomainParticipant& participant, const char* name) {
  const fast::TypeSupport type(new Support);
  type.register_type(&participant);
  return participant.create_topic(name, type.get_type_name(), fast::TOPIC_QOS_DEFAULT);
}

template <class Qos>
Qos with_delivery(Qos qos, bool reliable) {
  qos.reliability().kind = reliable ? fast::RELIABLE_RELIABILITY_QOS : fast::BEST_EFFORT_RELIABILITY_QOS;
  qos.data_sharing().off();
  return qos;
}

template <class Support>
fast::DataWriter* writer(fast::DomainParticipant& participant, fast::Publisher& publisher, const char* name,
                         bool reliable = false) {
  fast::DataWriterQos qos = with_delivery(fast::DATAWRITER_QOS_DEFAULT, reliable);
  gyre::dds::fast::heartbeat_period(qos) = {0, 30'000'000};
  return publisher.create_datawriter(topic<Support>(participant, name), qos);
}

template <class Support>
class Reader final : public fast::DataReaderListener {
 public:
  Reader(fast::DomainParticipant& participant, fast::Subscriber& subscriber, const char* name, bool reliable = false)
      : name_(name), created_(Clock::now()) {
    reader_ = subscriber.create_datareader(topic<Support>(participant, name),
                                           with_delivery(fast::DATAREADER_QOS_DEFAULT, reliable), this);
  }
  ~Reader() override {
    std::printf("  received %6d of %-12s first after %.3f s\n", count_.load(), name_, first_s_.load());
  }
  void stop() { reader_->set_listener(nullptr); }

  void on_data_available(fast::DataReader* reader) override {
    typename Support::type sample;
    fast::SampleInfo info;
    while (reader->take_next_sample(&sample, &info) == kOk) {
      if (count_++ == 0) first_s_ = std::chrono::duration<double>(Clock::now() - created_).count();
    }
  }

 private:
  const char* name_;
  Clock::time_point created_;
  fast::DataReader* reader_;
  std::atomic<int> count_{0};
  std::atomic<double> first_s_{-1.0};
};

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
void report(const char* role, int seconds) {
  std::printf("%s: %.2f %% of a core, RSS %ld kB, PSS %ld kB, %ld threads\n", role, 100.0 * cpu_s() / seconds,
              kilobytes("/proc/self/status", "VmRSS:"), kilobytes("/proc/self/smaps_rollup", "Pss:"),
              kilobytes("/proc/self/status", "Threads:"));
}

void fly(fast::DomainParticipant& participant, fast::Publisher& publisher, fast::Subscriber& subscriber, int seconds) {
  Reader<idl::BeaconPubSubType> phase(participant, subscriber, "phase");
  Reader<idl::CarrierStatePubSubType> state(participant, subscriber, "state");
  Reader<idl::TimeReplyPubSubType> reply(participant, subscriber, "time_reply");
  auto* const setpoints = writer<idl::CarrierSetpointPubSubType>(participant, publisher, "setpoint");
  auto* const status = writer<idl::AgentStatusPubSubType>(participant, publisher, "status", true);
  auto* const requests = writer<idl::TimeRequestPubSubType>(participant, publisher, "time_request");
  idl::CarrierSetpoint setpoint;
  idl::AgentStatus own_status;
  idl::TimeRequest request;
  run(seconds, [&](int n) {
    setpoints->write(&setpoint);
    if (n % 10 == 0) status->write(&own_status);
    if (n % 12 == 0) requests->write(&request);
  });
  report("agent", seconds);
  phase.stop();
  state.stop();
  reply.stop();
  participant.delete_contained_entities();
}

void be_the_world(fast::DomainParticipant& participant, fast::Publisher& publisher, fast::Subscriber& subscriber,
                  int seconds) {
  Reader<idl::CarrierSetpointPubSubType> setpoints(participant, subscriber, "setpoint");
  Reader<idl::AgentStatusPubSubType> status(participant, subscriber, "status", true);
  Reader<idl::TimeRequestPubSubType> requests(participant, subscriber, "time_request");
  auto* const phase = writer<idl::BeaconPubSubType>(participant, publisher, "phase");
  auto* const states = writer<idl::CarrierStatePubSubType>(participant, publisher, "state");
  auto* const replies = writer<idl::TimeReplyPubSubType>(participant, publisher, "time_reply");
  idl::Beacon beacon;
  idl::CarrierState state;
  idl::TimeReply reply;
  run(seconds, [&](int n) {
    states->write(&state);
    if (n % 2 == 0) phase->write(&beacon);
    if (n % 12 == 0) replies->write(&reply);
  });
  report("world", seconds);
  setpoints.stop();
  status.stop();
  requests.stop();
  participant.delete_contained_entities();
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const int seconds = arguments.size() > 1 ? std::atoi(arguments[1].c_str()) : 0;
  const int domain = arguments.size() > 2 ? std::atoi(arguments[2].c_str()) : 59;
  if (seconds < 1 || domain < 0 || domain > 100 || (arguments[0] != "agent" && arguments[0] != "world")) {
    std::fputs("usage: bench_idle_node agent|world SECONDS [DOMAIN], one of each at the same time\n", stderr);
    return 2;
  }
  const bool agent = arguments[0] == "agent";
  fast::DomainParticipant* const participant = open_bare_participant(domain, agent ? 4 : 0);
  if (!participant) return 1;
  auto* const publisher = participant->create_publisher(fast::PUBLISHER_QOS_DEFAULT);
  auto* const subscriber = participant->create_subscriber(fast::SUBSCRIBER_QOS_DEFAULT);
  (agent ? fly : be_the_world)(*participant, *publisher, *subscriber, seconds);
  fast::DomainParticipantFactory::get_instance()->delete_participant(participant);
  return 0;
}
