#include "coordinator/core/rehearsal.hpp"

#include "common/mechanics/clearance.hpp"
#include "common/mechanics/judgement.hpp"
#include "common/mechanics/load_hull.hpp"
#include "common/mechanics/transition_figures.hpp"

namespace gyre::coordinator {

Rehearsal::Rehearsal(std::vector<std::vector<mechanics::TimedLayer>> stacks, mechanics::Plan plan)
    : stacks_(std::move(stacks)), plan_(std::move(plan)) {
  const mechanics::TimedLayer& top = stacks_.front().back();
  begin_s_ = top.start_s;
  end_s_ = top.start_s + top.duration_s;
}

bool Rehearsal::advance() {
  if (!reasons_.empty() || apart_) return true;
  if (figures_.size() < stacks_.size()) {
    const auto& stack = stacks_[figures_.size()];
    const mechanics::Carrier* carrier = mechanics::find(plan_, stack.front().slice->id);
    const mechanics::Vehicle vehicle = carrier == nullptr ? mechanics::Vehicle{} : carrier->vehicle;
    figures_.push_back(
        mechanics::transition_figures(stack, begin_s_, end_s_, mechanics::weight(vehicle, plan_.gravity_m_s2)));
    mechanics::judge_carrier(figures_.back(), plan_.limits, false, reasons_);
    mechanics::judge_machines(figures_.back(), plan_.winch, vehicle, reasons_);
    return !reasons_.empty();
  }
  judge_apart();
  apart_ = true;
  return true;
}

void Rehearsal::judge_apart() {
  std::vector<mechanics::Hanging> carriers;
  for (std::size_t i = 0; i < stacks_.size(); ++i) {
    const mechanics::CarrierSlice& slice = *stacks_[i].back().slice;
    const mechanics::Carrier* carrier = mechanics::find(plan_, slice.id);
    carriers.push_back({slice.id, slice.attachment_w_m, carrier == nullptr ? 0.0 : carrier->radius_m,
                        figures_[i].altitude_m.min, figures_[i].acceleration_max_m_s2,
                        [&stack = stacks_[i]](double t_s) {
                          return mechanics::evaluate_course(stack.data(), stack.size(), t_s).position_w_m;
                        }});
  }
  // Absent: nothing that could touch, or a motion without bounds, which has its own reason.
  const auto separation = mechanics::separation(carriers, begin_s_, end_s_);
  if (separation) mechanics::judge_separation(*separation, plan_.limits, reasons_);
  const std::vector<Eigen::Vector3d> hull = mechanics::hull_w(plan_.load);
  const auto clearance = mechanics::clearance(carriers, hull, begin_s_, end_s_);
  if (clearance) mechanics::judge_clearance(*clearance, plan_.limits, reasons_);
  const auto above_load = mechanics::above_load(carriers, hull);
  if (above_load) mechanics::judge_above_load(*above_load, plan_.limits, reasons_);
}

}  // namespace gyre::coordinator
