// Whatever stands in a file, the reader answers: a mission or complaints, never a crash, never silence.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "common/mechanics/carrier_slice.hpp"
#include "common/mission/mission.hpp"
#include "tests/mission/sample_missions.hpp"

namespace gyre::test {
namespace {

void expect_answer(const std::string& text) {
  const Result<mission::Mission> result = mission::parse_mission(text, "mutated");
  if (result) {
    // Whoever holds a mission holds a plan that is well formed.
    const mechanics::Plan& plan = result.value().plan;
    RC_ASSERT(!plan.carriers.empty() && plan.carriers.size() <= kMaxCarrierId);
    RC_ASSERT(mechanics::slices(plan).size() == plan.carriers.size());
    RC_ASSERT(mechanics::period_s(plan) > 0.0);
    RC_ASSERT(mission::parse_mission(mission::to_text(result.value()), "again").ok());
    return;
  }
  const std::string& answer = result.error().text;
  RC_ASSERT(answer.rfind("mutated:", 0) == 0);
  RC_ASSERT(std::count(answer.begin(), answer.end(), '\n') <= 20);
}

RC_GTEST_PROP(Mutation, BytesReplaced, ()) {
  std::string text = kGoodMission;
  const auto count = *rc::gen::inRange(1, 8);
  for (int i = 0; i < count; ++i) text[*rc::gen::inRange<std::size_t>(0, text.size())] = *rc::gen::arbitrary<char>();
  expect_answer(text);
}

RC_GTEST_PROP(Mutation, PiecesCutOut, ()) {
  std::string text = kGoodMission;
  const auto count = *rc::gen::inRange(1, 4);
  for (int i = 0; i < count; ++i) {
    const auto at = *rc::gen::inRange<std::size_t>(0, text.size());
    text.erase(at, *rc::gen::inRange<std::size_t>(1, 60));
  }
  expect_answer(text);
}

RC_GTEST_PROP(Mutation, PiecesMoved, ()) {
  std::string text = kGoodMission;
  const auto from = *rc::gen::inRange<std::size_t>(0, text.size());
  const std::string piece = text.substr(from, *rc::gen::inRange<std::size_t>(1, 80));
  text.insert(*rc::gen::inRange<std::size_t>(0, text.size()), piece);
  expect_answer(text);
}

RC_GTEST_PROP(Mutation, NumbersReplaced, ()) {
  // Every number in turn becomes one that a careless hand or a broken tool could have written.
  static const std::vector<std::string> kNumbers = {"0",      "-1",         "1e308", "-inf", "nan",
                                                    "1e-320", "4294967295", "3.5",   "true"};
  std::string text = kGoodMission;
  std::vector<std::size_t> starts;
  for (std::size_t i = 0; (i = text.find(": ", i)) != std::string::npos; i += 2) starts.push_back(i + 2);
  const std::size_t start = *rc::gen::elementOf(starts);
  text.replace(start, text.find_first_of(" \n", start) - start, *rc::gen::elementOf(kNumbers));
  expect_answer(text);
}

RC_GTEST_PROP(Mutation, Noise, (const std::string& text)) {
  expect_answer(text);
}

}  // namespace
}  // namespace gyre::test
