#pragma once
// How one change of the course is agreed: rehearsed where it changes the plan, proposed, confirmed by every agent, go;
// or given up, and nothing happened.
//
// A machine of its own: it is told who has not confirmed yet, and answers what is to be done. It knows no beacon, no
// agent and no plan's meaning.

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

/// What the course is to become.
struct Intent {
  protocol::Wish wish;
  /// Another plan, by a transition; absent: another pace, wish.pace, by a ramp.
  std::optional<protocol::PlanNumber> plan;
  Duration duration{};
  bool may_slow_down = false;            ///< a rehearsal that breaks a limit is tried again at twice the duration
  bool rehearsed = true;                 ///< a change of plan; off when holding the load matters more than any limit
  std::optional<double> phase_rad;       ///< of the base plan's cycle, where a ramp to rest is to end; absent: anywhere
  std::optional<std::uint64_t> command;  ///< to be answered
};

class Agreement {
 public:
  Agreement(const Intent& intent, const AgreementOptions& options)
      : options_(options), intent_(intent), duration_(intent.duration) {}

  [[nodiscard]] const Intent& intent() const { return intent_; }
  [[nodiscard]] Duration duration() const { return duration_; }
  [[nodiscard]] SwarmTime start() const { return start_; }

  /// Sets the start anew, `carriers` rehearsals and a lead ahead. What is to be proposed then: `set_proposal`.
  void schedule(SwarmTime now, std::size_t carriers);
  void set_proposal(protocol::Course proposal, SwarmTime start) {
    proposal_ = std::move(proposal);
    start_ = start;
  }
  [[nodiscard]] const protocol::Course& proposal() const { return proposal_; }
  [[nodiscard]] bool needs_rehearsal() const { return rehearsed() && !proposed_ && !rehearsal_; }
  void rehearse(Rehearsal rehearsal) { rehearsal_.emplace(std::move(rehearsal)); }

  enum class Step {
    kWait,    ///< nothing new
    kAgain,   ///< schedule anew, for another rehearsal
    kGo,      ///< everybody has confirmed: the proposal is the course
    kGiveUp,  ///< nothing happened; why() says why
  };
  /// `unconfirmed`: who has not confirmed yet; read once proposed.
  Step step(SwarmTime now, const std::vector<CarrierId>& unconfirmed);
  [[nodiscard]] bool proposed() const { return proposed_; }
  [[nodiscard]] const std::string& why() const { return why_; }
  /// What the carriers do at their worst meanwhile, by the rehearsal; empty without one.
  [[nodiscard]] std::vector<mechanics::CarrierFigures> figures() const {
    return rehearsal_ ? rehearsal_->figures() : std::vector<mechanics::CarrierFigures>{};
  }

 private:
  [[nodiscard]] bool rehearsed() const { return options_.rehearse && intent_.rehearsed && intent_.plan; }
  Step give_up(std::string why);
  Step rehearsal_done(SwarmTime now);

  AgreementOptions options_;
  Intent intent_;
  protocol::Course proposal_;
  SwarmTime start_{};
  Duration duration_;
  std::optional<Rehearsal> rehearsal_;
  bool proposed_ = false;
  int attempt_ = 1;
  std::string why_;
};

}  // namespace gyre::coordinator
