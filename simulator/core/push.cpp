#include "simulator/core/push.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/text.hpp"

namespace gyre::simulator {

std::optional<std::string> Push::objection(const Eigen::Vector3d& force_w_n, Duration duration) const {
  // Not a > b, which would let through what is no number.
  if (!(force_w_n.norm() <= weight_n_)) {
    return text("a push of %.4g N; the load weighs %.4g N, and is pushed by no more", force_w_n.norm(), weight_n_);
  }
  if (duration <= Duration::zero() || duration > kLongestPush) {
    return text("a push of %.4g s; the load is pushed for more than 0 and at most %.0f s", seconds(duration),
                seconds(kLongestPush));
  }
  return std::nullopt;
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
