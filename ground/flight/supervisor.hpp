#pragma once
// The processes of one flight: started together, watched, and gone together.
//
// Each has a name a person knows ("agent 3") and a log file called after it. The supervisor never waits without a
// bound, and when it is destroyed every process is gone.

#include <deque>
#include <list>
#include <optional>
#include <string>
#include <vector>

#include "common/base/result.hpp"
#include "ground/flight/child_process.hpp"

namespace gyre::ground {

struct Program {
  std::string name;                  ///< "agent 3"
  std::vector<std::string> command;  ///< the executable's path and its arguments
};

/// What stop() does when, counted from its call.
struct StopPatience {
  double ask_again_s = 0.5;  ///< a second SIGTERM, for one who came to its signals only now
  double kill_s = 2.0;       ///< then SIGKILL
};

class Supervisor {
 public:
  explicit Supervisor(std::string log_directory) : log_directory_(std::move(log_directory)) {}

  /// Names are unique. Errors as ChildProcess::start.
  [[nodiscard]] Result<pid_t> start(const Program& program);

  /// Kills it if it still runs, and starts it anew; its log goes on. Errors as ChildProcess::start.
  [[nodiscard]] Result<pid_t> restart(const Program& program);
  /// Absent: it has ended, or there is none of this name.
  [[nodiscard]] std::optional<pid_t> pid(const std::string& name);

  struct Ended {
    std::string name;
    ProcessEnd end;
  };
  /// Those that have ended since the last call.
  [[nodiscard]] std::vector<Ended> collect();

  void send(const std::string& name, int signal);

  /// Ends all that still run. Returns the names of those that did not end when asked and had to be killed.
  std::vector<std::string> stop(const StopPatience& patience = {});

  [[nodiscard]] std::string log_path(const std::string& name) const;
  /// The last lines of a process's log, each on a line of its own; empty when it said nothing.
  [[nodiscard]] std::string log_tail(const std::string& name, std::size_t lines = 12) const;

 private:
  struct Member {
    std::string name;
    ChildProcess process;
    bool reported = false;
  };
  [[nodiscard]] Member* find(const std::string& name);
  void send_all(int signal);

  std::string log_directory_;
  std::list<Member> members_;
};

}  // namespace gyre::ground
