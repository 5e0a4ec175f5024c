#pragma once
// Plans to hold the laws against: the paper's, the reference cases, polygons known by hand, and random ones.

#include <functional>
#include <string>
#include <vector>

#include "common/base/angle.hpp"
#include "common/mechanics/carrier_slice.hpp"
#include "common/mechanics/grasp.hpp"
#include "common/mechanics/plan.hpp"
#include "common/mechanics/reference.hpp"

namespace gyre::mechanics::test {

/// tests/data/reference/cases/<name>.json, which was written independently of this code.
[[nodiscard]] Plan reference_plan(const std::string& name);

/// The paper's example with level carriers: n = 4, the phases of the paper.
[[nodiscard]] Plan paper_plan();

/// n level carriers on a horizontal regular polygon above the centre of mass, with edge-heading phases.
[[nodiscard]] Plan polygon_plan(std::size_t n);

/// phase_j := heading of edge j as travelled, W (docs/design.md, fact 2).
void take_edge_headings(Plan& plan);

/// What a random plan may be; RapidCheck draws the rest, so call it inside a property.
struct RandomPlan {
  std::size_t carriers_min = 3, carriers_max = 12;
  bool tilted = true;
  bool mixed_laws = true;  ///< else all level
};

/// A plan whose cables stay well away from slack and from their law's plane: every figure is finite.
[[nodiscard]] Plan random_plan(const RandomPlan& wish = {});

/// Another motion that holds the same load at the same attachments: other cycle, rate, forces and laws.
[[nodiscard]] Plan random_motion(Plan plan, bool mixed_laws = true);

/// The same load, held still as it is held at phase theta: no amplitude, and no profile that swings.
[[nodiscard]] Plan still_plan(const Plan& plan, double theta_rad);

/// Drawn evenly from [low, high].
[[nodiscard]] double real(double low, double high);
[[nodiscard]] std::size_t whole(std::size_t low, std::size_t high);

/// The wrench that forces at the carriers' attachments exert on the load.
[[nodiscard]] Vector6d wrench(const Plan& plan, const std::vector<Eigen::Vector3d>& forces_w_n);

/// The wrench of elastic, damped cables on a load that has moved, and moves, by (translation, rotation), with carriers
/// that pass their places at a pace.
[[nodiscard]] Vector6d wrench_of_moving(const Plan& plan, const std::vector<CarrierSlice>& all, double t_s, double pace,
                                        const Vector6d& moved, const Vector6d& velocity);

/// Calls `visit` at `count` + 1 moments, evenly from begin to end, both included.
void sample(double begin_s, double end_s, int count, const std::function<void(double t_s)>& visit);

}  // namespace gyre::mechanics::test
