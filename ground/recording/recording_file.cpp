#include "ground/recording/recording_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace gyre::ground {
namespace {

std::string cure_of(int error, const std::string& path) {
  switch (error) {
    case EEXIST:
      return "there is a file of this name already; give another one with -o, or --force to replace it";
    case ENOENT:
      return "there is no such folder; make it, or give another place with -o";
    case EACCES:
    case EPERM:
    case EROFS:
      return std::string("this may not be written (") + std::strerror(error) + "); give another place with -o";
    case EISDIR:
      return "this is a folder; give a file in it, as -o " + path + "/flight.mcap";
    case ENOSPC:
    case EDQUOT:
      return "the disk is full; make room on it";
    case EFBIG:
      return "the file may not grow further (ulimit -f)";
    default:
      return std::strerror(error);
  }
}

Error failure(const std::string& path, int error) {
  return Error{path + ": " + cure_of(error, path)};
}

class FileSource final : public McapSource {
 public:
  FileSource(int descriptor, std::uint64_t size) : descriptor_(descriptor), size_(size) {}
  FileSource(const FileSource&) = delete;
  FileSource& operator=(const FileSource&) = delete;
  ~FileSource() override { ::close(descriptor_); }

  [[nodiscard]] std::uint64_t size() const override { return size_; }
  [[nodiscard]] bool read(std::uint64_t offset, std::size_t count, std::uint8_t* to) const override {
    while (count > 0) {
      const ssize_t got = ::pread(descriptor_, to, count, static_cast<off_t>(offset));
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) return false;
      to += got;
      offset += static_cast<std::uint64_t>(got);
      count -= static_cast<std::size_t>(got);
    }
    return true;
  }

 private:
  int descriptor_;
  std::uint64_t size_;
};

}  // namespace

Result<RecordingFile> RecordingFile::create(const std::string& path, Existing existing) {
  constexpr mode_t kForAllToRead = 0644;
  // Without waiting for somebody to read: what is no file is refused below.
  const int flags = O_WRONLY | O_CREAT | O_CLOEXEC | O_NONBLOCK | (existing == Existing::kRefuse ? O_EXCL : 0);
  const int descriptor = ::open(path.c_str(), flags, kForAllToRead);
  if (descriptor < 0) return failure(path, errno);
  RecordingFile file(descriptor, path);
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) return failure(path, errno);
  if (!S_ISREG(status.st_mode)) return Error{path + ": this is no file that can be read again; give one with -o"};
  // Not before the lock: another recorder may be at it.
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) return Error{path + ": another recording is being written into it"};
  if (::ftruncate(descriptor, 0) != 0) return failure(path, errno);
  return file;
}

RecordingFile::RecordingFile(RecordingFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      path_(std::move(other.path_)),
      size_(other.size_),
      unclean_(other.unclean_) {}

RecordingFile::~RecordingFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void RecordingFile::take_back() {
  unclean_ = ::ftruncate(descriptor_, static_cast<off_t>(size_)) != 0;
}

std::optional<Error> RecordingFile::append(const Bytes& piece) {
  if (unclean_) take_back();
  if (unclean_) return failure(path_, errno);
  for (std::size_t done = 0; done < piece.size();) {
    const auto place = static_cast<off_t>(size_ + done);
    const ssize_t wrote = ::pwrite(descriptor_, piece.data() + done, piece.size() - done, place);
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote <= 0) {
      const int error = wrote < 0 ? errno : ENOSPC;
      take_back();
      return failure(path_, error);
    }
    done += static_cast<std::size_t>(wrote);
  }
  size_ += piece.size();
  return std::nullopt;
}

FilePlace::FilePlace(std::string path)
    : path_(std::move(path)), descriptor_(::open(path_.c_str(), O_PATH | O_CLOEXEC)) {}

FilePlace::~FilePlace() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::optional<std::string> FilePlace::loss() const {
  struct stat made {
  }, found{};
  if (descriptor_ < 0 || ::fstat(descriptor_, &made) != 0 || made.st_nlink == 0) {
    return path_ +
           " was deleted: what is written goes into a file without a name, and is gone when this program ends; "
           "end it and record anew";
  }
  if (::stat(path_.c_str(), &found) != 0) {
    return path_ + " is not there any more (" + std::strerror(errno) +
           "): it was moved, or its file system was; what is written goes to wherever it is now";
  }
  if (found.st_dev == made.st_dev && found.st_ino == made.st_ino) return std::nullopt;
  return path_ +
         " is another file by now: the one that is written into was moved, or another file system was mounted "
         "over it, and goes on growing there";
}

Result<std::unique_ptr<McapSource>> open_recording(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return Error{path + ": " + std::strerror(errno)};
  struct stat status {};
  if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) {
    ::close(descriptor);
    return Error{path + ": this is no file"};
  }
  return std::unique_ptr<McapSource>(new FileSource(descriptor, static_cast<std::uint64_t>(status.st_size)));
}

}  // namespace gyre::ground
