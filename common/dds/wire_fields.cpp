#include "common/dds/wire_fields.hpp"

namespace gyre::dds {
namespace {

namespace idl = fast::idl;

// The parts declared in the header are parts of the parts below, which would hide them.
using dds::from_wire;
using dds::to_wire;

idl::TimedPlan to_wire(const protocol::TimedPlan& plan) {
  idl::TimedPlan wire;
  wire.number(to_wire(plan.number));
  wire.plan_epoch_ns(ns(plan.epoch));
  return wire;
}

protocol::TimedPlan from_wire(const idl::TimedPlan& wire) {
  return {from_wire(wire.number()), plan_time(wire.plan_epoch_ns())};
}

idl::Transition to_wire(const protocol::Transition& transition) {
  idl::Transition wire;
  wire.to(to_wire(transition.to));
  wire.plan_start_ns(ns(transition.start));
  wire.plan_duration_ns(transition.duration.count());
  return wire;
}

protocol::Transition from_wire(const idl::Transition& wire) {
  return {from_wire(wire.to()), plan_time(wire.plan_start_ns()), Duration(wire.plan_duration_ns())};
}

idl::Ramp to_wire(const protocol::Ramp& ramp) {
  idl::Ramp wire;
  wire.swarm_start_ns(ns(ramp.start));
  wire.duration_ns(ramp.duration.count());
  wire.plan_from_ns(ns(ramp.from.at));
  wire.from_pace(ramp.from.pace);
  wire.from_rate_1_s(ramp.from.rate_1_s);
  wire.from_curvature_1_s2(ramp.from.curvature_1_s2);
  wire.target_pace(ramp.target);
  return wire;
}

protocol::Ramp from_wire(const idl::Ramp& wire) {
  return {swarm(wire.swarm_start_ns()),
          Duration(wire.duration_ns()),
          {plan_time(wire.plan_from_ns()), wire.from_pace(), wire.from_rate_1_s(), wire.from_curvature_1_s2()},
          wire.target_pace()};
}

idl::EdgePush to_wire(const mechanics::EdgePush& push) {
  idl::EdgePush wire;
  wire.direction_w(numbers(push.direction));
  wire.offset_n(push.offset_n);
  wire.amplitude_n(push.amplitude_n);
  wire.phase_rad(push.phase_rad);
  return wire;
}

mechanics::EdgePush from_wire(const idl::EdgePush& wire) {
  return {vector(wire.direction_w()), wire.offset_n(), wire.amplitude_n(), wire.phase_rad()};
}

using LawKind = mechanics::LengthLaw::Kind;

// The mechanics' enumeration has no numbers of its own: the wire's are stated here.
constexpr std::array<LawKind, 4> kLawKinds = {LawKind::kLevel, LawKind::kDirectional, LawKind::kSine, LawKind::kFixed};

idl::LengthLaw to_wire(const mechanics::LengthLaw& law) {
  idl::LengthLaw wire;
  for (std::size_t i = 0; i < kLawKinds.size(); ++i) {
    if (kLawKinds[i] == law.kind) wire.kind(static_cast<std::uint8_t>(i + 1));
  }
  wire.direction_w(numbers(law.direction));
  wire.profile_mean_m(law.profile.mean);
  wire.profile_swing_m(law.profile.swing);
  wire.harmonic_numerator(law.profile.harmonic.numerator);
  wire.harmonic_denominator(law.profile.harmonic.denominator);
  wire.profile_phase_rad(law.profile.phase_rad);
  return wire;
}

std::optional<mechanics::LengthLaw> from_wire(const idl::LengthLaw& wire) {
  if (wire.kind() < 1 || wire.kind() > kLawKinds.size()) return std::nullopt;
  mechanics::LengthLaw law;
  law.kind = kLawKinds[wire.kind() - 1U];
  law.direction = vector(wire.direction_w());
  law.profile.mean = wire.profile_mean_m();
  law.profile.swing = wire.profile_swing_m();
  law.profile.harmonic = {wire.harmonic_numerator(), wire.harmonic_denominator()};
  law.profile.phase_rad = wire.profile_phase_rad();
  return law;
}

}  // namespace

idl::PlanNumber to_wire(const protocol::PlanNumber& number) {
  idl::PlanNumber wire;
  wire.term(number.term);
  wire.revision(number.revision);
  return wire;
}

protocol::PlanNumber from_wire(const idl::PlanNumber& wire) {
  return {wire.term(), wire.revision()};
}

std::optional<idl::Course> to_wire(const protocol::Course& course) {
  if (course.transitions.size() > protocol::kMaxTransitions) return std::nullopt;
  if (course.pace.ramps.size() > protocol::kMaxRamps) return std::nullopt;
  idl::Course wire;
  wire.term(course.term);
  wire.revision(course.revision);
  wire.wish().pace(course.wish.pace);
  wire.wish().rest_when_changed(course.wish.rest_when_changed);
  wire.wish().by(static_cast<std::uint8_t>(course.wish.by));
  for (const protocol::Ramp& ramp : course.pace.ramps) wire.pace().push_back(to_wire(ramp));
  if (course.lease) wire.swarm_lease_ns().push_back(ns(*course.lease));
  wire.stopping_ns(course.stopping.count());
  wire.base(to_wire(course.base));
  for (const protocol::Transition& transition : course.transitions) wire.transitions().push_back(to_wire(transition));
  return wire;
}

std::optional<protocol::Course> from_wire(const idl::Course& wire) {
  const auto by = enumerator(wire.wish().by(), protocol::Wisher::kNobody, protocol::Wisher::kEvidence);
  if (!by || wire.transitions().size() > protocol::kMaxTransitions) return std::nullopt;
  if (wire.pace().size() > protocol::kMaxRamps || wire.swarm_lease_ns().size() > 1) return std::nullopt;
  protocol::Course course;
  course.term = wire.term();
  course.revision = wire.revision();
  course.wish = {wire.wish().pace(), wire.wish().rest_when_changed(), *by};
  course.pace.ramps.clear();
  for (const idl::Ramp& ramp : wire.pace()) course.pace.ramps.push_back(from_wire(ramp));
  if (!wire.swarm_lease_ns().empty()) course.lease = swarm(wire.swarm_lease_ns().front());
  course.stopping = Duration(wire.stopping_ns());
  course.base = from_wire(wire.base());
  for (const idl::Transition& transition : wire.transitions()) course.transitions.push_back(from_wire(transition));
  return course;
}

idl::CarrierSlice to_wire(const mechanics::CarrierSlice& slice) {
  idl::CarrierSlice wire;
  wire.carrier(slice.id);
  wire.attachment_w_m(numbers(slice.attachment_w_m));
  wire.particular_force_w_n(numbers(slice.particular_force_w_n));
  wire.incoming(to_wire(slice.incoming));
  wire.outgoing(to_wire(slice.outgoing));
  wire.rate_rad_s(slice.rate_rad_s);
  wire.law(to_wire(slice.law));
  wire.cable_stiffness_n_m(slice.cable_stiffness_n_m);
  wire.winch_lag_s(slice.winch_lag_s);
  wire.vehicle_lag_s(slice.vehicle_lag_s);
  return wire;
}

std::optional<mechanics::CarrierSlice> from_wire(const idl::CarrierSlice& wire) {
  const auto law = from_wire(wire.law());
  if (!law) return std::nullopt;
  return mechanics::CarrierSlice{wire.carrier(),
                                 vector(wire.attachment_w_m()),
                                 vector(wire.particular_force_w_n()),
                                 from_wire(wire.incoming()),
                                 from_wire(wire.outgoing()),
                                 wire.rate_rad_s(),
                                 *law,
                                 wire.cable_stiffness_n_m(),
                                 wire.winch_lag_s(),
                                 wire.vehicle_lag_s()};
}

idl::DropCounts to_wire(const protocol::DropCounts& counts) {
  idl::DropCounts wire;
  wire.late(counts.late);
  wire.duplicate(counts.duplicate);
  wire.wrong_term(counts.wrong_term);
  wire.nonsense(counts.nonsense);
  return wire;
}

protocol::DropCounts from_wire(const idl::DropCounts& wire) {
  return {wire.late(), wire.duplicate(), wire.wrong_term(), wire.nonsense()};
}

}  // namespace gyre::dds
