#include "common/design/sampled_motion.hpp"

#include <cmath>

#include "common/base/angle.hpp"

namespace gyre::design {
namespace {

using mechanics::Taylor;
using mechanics::TaylorVector;

/// Where in a share of a plan each number stands.
enum Share { kOffsetIn, kSineIn, kCosineIn, kOffsetOut, kSineOut, kCosineOut, kRate, kMean, kSwing, kPhase };
static_assert(kPhase + 1 == kShare);

constexpr int kMostTurns = 8;  // of a motion whose laws take many turns to repeat; what is left is the certificate's

using Shared = std::array<Number, kShare>;

/// offset + a sin(theta) + b cos(theta).
Taylor<Number> internal_force(const Number& offset, const Number& a, const Number& b, const Number& rate,
                              double phase_rad) {
  const double sine = std::sin(phase_rad);
  const double cosine = std::cos(phase_rad);
  const Number swing = sine * a + cosine * b;
  return {offset + swing, rate * (cosine * a - sine * b), -(rate * rate * swing)};
}

/// mean + swing sin(k theta + phase), phase a variable, too.
Taylor<Number> profile(const mechanics::Oscillation& law, const Shared& y, double phase_rad) {
  if (law.constant() && y[kSwing].value == 0.0) return mechanics::constant(y[kMean]);
  const double angle = law.harmonic.ratio() * phase_rad + y[kPhase].value;
  const Number sine{std::sin(angle), std::cos(angle) * y[kPhase].slope};
  const Number cosine{std::cos(angle), -std::sin(angle) * y[kPhase].slope};
  const Number rate = law.harmonic.ratio() * y[kRate];
  return {y[kMean] + y[kSwing] * sine, y[kSwing] * rate * cosine, -(y[kSwing] * rate * rate * sine)};
}

/// |v|, with a slope where it is 0, too.
Number length_of(const NumberVector& v) {
  const Number square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  return sqrt(square + Number(1e-18));
}

}  // namespace

SampledMotion::SampledMotion(const mechanics::Plan& plan, const Unknowns& unknowns, int samples)
    : plan_(plan), slices_(mechanics::slices(plan)), slots_(slices_.size()) {
  const double turns = std::round(mechanics::period_s(plan) * plan.cycle.rate_rad_s / kTwoPi);
  const int all = samples * std::min(static_cast<int>(turns), kMostTurns);
  for (int k = 0; k < all; ++k) phases_rad_.push_back(kTwoPi * k / samples);
  for (std::size_t i = 0; i < slices_.size(); ++i) {
    std::array<Slot, kShare>& mine = slots_[i];
    for (std::size_t j = 0; j < plan.cycle.edges.size(); ++j) {
      const EdgeSlots& edge = unknowns.edges[j];
      const auto put = [&](Share first) {
        mine[first] = edge.offset_n;
        mine[first + 1U] = edge.sine_n;
        mine[first + 2U] = edge.cosine_n;
      };
      if (plan.cycle.edges[j].to == slices_[i].id) put(kOffsetIn);
      if (plan.cycle.edges[j].from == slices_[i].id) put(kOffsetOut);
    }
    mine[kRate] = unknowns.rate_rad_s;
    mine[kMean] = unknowns.laws[i].mean_m;
    mine[kSwing] = unknowns.laws[i].swing_m;
    mine[kPhase] = unknowns.laws[i].phase_rad;
  }
  moments_.resize(slices_.size() * phases_rad_.size());
}

void SampledMotion::evaluate(const Eigen::VectorXd& x) {
  for (std::size_t i = 0; i < slices_.size(); ++i) {
    Shared y;
    for (int k = 0; k < kShare; ++k) {
      const auto at = static_cast<std::size_t>(k);
      y[at] = Number::variable(slots_[i][at].at(x), k);
    }
    for (std::size_t k = 0; k < samples(); ++k) moments_[i * samples() + k] = moment_at(i, y, phases_rad_[k]);
  }
}

Moment SampledMotion::moment_at(std::size_t carrier, const Shared& y, double phase_rad) const {
  const mechanics::CarrierSlice& slice = slices_[carrier];
  const TaylorVector<Number> f =
      mechanics::force(slice, internal_force(y[kOffsetIn], y[kSineIn], y[kCosineIn], y[kRate], phase_rad),
                       internal_force(y[kOffsetOut], y[kSineOut], y[kCosineOut], y[kRate], phase_rad));
  const Taylor<Number> s = mechanics::norm(f);
  const TaylorVector<Number> q = f / s;
  const Taylor<Number> l = mechanics::length(slice, q, profile(slice.law.profile, y, phase_rad));
  const mechanics::BasicReference<Number> now = mechanics::hang(slice, f, s, q, l);

  Moment out;
  out.position_w_m = now.position_w_m.value;
  for (int axis = 0; axis < 3; ++axis)
    out.internal_force_w_n[axis] = f.value[axis] - Number(slice.particular_force_w_n[axis]);
  out[Figure::kTension] = s.value;
  out[Figure::kLength] = l.value;
  out[Figure::kWinchRate] = l.first;
  const Taylor<Number> paid_out = mechanics::paid_out(now, slice.cable_stiffness_n_m);
  out[Figure::kPaidOut] = paid_out.value;
  out[Figure::kPaidOutRate] = paid_out.first;
  out[Figure::kPaidOutAcceleration] = paid_out.second;
  out[Figure::kSpeed] = length_of(now.position_w_m.first);
  out[Figure::kAcceleration] = length_of(now.position_w_m.second);
  out[Figure::kAltitude] = now.position_w_m.value[2];
  out[Figure::kVerticalCosine] = q.value[2];
  out[Figure::kDirectionCosine] =
      slice.law.is_projection() ? mechanics::dot(slice.law.direction, q).value : Number(1.0);

  const mechanics::Vehicle& vehicle = plan_.carriers[carrier].vehicle;
  const auto pull = [&](Figure thrust, Figure uprightness, const NumberVector& of) {
    out[thrust] = length_of(of);
    out[uprightness] = of[2] / out[thrust];
  };
  out[Figure::kUprightness] = out[Figure::kUprightnessAtRest] = Number(1.0);
  if (!vehicle.mass_kg) return out;
  NumberVector at_rest = f.value;  // m g_0 e_z + f
  at_rest[2] += Number(*vehicle.mass_kg * plan_.gravity_m_s2);
  NumberVector in_motion;  // and with m a
  for (int axis = 0; axis < 3; ++axis)
    in_motion[axis] = at_rest[axis] + *vehicle.mass_kg * now.position_w_m.second[axis];
  pull(Figure::kThrustAtRest, Figure::kUprightnessAtRest, at_rest);
  pull(Figure::kThrust, Figure::kUprightness, in_motion);
  return out;
}

void SampledMotion::scatter(std::size_t carrier, const Number::Slope& slope, double weight,
                            Eigen::Ref<Eigen::VectorXd> gradient) const {
  for (int k = 0; k < kShare; ++k) {
    const Slot& slot = slots_[carrier][static_cast<std::size_t>(k)];
    if (slot.index >= 0) gradient[slot.index] += weight * slot.factor * slope[k];
  }
}

}  // namespace gyre::design
