// Samples as bytes: what a node that records gets is what a node that reads would have got, and which it was.

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <chrono>
#include <functional>
#include <optional>
#include <tuple>

#include "common/dds/inbox.hpp"
#include "common/dds/payload.hpp"
#include "common/dds/topics.hpp"
#include "tests/dds/free_domain.hpp"
#include "tests/dds/random_messages.hpp"

namespace gyre {
namespace {

using namespace std::chrono_literals;

constexpr CarrierId kCarrier = 3;

template <class Message>
class EveryPayload : public testing::Test {};

template <class Tuple>
struct TypesOf;
template <class... Messages>
struct TypesOf<std::tuple<Messages...>> {
  using Types = testing::Types<Messages...>;
};
TYPED_TEST_SUITE(EveryPayload, TypesOf<dds::EveryMessage>::Types);

TYPED_TEST(EveryPayload, IsTheMessageAgain) {
  EXPECT_TRUE(tests::holds([] {
    const auto message = tests::random_message<TypeParam>();
    const auto payload = dds::encode_payload(message);
    RC_ASSERT(payload.has_value());
    const auto again = dds::decode_payload<TypeParam>(*payload);
    RC_ASSERT(again.has_value());
    RC_ASSERT(tests::bits_of(*again) == tests::bits_of(message));
    // Bytes of another length are no such message: padding to a multiple of four is all that may follow.
    auto longer = *payload;
    longer.resize(longer.size() + 8);
    RC_ASSERT(!dds::decode_payload<TypeParam>(longer));
    RC_ASSERT(!dds::decode_payload<TypeParam>({payload->begin(), payload->end() - 1}));
  }));
  EXPECT_FALSE(dds::decode_payload<TypeParam>({}));
}

/// What arrives within ten seconds and is `wanted`; `again` is called every 20 ms.
std::optional<dds::RecordedSample> wait_for(dds::Inbox<dds::RecordedSample>& inbox,
                                            const std::function<bool(const dds::RecordedSample&)>& wanted,
                                            const std::function<void()>& again) {
  const LocalTime deadline = dds::now() + 10s;
  while (dds::now() < deadline) {
    again();
    for (dds::RecordedSample& sample : inbox.wait_until(dds::now() + 20ms)) {
      if (wanted(sample)) return sample;
    }
  }
  return std::nullopt;
}

TYPED_TEST(EveryPayload, ArrivesAsItWasSent) {
  dds::NodeOptions options;
  dds::Inbox<dds::RecordedSample> inbox;  // outlives the node, whose handlers fill it
  const auto sender = tests::open_coordinator(options);
  const auto recorder = tests::open(options, {});
  ASSERT_TRUE(sender && recorder);
  constexpr const dds::Topic& kTopic = dds::kTopic<TypeParam>;
  const auto carrier = kTopic.per_carrier ? std::optional<CarrierId>(kCarrier) : std::nullopt;
  const auto writer = sender->template writer<TypeParam>(carrier);
  recorder->record([&](dds::RecordedSample sample) { inbox.push(std::move(sample)); }, carrier);
  const auto before = std::chrono::system_clock::now().time_since_epoch();
  std::uint64_t last = 0;
  EXPECT_TRUE(tests::holds([&] {
    const auto message = tests::random_message<TypeParam>();
    const auto same = [&](const dds::RecordedSample& sample) {
      EXPECT_EQ(sample.topic->name, dds::topic_name(kTopic, carrier));
      EXPECT_EQ(sample.topic->type, kTopic.type);
      EXPECT_LE(sample.arrived, dds::now());
      EXPECT_GE(std::chrono::nanoseconds(sample.source_ns), before);
      EXPECT_GT(sample.sequence, last) << "a writer numbers its samples";
      last = sample.sequence;
      const auto decoded = dds::decode_payload<TypeParam>(sample.payload);
      return decoded && tests::bits_of(*decoded) == tests::bits_of(message);
    };
    RC_ASSERT(wait_for(inbox, same, [&] { writer.write(message); }).has_value());
  }));
}

// One writer has one name, another one another: gaps are counted by them.
TEST(Recording, TellsWritersApart) {
  dds::NodeOptions options;
  dds::Inbox<dds::RecordedSample> inbox;
  const auto first = tests::open_coordinator(options);
  const auto second = tests::open(options, {dds::Hub::kSimulator, std::nullopt});
  const auto recorder = tests::open(options, {});
  ASSERT_TRUE(first && second && recorder);
  const auto one = first->writer<protocol::Health>();
  const auto other = second->writer<protocol::Health>();
  recorder->record([&](dds::RecordedSample sample) { inbox.push(std::move(sample)); });
  const auto of = [](const char* process) {
    return [process](const dds::RecordedSample& sample) {
      const auto health = dds::decode_payload<protocol::Health>(sample.payload);
      return health && health->process == process;
    };
  };
  protocol::Health word;
  word.process = "one";
  const auto from_one = wait_for(inbox, of("one"), [&] { one.write(word); });
  const auto from_one_again = wait_for(inbox, of("one"), [&] { one.write(word); });
  word.process = "other";
  const auto from_other = wait_for(inbox, of("other"), [&] { other.write(word); });
  ASSERT_TRUE(from_one && from_one_again && from_other);
  EXPECT_EQ(from_one->writer, from_one_again->writer);
  EXPECT_NE(from_one->writer, from_other->writer);
}

}  // namespace
}  // namespace gyre
