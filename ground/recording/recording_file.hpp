#pragma once
// The file that a recording goes into: it grows by whole pieces or not at all, and can be read by the place.

#include <memory>
#include <optional>
#include <string>

#include "common/base/result.hpp"
#include "ground/recording/core/mcap_source.hpp"

namespace gyre::ground {

/// A file to append to. While it is open nobody else records into it.
class RecordingFile {
 public:
  enum class Existing { kRefuse, kReplace };
  /// An error names the place and the cure.
  [[nodiscard]] static Result<RecordingFile> create(const std::string& path, Existing existing);
  RecordingFile(RecordingFile&& other) noexcept;
  RecordingFile& operator=(RecordingFile&&) = delete;
  RecordingFile(const RecordingFile&) = delete;
  RecordingFile& operator=(const RecordingFile&) = delete;
  ~RecordingFile();

  /// Absent: all of it is in the file. Otherwise nothing of it is, and the error says why.
  [[nodiscard]] std::optional<Error> append(const Bytes& piece);
  [[nodiscard]] std::uint64_t size() const { return size_; }
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  RecordingFile(int descriptor, std::string path) : descriptor_(descriptor), path_(std::move(path)) {}
  void take_back();

  int descriptor_;
  std::string path_;
  std::uint64_t size_ = 0;
  bool unclean_ = false;  // more is in the file than counts
};

/// Where a file was made, and whether it is still there. One that was deleted takes every byte all the same, and so
/// does one that something was mounted over: only who looks at the place notices.
class FilePlace {
 public:
  /// Of a file that is there now.
  explicit FilePlace(std::string path);
  FilePlace(FilePlace&&) = delete;
  FilePlace& operator=(FilePlace&&) = delete;
  FilePlace(const FilePlace&) = delete;
  FilePlace& operator=(const FilePlace&) = delete;
  ~FilePlace();

  /// What became of it, and what that means for who writes on; absent: it is there.
  [[nodiscard]] std::optional<std::string> loss() const;

 private:
  std::string path_;
  int descriptor_;  // of the file, whatever it is called by now
};

/// A file to read; as long as it was when it was opened.
[[nodiscard]] Result<std::unique_ptr<McapSource>> open_recording(const std::string& path);

}  // namespace gyre::ground
