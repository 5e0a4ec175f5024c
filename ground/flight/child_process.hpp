#pragma once
// One child process that cannot outlive its parent.
//
// Intuition: the kernel kills the child when its parent is gone (PR_SET_PDEATHSIG), whatever ended the parent. The
// child has a process group of its own, so that Ctrl-C on the terminal reaches the parent only, which then ends the
// flight in order. It inherits no descriptor but its log: sockets of the parent stay the parent's.
//
// The kernel ties the child to the THREAD that forked it: start children from a thread that lives as long as they do.

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

#include "common/base/result.hpp"

namespace gyre::ground {

/// How a process ended: by itself with an exit code, or by a signal.
struct ProcessEnd {
  std::optional<int> exit_code;
  int signal = 0;

  [[nodiscard]] bool clean() const { return exit_code == 0; }
  /// "ended with exit code 1", "was killed by signal 9 (Killed)".
  [[nodiscard]] std::string text() const;
};

enum class LogFile { kStartsEmpty, kGoesOn };

class ChildProcess {
 public:
  /// `command[0]` is the executable's path. stdout and stderr go to the file at `log_path`. Fails
  /// when the log cannot be written or the executable cannot be run; the error names the path and the reason.
  [[nodiscard]] static Result<ChildProcess> start(const std::vector<std::string>& command, const std::string& log_path,
                                                  LogFile log_file = LogFile::kStartsEmpty);

  /// Kills it, and waits until it is gone.
  ~ChildProcess();
  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&&) = delete;
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  [[nodiscard]] pid_t pid() const { return pid_; }
  /// How it ended, if it has; does not wait.
  [[nodiscard]] std::optional<ProcessEnd> ended();
  /// Nothing happens when it has ended.
  void send(int signal);

 private:
  explicit ChildProcess(pid_t pid) : pid_(pid) {}

  pid_t pid_;
  std::optional<ProcessEnd> end_;
};

}  // namespace gyre::ground
