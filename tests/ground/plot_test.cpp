// A mission's picture: it is an SVG, everything is in it, in its place, and all that is written can be read.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "common/mechanics/certificate.hpp"
#include "common/mission/mission.hpp"
#include "ground/plot/core/labels.hpp"
#include "ground/plot/core/plot_svg.hpp"
#include "ground/plot/core/scale.hpp"
#include "ground/plot/core/svg.hpp"
#include "ground/plot/core/view.hpp"
#include "tests/ground/svg_reader.hpp"
#include "tests/mechanics/plans.hpp"
#include "tests/places.hpp"

namespace gyre::test {
namespace {

using ground::Box;
using ground::Point;
using mechanics::Plan;

mission::Mission shipped(const std::string& name) {
  return mission::read_mission_file(source_directory() + "/deploy/missions/" + name + ".textproto").value();
}

std::string picture(const std::string& name, const Plan& plan) {
  return ground::plot_svg(name, plan, mechanics::certify(plan));
}

SvgFile drawn(const Plan& plan, const std::string& name = "a mission") {
  SvgFile file = read_svg(picture(name, plan));
  EXPECT_EQ(file.complaint, "");
  return file;
}

const std::vector<std::string> kShipped{"fixed-wing-trio", "hex-multirotor", "pair",   "pair-level", "paper",
                                        "paper-fixed",     "penta-tilted",   "single", "tri-mixed"};

std::vector<Plan> plans() {
  std::vector<Plan> out;
  for (const std::string& name : kShipped) out.push_back(shipped(name).plan);
  for (const std::size_t n : {3, 12, 13, 64}) out.push_back(mechanics::test::polygon_plan(n));
  return out;
}

std::string tone_of(std::size_t index) {
  return ground::carrier_tone(index).name;
}

std::vector<Point> points_of(const Element& element) {
  std::vector<Point> out;
  std::istringstream words(element.attributes.at("points"));
  char comma = 0;
  for (Point point; words >> point.x >> comma >> point.y;) out.push_back(point);
  return out;
}

/// Where the words of a text are.
Box place_of(const Element& text) {
  const double size = text.number("font-size");
  const double width = ground::width_of(text.text, size);
  const auto anchor = text.attributes.find("text-anchor");
  const double share = anchor == text.attributes.end() ? 0.0 : anchor->second == "middle" ? 0.5 : 1.0;
  const double left = text.number("x") - share * width;
  return {left, text.number("y") - 0.72 * size, left + width, text.number("y")};
}

std::string overlap(const SvgFile& file) {
  const std::vector<Element> texts = file.all("text");
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const Box a = place_of(texts[i]);
    if (a.left < 0.0 || a.right > 1000.0) return texts[i].text + " leaves the picture";
    for (std::size_t j = 0; j < i; ++j) {
      const Box b = place_of(texts[j]);
      if (a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom)
        return texts[i].text + " over " + texts[j].text;
    }
  }
  return {};
}

TEST(Plot, EveryCarrierHasOrbitsCablesCurvesAndAName) {
  for (const Plan& plan : plans()) {
    const SvgFile file = drawn(plan);
    const std::size_t n = plan.carriers.size();
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t sharing = (n - 1 - i % 12) / 12 + 1;  // carriers of this tone
      std::size_t curves = 0, cables = 0;
      for (const Element& line : file.all("polyline")) {
        if (line.tone != tone_of(i)) continue;
        (points_of(line).size() > 2 ? curves : cables) += 1;
      }
      EXPECT_EQ(curves, 6 * sharing) << "two orbits, four figures";
      EXPECT_GE(cables, 3 * sharing) << "two cables and the legend";
      EXPECT_TRUE(file.says(std::to_string(plan.carriers[i].id)));
    }
  }
}

TEST(Plot, WhatIsWrittenCanBeRead) {
  for (const Plan& plan : plans()) EXPECT_EQ(overlap(drawn(plan)), "") << plan.carriers.size() << " carriers";
}

RC_GTEST_PROP(Plot, WhatIsWrittenOfAnyPlanCanBeRead, ()) {
  Plan plan = mechanics::test::random_plan({3, 8});
  for (mechanics::Carrier& carrier : plan.carriers) carrier.radius_m = mechanics::test::real(0.0, 0.5);
  const SvgFile file = read_svg(picture("random", plan));
  RC_ASSERT(file.complaint.empty());
  RC_ASSERT(overlap(file) == "");
}

/// In both views, as far from each other as the period's begin has them, and as large as they are.
TEST(Plot, VehiclesStandWhereTheyAreAndAreAsLargeAsTheyAre) {
  const Plan plan = shipped("hex-multirotor").plan;
  const ground::Motion motion = ground::motion(plan, mechanics::certify(plan));
  const ground::Frames frames = ground::frames(ground::extents(motion), {0.0, 0.0}, 944.0);
  const double radius = 0.4 * frames.above.px_per_m();
  std::vector<std::vector<Point>> vehicles(motion.carriers.size());  // from above, from the side
  for (const Element& circle : drawn(plan).all("circle")) {
    if (circle.attributes.at("fill") == "none" || std::abs(circle.number("r") - radius) > 0.01) continue;
    for (std::size_t i = 0; i < vehicles.size(); ++i) {
      if (circle.tone == tone_of(i)) vehicles[i].push_back({circle.number("cx"), circle.number("cy")});
    }
  }
  for (std::size_t i = 0; i < vehicles.size(); ++i) {
    ASSERT_EQ(vehicles[i].size(), 2u);
    for (const std::size_t view : {0u, 1u}) {
      const ground::Frame& frame = view == 0 ? frames.above : frames.side;
      const Point here = frame(motion.carriers[i].moments.front().position_w_m);
      const Point first = frame(motion.carriers[0].moments.front().position_w_m);
      EXPECT_NEAR(vehicles[i][view].x - vehicles[0][view].x, here.x - first.x, 0.02);
      EXPECT_NEAR(vehicles[i][view].y - vehicles[0][view].y, here.y - first.y, 0.02);
    }
  }
}

TEST(Plot, CurvesRunWithinTheCertifiedBand) {
  const SvgFile file = drawn(shipped("penta-tilted").plan);
  std::vector<Element> bands;
  for (const Element& box : file.all("rect")) {
    if (box.tone == "muted") bands.push_back(box);
  }
  ASSERT_EQ(bands.size(), 4u);
  int curves = 0;
  for (const Element& line : file.all("polyline")) {
    const std::vector<Point> points = points_of(line);
    for (const Element& band : bands) {
      const bool within = points.size() > 2 && std::abs(points.front().x - band.number("x")) < 0.1 &&
                          std::abs(points.back().x - band.number("x") - band.number("width")) < 0.1 &&
                          points[1].y > band.number("y") - 50.0 && points[1].y < band.number("y") + 150.0;
      if (!within) continue;
      ++curves;
      for (const Point& point : points) {
        EXPECT_GE(point.y, band.number("y") - 0.1);
        EXPECT_LE(point.y, band.number("y") + band.number("height") + 0.1);
      }
    }
  }
  EXPECT_EQ(curves, 4 * 5);
}

TEST(Plot, LimitsAreDrawnWhereThereAreSome) {
  Plan plan = shipped("fixed-wing-trio").plan;
  const SvgFile limited = drawn(plan);
  for (const char* words : {"min 30", "max 45", "min 60", "max 90", "min 12", "max 15", "max 4", "min \u22124"})
    EXPECT_TRUE(limited.says(words)) << words;
  plan.limits = {};
  const SvgFile free = drawn(plan);
  EXPECT_FALSE(free.says("min ") || free.says("max "));
}

TEST(Plot, AFarLimitIsNamedAndDoesNotFlattenTheCurves) {
  Plan plan = shipped("paper").plan;
  plan.limits.tension_max_n = 5000.0;
  const SvgFile file = drawn(plan);
  EXPECT_TRUE(file.says("max 5000 \u2191"));
  EXPECT_FALSE(file.says("max 2 \u2191")) << "the length's, which is near";
}

TEST(Plot, ABrokenLimitIsMarked) {
  Plan plan = shipped("paper").plan;
  plan.limits.tension_max_n = 1.5;
  for (const Element& text : drawn(plan).all("text")) {
    EXPECT_EQ(text.tone == "bad" && text.text.rfind("max", 0) == 0, text.text == "max 1.5") << text.text;
  }
  EXPECT_TRUE(drawn(plan).says("0.7072 .. 1.916, outside its limits"));
}

TEST(Plot, SaysWhatItIsAndTheVerdict) {
  const SvgFile good = drawn(shipped("fixed-wing-trio").plan, "trio");
  EXPECT_TRUE(good.says("trio"));
  EXPECT_TRUE(good.says("3 carriers \u00b7 load 10 kg \u00b7 period 9.666 s"));
  EXPECT_TRUE(good.says("admissible"));
  EXPECT_FALSE(good.says("refused"));

  const SvgFile refused = drawn(shipped("pair-level").plan);
  EXPECT_TRUE(refused.says("refused, 6 rules broken"));
  EXPECT_TRUE(refused.says("two-carrier obstruction: "));
  EXPECT_TRUE(refused.says("and 5 more"));
  EXPECT_FALSE(refused.says("admissible"));
}

TEST(Plot, TheClosestApproachesAreTheCertificates) {
  const Plan plan = shipped("hex-multirotor").plan;
  const mechanics::Certificate certificate = mechanics::certify(plan);
  const SvgFile file = drawn(plan);
  EXPECT_TRUE(file.says("2.045 m") && file.says("carriers 1 and 2 come within 2.045 m"))
      << certificate.separation->min_m;
  EXPECT_TRUE(file.says("1.486 m") && file.says("the cables of carriers 1 and 2 come within 1.486 m"));
  // what is drawn from one to the other is as long as that, where it is seen from above: both at one altitude
  const ground::Motion motion = ground::motion(plan, certificate);
  EXPECT_NEAR((motion.places->first.closest_w_m - motion.places->second.closest_w_m).norm(),
              certificate.separation->min_m, 1e-6);
  const double cables = (motion.cables->first.closest_w_m - motion.cables->second.closest_w_m).norm();
  EXPECT_GE(cables, certificate.cable_distance->min_m);
  EXPECT_LE(cables, 1.01 * certificate.cable_distance->min_m + 1e-6);
}

TEST(Plot, NamesAreEscaped) {
  const std::string name = "<&\">' \u00e4 \u2192";
  EXPECT_TRUE(drawn(shipped("single").plan, name).says(name));
  EXPECT_TRUE(drawn(shipped("single").plan, std::string("a\x01\xff\xed\xa0\x80z")).says("a\uFFFD\uFFFD\uFFFD"));
  const SvgFile file = drawn(shipped("single").plan, std::string(5000, 'w'));
  EXPECT_EQ(overlap(file), "");
}

RC_GTEST_PROP(Plot, AnyBytesAreEscapedToText, (const std::string& bytes)) {
  const SvgFile file = read_svg("<a b=\"" + ground::escaped(bytes) + "\">" + ground::escaped(bytes) + "</a>");
  RC_ASSERT(file.complaint.empty());
}

TEST(Plot, OrbitsOfAllLawsCloseAndAreSeenWhole) {
  for (const Plan& plan : plans()) {
    const ground::Motion motion = ground::motion(plan, mechanics::certify(plan));
    const ground::Frames frames = ground::frames(ground::extents(motion), {28.0, 100.0}, 944.0);
    for (const ground::Frame* frame : {&frames.above, &frames.side}) {
      EXPECT_NEAR(frame->px_per_m(), frames.above.px_per_m(), 1e-9 * frames.above.px_per_m());
      EXPECT_NEAR(frame->plot.height() / frame->up.shown.span(), frame->px_per_m(), 1e-9 * frame->px_per_m());
    }
    for (const ground::CarrierPath& path : motion.carriers) {
      EXPECT_LT((path.moments.front().position_w_m - path.moments.back().position_w_m).norm(), 1e-6);
      for (const ground::Moment& moment : path.moments) {
        for (const ground::Frame* frame : {&frames.above, &frames.side}) {
          const Point place = (*frame)(moment.position_w_m);
          EXPECT_TRUE(place.x > frame->plot.left && place.x < frame->plot.right);
          EXPECT_TRUE(place.y > frame->plot.top && place.y < frame->plot.bottom);
        }
      }
    }
  }
}

TEST(Plot, UpIsUpAndNorthIsUpFromAbove) {
  const Plan plan = shipped("paper").plan;
  const ground::Frames frames =
      ground::frames(ground::extents(ground::motion(plan, mechanics::certify(plan))), {0.0, 0.0}, 944.0);
  EXPECT_LT(frames.above({0.0, 1.0, 0.0}).y, frames.above({0.0, 0.0, 0.0}).y);
  EXPECT_GT(frames.above({1.0, 0.0, 0.0}).x, frames.above({0.0, 0.0, 0.0}).x);
  EXPECT_LT(frames.side({0.0, 0.0, 1.0}).y, frames.side({0.0, 0.0, 0.0}).y);
}

RC_GTEST_PROP(Ticks, AreRoundEvenlySpacedAndInside, ()) {
  const double middle = mechanics::test::real(-1e4, 1e4), half = std::pow(10.0, mechanics::test::real(-6.0, 6.0));
  const mechanics::Range shown{middle - half, middle + half};
  const auto ticks = ground::ticks(shown, 8);
  RC_ASSERT(ticks.size() >= 2u && ticks.size() <= 9u);
  const double step = ticks[1].figure - ticks[0].figure;
  for (std::size_t k = 0; k < ticks.size(); ++k) {
    RC_ASSERT(ticks[k].figure >= shown.min - 1e-6 * step && ticks[k].figure <= shown.max + 1e-6 * step);
    RC_ASSERT(std::abs(ticks[k].figure - ticks[0].figure - static_cast<double>(k) * step) < 1e-6 * step + 1e-11);
    if (k > 0) RC_ASSERT(ticks[k].words != ticks[k - 1].words);
  }
}

RC_GTEST_PROP(Labels, NeverLieOnEachOtherOrOnWhatIsTaken, ()) {
  using mechanics::test::real;
  const Box within{0.0, 0.0, 200.0, 100.0};
  ground::Labels labels(within);
  std::vector<Box> boxes{{80.0, 40.0, 120.0, 60.0}};
  labels.occupy(boxes.front());
  for (int k = 0; k < 40; ++k) {
    const auto room = labels.place("12", 10.0, {real(0.0, 200.0), real(0.0, 100.0)}, 4.0, {real(-1.0, 1.0), 0.5});
    if (!room) continue;
    const double half = 0.5 * ground::width_of("12", 10.0);
    const Box box{room->x - half, room->y - 7.4, room->x + half, room->y};
    RC_ASSERT(box.left >= within.left - 1e-9 && box.right <= within.right + 1e-9 && box.top >= within.top - 1e-9 &&
              box.bottom <= within.bottom + 1e-9);
    for (const Box& other : boxes) {
      RC_ASSERT(box.left >= other.right - 1e-9 || other.left >= box.right - 1e-9 || box.top >= other.bottom - 1e-9 ||
                other.top >= box.bottom - 1e-9);
    }
    boxes.push_back(box);
  }
  RC_ASSERT(boxes.size() > 5u);
}

/// The words of a file, and its numbers apart from them.
struct Written {
  std::string words;
  std::vector<double> numbers;
};

Written written(const std::string& text) {
  Written out;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = at;
    while (end < text.size() && (std::isdigit(static_cast<unsigned char>(text[end])) || text[end] == '.')) ++end;
    if (end > at && std::isdigit(static_cast<unsigned char>(text[at]))) {
      out.numbers.push_back(std::stod(text.substr(at, end - at)));
      at = end;
    } else {
      out.words += text[at++];
    }
  }
  return out;
}

/// What the README shows is what the command draws today; but for the last digit, which compilers round as they like.
TEST(Plot, TheCommittedPicturesAreTodays) {
  for (const std::string name : {"fixed-wing-trio", "hex-multirotor"}) {
    const std::string file = source_directory() + "/docs/pictures/" + name + ".svg";
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    const Written committed = written(text.str());
    const Written today = written(picture(name, shipped(name).plan));
    const std::string cure =
        "draw it again: gyre plot deploy/missions/" + name + ".textproto -o docs/pictures/" + name + ".svg";
    EXPECT_LT(text.str().size(), 150000u);
    EXPECT_EQ(committed.words, today.words) << cure;
    ASSERT_EQ(committed.numbers.size(), today.numbers.size()) << cure;
    for (std::size_t k = 0; k < today.numbers.size(); ++k)
      ASSERT_NEAR(committed.numbers[k], today.numbers[k], 0.1 + 1e-9) << cure;
  }
}

}  // namespace
}  // namespace gyre::test
