#pragma once
// How a vehicle that was without setpoints takes them up again: not by a leap.
//
// It has come to a stand somewhere (extrapolation.hpp), and the next setpoint may ask for a place metres away. No
// vehicle leaps there, and none should try: it closes the gap between what it did and what it is asked for by a quintic
// that fades to nothing. An agent that hears where its vehicle is begins there, and leaves no gap to close: it calls
// the vehicle back while that is already catching up, and is followed from where the vehicle is then.
//
//   e0, e0'   gap in value and rate at t0, when setpoints come again
//   e(x) = e0 (1 − 10x³ + 15x⁴ − 6x⁵) + e0' T (x − 6x³ + 8x⁴ − 3x⁵)     x = (t − t0) / T, T = kCatchUp_s

#include <algorithm>

namespace gyre::simulator {

inline constexpr double kCatchUp_s = 3.0;
/// A target that changes its mind by more, and not the extrapolation of it.
inline constexpr double kCalledElsewhere_m = 1e-3;

/// Quantity: a length, or a vector of them.
template <class Quantity>
class CatchUp {
 public:
  struct Gap {
    Quantity value;
    Quantity rate;
  };

  explicit CatchUp(const Quantity& zero) : gap_{zero, zero} {}

  void begin(const Gap& gap, double now_s) {
    gap_ = gap;
    begin_s_ = now_s;
  }

  [[nodiscard]] bool under_way(double t_s) const { return t_s < begin_s_ + kCatchUp_s; }

  /// What is left of the gap.
  [[nodiscard]] Gap at(double t_s) const {
    const double x = std::clamp((t_s - begin_s_) / kCatchUp_s, 0.0, 1.0);
    const double x2 = x * x;
    const double value = 1.0 - x * x2 * (10.0 + x * (-15.0 + 6.0 * x));
    const double value_rate = -30.0 * x2 * (1.0 - x) * (1.0 - x) / kCatchUp_s;
    const double slope = kCatchUp_s * x * (1.0 + x2 * (-6.0 + x * (8.0 - 3.0 * x)));
    const double slope_rate = 1.0 + x2 * (-18.0 + x * (32.0 - 15.0 * x));
    return {Quantity(value * gap_.value + slope * gap_.rate),
            Quantity(value_rate * gap_.value + slope_rate * gap_.rate)};
  }

 private:
  Gap gap_;
  double begin_s_ = -kCatchUp_s;
};

}  // namespace gyre::simulator
