#include "ground/flight/flight.hpp"

#include <csignal>
#include <thread>
#include <vector>

#include "common/base/interrupts.hpp"
#include "common/base/text.hpp"
#include "ground/flight/flight_programs.hpp"
#include "ground/flight/processor_account.hpp"

namespace gyre::ground {
namespace {

constexpr Duration kTick = std::chrono::milliseconds(40);
/// Beyond the transition itself: proposing it, waiting for every agent's word, ending.
constexpr Duration kReleasePatience = std::chrono::seconds(15);

std::vector<CarrierId> carrier_ids(const mission::Mission& mission) {
  std::vector<CarrierId> ids;
  for (const mechanics::Carrier& carrier : mission.plan.carriers) ids.push_back(carrier.id);
  return ids;
}

}  // namespace

Flight::Flight(const mission::Mission& mission, double duration_s, dds::Node& node, Supervisor& supervisor,
               FlightDisplay& display)
    : mission_(mission),
      duration_s_(duration_s),
      node_(node),
      supervisor_(supervisor),
      display_(display),
      listening_(node, Interest::kCarriers),
      monitor_(view_, carrier_ids(mission), dds::now()),
      record_(mission.plan),
      certificate_(mission.plan) {
  listening_.attend(carrier_ids(mission));
}

std::optional<FlightFailure> Flight::run() {
  while (!released_) {
    std::this_thread::sleep_for(kTick);
    for (const Heard& heard : listening_.wait_until(dds::now())) take(heard);
    node_.answer_callers({"gyre fly", ""});
    const LocalTime now = dds::now();
    turn_page(now);
    starvation_.see(now, processor_account());
    interrupts_ += take_interrupts().total();
    if (interrupts_ >= 2) return FlightFailure{"ended at once, as asked: the load was not brought to rest", {}};
    if (const auto failure = look_after_processes()) return failure;

    const bool over = interrupts_ > 0 || seconds(monitor_.flown(now)) >= duration_s_ ||
                      (by_hand_.empty() && monitor_.phase(now) == FlightPhase::kReleasing);
    if (over) release(now);
    if (!release_deadline_) {
      // What a person does by hand, and what comes of it, is for that person to end.
      const auto complaint = by_hand_.empty() ? monitor_.complaint(now) : std::nullopt;
      if (complaint) return FlightFailure{*complaint, kCoordinatorName};
    } else if (now > *release_deadline_ && !released_) {
      return FlightFailure{"the coordinator did not bring the load to rest in time", kCoordinatorName};
    }
    show(now);
  }
  display_.finish();
  return std::nullopt;
}

void Flight::turn_page(LocalTime now) {
  if (!page_) return;
  for (HurtTask& task : page_->take_hurts()) {
    const Answer answer = hurting_->perform(now, task.wish);
    if (answer.done) page_->feed().hurt(now, answer.text);
    if (answer.done) by_hand_.push_back(answer.text);
    task.answer->set_value(answer);
  }
  page_->step(now, hurting_->processes());
}

void Flight::take(const Heard& heard) {
  if (!view_.step(heard.arrived, heard.message)) return;
  if (page_) page_->hear(heard.arrived, heard.message);
  if (const auto* command = std::get_if<protocol::Command>(&heard.message);
      page_ && command && ordered_.insert(command->id).second) {
    by_hand_.push_back("asked to " + order_words(*command));
  }
  monitor_.look(heard.arrived);
  if (const auto* beacon = std::get_if<protocol::Beacon>(&heard.message)) {
    certificate_.include(beacon->course);
    record_.see_beacon();
  } else if (const auto* word = std::get_if<protocol::CoordinatorStatus>(&heard.message)) {
    certificate_.see(*word);
  }
  if (!monitor_.under_way(heard.arrived)) return;
  if (const auto* status = std::get_if<protocol::AgentStatus>(&heard.message)) {
    record_.see(*status);
  } else if (const auto* carrier = std::get_if<protocol::CarrierState>(&heard.message)) {
    record_.see(*carrier, monitor_.phase(heard.arrived) == FlightPhase::kFlying);
  } else if (const auto* load = std::get_if<protocol::LoadState>(&heard.message)) {
    record_.see(*load, heard.arrived);
  } else if (const auto* health = std::get_if<protocol::Health>(&heard.message)) {
    record_.see(*health);
  }
}

std::optional<FlightFailure> Flight::look_after_processes() {
  for (const Supervisor::Ended& ended : supervisor_.collect()) {
    if (page_ && hurting_->meant(ended.name)) continue;
    const bool asked = release_deadline_.has_value() && ended.name == kCoordinatorName;
    // Asked before it was ready for signals, it has nothing to bring to rest.
    const bool unready = ended.end.signal == SIGINT && !monitor_.under_way(dds::now());
    if (!asked || !(ended.end.clean() || unready))
      return FlightFailure{ended.name + " " + ended.end.text(), ended.name};
    released_ = true;
  }
  return std::nullopt;
}

void Flight::release(LocalTime now) {
  if (release_deadline_) return;
  release_deadline_ = now + 2 * monitor_.transition_duration() + kReleasePatience;
  supervisor_.send(kCoordinatorName, SIGINT);  // as a person would: back to rest, then the end
  if (!by_hand_.empty() && !supervisor_.pid(kCoordinatorName)) {
    by_hand_.push_back("no coordinator was left to bring the load to rest");
    released_ = true;
  }
}

void Flight::show(LocalTime now) {
  FlightProgress progress;
  progress.phase = release_deadline_ && monitor_.under_way(now) ? FlightPhase::kReleasing : monitor_.phase(now);
  progress.agents = monitor_.agents();
  progress.agents_ready = monitor_.agents_ready();
  progress.flown_s = seconds(monitor_.flown(now));
  progress.duration_s = duration_s_;
  if (record_.load().samples > 0) progress.load = record_.load();
  display_.show(progress);
}

std::optional<FlightReport> Flight::report() const {
  const double flown_s = seconds(monitor_.flown(dds::now()));
  if (flown_s <= 0.0) return std::nullopt;
  return judge_flight(mission_, certificate_, record_, flown_s);
}

}  // namespace gyre::ground
