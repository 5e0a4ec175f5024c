#pragma once
// The swarm as figures for a monitoring system, in Prometheus' text form.

#include <memory>
#include <optional>
#include <string>

#include "ground/page/core/known_mission.hpp"
#include "ground/swarm/core/load_gauge.hpp"
#include "ground/swarm/core/swarm_view.hpp"

namespace gyre::ground {

class Metrics {
 public:
  Metrics();
  ~Metrics();
  Metrics(const Metrics&) = delete;
  Metrics& operator=(const Metrics&) = delete;

  /// `load`: since the last call. `mission` may be unknown (nullptr): then there are no margins.
  [[nodiscard]] std::string text(const SwarmView& view, const KnownMission* mission, const LoadWindow& load,
                                 const std::optional<std::string>& complaint, LocalTime now);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gyre::ground
