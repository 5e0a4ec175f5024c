// What the page's server decides without a socket: who may come in, what came of a hurt, how a load's shape is drawn.

#include <gtest/gtest.h>

#include <set>

#include "common/mechanics/load_hull.hpp"
#include "ground/page/core/door.hpp"
#include "ground/page/core/hurt_gauge.hpp"
#include "ground/page/core/known_mission.hpp"
#include "ground/page/core/utf8.hpp"
#include "tests/ground/heard_swarm.hpp"

namespace gyre::ground {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

// --------------------------------------------------------------------------------------------------------- the door

TEST(Door, OpensToTheTokenAndToNothingElse) {
  EXPECT_TRUE(same_token("abc123", "abc123"));
  for (const char* wrong : {"", "a", "abc12", "abc1234", "abc123abc123", "ABC123", "abc124", "bbc123"}) {
    EXPECT_FALSE(same_token(wrong, "abc123")) << wrong;
  }
  EXPECT_FALSE(same_token("", "")) << "no token is no key";
  EXPECT_FALSE(same_token("x", ""));
  EXPECT_FALSE(same_token(std::string_view("\0", 1), "")) << "what an empty token might be compared with";
  EXPECT_TRUE(same_token("\xff\x80", "\xff\x80"));
  EXPECT_FALSE(same_token("\xff\x80", "\x7f\x80"));
}

TEST(Door, AddressesAndLocalhostAreOwnHosts) {
  for (const char* host : {"127.0.0.1", "127.0.0.1:8480", "192.168.7.5:80", "localhost", "localhost:8480",
                           "LOCALHOST:8480", "[::1]", "[::1]:8480", "[fe80::1]:1", "[::ffff:127.0.0.1]:8480"}) {
    EXPECT_TRUE(is_own_host(host)) << host;
  }
}

TEST(Door, NamesThatAreMadeToPointHereAreNot) {
  for (const char* host : {"",
                           ":",
                           ":8480",
                           "evil.example",
                           "evil.example:8480",
                           "127.0.0.1.evil.example",
                           "localhost.evil.example",
                           "localhost.",
                           "localhost:",
                           "localhost:http",
                           "127.0.0.1:",
                           "127.0.0.1:84x",
                           "127.0.0.1:8480:8480",
                           "127.0.0.1 ",
                           " 127.0.0.1",
                           "evil.example#127.0.0.1",
                           "user@127.0.0.1",
                           "[::1",
                           "::1",
                           "[]",
                           "[]:80",
                           "[evil.example]:80",
                           "[::1]evil:80",
                           "127.1",
                           "2130706433",
                           "...",
                           "1..2.3",
                           "1.2.3.4.5"}) {
    EXPECT_FALSE(is_own_host(host)) << host;
  }
  EXPECT_FALSE(is_own_host(std::string(100'000, '1')));
}

TEST(Door, ANameThatTheServerWasToldIsItsOwn) {
  const std::vector<std::string> names{"drone-lab.example", "ground"};
  for (const char* host : {"drone-lab.example", "drone-lab.example:8480", "Drone-Lab.Example:8480", "ground:80"}) {
    EXPECT_TRUE(is_own_host(host, names)) << host;
  }
  for (const char* host : {"", ":80", "lab.example", "evil.drone-lab.example", "drone-lab.example.evil.example"}) {
    EXPECT_FALSE(is_own_host(host, names)) << host;
  }
  EXPECT_FALSE(is_own_host("", {""})) << "an empty name is nobody's";
  EXPECT_FALSE(is_own_host(":80", {""}));
}

TEST(Door, OriginIsTheHostsOwnPageOrNoBrowsers) {
  EXPECT_TRUE(is_same_origin("", "127.0.0.1:8480")) << "curl has none";
  EXPECT_TRUE(is_same_origin("http://127.0.0.1:8480", "127.0.0.1:8480"));
  EXPECT_TRUE(is_same_origin("http://[::1]:8480", "[::1]:8480"));
  for (const char* origin : {"null", "http://127.0.0.1", "http://127.0.0.1:8481", "http://localhost:8480",
                             "https://127.0.0.1:8480", "http://evil.example", "http://127.0.0.1:8480.evil.example",
                             "127.0.0.1:8480", "http://", "file://", "http://127.0.0.1:8480/"}) {
    EXPECT_FALSE(is_same_origin(origin, "127.0.0.1:8480")) << origin;
  }
  EXPECT_FALSE(is_same_origin("http://", "")) << "nobody's page at nobody's host";
}

TEST(Door, SoManyAtOnceAndSoManyASecond) {
  RateJudge judge(5.0, 2.0);
  LocalTime now{seconds(100)};
  const auto admitted = [&](int tries) {
    int count = 0;
    for (int i = 0; i < tries; ++i) count += judge.admits(now) ? 1 : 0;
    return count;
  };
  EXPECT_EQ(admitted(100), 5);
  now += seconds(1);
  EXPECT_EQ(admitted(100), 2);
  now += std::chrono::hours(1);
  EXPECT_EQ(admitted(100), 5) << "waiting saves up no more than a burst";
  now -= seconds(10);
  EXPECT_EQ(admitted(100), 0) << "a clock that steps back gives nothing";
  now += milliseconds(500);
  EXPECT_EQ(admitted(100), 1);
}

// --------------------------------------------------------------------------------------------------------- the hurt

class HurtGaugeTest : public testing::Test {
 protected:
  void see(double displacement_m, bool calm, Duration passed = milliseconds(40)) {
    now_ += passed;
    LoadWindow window;
    window.displacement_max_m = displacement_m;
    window.samples = 4;
    gauge_.see(now_, window, calm);
  }
  [[nodiscard]] HurtOutcome outcome() const { return *gauge_.outcome(now_); }

  LocalTime now_{seconds(100)};
  HurtGauge gauge_;
};

TEST_F(HurtGaugeTest, NobodyHasHurtItYet) {
  see(0.5, false);
  EXPECT_FALSE(gauge_.outcome(now_));
}

TEST_F(HurtGaugeTest, ComparesTheSecondBeforeWithWhatCameAfter) {
  see(0.9, true);
  for (int i = 0; i < 30; ++i) see(0.002, true);  // 1.2 s: what was before that does not count
  see(0.003, true);
  gauge_.hurt(now_, "agent 3 was killed");
  EXPECT_EQ(outcome().number, 1U);
  EXPECT_EQ(outcome().text, "agent 3 was killed");
  EXPECT_DOUBLE_EQ(outcome().before_m, 0.003);
  EXPECT_EQ(outcome().moved_max_m, 0.0);
  see(0.001, true);
  see(0.007, true);
  see(0.004, true);
  EXPECT_DOUBLE_EQ(outcome().moved_max_m, 0.007);
  EXPECT_EQ(outcome().since, milliseconds(120));
}

TEST_F(HurtGaugeTest, CalmIsWhenItLastsAndNotBeforeWhatWasHurtCouldShow) {
  gauge_.hurt(now_, "agent 3 was killed");
  for (int i = 0; i < 37; ++i) see(0.0, true);
  EXPECT_FALSE(outcome().calm_after) << "silence is not noticed at once";
  for (int i = 0; i < 10; ++i) see(0.0, false);
  EXPECT_FALSE(outcome().calm_after);
  see(0.0, true);
  ASSERT_TRUE(outcome().calm_after);
  EXPECT_EQ(*outcome().calm_after, milliseconds(48 * 40));
  for (int i = 0; i < 10; ++i) see(0.0, true);
  EXPECT_EQ(*outcome().calm_after, milliseconds(48 * 40)) << "when it became calm, not since when";
  see(0.0, false);
  EXPECT_FALSE(outcome().calm_after) << "it was not the end of it";
}

TEST_F(HurtGaugeTest, TheNextHurtBeginsAnew) {
  gauge_.hurt(now_, "agent 3 was killed");
  for (int i = 0; i < 10; ++i) see(0.01, false);
  gauge_.hurt(now_, "agent 3 was started anew");
  EXPECT_EQ(outcome().number, 2U);
  EXPECT_DOUBLE_EQ(outcome().before_m, 0.01);
  EXPECT_EQ(outcome().moved_max_m, 0.0);
  EXPECT_FALSE(outcome().calm_after);
  EXPECT_EQ(outcome().since, Duration::zero());
}

// --------------------------------------------------------------------------------------------------------- the words

TEST(Utf8, WhatIsTextStaysAsItIs) {
  for (const char* text : {"", "plain", "\x7f", "\xc2\x80", "\xdf\xbf", "\xe0\xa0\x80", "\xed\x9f\xbf", "\xee\x80\x80",
                           "\xef\xbf\xbf", "\xf0\x90\x80\x80", "\xf4\x8f\xbf\xbf", "a\xe2\x82\xac z"}) {
    EXPECT_EQ(utf8(text), text);
  }
  EXPECT_EQ(utf8(std::string_view("a\0b", 3)), std::string("a\0b", 3));
}

TEST(Utf8, WhatIsNoneIsAQuestionMarkForEachByte) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"\x80", "?"},       // follows nothing
      {"\xc0\xaf", "??"},  // longer than it has to be
      {"\xe0\x9f\xbf", "???"},
      {"\xf0\x8f\xbf\xbf", "????"},
      {"\xed\xa0\x80", "???"},       // half of a surrogate pair
      {"\xf4\x90\x80\x80", "????"},  // beyond the last character
      {"\xf5\x80\x80\x80", "????"},
      {"\xff\xfe", "??"},
      {"\xe2\x82", "??"},  // cut off
      {"\xf0\x9f\x98", "???"},
      {"\xc3(", "?("},  // followed by something else
      {"\xe2\x82(", "\?\?("},
  };
  for (const auto& [bytes, text] : cases) EXPECT_EQ(utf8(bytes), text);
}

// ------------------------------------------------------------------------------------------------------- the mission

/// What the triangles enclose, positive where all of them are seen from outside counter-clockwise; and each edge has to
/// be passed once each way, or it is no closed surface.
double enclosed_m3(const std::vector<Eigen::Vector3d>& points, const std::vector<std::uint32_t>& triangles) {
  double volume = 0.0;
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (std::size_t t = 0; t + 2 < triangles.size(); t += 3) {
    const std::uint32_t a = triangles[t], b = triangles[t + 1], c = triangles[t + 2];
    volume += points[a].dot(points[b].cross(points[c])) / 6.0;
    for (const auto& edge : {std::pair{a, b}, {b, c}, {c, a}}) EXPECT_TRUE(edges.insert(edge).second) << "twice";
  }
  for (const auto& [from, to] : edges) EXPECT_EQ(edges.count({to, from}), 1U) << from << " to " << to << " is open";
  return volume;
}

TEST(HullFaces, ABoxIsTwelveTrianglesSeenFromOutside) {
  const Eigen::Vector3d half(0.9, 0.6, 0.2), centre(5.0, -3.0, 2.0);
  const auto box = mechanics::box_hull(half, centre);
  const auto faces = hull_faces(box);
  ASSERT_EQ(faces.size(), 36U);
  EXPECT_NEAR(enclosed_m3(box, faces), 8.0 * half.prod(), 1e-12);
  for (std::size_t t = 0; t < faces.size(); t += 3) {
    const Eigen::Vector3d &a = box[faces[t]], &b = box[faces[t + 1]], &c = box[faces[t + 2]];
    const Eigen::Vector3d normal = (b - a).cross(c - a);
    EXPECT_GT(normal.dot((a + b + c) / 3.0 - centre), 0.0);
  }
}

TEST(HullFaces, WhatIsNoCornerIsInNoTriangle) {
  std::vector<Eigen::Vector3d> points = mechanics::box_hull({1.0, 1.0, 1.0}, Eigen::Vector3d::Zero());
  const std::size_t corners = points.size();
  points.insert(points.end(), {{1.0, 0.0, 0.0},    // within a face
                               {1.0, 1.0, 0.3},    // on an edge
                               {0.0, 0.0, 1.0},    // in the middle of a face
                               {0.2, 0.1, -0.3},   // inside
                               {1.0, 1.0, 1.0}});  // a corner, again
  const auto faces = hull_faces(points);
  EXPECT_EQ(faces.size(), 36U);
  std::set<std::pair<double, std::pair<double, double>>> used;
  for (const std::uint32_t i : faces) used.insert({points[i].x(), {points[i].y(), points[i].z()}});
  EXPECT_EQ(used.size(), corners);
}

TEST(HullFaces, PointsOnASphereAreAllCorners) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 40; ++i) {  // a spiral from pole to pole
    const double z = 1.0 - 2.0 * (i + 0.5) / 40.0, angle = 2.4 * i, r = std::sqrt(1.0 - z * z);
    points.push_back({r * std::cos(angle), r * std::sin(angle), z});
  }
  const auto faces = hull_faces(points);
  EXPECT_EQ(faces.size(), 3U * (2U * 40U - 4U)) << "Euler: 2 n - 4 triangles";
  const double volume = enclosed_m3(points, faces);
  EXPECT_GT(volume, 3.5);
  EXPECT_LT(volume, 4.0 * kPi / 3.0);
}

TEST(HullFaces, WhatHasNoVolumeHasNoneOrIsClosed) {
  EXPECT_TRUE(hull_faces({}).empty());
  EXPECT_TRUE(hull_faces({{1.0, 2.0, 3.0}}).empty());
  EXPECT_TRUE(hull_faces(std::vector<Eigen::Vector3d>(9, {1.0, 2.0, 3.0})).empty());
  EXPECT_TRUE(hull_faces({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}).empty()) << "a line";
  EXPECT_TRUE(hull_faces({{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}).empty()) << "a plane";
}

TEST(KnownMission, IsReadCertifiedAndKeepsItsPlansNumber) {
  const test::HeardSwarm swarm;
  const auto known = know(swarm.text);
  ASSERT_TRUE(known);
  EXPECT_EQ(known->plan, test::kMotion);
  EXPECT_EQ(known->mission.name, "polygon");
  EXPECT_NEAR(known->certificate.period_s, 2.0 * kPi / swarm.mission.plan.cycle.rate_rad_s, 1e-9);
  EXPECT_EQ(known->certificate.carriers.size(), 4U);
  for (const char* text : {"", "name: ", "load {}", "\xff\xfe", "nonsense { }"}) {
    EXPECT_FALSE(know({1, test::kMotion, text})) << text;
  }
}

TEST(KnownMission, AnOrbitIsThePathOverOnePeriod) {
  const test::HeardSwarm swarm;
  const auto orbit = orbit_w_m(swarm.mission.plan, 2, 64);
  ASSERT_EQ(orbit.size(), 64U);
  const auto slices = mechanics::slices(swarm.mission.plan);
  const double period_s = mechanics::period_s(swarm.mission.plan);
  for (std::size_t k = 0; k < orbit.size(); ++k) {
    const double t_s = period_s * static_cast<double>(k) / 64.0;
    EXPECT_LT((orbit[k] - mechanics::evaluate(slices[1], t_s).position_w_m.value).norm(), 1e-12);
  }
  EXPECT_TRUE(orbit_w_m(swarm.mission.plan, 9, 64).empty());
}

}  // namespace
}  // namespace gyre::ground
