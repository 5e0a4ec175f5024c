#pragma once
// What the page is shown, and when: frames often, the state of things now and then, what happened once.
//
// Told the time and every message that the view believed; what there is to show goes onto the stage. While nobody looks
// nothing is drawn, but what happened is kept.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/program/worker.hpp"
#include "ground/page/core/hurt_gauge.hpp"
#include "ground/page/core/known_mission.hpp"
#include "ground/page/metrics.hpp"
#include "ground/page/page_json.hpp"
#include "ground/page/stage.hpp"
#include "ground/swarm/core/happenings.hpp"
#include "ground/swarm/core/load_gauge.hpp"
#include "ground/swarm/core/swarm_view.hpp"

namespace gyre::ground {

class PageFeed {
 public:
  static constexpr Duration kFrame = std::chrono::milliseconds(40);
  static constexpr Duration kStatus = std::chrono::milliseconds(250);
  static constexpr Duration kFigures = std::chrono::seconds(1);

  /// View and stage outlive it.
  PageFeed(const SwarmView& view, Stage& stage, PageOwner owner, LocalTime now);

  /// After every message that the view believed.
  void hear(LocalTime now, const SwarmMessage& message);
  /// As often as the loop turns. `own`: the processes that the server started.
  void step(LocalTime now, const std::vector<OwnProcess>& own);
  /// Somebody hurt the flight on purpose.
  void hurt(LocalTime now, const std::string& text);
  void tell(LocalTime now, Notice::Level level, const std::string& who, const std::string& text);

  /// Of /metrics, where it is new.
  [[nodiscard]] std::optional<std::string> take_metrics();
  [[nodiscard]] const std::optional<KnownMission>& mission() const { return mission_; }

 private:
  void learn(LocalTime now);
  void take_up(std::optional<KnownMission> mission);
  void show_mission(LocalTime now);
  void show_frame(LocalTime now);
  void show_status(LocalTime now, const std::vector<OwnProcess>& own);
  [[nodiscard]] Shown shown(LocalTime now) const;
  [[nodiscard]] std::optional<std::string> complaint(LocalTime now) const;

  const SwarmView& view_;
  Stage& stage_;
  const PageOwner owner_;
  const LocalTime begin_;
  Happenings happenings_;
  std::uint64_t happening_shown_ = 0;

  program::Worker<protocol::MissionText, std::optional<KnownMission>> reader_{ground::know};
  std::optional<protocol::MissionText> asked_;
  std::optional<KnownMission> mission_;
  struct MissionShown {
    protocol::PlanNumber in_force, known;
    std::size_t slices = 0;
    [[nodiscard]] bool operator==(const MissionShown& other) const {
      return in_force == other.in_force && known == other.known && slices == other.slices;
    }
  };
  std::optional<MissionShown> mission_shown_;

  std::optional<LoadGauge> load_;
  LoadWindow flown_;    ///< since the motion began
  LoadWindow second_;   ///< for the figures
  bool moved_ = false;  ///< whether it has begun
  HurtGauge hurt_;
  std::optional<std::string> metrics_text_;
  LocalTime next_frame_, next_status_, next_figures_;
};

}  // namespace gyre::ground
