// The missions we ship are what their comments say.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "common/mechanics/certificate.hpp"
#include "common/mission/requirements.hpp"
#include "tests/mission/sample_missions.hpp"
#include "tests/places.hpp"

namespace gyre::test {
namespace {

mechanics::Certificate certified(const std::string& name) {
  const Result<mission::Mission> mission = mission::read_mission_file(shipped_path(name));
  if (!mission) {
    ADD_FAILURE() << mission.error().text;
    return {};
  }
  EXPECT_EQ(mission.value().name, name);
  return mechanics::certify(mission.value().plan);
}

bool broken(const mechanics::Certificate& certificate, mechanics::Rule rule) {
  return std::any_of(certificate.reasons.begin(), certificate.reasons.end(),
                     [rule](const mechanics::Reason& reason) { return reason.rule == rule; });
}

TEST(Shipped, EveryFileIsInTheList) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(source_directory() + "/deploy/missions")) {
    if (entry.path().extension() != ".textproto") continue;
    EXPECT_EQ(file_text(entry.path().string()).rfind("# ", 0), 0u) << entry.path() << " has to say what it shows";
    if (entry.path().stem().extension() == ".requirements") continue;
    ++files;
    EXPECT_EQ(std::count(kShippedMissions.begin(), kShippedMissions.end(), entry.path().stem().string()), 1)
        << entry.path();
  }
  EXPECT_EQ(files, kShippedMissions.size());
}

TEST(Shipped, TheVerdictsAreTheIntendedOnes) {
  for (const std::string& name : kShippedMissions) {
    const mechanics::Certificate certificate = certified(name);
    const bool meant_to_be_refused = name == "single" || name == "pair-level" || name == "pair-unrestricted";
    EXPECT_EQ(certificate.admissible(), !meant_to_be_refused)
        << name << ": " << (certificate.reasons.empty() ? "" : certificate.reasons.front().text);
  }
  EXPECT_TRUE(broken(certified("single"), mechanics::Rule::kOneCarrierImpossibility));
  EXPECT_TRUE(broken(certified("pair-level"), mechanics::Rule::kTwoCarrierObstruction));
  EXPECT_TRUE(broken(certified("pair-unrestricted"), mechanics::Rule::kClearance)) << "its cables cross";
  EXPECT_TRUE(broken(certified("pair-unrestricted"), mechanics::Rule::kSwing));
}

TEST(Shipped, OnlyWhatCannotStopOrIsMeantToEndureFliesOnInSilence) {
  for (const std::string& name : kShippedMissions) {
    const Result<mission::Mission> mission = mission::read_mission_file(shipped_path(name));
    ASSERT_TRUE(mission) << name;
    const bool flies_on = name.find("wing") != std::string::npos || name == "paper-enduring";
    EXPECT_EQ(!mission.value().silence.stop_after, flies_on) << name;
  }
}

TEST(Shipped, TheWingedTrioKeepsFlyingAndApart) {
  const mechanics::Certificate certificate = certified("fixed-wing-trio");
  EXPECT_GE(certificate.separation->min_m, 6.0);
  for (const mechanics::CarrierFigures& carrier : certificate.carriers) {
    EXPECT_GE(carrier.speed_m_s.min, 12.0);
    EXPECT_LE(carrier.acceleration_max_m_s2, 12.0);
    EXPECT_GE(carrier.length_m.min, 20.0);
  }
}

TEST(Shipped, WhatWasDesignedIsWhatWasAskedFor) {
  for (const std::string& name : kDesignedMissions) {
    const Result<mission::Requirements> asked = mission::read_requirements_file(shipped_path(name + ".requirements"));
    const Result<mission::Mission> designed = mission::read_mission_file(shipped_path(name));
    ASSERT_TRUE(asked && designed) << name << (asked ? "" : asked.error().text);
    const mechanics::Plan& wanted = asked.value().mission.plan;
    mechanics::Plan plan = designed.value().plan;
    plan.limits = wanted.limits;
    plan.winch = wanted.winch;
    ASSERT_EQ(plan.carriers.size(), wanted.carriers.size()) << name;
    for (std::size_t i = 0; i < plan.carriers.size(); ++i) {
      EXPECT_EQ(plan.carriers[i].attachment_b_m, wanted.carriers[i].attachment_b_m) << name;
      EXPECT_EQ(plan.carriers[i].radius_m, wanted.carriers[i].radius_m) << name;
    }
    EXPECT_EQ(plan.load.mass_kg, wanted.load.mass_kg) << name;
    EXPECT_TRUE(mechanics::certify(plan).admissible()) << name;
    EXPECT_GT(wanted.limits.clearance_min_m.value_or(0.0), 0.0) << name;
  }
}

TEST(Shipped, TheSixMultirotorsKeepApart) {
  EXPECT_GE(certified("hex-multirotor").separation->min_m, 1.5);
}

TEST(Shipped, HeadingsAsPhasesGiveSevenTimesTheGuaranteedSpeed) {
  const auto slowest = [](const mechanics::Certificate& certificate) {
    double speed = std::numeric_limits<double>::infinity();
    for (const mechanics::CarrierFigures& carrier : certificate.carriers)
      speed = std::min(speed, carrier.speed_m_s.min);
    return speed;
  };
  EXPECT_GT(slowest(certified("paper-headings")), 7.0 * slowest(certified("paper")));
}

}  // namespace
}  // namespace gyre::test
