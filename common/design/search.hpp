#pragma once
// Looks for the best motion that meets every demand at the samples: sequential quadratic programming over the rows that
// matter, again and again until no row that was left out is broken.
//
//   symbol    meaning
//   x         variables (unknowns.hpp)
//   r_k       residuals of all demands at all samples (demands.hpp)
//   J         what is to be least (effort.hpp), or less what is to be greatest
//
//   meet      min t         over (x, t)     r_k(x) <= t
//   improve   min J(x)      over x          r_k(x) <= −margin
//   raise     max t         over (x, t)     r_k(x) <= −margin,  the raised demands' with limits L + t S0
//
// Reference: SLSQP of NLopt (D. Kraft, A software package for sequential quadratic programming).

#include <functional>
#include <vector>

#include "common/design/effort.hpp"

namespace gyre::design {

struct Point {
  Eigen::VectorXd x;
  double worst = std::numeric_limits<double>::infinity();  ///< residual, over all samples
  double cost = std::numeric_limits<double>::infinity();   ///< J, or −L of the first raised demand
};

/// What is searched, whole.
struct Search {
  const mechanics::Plan* plan = nullptr;
  Unknowns unknowns;
  std::vector<Demand> demands;
  /// The demands whose limits are to be raised together, by as many metres or metres per second as can be; none: least
  /// effort.
  std::vector<std::size_t> raised;
  Objective objective = Objective::kLeastEverything;
  Scales scales;
  double gravity_m_s2 = 9.81;
  int samples = 64;
  double margin = 2e-3;
  std::function<bool()> keep_going;  ///< asked at every step
};

/// Towards a point that meets all demands; as near to one as was found.
[[nodiscard]] Point meet(const Search& search, const Eigen::VectorXd& x, int rounds = 10);

/// From a point that meets all demands to the best one around; never to a worse one.
[[nodiscard]] Point improve(const Search& search, const Point& from);

}  // namespace gyre::design
