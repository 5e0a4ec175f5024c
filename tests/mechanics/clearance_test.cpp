// Bounds on how close things come: against dense sampling, and where it is hard to see, in dips that no midpoint of a
// cell shows.

#include "common/mechanics/clearance.hpp"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include <cmath>

#include "common/mechanics/braid.hpp"
#include "common/mechanics/certificate.hpp"
#include "common/mechanics/load_hull.hpp"
#include "common/mechanics/quintic.hpp"
#include "common/mechanics/segment.hpp"
#include "tests/mechanics/plans.hpp"

namespace gyre::mechanics::test {
namespace {

/// A carrier on a line along x, `aside_m` beside it.
template <class Along>
Hanging on_a_line(CarrierId id, double aside_m, double acceleration_max_m_s2, Along along) {
  return {id, Eigen::Vector3d::Zero(), 0.0, 0.0, acceleration_max_m_s2, [along, aside_m](double t_s) {
            const Taylor<double> x = along(t_s);
            const Eigen::Vector3d ahead = Eigen::Vector3d::UnitX();
            return TaylorVector<double>{x.value * ahead + aside_m * Eigen::Vector3d::UnitY(), x.first * ahead,
                                        x.second * ahead};
          }};
}

Hanging still(CarrierId id, double aside_m) {
  return on_a_line(id, aside_m, 0.0, [](double) { return constant(0.0); });
}

constexpr double kEnd_s = 64.0;  // cells are a second wide and have their midpoint at .5 s

TEST(Separation, a_fall_with_all_of_the_acceleration_after_the_last_midpoint_is_found) {
  // It waits a metre away, steps back by 28 mm, and falls towards the other from the last midpoint on: by 50 mm.
  constexpr double kBack_m = 0.028, kAcceleration_m_s2 = 0.4, kFall_s = 0.5;
  const Hanging falling = on_a_line(2, 0.0, kAcceleration_m_s2, [](double t_s) {
    if (t_s < kEnd_s - kFall_s) return constant(1.0) + kBack_m * smooth_step(t_s - 58.0, 5.0);
    const double fallen_s = t_s - (kEnd_s - kFall_s);
    return Taylor<double>{1.0 + kBack_m - 0.5 * kAcceleration_m_s2 * fallen_s * fallen_s,
                          -kAcceleration_m_s2 * fallen_s, -kAcceleration_m_s2};
  });
  const Approach s = separation({still(1, 0.0), falling}, 0.0, kEnd_s).value();
  EXPECT_NEAR(s.min_m, 1.0 + kBack_m - 0.5 * kAcceleration_m_s2 * kFall_s * kFall_s, 2.0 * kSeparationSlack_m);
}

TEST(Separation, a_visit_between_two_midpoints_is_found) {
  // Three metres away at every midpoint; in between it comes as close as half a metre, and the other pair is at one.
  constexpr double kVisit_m = 2.5, kLeaves_s = 20.5;
  const Hanging visitor = on_a_line(3, 0.0, 2.0 * kPi * kPi * kVisit_m, [](double t_s) {
    if (t_s < kLeaves_s || t_s > kLeaves_s + 1.0) return constant(3.0);
    const Taylor<double> swing = oscillation(0.5, -0.5, 2.0 * kPi, 0.5 * kPi, t_s - kLeaves_s);
    return constant(3.0) - kVisit_m * swing;
  });
  const Approach s = separation({still(1, 0.0), still(2, 1.0), visitor}, 0.0, kEnd_s).value();
  EXPECT_NEAR(s.min_m, 0.5, 2.0 * kSeparationSlack_m);
  EXPECT_EQ(s.first, 1U);
  EXPECT_EQ(s.second, 3U);
}

// --- segments ---

Eigen::Vector3d place(double size) {
  return {real(-size, size), real(-size, size), real(-size, size)};
}

RC_GTEST_PROP(Segments, no_two_points_are_closer_than_the_closest, ()) {
  const Segment x{place(2.0), place(2.0), 1.0};
  const Segment y{place(2.0), place(2.0), real(0.0, 1.0) < 0.5 ? 1.0 : std::numeric_limits<double>::infinity()};
  const ClosestPoints closest = closest_points(x, y);
  RC_ASSERT((x.at(closest.s) - y.at(closest.t) - closest.apart).norm() < 1e-12);
  const double end = std::isfinite(y.reach) ? 1.0 : 20.0;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= 100; ++i) {
    for (int j = 0; j <= 100; ++j) least = std::min(least, (x.at(0.01 * i) - y.at(0.01 * j * end)).norm());
  }
  RC_ASSERT(closest.apart.norm() <= least + 1e-12);
  RC_ASSERT(closest.apart.norm() >= least - 0.01 * (x.along.norm() + end * y.along.norm()));
}

TEST(Segments, PointsParallelsAndSegmentsOnOneLine) {
  const auto apart = [](const Segment& x, const Segment& y) { return closest_points(x, y).apart.norm(); };
  const Eigen::Vector3d e = Eigen::Vector3d::UnitX();
  const Segment unit{Eigen::Vector3d::Zero(), e, 1.0};
  EXPECT_DOUBLE_EQ(apart(unit, {3.0 * e, Eigen::Vector3d::Zero(), 1.0}), 2.0);
  EXPECT_DOUBLE_EQ(apart({3.0 * e, Eigen::Vector3d::Zero(), 1.0}, unit), 2.0);
  EXPECT_DOUBLE_EQ(apart(unit, {3.0 * e, e, 1.0}), 2.0);
  EXPECT_DOUBLE_EQ(apart(unit, {3.0 * e, -e, 1.0}), 1.0);
  EXPECT_DOUBLE_EQ(apart({4.0 * e, -e, std::numeric_limits<double>::infinity()}, unit), 0.0);
  EXPECT_DOUBLE_EQ(apart(unit, {0.5 * e + 2.0 * Eigen::Vector3d::UnitZ(), e, 1.0}), 2.0);
}

// --- the load's hull ---

RC_GTEST_PROP(LoadHull, a_place_is_as_far_off_as_the_nearest_direction_of_the_load, ()) {
  const Eigen::Vector3d half(real(0.2, 1.0), real(0.2, 1.0), real(0.2, 1.0));
  const auto hull = box_hull(half, Eigen::Vector3d::Zero());
  // At a corner, on an edge, on the top, or above it.
  const double x = real(0.0, 1.0) < 0.5 ? half.x() : real(-half.x(), half.x());
  const double y = real(0.0, 1.0) < 0.5 ? half.y() : real(-half.y(), half.y());
  const Eigen::Vector3d attachment(x, y, half.z() + (real(0.0, 1.0) < 0.5 ? 0.0 : 0.3));
  const auto cone = LoadCone::seen_from(attachment, hull);
  RC_ASSERT(cone.has_value());
  const Eigen::Vector3d carrier = place(3.0);
  const Eigen::Vector3d off = cone->off(carrier);
  // Nothing of the cone is on this side of the plane through the nearest point, and that point is in the cone.
  for (const Eigen::Vector3d& corner : hull) RC_ASSERT(off.dot(corner - attachment) <= 1e-9);
  RC_ASSERT(std::abs(off.dot(carrier - off)) <= 1e-9 * carrier.squaredNorm());
  RC_ASSERT(cone->off(carrier - off).norm() <= 1e-9 * carrier.norm());
}

TEST(LoadHull, OfABoxByHand) {
  const auto hull = box_hull({1.0, 1.0, 0.5}, Eigen::Vector3d::Zero());
  const auto off = [&hull](const Eigen::Vector3d& attachment, const Eigen::Vector3d& carrier) {
    return LoadCone::seen_from(attachment, hull).value().off(carrier);
  };
  EXPECT_LT((off({0, 0, 0.5}, {3, 4, 2}) - Eigen::Vector3d(0, 0, 2)).norm(), 1e-12) << "above a face";
  EXPECT_LT((off({1, 0, 0.5}, {3, 4, 2}) - Eigen::Vector3d(3, 0, 2)).norm(), 1e-12) << "off an edge";
  EXPECT_LT((off({1, 1, 0.5}, {3, 4, 2}) - Eigen::Vector3d(3, 4, 2)).norm(), 1e-12) << "off a corner";
  EXPECT_EQ(off({0, 0, 0.5}, {3, 4, -1}).norm(), 0.0) << "through the load";
  EXPECT_FALSE(LoadCone::seen_from({0.2, 0.1, 0.4}, hull).has_value()) << "inside";
}

// --- cables ---

std::vector<Hanging> hanging(const Plan& plan, const std::vector<CarrierSlice>& all, const Certificate& certificate) {
  std::vector<Hanging> out;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const CarrierFigures& figures = certificate.carriers[i];
    out.push_back({all[i].id, all[i].attachment_w_m, plan.carriers[i].radius_m, figures.altitude_m.min,
                   figures.acceleration_max_m_s2,
                   [&slice = all[i]](double t_s) { return evaluate(slice, t_s).position_w_m; }});
  }
  return out;
}

/// How far the first may stray before it touches the second, by the words of clearance.hpp, at one moment.
double stray(const CarrierSlice& first, const CarrierSlice& second, double radius_m, double t_s) {
  const Eigen::Vector3d p = evaluate(first, t_s).position_w_m.value;
  const Eigen::Vector3d q = evaluate(second, t_s).position_w_m.value;
  const Segment other{second.attachment_w_m, q - second.attachment_w_m, 1.0};
  double least = closest_points({p, Eigen::Vector3d::Zero(), 1.0}, other).apart.norm() - radius_m;
  const auto at = [&](double a) {  // convex in 1 / a: narrowed down by thirds
    const Eigen::Vector3d x = first.attachment_w_m + a * (p - first.attachment_w_m);
    const Segment below{second.attachment_w_m, a * (q - second.attachment_w_m), 1.0};  // b <= a
    return closest_points({x, Eigen::Vector3d::Zero(), 1.0}, below).apart.norm() / a;
  };
  double low = 1e-3;
  double high = 1.0;
  for (int k = 0; k < 50; ++k) {
    const double a = low + (high - low) / 3.0;
    const double b = high - (high - low) / 3.0;
    (at(a) < at(b) ? high : low) = at(a) < at(b) ? b : a;
  }
  least = std::min(least, at(high));
  return least;
}

// In CMakeLists.txt: 2000 cases.
RC_GTEST_PROP(Clearance, is_below_every_sample_and_attained_where_it_says, ()) {
  RandomPlan wish;
  wish.carriers_min = 2;
  Plan plan = random_plan(wish);
  const bool radii = real(0.0, 1.0) < 0.5;
  for (Carrier& carrier : plan.carriers) carrier.radius_m = radii ? real(0.0, 0.05) : 0.0;
  const Certificate figures = certify(plan, {false, false, false});
  const std::vector<CarrierSlice> all = slices(plan);
  const std::vector<Hanging> carriers = hanging(plan, all, figures);
  const Approach apart = cable_distance(carriers, 0.0, figures.period_s).value();
  const Approach clear = clearance(carriers, {}, 0.0, figures.period_s).value();

  if (!braids(all, figures.period_s).empty()) RC_ASSERT(clear.min_m == 0.0 && apart.min_m == 0.0);

  const auto cable = [&](std::size_t i, double t_s) {
    const Eigen::Vector3d& attachment = all[i].attachment_w_m;
    return Segment{attachment, evaluate(all[i], t_s).position_w_m.value - attachment, 1.0};
  };
  sample(0.0, figures.period_s, 8, [&](double t_s) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      for (std::size_t j = 0; j < all.size(); ++j) {
        if (i == j) continue;
        RC_ASSERT(apart.min_m <= closest_points(cable(i, t_s), cable(j, t_s)).apart.norm());
        RC_ASSERT(clear.min_m <= std::max(0.0, stray(all[i], all[j], plan.carriers[i].radius_m, t_s)));
      }
    }
  });
  // So the truth is between the bound and what is attained: at most 1 % apart.
  const auto attained = closest_points(cable(apart.first - 1, apart.at_s), cable(apart.second - 1, apart.at_s));
  RC_ASSERT(apart.min_m >= 0.99 * attained.apart.norm() - kTouch_m);
  double strays =
      stray(all[clear.first - 1], all[clear.second - 1], plan.carriers[clear.first - 1].radius_m, clear.at_s);
  if (clear.what == Touch::kVehicles) {
    strays = (evaluate(all[clear.first - 1], clear.at_s).position_w_m.value -
              evaluate(all[clear.second - 1], clear.at_s).position_w_m.value)
                 .norm() -
             plan.carriers[clear.first - 1].radius_m - plan.carriers[clear.second - 1].radius_m;
  }
  RC_ASSERT(std::max(0.0, strays) >= clear.min_m - 10.0 * kTouch_m);
  RC_ASSERT(clear.min_m >= 0.99 * strays - 10.0 * kTouch_m);  // narrowed down by thirds is not exact
}

TEST(Clearance, VehiclesAreAsBigAsTheyAre) {
  // Two carriers a metre apart on parallel cables of two metres; the second one's vehicle is big.
  const auto at = [](CarrierId id, double x, double z, double radius_m) {
    return Hanging{id, {x, 0.0, 0.0}, radius_m,
                   z,  0.0,           [x, z](double) {
                     return constant_vector<double>({x, 0.0, z}); }};
  };
  const auto what = [&](double z, double first_m, double second_m) {
    return clearance({at(1, 0.0, 2.0, first_m), at(2, 1.0, z, second_m)}, {}, 0.0, 1.0).value();
  };
  EXPECT_NEAR(what(2.0, 0.0, 0.0).min_m, 1.0, 0.01);
  EXPECT_EQ(what(2.0, 0.0, 0.0).what, Touch::kStrayingCable);
  EXPECT_NEAR(what(2.0, 0.1, 0.3).min_m, 0.6, 0.006);
  EXPECT_EQ(what(2.0, 0.1, 0.3).what, Touch::kVehicles);
  EXPECT_NEAR(what(1.0, 0.1, 0.3).min_m, 0.7, 0.007) << "lower, it is beside the other's cable";
  EXPECT_EQ(what(1.0, 0.1, 0.3).what, Touch::kVehicleAndCable);
  EXPECT_EQ(what(1.0, 0.1, 1.3).min_m, 0.0);
  EXPECT_NEAR(above_load({at(1, 0.0, 2.0, 0.5)}, box_hull({1, 1, 0.4}, {0, 0, 0})).value(), 1.1, 1e-12);
  EXPECT_FALSE(clearance({at(1, 0.0, 2.0, 0.5)}, {}, 0.0, 1.0).has_value()) << "nothing to touch";
}

TEST(Clearance, OfACableFromTheLoadIsHowFarItsCarrierIsOffTheLoadsFaces) {
  const auto hull = box_hull({1.0, 1.0, 0.5}, Eigen::Vector3d::Zero());
  const auto carrier = [](const Eigen::Vector3d& attachment) {
    // From straight above down to 30 degrees, inwards over the box, and back.
    return Hanging{1, attachment, 0.0, 0.0, 10.0, [attachment](double t_s) {
                     const Taylor<double> angle = oscillation(kPi / 3.0, kPi / 6.0, 1.0, kPi / 2.0, t_s);
                     const double s = std::sin(angle.value), c = std::cos(angle.value);
                     TaylorVector<double> p;
                     p.value = attachment + 2.0 * Eigen::Vector3d(-c, 0.0, s);
                     p.first = 2.0 * angle.first * Eigen::Vector3d(s, 0.0, c);
                     return p;
                   }};
  };
  const Approach top = clearance({carrier({1.0, 0.0, 0.5})}, hull, 0.0, 2.0 * kPi).value();
  EXPECT_NEAR(top.min_m, 1.0, 0.01);
  EXPECT_EQ(top.what, Touch::kCableAndLoad);
  EXPECT_NEAR(std::fmod(top.at_s, 2.0 * kPi), kPi, 0.2);
  EXPECT_EQ(clearance({carrier({1.0, 0.0, 0.0})}, hull, 0.0, 2.0 * kPi)->min_m, 0.0) << "attached at the side";
}

}  // namespace
}  // namespace gyre::mechanics::test
