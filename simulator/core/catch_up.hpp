#pragma once
// How a vehicle that was without setpoints takes them up again: not by a leap.
//
// It has come to a stand somewhere (extrapolation.hpp, on_silence.hpp), and the next setpoint may ask for a place
// metres away. No vehicle leaps there, and none should try: it closes the gap between what it did and what it is asked
// for by a quintic that fades to nothing. An agent that hears where its vehicle is begins there, and leaves no gap to
// close: it calls the vehicle back while that is already catching up, and is followed from where the vehicle is then.
//
//   e0, e0'   gap in value and rate at t0, when setpoints come again
//   e(t) = e0 v(x) + e0' T s(x)     x = (t − t0) / T, T = kCatchUp_s, v and s as in quintic.hpp

#include "common/mechanics/quintic.hpp"

namespace gyre::simulator {

inline constexpr double kCatchUp_s = 3.0;
/// A target that changes its mind by more, and not the extrapolation of it.
inline constexpr double kCalledElsewhere_m = 1e-3;

/// Who gives a target: whoever gave the one before; the same again after a silence, who may have begun anew from where
/// the vehicle was; or somebody else, who need not have had the same in mind.
enum class Hand { kSame, kReturns, kAnother };

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
    const mechanics::Taylor<double> x = mechanics::progress(t_s - begin_s_, kCatchUp_s);
    const mechanics::Taylor<double> value = mechanics::value_left(x);
    const mechanics::Taylor<double> slope = kCatchUp_s * mechanics::slope_left(x);
    return {Quantity(value.value * gap_.value + slope.value * gap_.rate),
            Quantity(value.first * gap_.value + slope.first * gap_.rate)};
  }

 private:
  Gap gap_;
  double begin_s_ = -kCatchUp_s;
};

}  // namespace gyre::simulator
