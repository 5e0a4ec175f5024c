// Files that somebody made to hurt a reader: lengths that are lies, chunks that unpack to more than memory has.

#include <gmock/gmock.h>
#include <zstd.h>

#include "ground/recording/core/mcap_records.hpp"
#include "tests/recording/mcap_files.hpp"

namespace gyre::tests {
namespace {

using ground::Opcode;
using ground::RecordWriter;
using testing::HasSubstr;

Bytes beginning() {
  Bytes bytes(ground::kMcapMagic.begin(), ground::kMcapMagic.end());
  ground::write_header(bytes, "", "");
  return bytes;
}

void add_chunk(Bytes& bytes, std::uint64_t unpacked, const std::string& compression, const Bytes& records) {
  RecordWriter chunk(bytes, Opcode::kChunk);
  chunk.number(std::uint64_t{0});
  chunk.number(std::uint64_t{0});
  chunk.number(unpacked);
  chunk.number(std::uint32_t{0});
  chunk.text(compression);
  chunk.number(static_cast<std::uint64_t>(records.size()));
  chunk.raw(records.data(), records.size());
}

Bytes zstd(const Bytes& from) {
  Bytes to(::ZSTD_compressBound(from.size()));
  to.resize(::ZSTD_compress(to.data(), to.size(), from.data(), from.size(), 19));
  return to;
}

TEST(HostileFile, ARecordLongerThanTheFileIsNotMadeRoomFor) {
  Bytes bytes = beginning();
  const std::size_t place = bytes.size();
  ByteWriter writer(bytes);
  writer.number(static_cast<std::uint8_t>(Opcode::kChunk));
  writer.number(std::uint64_t{0xFFFFFFFFFFFFFFFF});
  const Streamed read = streamed(bytes);
  EXPECT_EQ(read.words, "byte " + std::to_string(place) +
                            ": the file was cut off in the record that begins here: it is to have "
                            "18446744073709551615 bytes and has 0");
}

TEST(HostileFile, ABombIsRefusedByWhatItSays) {
  Bytes bytes = beginning();
  add_chunk(bytes, std::uint64_t{1} << 40, "zstd", zstd(Bytes(100)));
  EXPECT_THAT(streamed(bytes).words, HasSubstr("wants 1099511627776 bytes unpacked"));
}

TEST(HostileFile, ABombThatLiesIsRefusedByWhatItUnpacksTo) {
  Bytes bytes = beginning();
  add_chunk(bytes, 10, "zstd", zstd(Bytes(std::size_t{1} << 22)));
  EXPECT_THAT(streamed(bytes).words, HasSubstr("zstd does not unpack"));
}

TEST(HostileFile, AChunkOfAnotherCompressionNamesTheCure) {
  Bytes bytes = beginning();
  add_chunk(bytes, 10, "lz4", Bytes(5));
  EXPECT_THAT(streamed(bytes).words, HasSubstr("compressed by \"lz4\""));
}

TEST(HostileFile, AMapLongerThanItsRecordIsNoMap) {
  Bytes bytes = beginning();
  {
    RecordWriter metadata(bytes, Opcode::kMetadata);
    metadata.text("name");
    metadata.number(std::uint32_t{0xFFFFFFFF});
  }
  EXPECT_THAT(streamed(bytes).words, HasSubstr("metadata whose fields do not fit"));
}

TEST(HostileFile, MessagesOfChannelsThatWereNotToldAreRefused) {
  Bytes bytes = beginning();
  ground::write(bytes, ground::Message{7, 1, 1, 1, {1, 2, 3}});
  const Streamed read = streamed(bytes);
  EXPECT_TRUE(read.messages.empty());
  EXPECT_THAT(read.words, HasSubstr("channel 7"));
}

TEST(HostileFile, TwoChannelsOfOneNumberAreRefused) {
  Bytes bytes = beginning();
  ground::write(bytes, ground::Channel{1, 0, "/a", "cdr", {}});
  ground::write(bytes, ground::Channel{1, 0, "/a", "cdr", {}});  // the same again is allowed
  ground::write(bytes, ground::Message{1, 1, 1, 1, {}});
  EXPECT_EQ(streamed(bytes).messages.size(), 1U) << "a message that is in no chunk";
  ground::write(bytes, ground::Channel{1, 0, "/b", "cdr", {}});
  EXPECT_THAT(streamed(bytes).words, HasSubstr("two different channels with the number 1"));
}

// Sixty-five thousand channels of a thousand bytes each, again and again packed into nothing.
TEST(HostileFile, AReaderKeepsOnlySoManyChannels) {
  Bytes bytes = beginning();
  Bytes records;
  for (std::uint16_t id = 1; id <= 1000; ++id) {
    ground::write(records, ground::Channel{id, 0, std::string(70'000, 'x'), "cdr", {}});
    if (id % 500 != 0) continue;
    add_chunk(bytes, records.size(), "zstd", zstd(records));
    records.clear();
  }
  EXPECT_THAT(streamed(bytes).words, HasSubstr("more schemas, channels and metadata than a reader keeps"));
}

TEST(HostileFile, ASummaryThatPointsNowhereIsRefused) {
  FileInMemory file;
  (void)file.channel("/a");
  file.add({0, 1, 1, 1, {1}});
  const Bytes good = file.finish();
  const std::size_t footer = good.size() - ground::kMcapMagic.size() - ground::kFooterBytes;
  for (const std::uint64_t summary : {std::uint64_t{1}, std::uint64_t{good.size()}, ~std::uint64_t{0}}) {
    Bytes bytes = good;
    ByteWriter(bytes).overwrite(footer, summary);
    ByteWriter(bytes).overwrite(footer + 16, std::uint32_t{0});  // no checksum
    const BytesSource source(bytes);
    const auto index = ground::McapIndex::open(source);
    ASSERT_FALSE(index.ok());
    EXPECT_THAT(index.error().text, HasSubstr("the footer names a summary that is not in the file"));
  }
}

TEST(HostileFile, AnIndexThatPointsNowhereIsSaidAndPassedOver) {
  Bytes bytes = beginning();
  const std::uint64_t summary = bytes.size();
  ground::write(bytes, ground::Channel{1, 0, "/a", "cdr", {}});
  ground::ChunkIndex index;
  index.offset = 3;
  index.length = 40;
  ground::write(bytes, index);
  index.offset = ~std::uint64_t{0} - 10;
  ground::write(bytes, index);
  {
    RecordWriter footer(bytes, Opcode::kFooter);
    footer.number(summary);
    footer.number(std::uint64_t{0});
    footer.number(std::uint32_t{0});
  }
  bytes.insert(bytes.end(), ground::kMcapMagic.begin(), ground::kMcapMagic.end());
  const BytesSource source(bytes);
  const auto read = ground::McapIndex::open(source);
  ASSERT_TRUE(read.ok()) << read.error().text;
  auto cursor = read.value().messages();
  EXPECT_FALSE(cursor.next());
  EXPECT_EQ(cursor.problems().count(), 2U);
}

}  // namespace
}  // namespace gyre::tests
