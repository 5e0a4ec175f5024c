#include "common/design/effort.hpp"

namespace gyre::design {
namespace {

constexpr double kHeightShare = 0.1;
constexpr double kTieBreak = 1e-3;

Number square(const Number& a) {
  return a * a;
}

}  // namespace

double effort(Objective objective, const SampledMotion& motion, const Scales& scales, double gravity_m_s2,
              Eigen::Ref<Eigen::VectorXd> gradient) {
  const bool work = objective == Objective::kLeastWinchWork;
  const double share = 1.0 / static_cast<double>(motion.carriers() * motion.samples());
  double total = 0.0;
  gradient.setZero();
  for (std::size_t i = 0; i < motion.carriers(); ++i) {
    Number sum;
    for (std::size_t k = 0; k < motion.samples(); ++k) {
      const Moment& now = motion.moment(i, k);
      Number everything = (kHeightShare / scales.length_m) * now[Figure::kLength];
      for (int axis = 0; axis < 3; ++axis) everything += square((1.0 / scales.force_n) * now.internal_force_w_n[axis]);
      everything += square((1.0 / gravity_m_s2) * now[Figure::kAcceleration]);
      everything += square((1.0 / scales.speed_m_s) * now[Figure::kWinchRate]);
      if (!work) {
        sum += everything;
        continue;
      }
      sum += square((1.0 / (scales.force_n * scales.speed_m_s)) * (now[Figure::kTension] * now[Figure::kWinchRate])) +
             kTieBreak * everything;
    }
    total += share * sum.value;
    motion.scatter(i, sum.slope, share, gradient);
  }
  return total;
}

}  // namespace gyre::design
