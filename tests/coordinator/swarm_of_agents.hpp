#pragma once
// A coordinator and its agents in one process on one clock: messages arrive at once, or not at all.

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "agent/core/agent.hpp"
#include "coordinator/core/coordinator.hpp"
#include "tests/mechanics/plans.hpp"

namespace gyre::coordinator::test {

/// Four carriers on a polygon, and nothing else that matters.
inline Job job() {
  Job job;
  job.plan = mechanics::test::polygon_plan(4);
  return job;
}

inline bool says(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

class SwarmOfAgents {
 public:
  explicit SwarmOfAgents(const Job& job, const CoordinatorOptions& options = {}) : job_(job), options_(options) {
    start_coordinator();
    for (const mechanics::Carrier& carrier : job.plan.carriers) start_agent(carrier.id);
  }

  void start_coordinator() {
    coordinator_ = std::make_unique<Coordinator>(job_, options_);
    finished.reset();
    for (const auto& [id, held] : held_) tell(held);  // transient local
  }
  void stop_coordinator() { coordinator_.reset(), offers_.clear(); }

  void start_agent(CarrierId id, const mechanics::Limits& vehicle = {}) {
    agent::AgentOptions options;
    options.carrier = id;
    options.incarnation = ++incarnations_;
    options.vehicle = vehicle;
    options.vehicle_wait = Duration::zero();
    agents_[id] = std::make_unique<agent::Agent>(options);
    if (offers_.count(id) > 0) tell_agent(id, offers_.at(id));  // transient local
  }
  void stop_agent(CarrierId id) { agents_.erase(id), held_.erase(id); }

  void tell(const Event& event) {
    if (!coordinator_) return;
    const Outputs out = coordinator_->step(now, event);
    for (const Notice& notice : out.notices) news += notice.text + "\n";
    for (const protocol::CommandReply& reply : out.replies) replies.push_back(reply);
    if (out.finished) finished = out.finished;
    if (out.status) status = out.status;
    for (const protocol::PlanOffer& offer : out.offers) {
      most_offered = std::max(most_offered, offer.slices.size());
      last_offers[offer.carrier] = offer;
      offers_[offer.carrier] = offer;
      tell_agent(offer.carrier, offer);
    }
    if (out.time_reply) {
      tell_agent(out.time_reply->carrier, agent::TimeReplyArrived{*out.time_reply, now});
    }
    if (out.beacon) {
      beacon = out.beacon;
      for (const auto& [id, unused] : job_carriers()) {
        if (deaf.count(id) == 0) tell_agent(id, *out.beacon);
      }
    }
  }

  void fly(Duration duration) {
    for (const LocalTime end = now + duration; now < end && !finished; now += std::chrono::milliseconds(10)) {
      tell(Tick{});
      for (const auto& [id, unused] : job_carriers()) tell_agent(id, agent::Tick{});
      if (visit) visit();
    }
  }

  /// The one answer to this command, after it had its time.
  [[nodiscard]] std::string command(protocol::CommandKind kind, Duration patience = std::chrono::seconds(10)) {
    const std::uint64_t id = ++commands_;
    tell(protocol::Command{id, kind, ""});
    return answer_to(id, patience);
  }
  [[nodiscard]] std::string retune(const Job& job) {
    const std::uint64_t id = ++commands_;
    tell(Retune{id, job});
    return answer_to(id, std::chrono::seconds(10));
  }

  Coordinator& coordinator() { return *coordinator_; }
  agent::Agent& agent(CarrierId id) { return *agents_.at(id); }

  LocalTime now{std::chrono::hours(1)};
  std::string news;
  std::vector<protocol::CommandReply> replies;
  std::optional<Outcome> finished;
  std::optional<protocol::Beacon> beacon;
  std::optional<protocol::CoordinatorStatus> status;
  std::map<CarrierId, protocol::Setpoint> setpoints;
  std::map<CarrierId, protocol::AgentStatus> statuses;
  std::map<CarrierId, protocol::PlanOffer> last_offers;
  std::set<CarrierId> deaf;  ///< hear no beacon
  std::set<CarrierId> mute;  ///< nothing they say arrives
  std::function<void(protocol::AgentStatus&)> change_status;
  std::function<void()> visit;
  std::size_t most_offered = 0;

 private:
  [[nodiscard]] std::map<CarrierId, bool> job_carriers() const {
    std::map<CarrierId, bool> out;
    for (const auto& [id, agent] : agents_) out[id] = true;
    return out;
  }

  [[nodiscard]] std::string answer_to(std::uint64_t id, Duration patience) {
    fly(patience);
    std::string text;
    int answers = 0;
    for (const protocol::CommandReply& reply : replies) {
      if (reply.id == id) ++answers, text = (reply.done ? "done: " : "refused: ") + reply.text;
    }
    return answers == 1 ? text : "answered " + std::to_string(answers) + " times";
  }

  void tell_agent(CarrierId id, const agent::Event& event) {
    const auto found = agents_.find(id);
    if (found == agents_.end()) return;
    const agent::Outputs out = found->second->step(now, event);
    if (out.setpoint) setpoints[id] = *out.setpoint;
    if (mute.count(id) > 0) return;
    if (out.held) {
      held_[id] = *out.held;
      tell(*out.held);
    }
    if (out.time_request) tell(TimeRequestArrived{*out.time_request, now});
    if (out.status) {
      protocol::AgentStatus told = *out.status;
      if (change_status) change_status(told);
      statuses[id] = told;
      tell(told);
    }
  }

  Job job_;
  CoordinatorOptions options_;
  std::unique_ptr<Coordinator> coordinator_;
  std::map<CarrierId, std::unique_ptr<agent::Agent>> agents_;
  std::map<CarrierId, protocol::PlanOffer> offers_;
  std::map<CarrierId, protocol::HeldPlans> held_;
  std::uint64_t incarnations_ = 0;
  std::uint64_t commands_ = 0;
};

}  // namespace gyre::coordinator::test
