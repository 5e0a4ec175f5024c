#include "common/dds/node.hpp"

#include <algorithm>
#include <atomic>
#include <iterator>
#include <map>
#include <tuple>
#include <type_traits>
#include <utility>

#include "common/dds/clock.hpp"
#include "common/dds/codec.hpp"
#include "common/dds/participant.hpp"
#include "common/dds/raw_type.hpp"
#include "common/dds/seat_lock.hpp"
#include "common/dds/strict_type.hpp"
#include "common/dds/topics.hpp"

namespace gyre::dds {
namespace {

using Counter = std::atomic<std::uint64_t>;

/// What every Writer<Message>::State has: the node empties it when it goes.
struct Outlet {
  fast::api::DataWriter* writer = nullptr;
  std::shared_ptr<Counter> unsendable;
};

template <class Message>
class Listener final : public fast::api::DataReaderListener {
 public:
  Listener(std::function<void(Message, LocalTime)> handler, std::shared_ptr<Counter> undecodable)
      : handler_(std::move(handler)), undecodable_(std::move(undecodable)) {}

  void on_data_available(fast::api::DataReader* reader) override {
    const LocalTime arrived = now();
    fast::api::SampleInfo info;
    while (fast::take(*reader, &sample_, info)) {
      if (!info.valid_data) continue;
      if (auto message = decode(sample_)) {
        handler_(std::move(*message), arrived);
      } else {
        ++*undecodable_;
      }
    }
  }

 private:
  const std::function<void(Message, LocalTime)> handler_;
  const std::shared_ptr<Counter> undecodable_;
  typename Wire<Message>::Type sample_;  // one reader, one receive thread
};

/// Leaves each sample's bytes, and what RTPS says of them, with the handler.
class RecordingListener final : public fast::api::DataReaderListener {
 public:
  RecordingListener(std::function<void(RecordedSample)> handler, RecordedTopic topic)
      : handler_(std::move(handler)), topic_(std::make_shared<const RecordedTopic>(std::move(topic))) {}

  void on_data_available(fast::api::DataReader* reader) override {
    const LocalTime arrived = now();
    fast::api::SampleInfo info;
    RawSample raw;
    while (fast::take(*reader, &raw, info)) {
      if (!info.valid_data) continue;
      const auto& identity = info.sample_identity;
      RecordedSample sample;
      sample.topic = topic_;
      const auto& prefix = identity.writer_guid().guidPrefix.value;
      const auto& entity = identity.writer_guid().entityId.value;
      std::copy(std::begin(entity), std::end(entity),
                std::copy(std::begin(prefix), std::end(prefix), sample.writer.begin()));
      sample.sequence = identity.sequence_number().to64long();
      sample.source_ns = info.source_timestamp.to_ns();
      sample.arrived = arrived;
      sample.payload = std::move(raw.bytes);
      handler_(std::move(sample));
    }
  }

 private:
  const std::function<void(RecordedSample)> handler_;
  const std::shared_ptr<const RecordedTopic> topic_;
};

void set_reliability(fast::api::ReliabilityQosPolicy& reliability, Delivery delivery) {
  reliability.kind = reliable(delivery) ? fast::api::RELIABLE_RELIABILITY_QOS : fast::api::BEST_EFFORT_RELIABILITY_QOS;
  reliability.max_blocking_time = fast::Time(0, 5'000'000);
}

// What writers and readers have in common. Samples over the type's bound are refused by Fast DDS before it allocates
// anything for them; of the others the memory for one is set aside, where the default is a hundred.
template <class Qos>
void set_common(Qos& qos, Delivery delivery, int depth) {
  set_reliability(qos.reliability(), delivery);
  qos.durability().kind =
      delivery == Delivery::kRetained ? fast::api::TRANSIENT_LOCAL_DURABILITY_QOS : fast::api::VOLATILE_DURABILITY_QOS;
  qos.history().kind = fast::api::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = depth;
  qos.resource_limits().allocated_samples = 1;
  qos.endpoint().history_memory_policy = fast::rtps::PREALLOCATED_MEMORY_MODE;
  qos.data_sharing().off();  // silent between users and containers
}

}  // namespace

template <class Message>
struct Writer<Message>::State : Outlet {};

struct Node::Impl {
  explicit Impl(Participant opened)
      : participant(std::move(opened)), incarnation(static_cast<std::uint64_t>(now().time_since_epoch().count())) {}
  ~Impl();

  template <class Message, class Type = StrictType<typename Wire<Message>::Support>>
  fast::api::Topic* topic(std::optional<CarrierId> carrier);
  template <class Message>
  void record(const std::function<void(RecordedSample)>& handler, std::optional<CarrierId> carrier);

  Participant participant;
  const std::uint64_t incarnation;
  std::shared_ptr<Counter> unsendable = std::make_shared<Counter>(0);
  std::shared_ptr<Counter> undecodable = std::make_shared<Counter>(0);
  std::map<std::string, fast::api::Topic*> topics;
  std::vector<std::shared_ptr<Outlet>> outlets;
  std::vector<fast::api::DataReader*> readers;
  std::vector<std::unique_ptr<fast::api::DataReaderListener>> listeners;
};

Node::Impl::~Impl() {
  for (const auto& outlet : outlets) outlet->writer = nullptr;
  for (fast::api::DataReader* reader : readers) reader->set_listener(nullptr);
  participant.close();  // before the listeners go: a callback may still be running in one
}

template <class Message, class Type>
fast::api::Topic* Node::Impl::topic(std::optional<CarrierId> carrier) {
  const Topic& description = kTopic<Message>;
  fast::api::Topic*& known = topics[topic_name(description, carrier)];
  if (known) return known;
  if (participant->find_type(description.type).empty()) {
    const fast::api::TypeSupport type(new Type(undecodable));
    type.register_type(participant.get(), description.type);
  }
  known = participant->create_topic(topic_name(description, carrier), description.type, fast::api::TOPIC_QOS_DEFAULT);
  GYRE_ENSURE(known, "Fast DDS gives a topic for a registered type");
  return known;
}

Node::Node(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Node::~Node() = default;

Result<std::unique_ptr<Node>> Node::open(const NodeOptions& options) {
  Result<Participant> participant = Participant::open(options);
  if (!participant) return participant.error();
  return std::unique_ptr<Node>(new Node(std::make_unique<Impl>(std::move(participant).value())));
}

int Node::domain() const {
  return static_cast<int>(impl_->participant->get_domain_id());
}

std::uint64_t Node::incarnation() const {
  return impl_->incarnation;
}

const std::string& Node::address() const {
  return impl_->participant.address();
}

void Node::answer_callers(const SeatAnswer& answer) {
  impl_->participant.seat().answer(answer);
}

void Node::lose_packets(double share) {
  impl_->participant.packet_loss().set_share(share);
}

Node::Counters Node::counters() const {
  return {*impl_->unsendable, *impl_->undecodable};
}

template <class Message>
Writer<Message> Node::writer(std::optional<CarrierId> carrier) {
  constexpr Delivery kDelivery = kTopic<Message>.delivery;
  fast::api::DataWriterQos qos = impl_->participant.publisher().get_default_datawriter_qos();
  set_common(qos, kDelivery, writer_depth(kDelivery));
  qos.publish_mode().kind = fast::api::SYNCHRONOUS_PUBLISH_MODE;
  // The default of 3 s makes one lost packet cost half a second.
  fast::heartbeat_period(qos) = fast::Time(0, 30'000'000);

  auto state = std::make_shared<typename Writer<Message>::State>();
  state->writer = impl_->participant.publisher().create_datawriter(impl_->topic<Message>(carrier), qos);
  state->unsendable = impl_->unsendable;
  GYRE_ENSURE(state->writer, "Fast DDS gives a writer for our own quality of service");
  impl_->outlets.push_back(state);
  return Writer<Message>(std::move(state));
}

template <class Message>
void Node::read(std::function<void(Message, LocalTime)> handler, std::optional<CarrierId> carrier) {
  constexpr Delivery kDelivery = kTopic<Message>.delivery;
  fast::api::DataReaderQos qos = impl_->participant.subscriber().get_default_datareader_qos();
  set_common(qos, kDelivery, reader_depth(kDelivery));

  auto listener = std::make_unique<Listener<Message>>(std::move(handler), impl_->undecodable);
  fast::api::DataReader* reader = impl_->participant.subscriber().create_datareader(
      impl_->topic<Message>(carrier), qos, listener.get(), fast::api::StatusMask::data_available());
  GYRE_ENSURE(reader, "Fast DDS gives a reader for our own quality of service");
  impl_->readers.push_back(reader);
  impl_->listeners.push_back(std::move(listener));
}

template <class Message>
void Node::Impl::record(const std::function<void(RecordedSample)>& handler, std::optional<CarrierId> carrier) {
  const Topic& description = kTopic<Message>;
  if (description.per_carrier != carrier.has_value()) return;
  fast::api::DataReaderQos qos = participant.subscriber().get_default_datareader_qos();
  set_common(qos, description.delivery, kRecordingDepth);
  auto listener = std::make_unique<RecordingListener>(
      handler, RecordedTopic{topic_name(description, carrier), description.type, description.delivery});
  fast::api::DataReader* reader =
      participant.subscriber().create_datareader(topic<Message, RawType<typename Wire<Message>::Support>>(carrier), qos,
                                                 listener.get(), fast::api::StatusMask::data_available());
  GYRE_ENSURE(reader, "Fast DDS gives a reader for our own quality of service");
  readers.push_back(reader);
  listeners.push_back(std::move(listener));
}

void Node::record(const std::function<void(RecordedSample)>& handler, std::optional<CarrierId> carrier, bool journals) {
  const auto record_one = [&](auto message) {
    using Message = decltype(message);
    if (journals || !std::is_same_v<Message, protocol::JournalPiece>) impl_->record<Message>(handler, carrier);
  };
  const auto record_each = [&](auto... messages) { (record_one(messages), ...); };
  std::apply(record_each, EveryMessage{});
}

template <class Message>
void Writer<Message>::write(const Message& message) const {
  if (!state_ || !state_->writer) return;
  auto sample = encode(message);
  if (!sample || !fast::write(*state_->writer, &*sample)) ++*state_->unsendable;
}

template <class Message>
int Writer<Message>::readers() const {
  if (!state_ || !state_->writer) return 0;
  fast::api::PublicationMatchedStatus status;
  state_->writer->get_publication_matched_status(status);
  return status.current_count;
}

// NOLINTNEXTLINE(cppcoreguidelines-macro-usage): only a macro can spell explicit instantiations once
#define GYRE_CARRY(Message)                                                 \
  template class Writer<Message>;                                           \
  template Writer<Message> Node::writer<Message>(std::optional<CarrierId>); \
  template void Node::read<Message>(std::function<void(Message, LocalTime)>, std::optional<CarrierId>);

GYRE_CARRY(protocol::Beacon)
GYRE_CARRY(protocol::PlanOffer)
GYRE_CARRY(protocol::HeldPlans)
GYRE_CARRY(protocol::TimeRequest)
GYRE_CARRY(protocol::TimeReply)
GYRE_CARRY(protocol::AgentStatus)
GYRE_CARRY(protocol::Setpoint)
GYRE_CARRY(protocol::CarrierState)
GYRE_CARRY(protocol::LoadState)
GYRE_CARRY(protocol::Command)
GYRE_CARRY(protocol::CommandReply)
GYRE_CARRY(protocol::CoordinatorStatus)
GYRE_CARRY(protocol::MissionText)
GYRE_CARRY(protocol::Health)
GYRE_CARRY(protocol::Disturbance)
GYRE_CARRY(protocol::JournalPiece)
#undef GYRE_CARRY

}  // namespace gyre::dds
