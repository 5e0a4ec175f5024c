// What a design takes, by the number of carriers, and how good it is: regular polygons at 1.5 m/s, 0.5 m clear, every
// number open but the order of 64; and the paper's load beside the paper.

#include <chrono>
#include <cstdio>

#include "tests/design/asked.hpp"

namespace gyre::design::test {
namespace {

/// Runs a design, and how long it took.
std::pair<Design, double> timed(const Requirements& requirements) {
  const auto begun = std::chrono::steady_clock::now();
  Design design = designed(requirements);
  return {std::move(design), std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count()};
}

void polygons() {
  std::printf("carriers   order    time s   effort   prices\n");
  for (const std::size_t n : {3U, 4U, 6U, 8U, 12U, 16U, 32U, 64U}) {
    Requirements asked = polygon(n, 1.5, 0.5);
    const bool given = n > 16;
    if (given) {
      asked.open.order = false;
      asked.given.cycle.edges = mechanics::test::polygon_plan(n).cycle.edges;
      asked.open.edges.assign(n, {true, true, true});
    }
    const auto [design, time_s] = timed(asked);
    std::printf("%8zu   %-6s %8.2f   %6.3f   %zu%s\n", n, given ? "given" : "open", time_s, design.figure,
                design.prices.size(), design.plan ? "" : "   nothing found");
  }
}

void papers_load() {
  const mechanics::Plan plan = mechanics::test::paper_plan();
  const mechanics::Certificate paper = mechanics::certify(plan);
  std::printf("\nthe paper's load         least speed m/s   winch rate m/s   time s\n");
  std::printf("the paper's phases       %15.4f   %14.4f\n", slowest_m_s(paper), winch_rate_m_s(paper));
  Requirements asked;
  asked.given = plan;
  asked.given.limits = {};
  asked.open.laws.assign(4, {});
  asked.want.objective = Objective::kGreatestSpeed;
  asked.want.amplitude_max_n = 1.2;
  for (const double share : {8.0, 1.0}) {
    for (const bool offsets : {false, true}) {
      asked.open.edges.assign(4, {offsets, true, true});
      asked.given.limits.winch_rate_max_m_s = winch_rate_m_s(paper) / share;
      const auto [design, time_s] = timed(asked);
      std::printf("designed, %-8s 1/%.0f   %15.4f   %14.4f   %6.2f\n", offsets ? "offsets," : "", share,
                  slowest_m_s(design.certificate), winch_rate_m_s(design.certificate), time_s);
    }
  }
}

}  // namespace
}  // namespace gyre::design::test

int main() {
  gyre::design::test::polygons();
  gyre::design::test::papers_load();
  return 0;
}
