// How still the load hangs, by windows from which no peak is lost.

#include "ground/swarm/core/load_gauge.hpp"

#include <gtest/gtest.h>

#include "common/base/angle.hpp"

namespace gyre::ground {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

class LoadGaugeTest : public testing::Test {
 protected:
  static mechanics::Plan plan() {
    mechanics::Plan plan;
    plan.load.mass_kg = 2.0;
    plan.load.inertia_b_kg_m2 = Eigen::Vector3d(1.0, 2.0, 3.0).asDiagonal();
    plan.load.position_w_m = {1.0, 2.0, 3.0};
    plan.gravity_m_s2 = 10.0;
    plan.carriers.resize(2);
    plan.carriers[0].attachment_b_m = {0.0, 0.5, 0.0};
    plan.carriers[1].attachment_b_m = {0.1, 0.0, 0.0};
    return plan;
  }
  void see(const Eigen::Vector3d& off_w_m) {
    load_.stamp += milliseconds(10);
    load_.position_w_m = plan().load.position_w_m + off_w_m;
    gauge_.see(load_);
  }

  protocol::LoadState load_;
  LoadGauge gauge_{plan()};
};

TEST_F(LoadGaugeTest, AWindowWithoutASampleIsAllZero) {
  const LoadWindow window = gauge_.take();
  EXPECT_EQ(window.samples, 0U);
  EXPECT_EQ(window.displacement_max_m, 0.0);
  EXPECT_TRUE(window.displaced_w_m.isZero());
}

TEST_F(LoadGaugeTest, KeepsThePeakAndWhereToUntilItIsTaken) {
  see({0.001, 0.0, 0.0});
  see({0.0, -0.004, 0.0});
  see({0.0, 0.0, 0.002});
  EXPECT_NEAR(gauge_.displacement_now_m(), 0.002, 1e-12);
  const LoadWindow window = gauge_.take();
  EXPECT_EQ(window.samples, 3U);
  EXPECT_NEAR(window.displacement_max_m, 0.004, 1e-12);
  EXPECT_LT((window.displaced_w_m - Eigen::Vector3d(0.0, -0.004, 0.0)).norm(), 1e-12) << "with its sign";
  EXPECT_EQ(gauge_.window().samples, 0U);
  see({0.001, 0.0, 0.0});
  EXPECT_NEAR(gauge_.take().displacement_max_m, 0.001, 1e-12) << "the next one begins afresh";
}

TEST_F(LoadGaugeTest, TwoWindowsThatFollowEachOtherAreOne) {
  LoadWindow both;
  see({0.003, 0.0, 0.0});
  both.include(gauge_.take());
  see({0.0, 0.001, 0.0});
  load_.orientation_w_b = Eigen::AngleAxisd(radians(0.5), Eigen::Vector3d::UnitY());
  see({0.0, 0.001, 0.0});
  both.include(gauge_.take());
  EXPECT_EQ(both.samples, 3U);
  EXPECT_NEAR(both.displacement_max_m, 0.003, 1e-12);
  EXPECT_NEAR(both.displaced_w_m.x(), 0.003, 1e-12);
  EXPECT_NEAR(both.rotation_max_deg, 0.5, 1e-9);
  EXPECT_NEAR(gauge_.rotation_now_deg(), 0.5, 1e-9);
}

TEST_F(LoadGaugeTest, TheResidualIsNewtons) {
  see(Eigen::Vector3d::Zero());
  load_.velocity_w_m_s.x() = 0.02;
  see(Eigen::Vector3d::Zero());
  EXPECT_NEAR(gauge_.take().residual_max, 0.2, 1e-9) << "2 m/s2 of 2 kg against 20 N";
  see(Eigen::Vector3d::Zero());
  EXPECT_NEAR(gauge_.take().residual_max, 0.0, 1e-12) << "a steady drift";
  load_.angular_velocity_b_rad_s.z() = 0.01;
  see(Eigen::Vector3d::Zero());
  EXPECT_NEAR(gauge_.take().residual_max, 0.3, 1e-9) << "3 kg m2 by 1 rad/s2, at 0.5 m, against 20 N";
  load_.angular_velocity_b_rad_s = {1.0, 1.0, 0.01};
  see(Eigen::Vector3d::Zero());
  (void)gauge_.take();
  see(Eigen::Vector3d::Zero());  // w x J w = (0.01, -0.02, 1) about at that turning, nearly along z
  EXPECT_NEAR(gauge_.take().residual_max, Eigen::Vector3d(0.01, -0.02, 1.0).norm() / 0.5 / 20.0, 1e-9);
}

TEST_F(LoadGaugeTest, WhatComesOutOfOrderHasNoRateOfChange) {
  see(Eigen::Vector3d::Zero());
  load_.velocity_w_m_s.x() = 9.0;
  load_.stamp -= milliseconds(20);
  see(Eigen::Vector3d::Zero());
  EXPECT_EQ(gauge_.take().residual_max, 0.0);
}

}  // namespace
}  // namespace gyre::ground
