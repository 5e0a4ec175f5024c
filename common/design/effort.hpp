#pragma once
// What a motion costs, as one number without a unit, so that a gram and a ton, a metre and a hundred are weighed alike.
//
//   symbol    meaning                                                                unit
//   F         a carrier's share of the weight, mg / n                                N
//   v         the wanted speed                                                       m/s
//   L         v² / g and the load's own size                                         m
//   e_i       internal force of carrier i, beyond the particular one                 N
//   < >       mean over carriers and phases
//
//   everything    < |e|² > / F²  +  < |a|² > / g²  +  < l'² > / v²  +  < l > / 10 L
//   winch work    < (s l')² > / (F v)²  +  everything / 1000
//
// Internal force is what the load has to bear and vehicles pull for nothing but motion; it is the tensions' spread,
// too. The last term is height: without it cables grow for ever, since a long cable needs no force to let its carrier
// turn. The thousandth decides between motions of no work at all.
//
// Reference: docs/design.md, Designing a mission.

#include "common/design/demands.hpp"

namespace gyre::design {

/// Of the motion as it was last evaluated; gradient = its change by x.
[[nodiscard]] double effort(Objective objective, const SampledMotion& motion, const Scales& scales, double gravity_m_s2,
                            Eigen::Ref<Eigen::VectorXd> gradient);

}  // namespace gyre::design
