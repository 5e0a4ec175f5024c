#pragma once
// One figure of every carrier over a period, under the limits it is held to, with its certified extremes beside it.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/mechanics/certificate.hpp"
#include "common/mechanics/plan.hpp"
#include "ground/plot/core/motion.hpp"
#include "ground/plot/core/svg.hpp"

namespace gyre::ground {

struct Figure {
  const char* title;
  const char* unit;
  std::function<double(const Moment&)> of;
  std::function<mechanics::Range(const mechanics::CarrierFigures&)> certified;
  std::optional<double> limit_min, limit_max;
};

/// Tension, length, speed, winch rate.
[[nodiscard]] std::vector<Figure> figures(const mechanics::Limits& limits);

/// `place` takes in the axes and the title.
void draw_chart(Svg& svg, const Figure& figure, const Motion& motion, const mechanics::Certificate& certificate,
                const Box& place);

}  // namespace gyre::ground
