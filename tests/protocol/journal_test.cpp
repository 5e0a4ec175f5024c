// A journal in pieces: what goes in comes out, wherever it is cut; and what is no journal is not read.

#include "common/protocol/journal.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

namespace gyre::protocol {
namespace {

JournalEntry entry(std::int64_t at_ns, std::uint8_t kind, std::size_t bytes) {
  return {LocalTime(Duration(at_ns)), kind, static_cast<std::uint8_t>(kind + 1), Bytes(bytes, kind)};
}

std::vector<JournalEntry> all_of(JournalReader& reader) {
  std::vector<JournalEntry> out;
  while (auto read = reader.next()) out.push_back(std::move(*read));
  return out;
}

RC_GTEST_PROP(Journal, ComesOutAsItWentIn, ()) {
  JournalWriter writer;
  JournalReader reader;
  std::vector<JournalEntry> in;
  std::vector<JournalEntry> out;
  const int rounds = *rc::gen::inRange(1, 20);
  for (int i = 0; i < rounds; ++i) {
    const int entries = *rc::gen::inRange(0, 10);
    for (int k = 0; k < entries; ++k) {
      in.push_back(entry(*rc::gen::inRange<std::int64_t>(-1000, 1000), *rc::gen::arbitrary<std::uint8_t>(),
                         *rc::gen::inRange<std::size_t>(0, 3000)));
      writer.add(in.back());
    }
    const bool last = i + 1 == rounds;
    while (const auto piece = writer.next(last || *rc::gen::arbitrary<bool>())) {
      RC_ASSERT(piece->bytes.size() <= kMaxJournalBytes);
      reader.take(piece->offset, piece->bytes);
      if (*rc::gen::arbitrary<bool>()) reader.take(piece->offset, piece->bytes);  // told twice
      for (JournalEntry& read : all_of(reader)) out.push_back(std::move(read));
    }
  }
  RC_ASSERT(out == in);
  RC_ASSERT(!reader.gap());
  RC_ASSERT(!reader.broken());
}

TEST(Journal, WaitsUntilAPieceIsFullUnlessAllIsWanted) {
  JournalWriter writer;
  writer.add(entry(1, 2, 10));
  EXPECT_FALSE(writer.next(false));
  ASSERT_TRUE(writer.next(true));
  EXPECT_FALSE(writer.next(true));
  writer.add(entry(1, 2, 2500));
  EXPECT_TRUE(writer.next(false));
  EXPECT_TRUE(writer.next(false));
  EXPECT_FALSE(writer.next(false));
}

TEST(Journal, IsGivenUpWhenNobodyTakesIt) {
  JournalWriter writer(1000);
  writer.add(entry(1, 2, 900));
  EXPECT_FALSE(writer.given_up());
  writer.add(entry(1, 2, 900));
  EXPECT_TRUE(writer.given_up());
  EXPECT_EQ(writer.waiting(), 0U);
  EXPECT_FALSE(writer.next(true)) << "half a journal is none";
  writer.add(entry(1, 2, 1));
  EXPECT_FALSE(writer.next(true));
}

TEST(Journal, IsSaidAgainFromItsBeginningToWhoComesLater) {
  JournalWriter writer;
  JournalReader first;
  JournalReader second;
  std::vector<JournalEntry> in;
  const auto say = [&](bool both) {
    in.push_back(entry(static_cast<std::int64_t>(in.size()), 2, 1500));
    writer.add(in.back());
    while (const auto piece = writer.next(true)) {
      first.take(piece->offset, piece->bytes);
      if (both) second.take(piece->offset, piece->bytes);
    }
  };
  for (int i = 0; i < 5; ++i) say(false);
  writer.begin_again();
  for (int i = 0; i < 5; ++i) say(true);
  EXPECT_EQ(all_of(first), in);
  EXPECT_EQ(all_of(second), in);
}

TEST(Journal, WhatWasSaidIsForgottenBeforeAnythingIsGivenUp) {
  JournalWriter writer(4000);
  JournalReader reader;
  for (int i = 0; i < 20; ++i) {
    writer.add(entry(i, 2, 900));
    while (const auto piece = writer.next(true)) reader.take(piece->offset, piece->bytes);
  }
  EXPECT_EQ(all_of(reader).size(), 20U);
  EXPECT_FALSE(writer.given_up());
  writer.begin_again();
  const auto piece = writer.next(true);
  EXPECT_FALSE(piece) << "it has no beginning any more";
}

TEST(Journal, EndsAtAGap) {
  JournalWriter writer;
  for (int i = 0; i < 10; ++i) writer.add(entry(i, 2, 600));
  JournalReader reader;
  std::vector<JournalEntry> read;
  for (int i = 0; const auto piece = writer.next(true); ++i) {
    if (i != 3) reader.take(piece->offset, piece->bytes);
  }
  EXPECT_TRUE(reader.gap());
  EXPECT_EQ(reader.bytes(), 3 * kMaxJournalBytes);
  EXPECT_EQ(all_of(reader).size(), 4U) << "614 bytes each, of 3000";
  EXPECT_FALSE(reader.broken());
}

TEST(Journal, AGapIsFilledByWhatIsSaidAgain) {
  JournalWriter writer;
  JournalReader reader;
  for (int i = 0; i < 10; ++i) writer.add(entry(i, 2, 600));
  for (int i = 0; const auto piece = writer.next(true); ++i) {
    if (i > 2) reader.take(piece->offset, piece->bytes);
  }
  EXPECT_TRUE(reader.gap());
  EXPECT_FALSE(reader.next());
  writer.begin_again();
  while (const auto piece = writer.next(true)) reader.take(piece->offset, piece->bytes);
  EXPECT_FALSE(reader.gap());
  EXPECT_EQ(all_of(reader).size(), 10U);
}

TEST(Journal, NoneFromItsMiddle) {
  JournalReader reader;
  reader.take(5000, Bytes(100, 1));
  EXPECT_TRUE(reader.gap());
  EXPECT_FALSE(reader.next());
}

TEST(Journal, WhatIsNoJournalIsNotRead) {
  const auto read = [](const Bytes& bytes) {
    JournalReader reader;
    reader.take(0, bytes);
    EXPECT_FALSE(reader.next());
    return reader.broken();
  };
  EXPECT_FALSE(read({1, 0})) << "not whole yet";
  EXPECT_TRUE(read({9, 0, 0, 0})) << "shorter than any entry";
  EXPECT_TRUE(read({255, 255, 255, 255})) << "longer than any";
  Bytes in_no_time{10, 0, 0, 0};
  in_no_time.insert(in_no_time.end(), 8, 127);
  in_no_time.insert(in_no_time.end(), 2, 0);
  EXPECT_TRUE(read(in_no_time)) << "at a time that no clock shows";
}

}  // namespace
}  // namespace gyre::protocol
