#pragma once
// What becomes of a person's wish to hurt a flight: the one deed that does it, and the words for it; or why not.
//
// Intuition: the page promises what the processes then do. So a disturbance is judged by the rule that the process
// itself will judge it by (common/protocol/disturbance.hpp), with what was done to that process before; what a process
// that has ended or hangs would not notice is not said to be done; and what changes nothing is said to change nothing.
//
//   wish   kill, stop, continue, restart                lose, shift the clock, push
//   deed   a signal, or a process that begins anew      a word on the topic laboratory
//
// Nothing here performs a deed. It counts as done when it is answered, but for a restart, which can fail: restarted()
// is to be told how it went.
//
// What a process suffers ends with it: one that began anew has its packets and the machine's clock again.

#include <map>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "common/base/time.hpp"
#include "common/protocol/disturbance.hpp"
#include "ground/page/core/hurt_request.hpp"

namespace gyre::ground {

struct SignalDeed {
  enum class Kind { kKill, kStop, kContinue };
  Kind kind = Kind::kKill;
  std::string process;
};
struct RestartDeed {
  std::string process;
};

struct HurtVerdict {
  Answer answer;  ///< of a restart: once restarted() was told
  std::variant<std::monostate, SignalDeed, RestartDeed, protocol::Disturbance> deed;
};

/// What can be seen of a flight's processes from outside.
struct FlightSeen {
  std::set<std::string> running;    ///< that have not ended, whether they hang or not
  bool laboratory_listens = false;  ///< somebody reads the topic
};

class HurtJudge {
 public:
  /// `processes`: those that may be hurt. `load_weight_n`: as the simulator knows it.
  HurtJudge(const std::vector<std::string>& processes, double load_weight_n);

  [[nodiscard]] HurtVerdict judge(LocalTime now, const HurtRequest& wish, const FlightSeen& seen);
  /// How a RestartDeed went; `failure`: why the process could not be started. The former one is gone either way.
  [[nodiscard]] Answer restarted(const std::string& process, const std::optional<std::string>& failure);

  /// Whether this process ended because it was asked for.
  [[nodiscard]] bool meant(const std::string& process) const;
  [[nodiscard]] bool hangs(const std::string& process) const;

 private:
  struct Process {
    bool ended = false;  ///< because it was asked for
    bool hangs = false;
    double share = 0.0;                     ///< of its packets that are lost
    std::optional<LocalTime> lossy_until;   ///< absent: until told otherwise
    Duration shifted{};                     ///< of its clock, in all
    std::optional<LocalTime> stands_until;  ///< from when on its clock may be shifted back again
  };

  [[nodiscard]] HurtVerdict signal(const HurtRequest& wish, Process& process) const;
  [[nodiscard]] HurtVerdict disturb(LocalTime now, const HurtRequest& wish, const std::string& name, Process& process);
  [[nodiscard]] std::optional<std::string> objection(LocalTime now, const protocol::Disturbance& disturbance,
                                                     const Process& process) const;
  [[nodiscard]] std::string names() const;

  std::vector<std::string> order_;  ///< as they were given, for words
  std::map<std::string, Process> processes_;
  double load_weight_n_;
};

}  // namespace gyre::ground
