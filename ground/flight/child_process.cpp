#include "ground/flight/child_process.hpp"

#include <fcntl.h>
#include <linux/close_range.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include "common/base/text.hpp"

namespace gyre::ground {
namespace {

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  [[nodiscard]] int get() const { return number_; }
  void close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }

 private:
  int number_;
};

/// Between fork and exec only what is async-signal-safe: the parent has threads, and one may have held any lock.
[[noreturn]] void become(char* const* arguments, pid_t parent, int null, int log, int failure) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(127);  // it ended before the line above: nobody would ever kill us
  ::setpgid(0, 0);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  ::dup2(null, STDIN_FILENO);
  ::dup2(log, STDOUT_FILENO);
  ::dup2(log, STDERR_FILENO);
  ::close_range(STDERR_FILENO + 1, ~0U, CLOSE_RANGE_CLOEXEC);
  ::execv(arguments[0], arguments);
  const int reason = errno;
  const ssize_t written = ::write(failure, &reason, sizeof reason);
  ::_exit(written == sizeof reason ? 127 : 126);
}

Error failed(const std::string& what, int reason) {
  return Error{what + ": " + std::strerror(reason)};
}

}  // namespace

std::string ProcessEnd::text() const {
  if (exit_code) return gyre::text("ended with exit code %d", *exit_code);
  return gyre::text("was killed by signal %d (%s)", signal, ::strsignal(signal));
}

Result<ChildProcess> ChildProcess::start(const std::vector<std::string>& command, const std::string& log_path,
                                         LogFile log_file) {
  GYRE_ENSURE(!command.empty(), "a command names at least its executable");
  const int fresh = log_file == LogFile::kStartsEmpty ? O_TRUNC : 0;
  const Descriptor log(::open(log_path.c_str(), O_WRONLY | O_CREAT | fresh | O_APPEND | O_CLOEXEC, 0644));
  if (log.get() < 0) return failed("cannot write the log " + log_path, errno);
  const Descriptor null(::open("/dev/null", O_RDONLY | O_CLOEXEC));
  if (null.get() < 0) return failed("cannot open /dev/null", errno);
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return failed("cannot make a pipe", errno);
  const Descriptor failure_read(ends[0]);
  Descriptor failure_write(ends[1]);

  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);

  const pid_t parent = ::getpid();
  const pid_t pid = ::fork();
  if (pid < 0) return failed("cannot start another process", errno);
  if (pid == 0) become(arguments.data(), parent, null.get(), log.get(), failure_write.get());

  // The pipe closes without a word when the executable has taken over.
  failure_write.close();
  ChildProcess child(pid);
  int reason = 0;
  ssize_t got = 0;
  do got = ::read(failure_read.get(), &reason, sizeof reason);
  while (got < 0 && errno == EINTR);
  if (got == sizeof reason) return failed("cannot run " + command[0], reason);
  return child;
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)), end_(std::exchange(other.end_, std::nullopt)) {}

ChildProcess::~ChildProcess() {
  if (pid_ < 0 || end_) return;
  ::kill(pid_, SIGKILL);
  while (::waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

std::optional<ProcessEnd> ChildProcess::ended() {
  if (end_ || pid_ < 0) return end_;
  int status = 0;
  if (::waitpid(pid_, &status, WNOHANG) != pid_) return std::nullopt;
  end_ = WIFEXITED(status) ? ProcessEnd{WEXITSTATUS(status), 0} : ProcessEnd{std::nullopt, WTERMSIG(status)};
  return end_;
}

void ChildProcess::send(int signal) {
  if (!ended() && pid_ >= 0) ::kill(pid_, signal);
}

}  // namespace gyre::ground
