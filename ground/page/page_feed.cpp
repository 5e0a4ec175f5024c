#include "ground/page/page_feed.hpp"

#include <utility>

#include "ground/swarm/core/swarm_complaint.hpp"

namespace gyre::ground {

PageFeed::PageFeed(const SwarmView& view, Stage& stage, PageOwner owner, LocalTime now)
    : view_(view),
      stage_(stage),
      owner_(std::move(owner)),
      begin_(now),
      happenings_(view),
      next_frame_(now),
      next_status_(now),
      next_figures_(now) {
  stage_.show(Scene::kHello, hello_json(owner_));
}

Shown PageFeed::shown(LocalTime now) const {
  return {view_, mission_ ? &*mission_ : nullptr, now, begin_};
}

std::optional<std::string> PageFeed::complaint(LocalTime now) const {
  return ground::complaint(view_, load_ ? &*load_ : nullptr,
                           mission_ ? mission_->mission.load_tolerance : mission::LoadTolerance{}, now);
}

void PageFeed::hear(LocalTime now, const SwarmMessage& message) {
  happenings_.look(now, message);
  if (const auto* load = std::get_if<protocol::LoadState>(&message); load && load_) load_->see(*load);
}

void PageFeed::hurt(LocalTime now, const std::string& text) {
  hurt_.hurt(now, text);
  happenings_.tell(now, Notice::Level::kWarning, "a person", text);
}

void PageFeed::tell(LocalTime now, Notice::Level level, const std::string& who, const std::string& text) {
  happenings_.tell(now, level, who, text);
}

std::optional<std::string> PageFeed::take_metrics() {
  return std::exchange(metrics_text_, std::nullopt);
}

void PageFeed::learn(LocalTime now) {
  if (auto known = reader_.finished()) take_up(std::move(*known));
  const auto& told = view_.mission();
  const bool too_long = told && told->text.empty();
  if (too_long && mission_ && told->plan != mission_->plan) take_up(std::nullopt);
  const bool newer =
      told && !told->text.empty() && (!asked_ || asked_->plan != told->plan || asked_->text != told->text);
  if (newer && reader_.begin(*told)) asked_ = told;
  show_mission(now);
}

void PageFeed::take_up(std::optional<KnownMission> mission) {
  mission_ = std::move(mission);
  load_.reset();
  if (mission_) load_.emplace(mission_->mission.plan);
  flown_ = second_ = {};
}

/// Long, and hardly ever another one.
void PageFeed::show_mission(LocalTime now) {
  if (!view_.coordinator()) return;
  MissionShown is{view_.coordinator()->plan, mission_ ? mission_->plan : protocol::PlanNumber{}, 0};
  for (const auto& [id, carrier] : view_.carriers()) is.slices += carrier.slices.size();
  if (mission_) is.slices = 0;  // nothing of it is drawn by them
  if (mission_shown_ == is) return;
  mission_shown_ = is;
  stage_.show(Scene::kMission, mission_json(shown(now)));
}

void PageFeed::step(LocalTime now, const std::vector<OwnProcess>& own) {
  happenings_.look(now);
  for (const Happening& happening : happenings_.all()) {
    if (happening.number <= happening_shown_) continue;
    stage_.happen(happening_json(happening));
    happening_shown_ = happening.number;
  }
  if (now >= next_frame_) {
    next_frame_ = std::max(next_frame_ + kFrame, now);
    show_frame(now);
  }
  if (now >= next_status_) {
    next_status_ = std::max(next_status_ + kStatus, now);
    show_status(now, own);
    learn(now);
  }
  if (now >= next_figures_) {
    next_figures_ = std::max(next_figures_ + kFigures, now);
    metrics_text_ =
        ground::metrics_text(view_, mission_ ? &*mission_ : nullptr, std::exchange(second_, {}), complaint(now), now);
  }
}

void PageFeed::show_frame(LocalTime now) {
  const LoadWindow window = load_ ? load_->take() : LoadWindow{};
  second_.include(window);
  const auto swarm_time = view_.swarm_time(now);
  moved_ = moved_ || (swarm_time && view_.beacon()->course.moment(*swarm_time).pace > 0.0);
  if (moved_) flown_.include(window);
  hurt_.see(now, window, !complaint(now));
  if (stage_.watchers() > 0) stage_.show(Scene::kFrame, frame_json(shown(now), window));
}

void PageFeed::show_status(LocalTime now, const std::vector<OwnProcess>& own) {
  if (stage_.watchers() == 0) return;
  stage_.show(Scene::kStatus, status_json(shown(now), complaint(now), flown_, own, hurt_.outcome(now)));
}

}  // namespace gyre::ground
