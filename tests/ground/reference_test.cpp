// The shipped missions against figures that were computed independently: samples of the motion to 1e-9, and extremes
// that are at least as extreme as densely sampled ones and within 1e-6 of them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "tests/ground/gyre_command.hpp"
#include "tests/places.hpp"

namespace gyre::test {
namespace {

using Json = nlohmann::json;

struct ReferenceCase {
  const char* mission;
  const char* reference;
};

void PrintTo(const ReferenceCase& reference, std::ostream* out) {
  *out << reference.mission;
}

const ReferenceCase kCases[] = {{"paper", "paper-level"},
                                {"paper-fixed", "paper-fixed"},
                                {"pair-unrestricted", "pair-unrestricted"},
                                {"tri-mixed", "tri-mixed"},
                                {"penta-tilted", "penta-tilted"}};

class Reference : public ::testing::TestWithParam<ReferenceCase> {};

std::string reference_path(const std::string& file) {
  return source_directory() + "/tests/data/reference/" + file;
}

struct Table {
  std::string header;
  std::vector<std::vector<double>> rows;
};

Table read_table(std::istream& stream) {
  Table table;
  std::getline(stream, table.header);
  for (std::string line; std::getline(stream, line);) {
    std::istringstream cells(line);
    std::vector<double>& row = table.rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
  }
  return table;
}

/// Columns of one quantity: errors are relative to the quantity's greatest magnitude, not to each component's.
constexpr std::pair<std::size_t, std::size_t> kQuantities[] = {{0, 1},  {1, 2},   {2, 5},   {5, 6},   {6, 9},
                                                               {9, 12}, {12, 13}, {13, 14}, {14, 17}, {17, 20}};

TEST_P(Reference, SamplesAgree) {
  std::ifstream file(reference_path(std::string(GetParam().reference) + ".csv"));
  const Table expected = read_table(file);
  const std::size_t carriers = static_cast<std::size_t>(
      std::count_if(expected.rows.begin(), expected.rows.end(), [](const auto& row) { return row[0] == 0.0; }));
  ASSERT_GT(carriers, 0u);
  const std::size_t count = expected.rows.size() / carriers;
  const Answer answer = gyre("sample " + shipped(GetParam().mission) + " --count " + std::to_string(count));
  ASSERT_EQ(answer.exit_code, 0) << answer.complaint;
  std::istringstream stream(answer.output);
  const Table flown = read_table(stream);

  EXPECT_EQ(flown.header, expected.header);
  ASSERT_EQ(flown.rows.size(), expected.rows.size());
  for (const auto& [first, last] : kQuantities) {
    double scale = 0.0;
    for (const auto& row : expected.rows) {
      for (std::size_t column = first; column < last; ++column) scale = std::max(scale, std::abs(row[column]));
    }
    if (scale == 0.0) scale = 1.0;  // a fixed length has no rate
    double worst = 0.0;
    for (std::size_t i = 0; i < expected.rows.size(); ++i) {
      ASSERT_EQ(flown.rows[i].size(), 20u);
      for (std::size_t column = first; column < last; ++column) {
        worst = std::max(worst, std::abs(flown.rows[i][column] - expected.rows[i][column]));
      }
    }
    EXPECT_LT(worst / scale, 1e-9) << "columns from " << first;
  }
}

constexpr double kRounding = 1e-12;
constexpr double kClose = 1e-6;

void expect_at_most(const Json& exact, const Json& sampled, const std::string& what) {
  const double value = exact.get<double>();
  const double seen = sampled.get<double>();
  EXPECT_LE(value, seen + kRounding * (1.0 + std::abs(seen))) << what;
  EXPECT_GE(value, seen - kClose * (1.0 + std::abs(seen))) << what;
}

void expect_at_least(const Json& exact, const Json& sampled, const std::string& what) {
  expect_at_most(-exact.get<double>(), -sampled.get<double>(), what);
}

/// The summaries have NaN where a figure does not exist, which JSON has not.
Json read_summary(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  std::string words = text.str();
  for (std::size_t at = 0; (at = words.find("NaN", at)) != std::string::npos;) words.replace(at, 3, "null");
  return Json::parse(words);
}

TEST_P(Reference, ExtremesHoldAndAreTight) {
  const Json sampled = read_summary(reference_path(std::string(GetParam().reference) + ".summary.json"));
  const Answer answer = gyre("check --json " + shipped(GetParam().mission));
  // The reference knows nothing of cables, and those of its pair cross.
  const bool crosses = std::string(GetParam().mission) == "pair-unrestricted";
  ASSERT_EQ(answer.exit_code, crosses ? 1 : 0) << answer.complaint << answer.output;
  const Json exact = Json::parse(answer.output);

  EXPECT_NEAR(exact.at("period_s").get<double>(), sampled.at("period_s").get<double>(), 1e-9);
  EXPECT_LT(exact.at("wrench_error_max_n").get<double>(), 1e-9);
  expect_at_most(exact.at("carrier_separation_min_m"), sampled.at("carrier_separation_min_m"), "separation");
  for (std::size_t i = 0; i < exact.at("carriers").size(); ++i) {
    const Json& carrier = exact["carriers"][i];
    SCOPED_TRACE("carrier " + carrier.at("id").dump());
    expect_at_most(carrier.at("tension_min_n"), sampled["tension_min_N"][i], "tension_min_n");
    expect_at_least(carrier.at("tension_max_n"), sampled["tension_max_N"][i], "tension_max_n");
    expect_at_most(carrier.at("length_min_m"), sampled["length_min_m"][i], "length_min_m");
    expect_at_least(carrier.at("length_max_m"), sampled["length_max_m"][i], "length_max_m");
    expect_at_least(carrier.at("winch_rate_max_m_s"), sampled["winch_rate_max_mps"][i], "winch_rate_max_m_s");
    expect_at_most(carrier.at("speed_min_m_s"), sampled["speed_min_mps"][i], "speed_min_m_s");
    expect_at_least(carrier.at("speed_max_m_s"), sampled["speed_max_mps"][i], "speed_max_m_s");
    expect_at_least(carrier.at("altitude_swing_m"), sampled["altitude_swing_m"][i], "altitude_swing_m");
    const Json& cosine = sampled["directional_cosine_min"][i];
    EXPECT_EQ(carrier.at("direction_cosine_min").is_null(), cosine.is_null());
    if (!cosine.is_null()) expect_at_most(carrier["direction_cosine_min"], cosine, "direction_cosine_min");
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, Reference, ::testing::ValuesIn(kCases), [](const auto& test) {
  std::string name = test.param.mission;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

}  // namespace
}  // namespace gyre::test
