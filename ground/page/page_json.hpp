#pragma once
// The page's messages as JSON: what idl/page.proto says, and the one place in the ground that knows Protobuf.
//
// Fields keep their names, every field is there, a number that is not finite is a word ("Infinity"), as Protobuf's
// mapping has it.

#include <optional>
#include <string>
#include <vector>

#include "ground/page/core/hurt_gauge.hpp"
#include "ground/page/core/known_mission.hpp"
#include "ground/swarm/core/happenings.hpp"
#include "ground/swarm/core/swarm_view.hpp"

namespace gyre::ground {

/// What a server tells of itself.
struct PageOwner {
  std::string server;  ///< differs at every start
  int domain = 0;
  bool takes_orders = true;     ///< false: a recording is shown
  bool owns_processes = false;  ///< they can be hurt
  std::string mission_file;     ///< what is flown, by its name; empty: unknown
};

/// A process of the server's own.
struct OwnProcess {
  std::string name;
  int pid = 0;           ///< 0: it has ended
  bool stopped = false;  ///< by SIGSTOP
};

/// What is shown, as of a moment.
struct Shown {
  const SwarmView& view;
  const KnownMission* mission = nullptr;  ///< nullptr: not known
  LocalTime now{};
  LocalTime begin{};  ///< of the server
};

[[nodiscard]] std::string hello_json(const PageOwner& owner);
[[nodiscard]] std::string mission_json(const Shown& shown);
/// `window`: the load since the last frame.
[[nodiscard]] std::string frame_json(const Shown& shown, const LoadWindow& window);
/// `flown`: the load since the motion began.
[[nodiscard]] std::string status_json(const Shown& shown, const std::optional<std::string>& complaint,
                                      const LoadWindow& flown, const std::vector<OwnProcess>& own,
                                      const std::optional<HurtOutcome>& hurt);
[[nodiscard]] std::string happening_json(const Happening& happening);
[[nodiscard]] std::string time_json(double server_time_s);

}  // namespace gyre::ground
