#pragma once
// A coordinator and its agents in one process on one clock: messages arrive at once, or not at all. Whatever a test
// does with them, at every beacon everything is checked that has to hold at every moment of every flight.

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "agent/core/agent.hpp"
#include "coordinator/core/coordinator.hpp"
#include "tests/coordinator/jobs.hpp"

namespace gyre::coordinator::test {

class SwarmOfAgents {
 public:
  explicit SwarmOfAgents(const Job& job, const CoordinatorOptions& options = {}) : job_(job), options_(options) {
    start_coordinator();
    for (const mechanics::Carrier& carrier : job.plan.carriers) start_agent(carrier.id);
  }

  void start_coordinator() { start_coordinator(job_, options_); }
  void start_coordinator(const Job& job, const CoordinatorOptions& options) {
    coordinator_ = std::make_unique<Coordinator>(job, options);
    silence = job.silence;
    finished.reset();
    for (const auto& [id, held] : held_) tell(held);  // transient local
    for (const auto& [id, agent] : agents_) {
      if (statuses.count(id) > 0 && mute.count(id) == 0) tell(statuses.at(id));
    }
  }
  void stop_coordinator() { coordinator_.reset(), offers_.clear(); }

  void start_agent(CarrierId id, const mechanics::Limits& vehicle = {}) {
    agents_[id] = new_agent(id, vehicle);
    if (offers_.count(id) > 0) tell_agent(id, offers_.at(id));  // transient local
  }
  void stop_agent(CarrierId id) { agents_.erase(id), held_.erase(id); }
  /// One more agent that claims this carrier.
  void start_twin(CarrierId id) {
    twins_[id] = new_agent(id, {});
    if (offers_.count(id) > 0) tell_agent(id, offers_.at(id));
  }
  void stop_twin(CarrierId id) { twins_.erase(id); }
  agent::Agent& twin(CarrierId id) { return *twins_.at(id); }

  void tell(const protocol::AgentStatus& said) { tell(StatusArrived{said, now}); }
  void tell(const Event& event) {
    const Event told = by_a_clock_that_leapt(event, leapt);
    const Outputs out = coordinator_ ? coordinator_->step(now + leapt, told) : Outputs{};
    if (stepped && coordinator_) stepped(told, out);
    for (const Notice& notice : out.notices) news += notice.text + "\n";
    replies.insert(replies.end(), out.replies.begin(), out.replies.end());
    if (out.finished) finished = out.finished;
    if (out.status) status = out.status;
    if (out.mission) missions.push_back(*out.mission);
    for (const protocol::PlanOffer& offer : out.offers) {
      EXPECT_LE(offer.slices.size(), protocol::kMaxPlans);
      offers_[offer.carrier] = offer;
      tell_agent(offer.carrier, offer);
    }
    if (out.time_reply && deaf.count(out.time_reply->carrier) == 0) {
      tell_agent(out.time_reply->carrier, agent::TimeReplyArrived{*out.time_reply, now});
    }
    if (out.beacon) {
      if (leapt == Duration{}) said_.check(*out.beacon, silence);
      for (const auto& [id, offer] : offers_) {
        if (nobody_knows.count(id) == 0) check_that_plans_are_offered(*out.beacon, offer);
      }
      beacon = out.beacon;
      for (const CarrierId id : carriers()) {
        if (deaf.count(id) == 0) tell_agent(id, *out.beacon);
      }
    }
  }

  void fly(Duration duration) {
    for (const LocalTime end = now + duration; now < end && !finished; now += std::chrono::milliseconds(10)) {
      tell(Tick{});
      for (const CarrierId id : carriers()) tell_agent(id, agent::Tick{});
      if (visit) visit();
    }
  }
  /// As long as that takes, which is not for ever.
  template <class Condition>
  void fly_until(Condition holds, Duration longest = std::chrono::seconds(60)) {
    for (const LocalTime end = now + longest; now < end && !finished && !holds();) fly(std::chrono::milliseconds(10));
    EXPECT_TRUE(holds()) << news;
  }

  /// The one answer to this command, after it had its time.
  [[nodiscard]] std::string command(protocol::Command command, Duration patience = std::chrono::seconds(10)) {
    command.id = ++commands_;
    tell(command);
    return answer_to(command.id, patience);
  }
  [[nodiscard]] std::string command(protocol::CommandKind kind, Duration patience = std::chrono::seconds(10)) {
    return command(protocol::Command{0, kind, 1.0, {}, {}}, patience);
  }
  [[nodiscard]] std::string pace(double pace, Duration patience = std::chrono::seconds(10)) {
    return command(protocol::Command{0, protocol::CommandKind::kPace, pace, {}, {}}, patience);
  }
  [[nodiscard]] std::string retune(const Job& job, Duration patience = std::chrono::seconds(10)) {
    const std::uint64_t id = ++commands_;
    tell(Retune{id, job});
    return answer_to(id, patience);
  }

  Coordinator& coordinator() { return *coordinator_; }
  agent::Agent& agent(CarrierId id) { return *agents_.at(id); }
  [[nodiscard]] const protocol::Course& course() const { return beacon->course; }
  [[nodiscard]] protocol::PlanMoment moment() const { return course().moment(beacon->swarm_time); }
  [[nodiscard]] double pace() const { return moment().pace; }
  [[nodiscard]] bool rests() const { return course().rests(beacon->swarm_time); }
  [[nodiscard]] bool moves() const {
    const auto moves = [](const auto& said) { return said.second.velocity_w_m_s.norm() > 1e-6; };
    return std::any_of(setpoints.begin(), setpoints.end(), moves);
  }
  /// Whether all agents that live fly one and the same phase, from now on for so long, and as the coordinator has it.
  void expect_one_phase(Duration ahead) const {
    for (Duration in{}; in <= ahead; in += std::chrono::milliseconds(50)) {
      const SwarmTime then = beacon->swarm_time + in;
      for (const auto& [id, agent] : agents_) {
        const Duration off = agent->course().moment(then).at - course().moment(then).at;
        EXPECT_LE(std::abs(off.count()), 1) << "carrier " << id;
      }
    }
  }

  LocalTime now{std::chrono::hours(1)};
  std::string news;
  std::vector<protocol::CommandReply> replies;
  std::optional<Outcome> finished;
  std::optional<protocol::Beacon> beacon;
  std::optional<protocol::CoordinatorStatus> status;
  std::vector<protocol::MissionText> missions;  ///< all that were told, the oldest first
  std::map<CarrierId, protocol::Setpoint> setpoints;
  int twin_setpoints = 0;
  std::map<CarrierId, protocol::AgentStatus> statuses;
  std::set<CarrierId> deaf;  ///< hear no beacon and no time; plans are told again until they arrive
  std::set<CarrierId> mute;  ///< nothing they say arrives
  std::function<void(protocol::AgentStatus&)> change_status;
  Duration statuses_wait{};  ///< at the coordinator: said and arrived so long ago
  Duration leapt{};          ///< the coordinator's clock: it says what cannot be, until it is set right
  std::function<void()> visit;
  std::function<void(const Event&, const Outputs&)> stepped;  ///< the coordinator
  protocol::Silence silence;                                  ///< of the mission in force
  std::set<CarrierId> nobody_knows;                           ///< whose part of the plan in force is lost

 private:
  [[nodiscard]] std::set<CarrierId> carriers() const {
    std::set<CarrierId> out;
    for (const auto& [id, agent] : agents_) out.insert(id);
    for (const auto& [id, agent] : twins_) out.insert(id);
    return out;
  }

  [[nodiscard]] std::unique_ptr<agent::Agent> new_agent(CarrierId id, const mechanics::Limits& vehicle) {
    agent::AgentOptions options;
    options.carrier = id;
    options.incarnation = ++incarnations_;
    options.address = "agent " + std::to_string(options.incarnation);
    options.vehicle = vehicle;
    options.vehicle_wait = Duration::zero();
    return std::make_unique<agent::Agent>(options);
  }

  [[nodiscard]] std::string answer_to(std::uint64_t id, Duration patience) {
    fly(patience);
    return the_one_answer(replies, id);
  }

  void tell_agent(CarrierId id, const agent::Event& event) {
    if (const auto found = agents_.find(id); found != agents_.end()) {
      const agent::Outputs out = step(*found->second, id, event);
      if (out.setpoint) setpoints[id] = *out.setpoint;
    }
    if (const auto found = twins_.find(id); found != twins_.end()) {
      if (step(*found->second, id, event).setpoint) ++twin_setpoints;
    }
  }

  agent::Outputs step(agent::Agent& agent, CarrierId id, const agent::Event& event) {
    agent::Outputs out = agent.step(now, event);
    hear(id, out);
    if (out.question) step(agent, id, agent::judge(*out.question));  // at once
    return out;
  }

  void hear(CarrierId id, const agent::Outputs& out) {
    if (mute.count(id) > 0) return;
    if (out.held) tell(held_[id] = *out.held);
    if (out.time_request) tell(TimeRequestArrived{*out.time_request, now});
    if (out.status) {
      protocol::AgentStatus told = *out.status;
      if (change_status) change_status(told);
      statuses[id] = told;
      told.swarm_time -= statuses_wait;
      tell(StatusArrived{told, now - statuses_wait});
    }
  }

  Job job_;
  CoordinatorOptions options_;
  std::unique_ptr<Coordinator> coordinator_;
  std::map<CarrierId, std::unique_ptr<agent::Agent>> agents_, twins_;
  std::map<CarrierId, protocol::PlanOffer> offers_;
  std::map<CarrierId, protocol::HeldPlans> held_;
  Said said_;
  std::uint64_t incarnations_ = 0;
  std::uint64_t commands_ = 0;
};

}  // namespace gyre::coordinator::test
