#include "agent/core/plan_judge.hpp"

#include "common/mechanics/judgement.hpp"
#include "common/mechanics/orbit_figures.hpp"

namespace gyre::agent {
namespace {

/// A slice does not say where it is flown, and anywhere on earth it is this within half a percent.
constexpr double kStandardGravity_m_s2 = 9.80665;

}  // namespace

PlanVerdict judge(const PlanQuestion& question) {
  const mechanics::CarrierSlice& slice = question.plan.slice;
  const Machines& own = question.machines;
  const mechanics::CarrierFigures figures =
      mechanics::orbit_figures(slice, mechanics::weight(own.vehicle, kStandardGravity_m_s2));
  std::vector<mechanics::Reason> reasons;
  mechanics::judge_carrier(figures, question.vehicle, moves(slice), reasons);
  mechanics::judge_machines(figures, own.winch, own.vehicle, reasons);
  if (!reasons.empty()) return {question.plan.number, Error{reasons.front().text}};
  return {question.plan.number, figures};
}

}  // namespace gyre::agent
