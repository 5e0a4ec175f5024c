#include "coordinator/core/agreement.hpp"

#include "common/base/text.hpp"

namespace gyre::coordinator {

void Agreement::schedule(SwarmTime now, std::size_t carriers) {
  rehearsal_.reset();
  // Every further attempt gets more time: the last one may have failed for want of it, on a busy machine.
  const Duration rehearsal =
      rehearsed() ? options_.rehearsal_per_carrier * static_cast<Duration::rep>(carriers) * attempt_ : Duration::zero();
  start_ = now + options_.lead + rehearsal;
}

Agreement::Step Agreement::give_up(std::string why) {
  why_ = std::move(why);
  return Step::kGiveUp;
}

Agreement::Step Agreement::rehearsal_done(SwarmTime now) {
  if (!rehearsal_->reasons().empty()) {
    if (!intent_.may_slow_down || attempt_ == options_.attempts) {
      return give_up("it would break a limit: " + rehearsal_->reasons().front().text);
    }
    ++attempt_;
    duration_ *= 2;
    return Step::kAgain;
  }
  // The lead is for the agents to answer in; a rehearsal that used it up is done again, for a later start.
  if (start_ - now < options_.lead / 2 + options_.go_margin) {
    if (attempt_ == options_.attempts) return give_up("rehearsing it takes too long on this machine");
    ++attempt_;
    return Step::kAgain;
  }
  proposed_ = true;
  return Step::kWait;
}

Agreement::Step Agreement::step(SwarmTime now, const std::vector<CarrierId>& unconfirmed) {
  if (!proposed_) {
    if (!rehearsed()) {
      proposed_ = true;
      return Step::kWait;
    }
    return rehearsal_->advance() ? rehearsal_done(now) : Step::kWait;
  }
  if (start_ - now >= options_.go_margin) return unconfirmed.empty() ? Step::kGo : Step::kWait;
  // Who hung meanwhile finds all confirmations at once, and the start long past.
  if (unconfirmed.empty()) return give_up("it was decided too late: this process hung");
  return give_up("not confirmed in time by " + listed("carrier", unconfirmed));
}

}  // namespace gyre::coordinator
