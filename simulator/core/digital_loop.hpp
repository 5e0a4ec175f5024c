#pragma once
// The motion of whatever a digital loop drives: decided once per tick, with a rate that is linear within it.
//
//   x, r    where it is, and its rate
//   x*      where it is asked to be
//   h       tick                                                             s
//   T       lag                                                              s
//
//   a first-order lag, x' = (x* − x) / T, at the end of the tick:   r(t + h) = (x*(t + h) − x(t) − r(t) h/2) / (T +
//   h/2)
//
// The rate is linear within the tick because it must not jump: the cables' damping would turn a jump into a kick. The
// rule is the implicit trapezoid's: after each tick x' = (x* − x) / T holds exactly, in between to second order, and
// for T >= h/2 nothing rings.
//
// Reference: the trapezoidal rule, E. Hairer, G. Wanner, Solving Ordinary Differential Equations II.

namespace gyre::simulator {

/// Quantity: a length, or a vector of them.
template <class Quantity>
class DigitalLoop {
 public:
  struct Motion {
    Quantity value;
    Quantity rate;
  };

  /// Rests there; `zero`: of its kind.
  DigitalLoop(const Quantity& value, const Quantity& zero) : begin_{value, zero}, bend_(zero) {}

  /// The rate at the end of a tick that begins with this motion, of a lag that is asked for `asked` then.
  [[nodiscard]] static Quantity lagging(const Motion& begin, const Quantity& asked, double lag_s, double tick_s) {
    return (asked - begin.value - 0.5 * tick_s * begin.rate) / (lag_s + 0.5 * tick_s);
  }

  /// From `now` on, until the next tick, which ends with this rate.
  void go(double now_s, double tick_s, const Quantity& rate_at_end) {
    begin_ = at(now_s);
    since_s_ = now_s;
    bend_ = (rate_at_end - begin_.rate) / tick_s;
  }

  /// At any time within the tick.
  [[nodiscard]] Motion at(double t_s) const {
    const double elapsed_s = t_s - since_s_;
    return {Quantity(begin_.value + elapsed_s * (begin_.rate + 0.5 * elapsed_s * bend_)),
            Quantity(begin_.rate + elapsed_s * bend_)};
  }

 private:
  Motion begin_;  // at since_s_
  Quantity bend_;
  double since_s_ = 0.0;
};

}  // namespace gyre::simulator
