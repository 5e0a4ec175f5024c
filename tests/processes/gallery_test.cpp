// Every mission that `gyre design` has made for deploy/missions, flown by processes: what the certificate admits is
// also flown as it says. Shortened: for a moment, and with the shortest way from rest that keeps all limits.

#include <regex>

#include "tests/processes/launched.hpp"

namespace gyre::test {
namespace {

class GalleryTest : public ProgramsTest, public testing::WithParamInterface<const char*> {
 protected:
  [[nodiscard]] std::string shortened() const {
    std::ostringstream text;
    text << std::ifstream(shipped_mission(GetParam())).rdbuf();
    std::string path = directory() + "/mission.textproto";
    std::ofstream(path) << std::regex_replace(text.str(), std::regex("\\btransition \\{[^}]*\\}"), "");
    return path;
  }
};

TEST_P(GalleryTest, IsFlownAsItIsCertified) {
  constexpr double kFlight_s = 180.0;  // a bound, not a measure
  Launched flight = gyre({"fly", shortened(), "--duration", "2"});
  EXPECT_EQ(flight.end_within(kFlight_s).exit_code, 0) << flight.said();
  EXPECT_THAT(flight.said(), testing::HasSubstr("GOOD"));
}

INSTANTIATE_TEST_SUITE_P(Designed, GalleryTest,
                         testing::Values("duo", "multirotor-trio", "multirotor-quartet", "multirotor-sextet",
                                         "multirotor-octet", "tilted-quartet", "wing-trio", "wing-quartet",
                                         "wing-quintet", "wing-sextet", "fixed-wing-trio", "pair"),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace gyre::test
