// The floor beside the start of a swarm: bare Fast DDS processes in the same star, with as many topics, writers and
// readers as Gyre's have, that do nothing but find each other.
//
//   bench_idle_star hub N         sits where the coordinator sits; prints "matched" when it has found all of N spokes
//   bench_idle_star spoke I       sits where the agent of carrier I sits
//
// Both run until they are killed. Written against Fast DDS itself, so that nothing of common/dds but its names is in
// the floor.

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
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

class Star {
 public:
  explicit Star(int participant)
      : participant_(open_bare_participant(0, participant)),
        publisher_(participant_->create_publisher(fast::PUBLISHER_QOS_DEFAULT)),
        subscriber_(participant_->create_subscriber(fast::SUBSCRIBER_QOS_DEFAULT)) {}

  template <class Support>
  void write(const std::string& name, bool reliable) {
    fast::DataWriterQos qos = fast::DATAWRITER_QOS_DEFAULT;
    qos.reliability().kind = reliable ? fast::RELIABLE_RELIABILITY_QOS : fast::BEST_EFFORT_RELIABILITY_QOS;
    qos.data_sharing().off();
    gyre::dds::fast::heartbeat_period(qos) = {0, 30'000'000};
    writers_.push_back(publisher_->create_datawriter(topic<Support>(name), qos));
  }
  template <class Support>
  void read(const std::string& name, bool reliable) {
    fast::DataReaderQos qos = fast::DATAREADER_QOS_DEFAULT;
    qos.reliability().kind = reliable ? fast::RELIABLE_RELIABILITY_QOS : fast::BEST_EFFORT_RELIABILITY_QOS;
    qos.data_sharing().off();
    readers_.push_back(subscriber_->create_datareader(topic<Support>(name), qos));
  }

  /// How many counterparts all writers and readers have found.
  [[nodiscard]] int matched() const {
    int count = 0;
    for (fast::DataWriter* writer : writers_) {
      fast::PublicationMatchedStatus status;
      if (writer->get_publication_matched_status(status) == kOk) count += status.current_count;
    }
    for (fast::DataReader* reader : readers_) {
      fast::SubscriptionMatchedStatus status;
      if (reader->get_subscription_matched_status(status) == kOk) count += status.current_count;
    }
    return count;
  }

 private:
  template <class Support>
  fast::Topic* topic(const std::string& name) {
    const fast::TypeSupport type(new Support);
    type.register_type(participant_);
    return participant_->create_topic(name, type.get_type_name(), fast::TOPIC_QOS_DEFAULT);
  }

  fast::DomainParticipant* participant_;
  fast::Publisher* publisher_;
  fast::Subscriber* subscriber_;
  std::vector<fast::DataWriter*> writers_;
  std::vector<fast::DataReader*> readers_;
};

std::string of_carrier(int carrier, const char* name) {
  return "carrier_" + std::to_string(carrier) + "/" + name;
}

/// What an agent has: setpoint and state find nobody, as in a swarm that has no vehicles yet.
void be_spoke(Star& star, int carrier) {
  star.write<idl::CarrierSetpointPubSubType>(of_carrier(carrier, "setpoint"), false);
  star.write<idl::AgentStatusPubSubType>(of_carrier(carrier, "status"), true);
  star.write<idl::TimeRequestPubSubType>(of_carrier(carrier, "time_request"), false);
  star.write<idl::HeldPlansPubSubType>(of_carrier(carrier, "held"), true);
  star.write<idl::HealthPubSubType>("health", false);
  star.read<idl::BeaconPubSubType>("phase", false);
  star.read<idl::PlanOfferPubSubType>(of_carrier(carrier, "plan"), true);
  star.read<idl::TimeReplyPubSubType>(of_carrier(carrier, "time_reply"), false);
  star.read<idl::CarrierStatePubSubType>(of_carrier(carrier, "state"), false);
}

/// What the coordinator has for each carrier, and the beacon for all.
void be_hub(Star& star, int carriers) {
  star.write<idl::BeaconPubSubType>("phase", false);
  for (int carrier = 1; carrier <= carriers; ++carrier) {
    star.write<idl::TimeReplyPubSubType>(of_carrier(carrier, "time_reply"), false);
    star.write<idl::PlanOfferPubSubType>(of_carrier(carrier, "plan"), true);
    star.read<idl::AgentStatusPubSubType>(of_carrier(carrier, "status"), true);
    star.read<idl::HeldPlansPubSubType>(of_carrier(carrier, "held"), true);
    star.read<idl::TimeRequestPubSubType>(of_carrier(carrier, "time_request"), false);
  }
  constexpr int kMatchesPerCarrier = 6;
  while (star.matched() < carriers * kMatchesPerCarrier) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  std::puts("matched");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const int number = arguments.size() == 2 ? std::atoi(arguments[1].c_str()) : 0;
  if (number < 1 || number > 100 || (arguments[0] != "hub" && arguments[0] != "spoke")) {
    std::fputs("usage: bench_idle_star hub NUMBER_OF_SPOKES | spoke NUMBER, in a network namespace\n", stderr);
    return 2;
  }
  const bool hub = arguments[0] == "hub";
  Star star(hub ? 0 : 3 + number);
  (hub ? be_hub : be_spoke)(star, number);
  ::pause();
  return 0;
}
