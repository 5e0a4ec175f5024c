#pragma once
// The coordinator that leads: what the course is, and the one place that changes it.
//
// What is wished, motion or rest, is part of the course; the pace axis and transitions are how it comes about:
//
//   a pace      by a ramp (protocol/pace.hpp): proven by a formula, agreed by all, at any number of carriers
//   a plan      by a transition (mechanics/transition.hpp): rehearsed, agreed by all
//   silence     by the lease (lease_book.hpp): known to all beforehand, agreed by nobody
//
// Whatever is agreed is looked at afterwards: if somebody turns out not to follow at the start, the change is undone by
// another one, which then costs almost nothing, because a smooth step has hardly begun.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "coordinator/core/agreement.hpp"
#include "coordinator/core/command_desk.hpp"
#include "coordinator/core/job.hpp"
#include "coordinator/core/lease_book.hpp"
#include "coordinator/core/path_judge.hpp"
#include "coordinator/core/plan_book.hpp"
#include "coordinator/core/ramps.hpp"
#include "coordinator/core/swarm.hpp"
#include "coordinator/core/time_consensus.hpp"

namespace gyre::coordinator {

/// What a term begins with.
struct Beginning {
  std::uint64_t term = 0;
  std::optional<protocol::Course> course;  ///< what flies already; absent: nothing does
  Duration swarm_offset{};                 ///< swarm time − this process's clock
  std::map<protocol::PlanNumber, Slices> plans;
};

class Leading {
 public:
  Leading(LocalTime now, const Job& job, const CoordinatorOptions& options, Swarm& swarm, News& news,
          const Beginning& beginning, Outputs& out);

  void tick(LocalTime now, Outputs& out);
  void heard(LocalTime arrived, const protocol::AgentStatus& status, Outputs& out);
  void seen(LocalTime now, const protocol::CarrierState& state, Outputs& out);
  void learn(const protocol::HeldPlans& held, Outputs& out);
  void command(LocalTime now, const protocol::Command& command, Outputs& out);
  void retune(LocalTime now, const Retune& retune, Outputs& out);
  void shut_down(Outputs& out);
  /// Answers whoever still waits.
  void stand_down(const std::string& why, Outputs& out);

  [[nodiscard]] std::uint64_t term() const { return term_; }
  [[nodiscard]] const protocol::Course& course() const { return course_; }
  [[nodiscard]] SwarmTime swarm_time(LocalTime now) const { return SwarmTime(now.time_since_epoch() + swarm_offset_); }
  [[nodiscard]] std::optional<std::string> complaint(LocalTime now) const;

 private:
  // leading.cpp: what is wished, and by whom
  [[nodiscard]] std::optional<std::string> obstacle(LocalTime now, bool departs) const;
  [[nodiscard]] std::optional<std::string> plan_obstacle(LocalTime now, const protocol::PlanNumber& plan) const;
  [[nodiscard]] std::optional<protocol::Wish> pending_wish(LocalTime now);
  [[nodiscard]] bool departure_is_due(LocalTime now);
  [[nodiscard]] std::optional<std::string> command_obstacle(LocalTime now, const protocol::Command& command) const;
  [[nodiscard]] std::vector<CarrierId> without_plan(LocalTime now) const;
  /// Whether it has said that it follows this revision of the course.
  [[nodiscard]] bool follows(CarrierId carrier, std::uint64_t revision) const;
  /// Who has not, silent or not.
  [[nodiscard]] std::vector<CarrierId> not_following(LocalTime now, std::uint64_t revision) const;
  [[nodiscard]] std::optional<std::string> why_unsafe(LocalTime now) const;
  /// Of what went go: all had the time to begin it, and to say so, and nobody has.
  [[nodiscard]] bool is_unbegun(SwarmTime now) const;
  /// Until a retune is agreed, and all were seen to follow, the one before it.
  [[nodiscard]] const Job& mission_in_force() const { return before_retune_ ? before_retune_->job : job_; }
  [[nodiscard]] protocol::CoordinatorStatus status(LocalTime now) const;
  void offer_plans(Outputs& out);

  // course_changes.cpp: how the course becomes what is wished
  void change(protocol::Course course);
  void end_lease(SwarmTime now, Outputs& out);
  void stop_with(LocalTime now, const PathJudge::Stuck& stuck, Outputs& out);
  void drive(LocalTime now, Outputs& out);
  [[nodiscard]] std::vector<std::vector<mechanics::TimedLayer>> stacks_of(const protocol::Course& course,
                                                                          PlanTime origin) const;
  [[nodiscard]] Duration skew_budget(const protocol::Course& course) const;
  void begin(LocalTime now, const Intent& intent);
  void schedule(LocalTime now);
  void pursue(LocalTime now, Outputs& out);
  void go(LocalTime now, Outputs& out);
  void give_up(LocalTime now, const std::string& why, Outputs& out);
  void check_start(LocalTime now, Outputs& out);
  void turn_back(SwarmTime now);
  void forget_start();
  void undo_retune();
  [[nodiscard]] RampLimits ramp_limits() const;
  [[nodiscard]] Duration stopping_time() const {
    return coordinator::stopping_time(ramp_limits(), options_.stopping, options_.longest_ramp);
  }
  [[nodiscard]] Result<Intent> ramp_to(LocalTime now, const protocol::Wish& wish, bool at_once) const;
  [[nodiscard]] Intent transition_to(const protocol::PlanNumber& plan, const protocol::Wish& wish) const;
  [[nodiscard]] std::vector<protocol::PlanNumber> plans_in_use() const;
  [[nodiscard]] std::vector<CarrierId> unconfirmed(LocalTime now) const;

  Job job_;
  CoordinatorOptions options_;
  Swarm& swarm_;
  News& news_;
  std::uint64_t term_;
  Duration swarm_offset_;
  LocalTime since_;

  PlanBook plans_;
  protocol::PlanNumber plan_;  ///< the mission's
  struct Mission {
    Job job;
    protocol::PlanNumber plan;
  };
  std::optional<Mission> before_retune_;  ///< what is flown again if the retune that is being agreed is given up

  protocol::Course course_;
  std::uint64_t last_revision_;  ///< of a course or a proposal, go or given up: none is used twice
  LeaseBook lease_;
  TimeConsensus consensus_;
  PathJudge paths_;
  std::optional<Agreement> agreement_;
  std::vector<mechanics::CarrierFigures> mixture_;  ///< of the transition under way, where it was rehearsed
  struct Start {
    SwarmTime at{};
    std::uint64_t revision = 0;
    protocol::Course before;
    std::optional<LocalTime> deaf_at;  ///< nobody at all was heard
  };
  std::optional<Start> start_;  ///< of what went go last, still to be looked at

  CommandDesk desk_;
  Duration budget_in_force_{};  ///< clock disagreement that the plans in force allow; 0: any
  std::uint64_t sequence_ = 0;  ///< of beacons
  std::uint64_t offers_ = 0;
  LocalTime next_status_ = LocalTime::min();
  protocol::PlanNumber mission_told_;  ///< whose text went out last
  LocalTime retry_at_ = LocalTime::min();
  std::optional<LocalTime> not_ready_since_;  ///< all agents are, and somebody complains
  bool shutting_down_ = false;
  int failures_ = 0;  ///< to stop, at shutdown
};

}  // namespace gyre::coordinator
