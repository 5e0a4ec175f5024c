#pragma once
// A plan's motion over one period as points that lines are drawn through, and the moments at which things come closest.
//
// What is drawn between the points is a straight line, and nothing is judged by it: figures and verdicts are the
// certificate's.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "common/mechanics/carrier_slice.hpp"
#include "common/mechanics/certificate.hpp"
#include "common/mechanics/plan.hpp"

namespace gyre::ground {

/// So many are told apart one by one; of more, lines are finer and words fewer.
inline constexpr std::size_t kFewCarriers = 12;

struct Moment {
  double t_s = 0.0;
  Eigen::Vector3d position_w_m = Eigen::Vector3d::Zero();
  double tension_n = 0.0, length_m = 0.0, speed_m_s = 0.0, winch_rate_m_s = 0.0;
};

struct CarrierPath {
  CarrierId id = 0;
  double radius_m = 0.0;
  Eigen::Vector3d attachment_w_m = Eigen::Vector3d::Zero();
  std::vector<Moment> moments;  ///< both ends of the period
};

/// Two carriers, or their cables, when they are closest.
struct Nearest {
  mechanics::Approach approach;
  struct Side {
    std::size_t index = 0;  ///< in the plan
    Eigen::Vector3d attachment_w_m, carrier_w_m;
    Eigen::Vector3d closest_w_m;  ///< the carrier, or a place on its cable
  };
  Side first, second;
};

struct Motion {
  double period_s = 0.0;
  std::vector<CarrierPath> carriers;
  std::optional<Nearest> places, cables;
  Eigen::Vector3d load_position_w_m = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> load_w_m;  ///< the corners of its hull; without one, its attachments
};

[[nodiscard]] inline bool few(const Motion& motion) {
  return motion.carriers.size() <= kFewCarriers;
}

/// Of a valid plan that has a bounded motion, with its certificate.
[[nodiscard]] Motion motion(const mechanics::Plan& plan, const mechanics::Certificate& certificate);

}  // namespace gyre::ground
