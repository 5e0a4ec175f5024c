#include "simulator/core/winch.hpp"

#include <algorithm>
#include <cmath>

#include "simulator/core/extrapolation.hpp"

namespace gyre::simulator {

Winch::Winch(double rest_length_m, const WinchSettings& settings, OnSilence on_silence)
    : settings_(settings), on_silence_(on_silence), drum_(rest_length_m, 0.0) {
  if (settings_.lag_s > 0.0) settings_.lag_s = std::max(settings_.lag_s, settings_.tick_s);
  target_.length_m = rest_length_m;
}

void Winch::command(const WinchTarget& target, double held_s, double now_s, Hand hand) {
  const WinchMotion before = asked(now_s);
  const bool slowed_down = led_ && (now_s - target_since_s_ > kExtrapolationHorizon_s || now_s > brakes_at_s_);
  led_ = true;
  target_ = target;
  target_since_s_ = held_s;
  brakes_at_s_ = brakes_at_s(on_silence_, now_s);
  const bool called_elsewhere = (hand == Hand::kAnother || (hand == Hand::kReturns && catch_up_.under_way(now_s))) &&
                                std::abs(asked(now_s).length_m - before.length_m) > kCalledElsewhere_m;
  if (!slowed_down && !called_elsewhere) return;
  catch_up_ = CatchUp<double>(0.0);
  const WinchMotion wanted = asked(now_s);
  catch_up_.begin({before.length_m - wanted.length_m, before.rate_m_s - wanted.rate_m_s}, now_s);
}

void Winch::tick(double now_s) {
  if (exact()) return;
  const double h = settings_.tick_s;
  const DigitalLoop<double>::Motion begin = drum_.at(now_s);
  const WinchMotion at_end = asked(now_s + h);
  double rate = settings_.lag_s > 0.0 ? DigitalLoop<double>::lagging(begin, at_end.length_m, settings_.lag_s, h)
                                      : at_end.rate_m_s + (asked(now_s).length_m - begin.value) / (3.0 * h);
  if (const auto& most = settings_.acceleration_limit_m_s2)
    rate = std::clamp(rate, begin.rate - *most * h, begin.rate + *most * h);
  if (const auto& most = settings_.rate_limit_m_s) rate = std::clamp(rate, -*most, *most);
  drum_.go(now_s, h, rate);
}

WinchMotion Winch::led(double t_s) const {
  const ExtrapolationWeights w = extrapolate(t_s - target_since_s_);
  const auto left = catch_up_.at(t_s);
  return {
      left.value + target_.length_m + w.by_velocity * target_.rate_m_s + w.by_acceleration * target_.acceleration_m_s2,
      left.rate + w.rate_by_velocity * target_.rate_m_s + w.rate_by_acceleration * target_.acceleration_m_s2};
}

WinchMotion Winch::asked(double t_s) const {
  if (t_s <= brakes_at_s_) return led(t_s);
  const WinchMotion last = led(brakes_at_s_);
  const Fading braking = fade(t_s - brakes_at_s_, kBraking_s);
  return {last.length_m + braking.travelled_s * last.rate_m_s, braking.share * last.rate_m_s};
}

WinchMotion Winch::at(double t_s) const {
  if (exact()) return asked(t_s);
  const DigitalLoop<double>::Motion motion = drum_.at(t_s);
  return {motion.value, motion.rate};
}

}  // namespace gyre::simulator
