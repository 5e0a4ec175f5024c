#include "simulator/core/wind.hpp"

#include <cmath>

#include "common/base/ensure.hpp"
#include "common/mechanics/quintic.hpp"

namespace gyre::simulator {

Wind::Wind(const WindSettings& settings, std::uint64_t seed, double tick_s)
    : settings_(settings), random_(seed, "wind"), tick_s_(tick_s) {
  GYRE_ENSURE(settings_.gust_time_scale_s > 0.0, "a gust has a time scale");
}

void Wind::tick(double now_s) {
  since_s_ = now_s;
  begin_w_n_ = end_w_n_;
  if (settings_.gust_deviation_n == 0.0) return;
  // g(t + h) = φ g(t) + σ √(1 − φ²) · normal,  φ = exp(−h / T)
  const double keep = std::exp(-tick_s_ / settings_.gust_time_scale_s);
  const double add_n = settings_.gust_deviation_n * std::sqrt(1.0 - keep * keep);
  for (int axis = 0; axis < 3; ++axis) end_w_n_[axis] = keep * begin_w_n_[axis] + add_n * random_.normal();
}

Eigen::Vector3d Wind::force_w_n(double t_s) const {
  const double share = (t_s - since_s_) / tick_s_;
  const double rise = mechanics::smooth_step(t_s, kWindRise_s).value;
  return rise * settings_.mean_force_w_n + begin_w_n_ + share * (end_w_n_ - begin_w_n_);
}

}  // namespace gyre::simulator
