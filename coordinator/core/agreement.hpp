#pragma once
// How one transition is agreed: rehearsed, proposed, confirmed by every agent that is asked, go; or given up, and
// nothing happened.
//
// A machine of its own: it is told who has not confirmed yet, and answers what the course should hold. It knows no
// beacon, no agent and no plan's meaning.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/protocol/messages.hpp"
#include "coordinator/core/rehearsal.hpp"

namespace gyre::coordinator {

struct AgreementOptions {
  Duration lead = std::chrono::milliseconds(600);                  ///< from proposal to start
  Duration go_margin = std::chrono::milliseconds(150);             ///< before the start nothing is decided any more
  Duration rehearsal_per_carrier = std::chrono::milliseconds(40);  ///< of the first attempt, before the lead
  int attempts = 5;  ///< at rehearsing: at twice the duration if a limit broke, for a later start if it took too long
  bool rehearse = true;  ///< off in flights on virtual time, where thousands fly and no vehicle can be hurt
};

/// What a transition is for.
struct Intent {
  protocol::PlanNumber to;
  Duration duration{};
  bool may_slow_down = false;            ///< a rehearsal that breaks a limit is tried again at twice the duration
  bool rehearsed = true;                 ///< off when holding the load matters more than any limit
  std::optional<std::uint64_t> command;  ///< to be answered
};

class Agreement {
 public:
  Agreement(std::uint64_t id, const Intent& intent, const AgreementOptions& options)
      : options_(options), intent_(intent) {
    transition_.id = id;
    transition_.to.number = intent.to;
    transition_.duration = intent.duration;
  }

  [[nodiscard]] const protocol::Transition& transition() const { return transition_; }
  [[nodiscard]] const Intent& intent() const { return intent_; }

  /// Sets the start anew, `carriers` rehearsals and a lead ahead; a motion begins there at phase zero.
  void schedule(SwarmTime now, std::size_t carriers);
  [[nodiscard]] bool needs_rehearsal() const { return rehearsed() && !proposed_ && !rehearsal_; }
  void rehearse(Rehearsal rehearsal) { rehearsal_.emplace(std::move(rehearsal)); }

  enum class Step {
    kWait,     ///< nothing new
    kAgain,    ///< schedule anew, for another rehearsal
    kPropose,  ///< put transition() on the course
    kGo,       ///< everybody has confirmed: it is go
    kGiveUp,   ///< take it off the course; why() says why
  };
  /// `unconfirmed`: who has not confirmed yet; read once proposed.
  Step step(SwarmTime now, const std::vector<CarrierId>& unconfirmed);
  [[nodiscard]] bool proposed() const { return proposed_; }
  [[nodiscard]] const std::string& why() const { return why_; }

 private:
  [[nodiscard]] bool rehearsed() const { return options_.rehearse && intent_.rehearsed; }
  Step give_up(std::string why);
  Step rehearsal_done(SwarmTime now);

  AgreementOptions options_;
  Intent intent_;
  protocol::Transition transition_;
  std::optional<Rehearsal> rehearsal_;
  bool proposed_ = false;
  int attempt_ = 1;
  std::string why_;
};

}  // namespace gyre::coordinator
