// The floor beside the start of a swarm: bare Fast DDS processes in the same star, with as many topics, writers and
// readers as Gyre's have, that do nothing but find each other.
//
//   bench_idle_star hub N         sits where the coordinator sits, and finds N spokes
//   bench_idle_star watch N       sits where the ground sits, to which Gyre's agents say that they are ready
//   bench_idle_star spoke I       sits where the agent of carrier I sits
//
// Each prints "matched" when all its writers and readers have found all their counterparts; all run until they are
// killed. Written against Fast DDS itself, so that nothing of common/dds but its names is in the floor.

#include <unistd.h>

#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <mutex>
#include <string>
#include <vector>

#include "common/dds/fastdds_version.hpp"
#include "tests/bench/bare_participant.hpp"

namespace {

using gyre::bench::open_bare_participant;
namespace fast = gyre::dds::fast::api;
namespace idl = gyre::dds::fast::idl;

class Star : fast::DataWriterListener, fast::DataReaderListener {
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
    publisher_->create_datawriter(topic<Support>(name), qos, this, fast::StatusMask::publication_matched());
  }
  template <class Support>
  void read(const std::string& name, bool reliable) {
    fast::DataReaderQos qos = fast::DATAREADER_QOS_DEFAULT;
    qos.reliability().kind = reliable ? fast::RELIABLE_RELIABILITY_QOS : fast::BEST_EFFORT_RELIABILITY_QOS;
    qos.data_sharing().off();
    subscriber_->create_datareader(topic<Support>(name), qos, this, fast::StatusMask::subscription_matched());
  }

  /// Until all writers and readers together have found so many counterparts.
  void wait_for(int matches) {
    std::unique_lock<std::mutex> lock(mutex_);
    found_.wait(lock, [&] { return matched_ >= matches; });
    std::puts("matched");
    std::fflush(stdout);
  }

 private:
  void on_publication_matched(fast::DataWriter* /*writer*/, const fast::PublicationMatchedStatus& status) override {
    add(status.current_count_change);
  }
  void on_subscription_matched(fast::DataReader* /*reader*/, const fast::SubscriptionMatchedStatus& status) override {
    add(status.current_count_change);
  }
  void add(int change) {
    const std::lock_guard<std::mutex> lock(mutex_);
    matched_ += change;
    found_.notify_all();
  }

  template <class Support>
  fast::Topic* topic(const std::string& name) {
    if (auto* known = participant_->lookup_topicdescription(name)) return dynamic_cast<fast::Topic*>(known);
    const fast::TypeSupport type(new Support);
    type.register_type(participant_);
    return participant_->create_topic(name, type.get_type_name(), fast::TOPIC_QOS_DEFAULT);
  }

  fast::DomainParticipant* participant_;
  fast::Publisher* publisher_;
  fast::Subscriber* subscriber_;
  std::mutex mutex_;
  std::condition_variable found_;
  int matched_ = 0;
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
  constexpr int kMatches = 8;  // of the hub its status and six more, and the watch's interest in the status
  star.wait_for(kMatches);
}

/// What the coordinator has for each carrier, and for all. As with the agents, vehicles are not there.
void be_hub(Star& star, int carriers) {
  star.write<idl::BeaconPubSubType>("phase", false);
  star.write<idl::CoordinatorStatusPubSubType>("coordinator/status", true);
  star.write<idl::CommandReplyPubSubType>("command_reply", true);
  star.write<idl::HealthPubSubType>("health", false);
  star.read<idl::BeaconPubSubType>("phase", false);
  star.read<idl::HealthPubSubType>("health", false);
  star.read<idl::CommandPubSubType>("command", true);
  for (int carrier = 1; carrier <= carriers; ++carrier) {
    star.write<idl::TimeReplyPubSubType>(of_carrier(carrier, "time_reply"), false);
    star.write<idl::PlanOfferPubSubType>(of_carrier(carrier, "plan"), true);
    star.read<idl::AgentStatusPubSubType>(of_carrier(carrier, "status"), true);
    star.read<idl::HeldPlansPubSubType>(of_carrier(carrier, "held"), true);
    star.read<idl::CarrierStatePubSubType>(of_carrier(carrier, "state"), false);
    star.read<idl::TimeRequestPubSubType>(of_carrier(carrier, "time_request"), false);
  }
  // Of each carrier phase, health, and all its own but the state; of the watch the command; and its own reader of phase
  // and of health, each seen from both ends.
  constexpr int kMatchesPerCarrier = 7;
  constexpr int kOtherMatches = 5;
  star.wait_for(carriers * kMatchesPerCarrier + kOtherMatches);
}

void be_watch(Star& star, int carriers) {
  star.write<idl::CommandPubSubType>("command", true);
  for (int carrier = 1; carrier <= carriers; ++carrier) {
    star.read<idl::AgentStatusPubSubType>(of_carrier(carrier, "status"), true);
  }
  star.wait_for(carriers + 1);
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const int number = arguments.size() == 2 ? std::atoi(arguments[1].c_str()) : 0;
  const std::string role = number >= 1 && number <= 100 ? arguments[0] : "";
  if (role != "hub" && role != "watch" && role != "spoke") {
    std::fputs("usage: bench_idle_star hub|watch NUMBER_OF_SPOKES | spoke NUMBER, in a network namespace\n", stderr);
    return 2;
  }
  Star star(role == "hub" ? 0 : role == "watch" ? 3 : 3 + number);
  (role == "hub" ? be_hub : role == "watch" ? be_watch : be_spoke)(star, number);
  ::pause();
  return 0;
}
