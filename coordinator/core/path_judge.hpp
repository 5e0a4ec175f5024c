#pragma once
// Whether carriers are where the course has them, by what their own vehicles say: evidence, whatever their agents say.
//
// Intuition: a carrier that stands while the others fly on unbalances up to the whole weight, and soon. It shows first
// in its speed: on its path a vehicle is as fast as its plan, wherever a clock has it by some milliseconds. So who was
// on his path, and then tells for a while that he makes less than half of his way, is stuck; and where on the path that
// is tells the phase at which all the others have to stop.
//
//   v    where the plan has it go now                                m/s
//   e    planned place − told place                                  m
//   way  told velocity · v / |v|²: the share of its way that it makes
//   lag  e · v / |v|²: how long ago it should have been there        s
//
// Who has not been on his path is not stuck: an agent that merges back is off it for a while, and so is the vehicle of
// one that never heard of a change. And where half of them are, it is not they: it is the clock here.

#include <map>
#include <optional>
#include <vector>

#include "common/mechanics/taylor.hpp"
#include "common/protocol/messages.hpp"

namespace gyre::coordinator {

struct PathJudgeOptions {
  double way = 0.5;                                       ///< a carrier makes less than that of its way: it is slow
  Duration slow_for = std::chrono::milliseconds(40);      ///< and then it is stuck
  Duration on_path_for = std::chrono::milliseconds(500);  ///< before it can be
  Duration fresh = std::chrono::milliseconds(200);        ///< what was not said again since is not so any more
  double least_speed_m_s = 0.005;  ///< a plan slower than that tells nothing about who follows it
  double near_m = 0.02;            ///< of its place, and what it flies in a twentieth of a second
};

class PathJudge {
 public:
  explicit PathJudge(const PathJudgeOptions& options = {}) : options_(options) {}

  /// `planned`: where the course has it when this came, by swarm time.
  void take(LocalTime now, const protocol::CarrierState& state, const mechanics::TaylorVector<double>& planned);

  struct Stuck {
    CarrierId carrier = 0;
    Duration lag{};  ///< of its place behind where the course has it, by swarm time
  };
  /// Who has just got stuck, told once; `carriers`: how many there are.
  [[nodiscard]] std::optional<Stuck> stuck(LocalTime now, std::size_t carriers);
  /// Whether its vehicle says so, and says it now.
  [[nodiscard]] bool on_path(LocalTime now, CarrierId carrier) const;
  /// How far away its vehicle says it is; absent: it says nothing now.
  [[nodiscard]] std::optional<double> off_m(LocalTime now, CarrierId carrier) const;

 private:
  struct Track {
    LocalTime heard{};
    double off_m = 0.0;
    Duration lag{};
    std::optional<LocalTime> near_since;
    std::optional<LocalTime> slow_since;
    bool armed = false;  ///< it was on its path
  };
  [[nodiscard]] bool slow(const Track& track, LocalTime now) const;

  PathJudgeOptions options_;
  std::map<CarrierId, Track> tracks_;
};

}  // namespace gyre::coordinator
