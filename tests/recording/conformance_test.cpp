// The format's own conformance files, 416 small ones with every combination of what a writer may do or leave out, read
// by both of our readers.

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/recording/judge.hpp"
#include "tests/recording/mcap_files.hpp"

namespace gyre::tests {
namespace {

TEST(Conformance, EveryFileOfTheFormatIsRead) {
  const std::string folder = testing::TempDir() + "conformance-" + std::to_string(::getpid());
  if (!judged("conformance.mjs", folder)) GTEST_SKIP() << "no Node, or no npm: see above";
  std::ifstream manifest(folder + "/MANIFEST");
  std::string name;
  std::size_t messages = 0;
  std::size_t metadata = 0;
  bool indexed = false;
  int files = 0;
  while (manifest >> name >> messages >> indexed >> metadata) {
    ++files;
    std::ifstream file(folder + "/" + name + ".mcap", std::ios::binary);
    const Bytes bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    const Streamed read = streamed(bytes);
    EXPECT_TRUE(read.whole) << name;
    EXPECT_EQ(read.problems, 0U) << name << ": " << read.words;
    EXPECT_EQ(read.messages.size(), messages) << name;
    EXPECT_EQ(read.metadata.size(), metadata) << name;
    for (const ground::Message& message : read.messages) EXPECT_EQ(message.payload, (Bytes{1, 2, 3})) << name;

    const BytesSource source(bytes);
    const auto index = ground::McapIndex::open(source);
    if (!index) {
      EXPECT_FALSE(indexed) << name << ": " << index.error().text;
      continue;
    }
    auto cursor = index.value().messages();
    std::size_t found = 0;
    std::uint64_t before_ns = 0;
    while (const auto message = cursor.next()) {
      EXPECT_GE(message->log_ns, before_ns) << name << ": in the order of time";
      before_ns = message->log_ns;
      ++found;
    }
    // A file whose messages the summary does not lead to is refused: it must not read as an empty one.
    EXPECT_EQ(found, messages) << name;
  }
  EXPECT_EQ(files, 416);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace gyre::tests
