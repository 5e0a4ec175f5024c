#include "agent/core/plan_judge.hpp"

#include "common/mechanics/judgement.hpp"
#include "common/mechanics/orbit_figures.hpp"

namespace gyre::agent {

PlanVerdict judge(const PlanQuestion& question) {
  const mechanics::CarrierSlice& slice = question.plan.slice;
  const mechanics::CarrierFigures figures = mechanics::orbit_figures(slice);
  std::vector<mechanics::Reason> reasons;
  mechanics::judge_carrier(figures, question.vehicle, moves(slice), reasons);
  if (!reasons.empty()) return {question.plan.number, Error{reasons.front().text}};
  return {question.plan.number, figures};
}

}  // namespace gyre::agent
