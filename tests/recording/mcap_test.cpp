// The MCAP writer and both readers: what is written is read, wherever the file ends, and whatever was done to it.

#include <gmock/gmock.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <set>

#include "ground/recording/core/mcap_records.hpp"
#include "tests/recording/mcap_files.hpp"

namespace gyre::tests {
namespace {

using ground::McapIndex;
using ground::McapQuery;
using ground::Message;
using testing::HasSubstr;

/// On channels 0..2, of sizes around a chunk's.
std::vector<Message> any_messages() {
  const auto count = *rc::gen::inRange<std::size_t>(0, 40);
  std::vector<Message> messages(count);
  for (Message& message : messages) {
    message.channel = *rc::gen::inRange<std::uint16_t>(0, 3);
    message.sequence = *rc::gen::arbitrary<std::uint32_t>();
    message.log_ns = *rc::gen::inRange<std::uint64_t>(1, 5'000'000'000);
    message.publish_ns = *rc::gen::arbitrary<std::uint64_t>();
    message.payload = *rc::gen::container<Bytes>(rc::gen::arbitrary<std::uint8_t>());
  }
  return messages;
}

Bytes file_of(const std::vector<Message>& messages, FileInMemory& file) {
  for (const char* topic : {"/a", "/b", "/c"}) (void)file.channel(topic);
  for (const Message& message : messages) file.add(message);
  return file.finish();
}

std::vector<Message> indexed(const McapIndex& index, const McapQuery& query) {
  std::vector<Message> found;
  auto cursor = index.messages(query);
  while (auto message = cursor.next()) found.push_back(std::move(*message));
  EXPECT_EQ(cursor.problems().count(), 0U);
  return found;
}

bool all_same(const std::vector<Message>& a, const std::vector<Message>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), same);
}

RC_GTEST_PROP(Mcap, IsReadFromTheFrontAsItWasWritten, ()) {
  const auto messages = any_messages();
  FileInMemory file;
  const Streamed read = streamed(file_of(messages, file));
  RC_ASSERT(read.whole);
  RC_ASSERT(read.problems == 0U);
  RC_ASSERT(all_same(read.messages, messages));
  RC_ASSERT(read.metadata.size() == 2U);
  RC_ASSERT(read.metadata.back().entries.at("lost") == "0");
}

// What the index gives is what a filter over everything gives, in the order of time.
RC_GTEST_PROP(Mcap, IsReadByTimeAndTopic, ()) {
  const auto messages = any_messages();
  FileInMemory file;
  const BytesSource source(file_of(messages, file));
  const auto index = McapIndex::open(source);
  RC_ASSERT(index.ok());
  McapQuery query;
  query.from_ns = *rc::gen::inRange<std::uint64_t>(0, 5'000'000'000);
  query.to_ns = *rc::gen::inRange<std::uint64_t>(0, 6'000'000'000);
  query.topics = *rc::gen::elementOf(std::vector<std::set<std::string>>{{}, {"/a"}, {"/b", "/c"}, {"/nowhere"}});
  auto expected = messages;
  const std::map<std::uint16_t, std::string> topics{{0, "/a"}, {1, "/b"}, {2, "/c"}};
  expected.erase(std::remove_if(expected.begin(), expected.end(),
                                [&](const Message& m) {
                                  const bool other =
                                      !query.topics.empty() && query.topics.count(topics.at(m.channel)) == 0;
                                  return other || m.log_ns < query.from_ns || m.log_ns > query.to_ns;
                                }),
                 expected.end());
  std::stable_sort(expected.begin(), expected.end(),
                   [](const Message& a, const Message& b) { return a.log_ns < b.log_ns; });
  auto found = indexed(index.value(), query);
  RC_ASSERT(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) RC_ASSERT(found[i].log_ns == expected[i].log_ns);
  // At one time the order is the file's, not the one in which they came; so the same ones, in any order.
  const auto order = [](const Message& a, const Message& b) {
    return std::tie(a.log_ns, a.channel, a.sequence, a.publish_ns, a.payload) <
           std::tie(b.log_ns, b.channel, b.sequence, b.publish_ns, b.payload);
  };
  std::sort(found.begin(), found.end(), order);
  std::sort(expected.begin(), expected.end(), order);
  RC_ASSERT(all_same(found, expected));
}

RC_GTEST_PROP(Mcap, CountsWhatIsInIt, ()) {
  const auto messages = any_messages();
  FileInMemory file;
  const BytesSource source(file_of(messages, file));
  const auto index = McapIndex::open(source);
  RC_ASSERT(index.ok());
  const auto& statistics = index.value().statistics();
  RC_ASSERT(statistics.has_value());
  RC_ASSERT(statistics->messages == messages.size());
  RC_ASSERT(statistics->chunks == index.value().chunks().size());
  for (std::uint16_t channel = 0; channel < 3; ++channel) {
    const auto count = static_cast<std::uint64_t>(
        std::count_if(messages.begin(), messages.end(), [&](const Message& m) { return m.channel == channel; }));
    const auto counted = statistics->by_channel.find(channel);
    RC_ASSERT((counted == statistics->by_channel.end() ? 0 : counted->second) == count);
  }
  RC_ASSERT(index.value().metadata("last").has_value());
  RC_ASSERT(!index.value().metadata("nothing").has_value());
}

/// Small, of several chunks.
Bytes small_file(FileInMemory& file) {
  (void)file.channel("/a");
  (void)file.channel("/b");
  for (std::uint32_t i = 0; i < 24; ++i) {
    const Bytes payload(17 + i, static_cast<std::uint8_t>(i));
    file.add({static_cast<std::uint16_t>(i % 2), i, 1000 + i, 900 + i, payload});
  }
  return file.finish();
}

TEST(Mcap, ReadsUpToItsLastWholeChunkWhereverItWasCutOff) {
  FileInMemory file(150);
  const Bytes whole = small_file(file);
  const auto all = streamed(whole).messages;
  ASSERT_EQ(all.size(), 24U);
  ASSERT_GT(file.wholes.size(), 5U) << "several chunks";
  std::size_t most = 0;
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const Streamed read = streamed(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)));
    if (!read.opened) {
      EXPECT_LT(size, ground::kMcapMagic.size());
      EXPECT_THAT(read.words,
                  HasSubstr("byte " + std::to_string(size) + ": the file ends before anything was recorded"));
      continue;
    }
    EXPECT_LE(read.messages.size(), all.size());
    EXPECT_GE(read.messages.size(), most) << "more of the file, and less is read: " << size;
    EXPECT_TRUE(std::equal(read.messages.begin(), read.messages.end(), all.begin(), same)) << size;
    most = std::max(most, read.messages.size());
    if (!read.whole) {
      EXPECT_THAT(read.words, HasSubstr("cut off"));
    }
    // Nothing but the summary is missing, or something is: never silence about it.
    EXPECT_EQ(read.whole, read.problems == 0) << size;
    const BytesSource source(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)));
    const auto index = McapIndex::open(source);
    ASSERT_FALSE(index.ok());
    EXPECT_THAT(index.error().text, HasSubstr("cut off"));
  }
  EXPECT_EQ(most, all.size());
}

// A chunk that a writer has written is read, without a byte behind it.
TEST(Mcap, EveryPieceIsReadableByItself) {
  FileInMemory file(150);
  const Bytes whole = small_file(file);
  std::size_t before = 0;
  for (std::size_t i = 0; i + 1 < file.wholes.size(); ++i) {
    const auto end = whole.begin() + static_cast<std::ptrdiff_t>(file.wholes[i]);
    const auto read = streamed(Bytes(whole.begin(), end)).messages.size();
    if (i > 0 && file.wholes[i] > file.wholes[i - 1]) {
      EXPECT_GT(read, before);
    }
    before = read;
  }
}

TEST(Mcap, NoticesEveryBitThatWasFlipped) {
  FileInMemory file(400);
  const Bytes whole = small_file(file);
  const auto all = streamed(whole).messages;
  for (std::size_t at = 0; at < whole.size(); ++at) {
    Bytes damaged = whole;
    damaged[at] = static_cast<std::uint8_t>(damaged[at] ^ (1U << (at % 8)));
    const Streamed read = streamed(damaged);
    const BytesSource source(damaged);
    const auto index = McapIndex::open(source);
    const bool noticed = !read.opened || read.problems > 0 || !read.whole || !index.ok();
    EXPECT_TRUE(noticed) << "byte " << at;
    // An index whose first byte becomes a message's reads as one; but not without a word about it.
    for (const Message& message : read.messages) {
      const bool known = std::any_of(all.begin(), all.end(), [&](const Message& m) { return same(m, message); });
      EXPECT_TRUE(known || read.problems > 0) << "a message nobody wrote, by a flip of byte " << at;
    }
    if (!index.ok()) continue;
    auto cursor = index.value().messages();
    while (const auto message = cursor.next()) {
      EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](const Message& m) { return same(m, *message); })) << at;
    }
  }
}

RC_GTEST_PROP(Mcap, AnyBytesAreReadWithoutHarm, ()) {
  FileInMemory file(150);
  Bytes damaged = small_file(file);
  const auto flips = *rc::gen::inRange(1, 20);
  for (int i = 0; i < flips; ++i) {
    damaged[*rc::gen::inRange<std::size_t>(8, damaged.size())] = *rc::gen::arbitrary<std::uint8_t>();
  }
  // An index whose first byte becomes a message's reads as one.
  RC_ASSERT(streamed(damaged).messages.size() <= 24U + static_cast<std::size_t>(flips));
  const BytesSource source(damaged);
  if (const auto index = McapIndex::open(source)) {
    auto cursor = index.value().messages();
    std::size_t count = 0;
    while (cursor.next()) RC_ASSERT(++count <= 1000U);
  }
}

// A disk that was full: what was discarded is gone, and all the rest is read, with the schemas and channels that the
// lost chunk was the first to tell.
TEST(Mcap, GoesOnAfterAPieceThatWasNotWritten) {
  FileInMemory file(1 << 20);
  const auto a = file.channel("/a");
  file.writer.add({a, 1, 100, 100, {1}});
  ASSERT_FALSE(file.writer.close_chunk().empty());
  file.writer.discarded();
  const auto b = file.channel("/b");
  file.add({a, 2, 200, 200, {2}});
  file.add({b, 3, 300, 300, {3}});
  file.close_chunk();
  file.writer.add({b, 4, 400, 400, {4}});
  ASSERT_FALSE(file.writer.close_chunk().empty());
  file.writer.discarded();
  file.add({b, 5, 500, 500, {5}});
  const Bytes whole = file.finish();
  const Streamed read = streamed(whole);
  EXPECT_EQ(read.problems, 0U) << read.words;
  ASSERT_EQ(read.messages.size(), 3U);
  EXPECT_EQ(read.messages[0].sequence, 2U);
  EXPECT_EQ(read.messages[2].sequence, 5U);
  const BytesSource source(whole);
  const auto index = McapIndex::open(source);
  ASSERT_TRUE(index.ok()) << index.error().text;
  EXPECT_EQ(index.value().statistics()->messages, 3U);
  EXPECT_EQ(indexed(index.value(), {}).size(), 3U);
}

TEST(Mcap, AChunkIsDueBySizeAndByAge) {
  FileInMemory file(1 << 20);
  const auto a = file.channel("/a");
  EXPECT_FALSE(file.writer.due(5'000'000'000)) << "nothing is in it";
  file.writer.add({a, 1, 1'000, 0, {}});
  EXPECT_FALSE(file.writer.due(1'000'000'999));
  EXPECT_TRUE(file.writer.due(1'000'001'000));
  file.writer.add({a, 2, 1'001, 0, Bytes(std::size_t{1} << 20)});
  EXPECT_TRUE(file.writer.due(1'001));
}

TEST(Mcap, SaysWhatIsNoSuchFile) {
  EXPECT_THAT(streamed({'P', 'K', 3, 4, 0, 0, 0, 0, 0}).words, HasSubstr("byte 0: no MCAP file"));
  EXPECT_THAT(streamed({}).words, HasSubstr("byte 0: the file ends before anything"));
  Bytes later(ground::kMcapMagic.begin(), ground::kMcapMagic.end());
  later[5] = '1';
  EXPECT_THAT(streamed(later).words, HasSubstr("another version"));
}

}  // namespace
}  // namespace gyre::tests
