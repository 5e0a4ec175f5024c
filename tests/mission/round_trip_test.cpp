// A mission written and read again is the same mission; absent stays absent.

#include <gtest/gtest.h>

#include <set>

#include "common/mechanics/carrier_slice.hpp"
#include "common/mission/mission.hpp"
#include "tests/mission/sample_missions.hpp"

namespace gyre::test {
namespace {

using mission::Mission;

Mission parsed(const std::string& text) {
  Result<Mission> result = mission::parse_mission(text, "round-trip");
  if (!result) {
    ADD_FAILURE() << result.error().text << "\nin\n" << text;
    return {};
  }
  return std::move(result).value();
}

void expect_same_vehicle(const mechanics::Vehicle& a, const mechanics::Vehicle& b) {
  EXPECT_EQ(a.mass_kg, b.mass_kg);
  EXPECT_EQ(a.thrust_max_n, b.thrust_max_n);
  ASSERT_EQ(a.bank_max_rad.has_value(), b.bank_max_rad.has_value());
  EXPECT_NEAR(a.bank_max_rad.value_or(0.0), b.bank_max_rad.value_or(0.0), 1e-15);  // degrees in the file
  EXPECT_EQ(a.time_constant_s, b.time_constant_s);
}

void expect_same_plan(const mechanics::Plan& a, const mechanics::Plan& b) {
  EXPECT_EQ(a.load.mass_kg, b.load.mass_kg);
  EXPECT_EQ(a.load.inertia_b_kg_m2, b.load.inertia_b_kg_m2);
  EXPECT_EQ(a.load.position_w_m, b.load.position_w_m);
  EXPECT_LT(a.load.orientation_w_b.angularDistance(b.load.orientation_w_b), 1e-15);
  EXPECT_EQ(a.gravity_m_s2, b.gravity_m_s2);
  EXPECT_EQ(a.cable.stiffness_n_m, b.cable.stiffness_n_m);
  EXPECT_EQ(a.cable.damping_n_s_m, b.cable.damping_n_s_m);
  EXPECT_EQ(a.cable.compensate_stretch, b.cable.compensate_stretch);
  ASSERT_EQ(a.carriers.size(), b.carriers.size());
  for (std::size_t i = 0; i < a.carriers.size(); ++i) {
    EXPECT_EQ(a.carriers[i].id, b.carriers[i].id);
    EXPECT_EQ(a.carriers[i].attachment_b_m, b.carriers[i].attachment_b_m);
    const mechanics::LengthLaw& law_a = a.carriers[i].law;
    const mechanics::LengthLaw& law_b = b.carriers[i].law;
    EXPECT_EQ(a.carriers[i].radius_m, b.carriers[i].radius_m);
    expect_same_vehicle(a.carriers[i].vehicle, b.carriers[i].vehicle);
    EXPECT_EQ(law_a.kind, law_b.kind);
    EXPECT_LT((law_a.direction - law_b.direction).norm(), 1e-15);  // normalised again on reading
    EXPECT_EQ(law_a.profile.mean, law_b.profile.mean);
    EXPECT_EQ(law_a.profile.swing, law_b.profile.swing);
    EXPECT_EQ(law_a.profile.phase_rad, law_b.profile.phase_rad);
    EXPECT_EQ(law_a.profile.harmonic.numerator, law_b.profile.harmonic.numerator);
    EXPECT_EQ(law_a.profile.harmonic.denominator, law_b.profile.harmonic.denominator);
  }
  EXPECT_EQ(a.cycle.rate_rad_s, b.cycle.rate_rad_s);
  ASSERT_EQ(a.cycle.edges.size(), b.cycle.edges.size());
  for (std::size_t j = 0; j < a.cycle.edges.size(); ++j) {
    EXPECT_EQ(a.cycle.edges[j].from, b.cycle.edges[j].from);
    EXPECT_EQ(a.cycle.edges[j].to, b.cycle.edges[j].to);
    EXPECT_EQ(a.cycle.edges[j].offset_n, b.cycle.edges[j].offset_n);
    EXPECT_EQ(a.cycle.edges[j].amplitude_n, b.cycle.edges[j].amplitude_n);
    EXPECT_EQ(a.cycle.edges[j].phase_rad, b.cycle.edges[j].phase_rad);
  }
  EXPECT_EQ(a.limits.tension_min_n, b.limits.tension_min_n);
  EXPECT_EQ(a.limits.tension_max_n, b.limits.tension_max_n);
  EXPECT_EQ(a.limits.length_min_m, b.limits.length_min_m);
  EXPECT_EQ(a.limits.length_max_m, b.limits.length_max_m);
  EXPECT_EQ(a.limits.winch_rate_max_m_s, b.limits.winch_rate_max_m_s);
  EXPECT_EQ(a.limits.speed_min_m_s, b.limits.speed_min_m_s);
  EXPECT_EQ(a.limits.speed_max_m_s, b.limits.speed_max_m_s);
  EXPECT_EQ(a.limits.acceleration_max_m_s2, b.limits.acceleration_max_m_s2);
  EXPECT_EQ(a.limits.separation_min_m, b.limits.separation_min_m);
  EXPECT_EQ(a.limits.clearance_min_m, b.limits.clearance_min_m);
  EXPECT_EQ(a.limits.vertical_cosine_min, b.limits.vertical_cosine_min);
  ASSERT_EQ(a.load.hull_b_m.size(), b.load.hull_b_m.size());
  for (std::size_t i = 0; i < a.load.hull_b_m.size(); ++i) {
    EXPECT_LT((a.load.hull_b_m[i] - b.load.hull_b_m[i]).norm(), 1e-15);  // a box is written by its edges and centre
  }
  EXPECT_EQ(a.winch.time_constant_s, b.winch.time_constant_s);
  EXPECT_EQ(a.winch.rate_max_m_s, b.winch.rate_max_m_s);
  EXPECT_EQ(a.winch.acceleration_max_m_s2, b.winch.acceleration_max_m_s2);
}

void expect_same(const Mission& a, const Mission& b) {
  EXPECT_EQ(a.name, b.name);
  expect_same_plan(a.plan, b.plan);
  EXPECT_EQ(a.simulation.lag_error, b.simulation.lag_error);
  EXPECT_EQ(a.simulation.carrier_time_constant_s, b.simulation.carrier_time_constant_s);
  ASSERT_EQ(a.simulation.wind.has_value(), b.simulation.wind.has_value());
  if (a.simulation.wind) {
    EXPECT_EQ(a.simulation.wind->force_w_n, b.simulation.wind->force_w_n);
    EXPECT_EQ(a.simulation.wind->gust_n, b.simulation.wind->gust_n);
    EXPECT_EQ(a.simulation.wind->gust_time_s, b.simulation.wind->gust_time_s);
    EXPECT_EQ(a.simulation.wind->seed, b.simulation.wind->seed);
  }
  EXPECT_EQ(a.holds, b.holds);
  EXPECT_EQ(a.transition_duration_s, b.transition_duration_s);
  EXPECT_EQ(a.silence.stop_after, b.silence.stop_after);
  EXPECT_EQ(a.load_tolerance.displacement_max_m, b.load_tolerance.displacement_max_m);
  EXPECT_EQ(a.load_tolerance.rotation_max_deg, b.load_tolerance.rotation_max_deg);
}

TEST(RoundTrip, AMissionWithEverything) {
  const Mission mission = parsed(replaced(kGoodMission, "z: 1.2 }", "z: 1.2 xy: 0.1 xz: -0.05 yz: 0.02 }"));
  expect_same(mission, parsed(mission::to_text(mission)));
}

TEST(RoundTrip, SilenceInEveryForm) {
  const auto with = [](const std::string& silence) {
    return parsed(replaced(kGoodMission, "silence { fly_on {} }", silence));
  };
  const std::pair<const char*, std::optional<Duration>> forms[] = {
      {"", std::chrono::seconds(5)},
      {"silence { fly_on {} }", std::nullopt},
      {"silence { stop_after_s: 2 }", protocol::kShortestLease},
      {"silence { stop_after_s: 7.25 }", std::chrono::milliseconds(7250)},
      {"silence { stop_after_s: 600 }", protocol::kLongestLease},
  };
  for (const auto& [text, stop_after] : forms) {
    SCOPED_TRACE(text);
    const Mission mission = with(text);
    EXPECT_EQ(mission.silence.stop_after, stop_after);
    expect_same(mission, parsed(mission::to_text(mission)));
  }
}

TEST(RoundTrip, VehiclesThatHoldAndVehiclesThatGoOn) {
  std::string text = replaced(kGoodMission, "mass_kg: 2.5", "mass_kg: 2.5 on_silence: GO_ON");
  text = replaced(text, "length_m: 11 }", "length_m: 11 } vehicle { on_silence: HOLD }");
  text = replaced(text, "phase_rad: 0.2 }", "phase_rad: 0.2 } vehicle {}");
  text = replaced(text, "mean_m: 12 }", "mean_m: 12 } vehicle { on_silence: HOLD }");
  const Mission mission = parsed(text);
  EXPECT_EQ(mission.holds, (std::set<CarrierId>{2, 4}));
  expect_same(mission, parsed(mission::to_text(mission)));
}

TEST(RoundTrip, AHullThatIsNoBox) {
  const std::string box = "box { x_m: 1.8 y_m: 1.7 z_m: 0.35 centre_m { z: 0.075 } }";
  const Mission mission = parsed(replaced(
      kGoodMission, box, "hull { vertex_m { x: 1 } vertex_m { y: 1 } vertex_m { x: -1 } vertex_m { z: 0.3 } }"));
  EXPECT_EQ(mission.plan.load.hull_b_m.size(), 4u);
  expect_same(mission, parsed(mission::to_text(mission)));
}

TEST(RoundTrip, EveryShippedMission) {
  for (const std::string& name : kShippedMissions) {
    SCOPED_TRACE(name);
    const Mission mission = parsed(file_text(shipped_path(name)));
    expect_same(mission, parsed(mission::to_text(mission)));
  }
}

TEST(Reading, AllIsWhereTheFileSays) {
  const Mission mission = parsed(kGoodMission);
  const mechanics::Plan& plan = mission.plan;
  EXPECT_EQ(mission.name, "good");
  EXPECT_EQ(plan.load.position_w_m, Eigen::Vector3d(0, 0, 4));
  EXPECT_EQ(plan.carriers[3].attachment_b_m, Eigen::Vector3d(0, -0.85, 0.25));
  EXPECT_EQ(plan.carriers[0].law.kind, mechanics::LengthLaw::Kind::kLevel);
  EXPECT_EQ(plan.carriers[1].law.kind, mechanics::LengthLaw::Kind::kFixed);
  EXPECT_EQ(plan.carriers[2].law.kind, mechanics::LengthLaw::Kind::kSine);
  EXPECT_EQ(plan.carriers[2].law.profile.harmonic.numerator, 3);
  EXPECT_EQ(plan.carriers[2].law.profile.harmonic.denominator, 2);
  EXPECT_EQ(plan.carriers[3].law.kind, mechanics::LengthLaw::Kind::kDirectional);
  EXPECT_NEAR(plan.carriers[3].law.direction.norm(), 1.0, 1e-15);
  EXPECT_EQ(plan.cycle.edges[2].phase_rad, 2.1);
  EXPECT_EQ(plan.limits.tension_max_n, 50.0);
  EXPECT_EQ(plan.limits.speed_min_m_s, std::nullopt);
  EXPECT_EQ(plan.winch.rate_max_m_s, 2.0);
  EXPECT_EQ(plan.winch.acceleration_max_m_s2, 9.0);
  EXPECT_EQ(plan.limits.clearance_min_m, 0.5);
  EXPECT_LT((plan.load.hull_b_m.front() - Eigen::Vector3d(-0.9, -0.85, -0.1)).norm(), 1e-15);
  EXPECT_LT((plan.load.hull_b_m.back() - Eigen::Vector3d(0.9, 0.85, 0.25)).norm(), 1e-15);
  EXPECT_EQ(plan.carriers[0].radius_m, 0.4);
  EXPECT_EQ(plan.carriers[0].vehicle.mass_kg, 2.5);
  EXPECT_EQ(plan.carriers[0].vehicle.thrust_max_n, 80.0);
  EXPECT_NEAR(plan.carriers[0].vehicle.bank_max_rad.value(), 0.610865, 1e-6);
  EXPECT_EQ(plan.carriers[0].vehicle.time_constant_s, 0.15);
  EXPECT_EQ(mission.simulation.lag_error, 0.2);
  EXPECT_EQ(mission.simulation.wind->force_w_n, Eigen::Vector3d(1, -2, 0));
  EXPECT_EQ(mission.simulation.wind->seed, 7u);
  EXPECT_EQ(mission.transition_duration_s, 20.0);
  EXPECT_EQ(mission.silence.stop_after, std::nullopt);
}

TEST(Reading, WhatAbsenceMeans) {
  const Mission mission = parsed(
      "load { mass_kg: 1 inertia_kg_m2 { x: 1 y: 1 z: 1 } }\n"
      "carrier { id: 1 attachment_m { z: 1 } fixed { length_m: 1 } } cycle { rate_rad_s: 1 }");
  EXPECT_EQ(mission.plan.load.position_w_m, Eigen::Vector3d::Zero());
  EXPECT_EQ(mission.plan.load.orientation_w_b.w(), 1.0);
  EXPECT_EQ(mission.plan.gravity_m_s2, 9.81);
  EXPECT_EQ(mission.plan.cable.stiffness_n_m, 1e4);
  EXPECT_EQ(mission.plan.cable.damping_n_s_m, 1e3);
  EXPECT_TRUE(mission.plan.cable.compensate_stretch);
  EXPECT_EQ(mission.plan.winch.time_constant_s, 0.0);
  EXPECT_EQ(mission.plan.winch.rate_max_m_s, std::nullopt);
  EXPECT_TRUE(mission.plan.load.hull_b_m.empty());
  EXPECT_EQ(mission.plan.carriers[0].radius_m, 0.0);
  EXPECT_EQ(mission.plan.carriers[0].vehicle.mass_kg, std::nullopt);
  EXPECT_EQ(mission.simulation.lag_error, 0.0);
  EXPECT_EQ(mission.simulation.carrier_time_constant_s, std::nullopt);
  EXPECT_FALSE(mission.simulation.wind);
  EXPECT_TRUE(mission.holds.empty());
  EXPECT_EQ(mission.transition_duration_s, std::nullopt);
  EXPECT_EQ(mission.silence.stop_after, Duration(std::chrono::seconds(5)));
}

TEST(Reading, UncompensatedStretchReachesTheSlices) {
  const Mission with = parsed(kGoodMission);
  const Mission without = parsed(replaced(kGoodMission, "compensate_stretch: true", "compensate_stretch: false"));
  EXPECT_EQ(mechanics::slices(with.plan)[0].cable_stiffness_n_m, 1e4);
  EXPECT_EQ(mechanics::slices(without.plan)[0].cable_stiffness_n_m, 0.0);
  EXPECT_EQ(without.plan.cable.stiffness_n_m, 1e4);
}

}  // namespace
}  // namespace gyre::test
