#pragma once
// The one way to change plans in flight: mix their forces, with weights that are smooth steps of plan time. Starting,
// slowing and stopping are no changes of plan: they are paces (protocol/pace.hpp).
//
// Intuition: if f_A and f_B both hold the load, so does (1 − w) f_A + w f_B for every w, because equilibrium is linear
// in the forces. So a retune, and turning back half-way, are the same motion between different plans, and the load is
// held at every moment of each. What is not linear is the cable: the length law of each plan is applied to the mixed
// direction, and the lengths are mixed.
//
//   f = (1 − w) f_below + w f_plan      l = (1 − w) l_below(q) + w l_plan(q)      w = smooth_step(t − start, duration)
//
// A mixture is a stack: a plan at the bottom, and on it one layer per transition under way. A second transition does
// not have to wait for the first: it lies on top, and when it is complete nothing below it counts any more.
// All plans hold the load in the same pose, so all slices have the same attachment point.
// Where the mixed cable goes slack, the result is as in reference.hpp.
// Reference: docs/design.md, fact 3 (mixtures preserve equilibrium).

#include <array>
#include <cstddef>

#include "common/base/ensure.hpp"
#include "common/mechanics/quintic.hpp"
#include "common/mechanics/reference.hpp"

namespace gyre::mechanics {

template <class S>
struct Layer {
  const CarrierSlice* slice = nullptr;
  S t_s{};           ///< since this plan's epoch
  Taylor<S> weight;  ///< of this layer over everything below it; not read for the bottom layer
};

/// What a carrier has to do while transitions are under way; `layers` from the bottom up, at least one (GYRE_ENSURE).
template <class S>
[[nodiscard]] inline BasicReference<S> evaluate_mixture(const Layer<S>* layers, std::size_t count) {
  GYRE_ENSURE(count >= 1, "a mixture has at least a bottom layer");
  if (count == 1) return evaluate(*layers[0].slice, layers[0].t_s);

  const auto mix = [](const Taylor<S>& w, const auto& below, const auto& above) {
    return below + w * (above - below);  // as in the formula, but what both agree on cancels, to the bit
  };
  TaylorVector<S> f = force(*layers[0].slice, layers[0].t_s);
  for (std::size_t i = 1; i < count; ++i) f = mix(layers[i].weight, f, force(*layers[i].slice, layers[i].t_s));
  const Taylor<S> s = norm(f);
  const TaylorVector<S> q = f / s;
  Taylor<S> l = length(*layers[0].slice, q, layers[0].t_s);
  for (std::size_t i = 1; i < count; ++i) l = mix(layers[i].weight, l, length(*layers[i].slice, q, layers[i].t_s));
  return hang(*layers[count - 1].slice, f, s, q, l);
}

/// A plan on a clock, and the transition that brought it in. Seconds on one clock of the caller's choice.
struct TimedLayer {
  const CarrierSlice* slice = nullptr;
  double epoch_s = 0.0;
  double start_s = 0.0;     ///< not read for the bottom layer
  double duration_s = 0.0;  ///< not read for the bottom layer
};

/// More layers than this never lie on each other (protocol::kMaxTransitions and the plan below them).
inline constexpr std::size_t kMaxLayers = 5;

/// The topmost layer that has come in completely by `now_s`: nothing below it counts any more.
[[nodiscard]] inline std::size_t complete_layer(const TimedLayer* layers, std::size_t count, double now_s) {
  std::size_t complete = 0;
  for (std::size_t i = 1; i < count; ++i) {
    if (now_s - layers[i].start_s >= layers[i].duration_s) complete = i;
  }
  return complete;
}

/// The reference at `now_s`; `layers` from the bottom up. That they are 1..kMaxLayers, that each has a slice and each
/// but the bottom a positive duration, is up to the caller (GYRE_ENSURE).
[[nodiscard]] inline Reference evaluate_course(const TimedLayer* layers, std::size_t count, double now_s) {
  GYRE_ENSURE(count >= 1 && count <= kMaxLayers, "a course has a bottom, and a bounded number of layers");
  std::array<Layer<double>, kMaxLayers> stack;
  for (std::size_t i = 0; i < count; ++i) {
    GYRE_ENSURE(layers[i].slice != nullptr, "a course is flown whole");
    stack[i] = {layers[i].slice, now_s - layers[i].epoch_s, {}};
    if (i == 0) continue;
    GYRE_ENSURE(layers[i].duration_s > 0.0, "a transition takes time");
    stack[i].weight = smooth_step(now_s - layers[i].start_s, layers[i].duration_s);
  }
  const std::size_t bottom = complete_layer(layers, count, now_s);
  return evaluate_mixture(stack.data() + bottom, count - bottom);
}

}  // namespace gyre::mechanics
