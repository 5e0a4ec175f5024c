// The file that a recording goes into: refused with the place and the cure, whole or not at all.

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "ground/recording/recording_file.hpp"

namespace gyre::tests {
namespace {

using ground::FilePlace;
using ground::RecordingFile;
using testing::HasSubstr;

class RecordingFileTest : public testing::Test {
 protected:
  RecordingFileTest() {
    std::string pattern = testing::TempDir() + "recording-XXXXXX";
    directory = ::mkdtemp(pattern.data());
  }
  ~RecordingFileTest() override { std::filesystem::remove_all(directory); }

  static std::string why(const std::string& path) {
    const auto file = RecordingFile::create(path, RecordingFile::Existing::kRefuse);
    return file ? "" : file.error().text;
  }

  std::string directory;
};

TEST_F(RecordingFileTest, WhatIsThereIsKeptUnlessToldOtherwise) {
  const std::string path = directory + "/flight.mcap";
  std::ofstream(path) << "precious";
  EXPECT_THAT(why(path), HasSubstr("--force"));
  EXPECT_EQ(std::filesystem::file_size(path), 8U);
  ASSERT_TRUE(RecordingFile::create(path, RecordingFile::Existing::kReplace).ok());
  EXPECT_EQ(std::filesystem::file_size(path), 0U);
}

TEST_F(RecordingFileTest, PlacesWhereNothingCanBeWrittenAreNamed) {
  EXPECT_THAT(why(directory + "/nowhere/flight.mcap"), HasSubstr("nowhere/flight.mcap: there is no such folder"));
  const auto folder = RecordingFile::create(directory, RecordingFile::Existing::kReplace);
  ASSERT_FALSE(folder.ok());
  EXPECT_THAT(folder.error().text, HasSubstr("this is a folder"));
  const auto device = RecordingFile::create("/dev/null", RecordingFile::Existing::kReplace);
  ASSERT_FALSE(device.ok());
  EXPECT_THAT(device.error().text, HasSubstr("no file that can be read again"));
}

TEST_F(RecordingFileTest, TwoRecordersDoNotShareOne) {
  const std::string path = directory + "/flight.mcap";
  auto first = RecordingFile::create(path, RecordingFile::Existing::kRefuse);
  ASSERT_TRUE(first.ok());
  RecordingFile file = std::move(first).value();
  EXPECT_FALSE(file.append({1, 2, 3}));
  const auto second = RecordingFile::create(path, RecordingFile::Existing::kReplace);
  ASSERT_FALSE(second.ok());
  EXPECT_THAT(second.error().text, HasSubstr("another recording"));
  EXPECT_EQ(std::filesystem::file_size(path), 3U);
}

TEST_F(RecordingFileTest, APieceIsWholeOrNotThereAtAll) {
  const std::string path = directory + "/flight.mcap";
  auto created = RecordingFile::create(path, RecordingFile::Existing::kRefuse);
  ASSERT_TRUE(created.ok());
  RecordingFile file = std::move(created).value();
  ASSERT_FALSE(file.append(Bytes(1000, 1)));
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit tight{1500, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &tight), 0);
  const auto failed = file.append(Bytes(1000, 2));
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  ASSERT_TRUE(failed);
  EXPECT_THAT(failed->text, HasSubstr("may not grow"));
  EXPECT_EQ(std::filesystem::file_size(path), 1000U) << "the half that found room was taken back";
  EXPECT_EQ(file.size(), 1000U);
  EXPECT_FALSE(file.append(Bytes(10, 3)));
  const auto source = ground::open_recording(path);
  ASSERT_TRUE(source.ok());
  ASSERT_EQ(source.value()->size(), 1010U);
  Bytes end(12);
  ASSERT_TRUE(source.value()->read(998, end.size(), end.data()));
  EXPECT_EQ(end, (Bytes{1, 1, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3}));
  EXPECT_FALSE(source.value()->read(1009, 2, end.data()));
}

TEST_F(RecordingFileTest, OneThatIsNotWhereItWasMadeIsNoticed) {
  const std::string path = directory + "/flight.mcap";
  auto made = RecordingFile::create(path, RecordingFile::Existing::kRefuse);
  ASSERT_TRUE(made.ok());
  RecordingFile file = std::move(made).value();
  const FilePlace place(path);
  EXPECT_FALSE(place.loss());
  ASSERT_FALSE(file.append(Bytes(1000, 1)));
  EXPECT_FALSE(place.loss()) << "it only grew";
  std::filesystem::rename(path, directory + "/elsewhere.mcap");
  EXPECT_THAT(place.loss().value_or(""), testing::AllOf(HasSubstr(path), HasSubstr("not there any more")));
  std::ofstream(path) << "of somebody else";
  EXPECT_THAT(place.loss().value_or(""), HasSubstr("another file by now"));
  std::filesystem::rename(directory + "/elsewhere.mcap", path);
  EXPECT_FALSE(place.loss()) << "and back";
  std::filesystem::remove(path);
  EXPECT_THAT(place.loss().value_or(""), testing::AllOf(HasSubstr("was deleted"), HasSubstr("record anew")));
  EXPECT_FALSE(file.append(Bytes(1000, 2))) << "which no writer is told";
}

}  // namespace
}  // namespace gyre::tests
