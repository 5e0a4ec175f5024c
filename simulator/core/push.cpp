#include "simulator/core/push.hpp"

#include <algorithm>
#include <cmath>

#include "common/protocol/disturbance.hpp"

namespace gyre::simulator {

std::optional<std::string> Push::objection(const Eigen::Vector3d& force_w_n, Duration duration) const {
  return protocol::objection_to_push(force_w_n, duration, weight_n_);
}

void Push::begin(LocalTime arrived, const Eigen::Vector3d& force_w_n, Duration duration) {
  begins_ = arrived;
  ticks_left_ = std::max<std::int64_t>(1, std::llround(seconds(duration) / seconds(tick_)));
  force_w_n_ = force_w_n * (seconds(duration) / (static_cast<double>(ticks_left_) * seconds(tick_)));
}

void Push::tick(LocalTime at) {
  const bool on = ticks_left_ > 0 && at >= begins_;
  if (on) --ticks_left_;
  now_w_n_ = on ? force_w_n_ : Eigen::Vector3d::Zero();
}

}  // namespace gyre::simulator
