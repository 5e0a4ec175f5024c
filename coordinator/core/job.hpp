#pragma once
// What a coordinator is told to do, what it asks for, and how patient it is.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/base/notice.hpp"
#include "common/base/result.hpp"
#include "common/mechanics/plan.hpp"
#include "common/mechanics/swing.hpp"
#include "common/protocol/messages.hpp"
#include "common/protocol/silence.hpp"
#include "coordinator/core/agreement.hpp"

namespace gyre::coordinator {

/// What is to be flown; its plan is admissible (mechanics/certificate.hpp).
struct Job {
  std::string name;
  mechanics::Plan plan;
  /// How long a change takes, of plan or of pace; absent: as short as it keeps all limits, but no shorter than
  /// shortest_transition.
  std::optional<Duration> transition;
  protocol::Silence silence;
  std::string mission_text = {};                 ///< the file as the swarm is told it; opaque here
  std::optional<mechanics::Swings> swings = {};  ///< of its certificate; absent: not judged
};

struct CoordinatorOptions {
  std::uint64_t nonce = 0;         ///< random; makes the terms of two coordinators differ
  bool engage_when_ready = false;  ///< start the motion as soon as every agent has accepted, if nobody ever wished
                                   ///< anything else of this swarm
  Duration beacon_period = std::chrono::milliseconds(20);
  /// Between two looks at what arrived, while it listens and while an agent waits for swarm time or its plan: a
  /// beginning is a few words to and fro, and all wait for it.
  Duration hurry = std::chrono::milliseconds(5);
  Duration status_period = std::chrono::milliseconds(500);
  Duration agent_timeout = std::chrono::milliseconds(450);    ///< an agent is named silent
  Duration listening = std::chrono::milliseconds(1500);       ///< to a swarm that already flies, since its first word
  Duration listening_least = std::chrono::milliseconds(350);  ///< to it, even when all was said: a few words of each
  Duration hopeless = std::chrono::seconds(5);                ///< that somebody still brings a plan that nobody knows
  Duration shortest_transition = std::chrono::seconds(5);
  Duration freezing = std::chrono::seconds(1);            ///< at least; as short as all limits allow
  Duration seizing = std::chrono::milliseconds(300);      ///< where a carrier got stuck, at least
  Duration stopping = std::chrono::seconds(2);            ///< at the end of a lease, at least
  Duration longest_ramp = std::chrono::minutes(5);        ///< that is tried to keep the limits
  Duration start_check = std::chrono::milliseconds(300);  ///< after a start, to see that everybody follows
  Duration patience = std::chrono::seconds(1);            ///< with complaints that are only late, before they are told
  Duration safe_within =
      std::chrono::milliseconds(1500);  ///< a wish, in the agents' hands; or its answer says it is not
  AgreementOptions agreement;
  int release_attempts = 5;  ///< at shutdown, with agents that do not answer
};

/// A retune whose mission was read and certified outside: the job, or why there is none.
struct Retune {
  std::uint64_t command = 0;
  Result<Job> job;
};

struct Outcome {
  bool clean = true;
  std::string text;
};

struct Outputs {
  std::optional<protocol::TimeReply> time_reply;
  std::vector<protocol::PlanOffer> offers;
  std::optional<protocol::Beacon> beacon;
  std::optional<protocol::CoordinatorStatus> status;
  std::optional<protocol::MissionText> mission;
  std::vector<protocol::CommandReply> replies;
  Notices notices;
  std::optional<Outcome> finished;  ///< nothing more to do; the process may end
  LocalTime next_tick{};
};

/// The latest of what there is to tell, beside the notices.
struct News {
  std::string latest;

  void tell(Outputs& out, Notice::Level level, const std::string& text) {
    latest = text;
    out.notices.push_back({level, text});
  }
  /// Unless it is what was told last.
  void tell_once(Outputs& out, Notice::Level level, const std::string& text) {
    if (text != latest) tell(out, level, text);
  }
};

}  // namespace gyre::coordinator
