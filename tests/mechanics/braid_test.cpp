// Cables that pass through each other: the showcase that did, its mirror image, and random ones against the angle that
// carriers sweep about each other.

#include "common/mechanics/braid.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <map>

#include "common/mechanics/certificate.hpp"
#include "tests/mechanics/plans.hpp"

namespace gyre::mechanics::test {
namespace {

/// Three wings whose circles enclose each other (docs/design.md, fact 8): as in tests/data/missions/fixed-wing-braid.
Plan braid(double handed = 1.0) {
  Plan plan;
  plan.load.mass_kg = 10.0;
  plan.load.inertia_b_kg_m2 = Eigen::Vector3d(1.92, 1.92, 1.54).asDiagonal();
  plan.load.position_w_m.z() = 60.0;
  plan.cable = {2e4, 200.0};
  const double places[3][3] = {{0.8, 0.0, 117.0}, {-0.4, 0.693, 121.6}, {-0.4, -0.693, 126.2}};
  const double phases[3] = {2.6178815871646, -1.5707963267948966, 0.5237110664251932};
  for (CarrierId i = 0; i < 3; ++i) {
    plan.carriers.push_back({i + 1, {places[i][0], handed * places[i][1], 2.0}, LengthLaw::level(places[i][2])});
    plan.cycle.edges.push_back({i + 1, (i + 1) % 3 + 1, 4.0, 15.42, phases[i]});
  }
  plan.cycle.rate_rad_s = 0.57;
  return plan;
}

std::vector<Braid> braids_of(const Plan& plan) {
  return braids(slices(plan), period_s(plan));
}

TEST(Braids, ThreeWingsWhoseCirclesEncloseEachOther) {
  const std::vector<Braid> found = braids_of(braid());
  ASSERT_EQ(found.size(), 3U);
  std::map<std::pair<CarrierId, CarrierId>, double> when;
  for (const Braid& b : found) {
    EXPECT_EQ(std::abs(b.winding), 1);
    EXPECT_EQ(b.winding, found.front().winding) << "all the same way round";
    EXPECT_NEAR(b.up_m, 4.3, 0.1);
    EXPECT_GT(b.apart_m, 18.0);
    when[{b.first, b.second}] = b.at_s;
  }
  EXPECT_NEAR((when[{1, 2}]), 3.67, 0.01);
  EXPECT_NEAR((when[{1, 3}]), 7.35, 0.01);
  const double period = period_s(braid());
  EXPECT_NEAR(std::remainder(when[{2, 3}], period), 0.0, 0.01);
}

TEST(Braids, TheMirrorImageWindsTheOtherWay) {
  const std::vector<Braid> one = braids_of(braid());
  const std::vector<Braid> other = braids_of(braid(-1.0));
  ASSERT_EQ(other.size(), one.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(other[i].winding, -one[i].winding);
    EXPECT_NEAR(other[i].at_s, one[i].at_s, 1e-6);
    EXPECT_NEAR(other[i].up_m, one[i].up_m, 1e-6);
  }
}

TEST(Braids, AreRefusedInWords) {
  for (const double handed : {1.0, -1.0}) {
    const Certificate certificate = certify(braid(handed), {true, true, true, false});  // its swings are another matter
    EXPECT_FALSE(certificate.admissible());
    EXPECT_EQ(certificate.clearance->min_m, 0.0);
    EXPECT_EQ(certificate.cable_distance->min_m, 0.0);
    ASSERT_EQ(certificate.reasons.size(), 3U);
    for (const Reason& reason : certificate.reasons) {
      EXPECT_EQ(reason.rule, Rule::kBraid);
      EXPECT_NE(reason.text.find("wind around each other once per period: their cables braid"), std::string::npos);
      EXPECT_NE(reason.text.find("pull them apart by offsets"), std::string::npos);
    }
  }
}

TEST(Braids, OffsetsThatPullTheCirclesApartUnbraidThem) {
  Plan plan = braid();
  for (Edge& edge : plan.cycle.edges) edge.offset_n = 20.0;
  EXPECT_TRUE(braids_of(plan).empty());
}

/// How often b goes around a, in a period, in the horizontal plane: the angle swept over a turn. Absent where samples
/// are too far apart to tell.
std::optional<int> swept(const CarrierSlice& a, const CarrierSlice& b, double period) {
  double swept_rad = 0.0;
  double greatest_rad = 0.0;
  std::optional<double> last;
  sample(0.0, period, 2000, [&](double t_s) {
    const Eigen::Vector3d d = evaluate(b, t_s).position_w_m.value - evaluate(a, t_s).position_w_m.value;
    const double angle = std::atan2(d.y(), d.x());
    const double step = last ? std::remainder(angle - *last, kTwoPi) : 0.0;
    greatest_rad = std::max(greatest_rad, std::abs(step));
    swept_rad += step;
    last = angle;
  });
  if (greatest_rad > 0.5) return std::nullopt;
  return static_cast<int>(std::lround(swept_rad / kTwoPi));
}

// In CMakeLists.txt: 2000 cases.
RC_GTEST_PROP(Braids, carriers_at_one_altitude_wind_as_often_as_they_sweep_around_each_other, ()) {
  RandomPlan wish;
  wish.carriers_max = 6;
  wish.mixed_laws = false;
  Plan plan = random_plan(wish);
  double top_m = -std::numeric_limits<double>::infinity();
  for (const Carrier& carrier : plan.carriers) top_m = std::max(top_m, carrier.law.profile.mean);
  for (Carrier& carrier : plan.carriers) carrier.law = LengthLaw::level(top_m);
  const std::vector<CarrierSlice> all = slices(plan);
  std::map<std::pair<CarrierId, CarrierId>, int> winding;
  for (const Braid& b : braids(all, period_s(plan))) winding[{b.first, b.second}] = b.winding;
  int total = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      const std::optional<int> expected = swept(all[i], all[j], period_s(plan));
      if (!expected) continue;
      const auto found = winding.find({all[i].id, all[j].id});
      RC_ASSERT((found == winding.end() ? 0 : std::abs(found->second)) == std::abs(*expected));
      if (*expected != 0) ++total;
    }
  }
  RC_TAG(total > 0 ? "braided" : "free");
}

TEST(Braids, OverSeveralTurnsOfTheCycleEachIsCounted) {
  // The length of one comes and goes over two turns: it is long enough to be passed through in one of them only.
  Plan plan = braid();
  const std::vector<Braid> once = braids_of(plan);
  plan.carriers[0].law = LengthLaw::sine({32.0, 30.0, {1, 2}, 0.0});
  const std::vector<Braid> halved = braids_of(plan);
  ASSERT_FALSE(halved.empty());
  for (const Braid& b : halved) {
    if (b.first == 1) continue;
    EXPECT_EQ(std::abs(b.winding), 2) << "two turns, and the pair has not changed";
  }
}

}  // namespace
}  // namespace gyre::mechanics::test
