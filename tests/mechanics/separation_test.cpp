// The bound on how close carriers come, where it is hard to see: dips that no midpoint of a cell shows.

#include "common/mechanics/separation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/mechanics/quintic.hpp"
#include "tests/mechanics/plans.hpp"

namespace gyre::mechanics::test {
namespace {

/// A carrier on a line along x, `aside_m` beside it.
template <class Along>
Path on_a_line(CarrierId id, double aside_m, double speed_max_m_s, double acceleration_max_m_s2, Along along) {
  return {id, speed_max_m_s, acceleration_max_m_s2, [along, aside_m](double t_s) {
            const Taylor<double> x = along(t_s);
            const Eigen::Vector3d ahead = Eigen::Vector3d::UnitX();
            return TaylorVector<double>{x.value * ahead + aside_m * Eigen::Vector3d::UnitY(), x.first * ahead,
                                        x.second * ahead};
          }};
}

Path still(CarrierId id, double aside_m) {
  return on_a_line(id, aside_m, 0.0, 0.0, [](double) { return constant(0.0); });
}

constexpr double kEnd_s =
    64.0;  // cells, and the samples of a sphere, are a second wide and have their midpoint at .5 s

TEST(Separation, a_fall_with_all_of_the_acceleration_after_the_last_midpoint_is_found) {
  // It waits a metre away, steps back by 28 mm, and falls towards the other from the last midpoint on: by 50 mm.
  constexpr double kBack_m = 0.028, kAcceleration_m_s2 = 0.4, kFall_s = 0.5;
  const Path falling = on_a_line(2, 0.0, kAcceleration_m_s2 * kFall_s, kAcceleration_m_s2, [](double t_s) {
    if (t_s < kEnd_s - kFall_s) return constant(1.0) + kBack_m * smooth_step(t_s - 58.0, 5.0);
    const double fallen_s = t_s - (kEnd_s - kFall_s);
    return Taylor<double>{1.0 + kBack_m - 0.5 * kAcceleration_m_s2 * fallen_s * fallen_s,
                          -kAcceleration_m_s2 * fallen_s, -kAcceleration_m_s2};
  });
  const Separation s = separation({still(1, 0.0), falling}, 0.0, kEnd_s).value();
  EXPECT_NEAR(s.min_m, 1.0 + kBack_m - 0.5 * kAcceleration_m_s2 * kFall_s * kFall_s, 2.0 * kSeparationSlack_m);
}

TEST(Separation, a_visit_between_two_samples_of_its_sphere_is_found) {
  // Three metres away at every sample; in between it comes as close as half a metre, and the other pair is at one.
  constexpr double kVisit_m = 2.5, kLeaves_s = 20.5;
  const Path visitor = on_a_line(3, 0.0, kPi * kVisit_m, 2.0 * kPi * kPi * kVisit_m, [](double t_s) {
    if (t_s < kLeaves_s || t_s > kLeaves_s + 1.0) return constant(3.0);
    const Taylor<double> swing = oscillation(0.5, -0.5, 2.0 * kPi, 0.5 * kPi, t_s - kLeaves_s);
    return constant(3.0) - kVisit_m * swing;
  });
  const Separation s = separation({still(1, 0.0), still(2, 1.0), visitor}, 0.0, kEnd_s).value();
  EXPECT_NEAR(s.min_m, 0.5, 2.0 * kSeparationSlack_m);
  EXPECT_EQ(s.first, 1U);
  EXPECT_EQ(s.second, 3U);
}

}  // namespace
}  // namespace gyre::mechanics::test
