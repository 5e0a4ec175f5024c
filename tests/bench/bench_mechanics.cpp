// What the mechanics cost: one setpoint beside its two sine/cosine pairs, and certificates by the number of carriers.

#include <benchmark/benchmark.h>

#include <cmath>

#include "common/mechanics/certificate.hpp"
#include "common/mechanics/transition_figures.hpp"
#include "tests/mechanics/plans.hpp"

namespace gyre::mechanics {
namespace {

/// The floor of a setpoint: no way to evaluate two edges costs less.
void two_sine_cosine_pairs(benchmark::State& state) {
  double t_s = 0.0;
  for (auto _ : state) {
    t_s += 0.01;
    double a = 0.08 * t_s + 1.77;
    double b = 0.08 * t_s + 1.57;
    benchmark::DoNotOptimize(a);
    benchmark::DoNotOptimize(b);
    benchmark::DoNotOptimize(std::sin(a) + std::cos(a) + std::sin(b) + std::cos(b));
  }
}
BENCHMARK(two_sine_cosine_pairs);

/// Force, tension, direction, length, position, each with two derivatives.
void full_setpoint(benchmark::State& state) {
  const std::vector<CarrierSlice> all = slices(test::paper_plan());
  double t_s = 0.0;
  for (auto _ : state) {
    t_s += 0.01;
    benchmark::DoNotOptimize(evaluate(all[0], t_s));
  }
}
BENCHMARK(full_setpoint);

void setpoint_in_a_transition(benchmark::State& state) {
  const std::vector<CarrierSlice> below = slices(test::still_plan(test::paper_plan(), 0.0));
  const std::vector<CarrierSlice> above = slices(test::paper_plan());
  const TimedLayer layers[] = {{&below[0], 0.0, 0.0, 0.0}, {&above[0], 0.0, 0.0, 1e9}};
  double t_s = 0.0;
  for (auto _ : state) {
    t_s += 0.01;
    benchmark::DoNotOptimize(evaluate_course(layers, 2, t_s));
  }
}
BENCHMARK(setpoint_in_a_transition);

void per_carrier(benchmark::State& state, std::size_t carriers) {
  state.counters["per_carrier"] = benchmark::Counter(
      static_cast<double>(carriers), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void certify_plan(benchmark::State& state, const Plan& plan, const CertifyOptions& options) {
  for (auto _ : state) benchmark::DoNotOptimize(certify(plan, options));
  per_carrier(state, plan.carriers.size());
}

/// Not the edge headings, whose figures are constant: other phases make every figure move.
Plan restless_polygon(std::size_t n) {
  Plan plan = test::polygon_plan(n);
  for (std::size_t e = 0; e < n; ++e) plan.cycle.edges[e].phase_rad += 0.4 * std::sin(3.0 * static_cast<double>(e));
  return plan;
}

void certify_paper(benchmark::State& state) {
  certify_plan(state, test::paper_plan(), {false, false, true});
}
BENCHMARK(certify_paper)->Unit(benchmark::kMicrosecond);

void certify_figures(benchmark::State& state) {
  certify_plan(state, restless_polygon(static_cast<std::size_t>(state.range(0))), {false, false, true});
}
BENCHMARK(certify_figures)->RangeMultiplier(2)->Range(4, 64)->Unit(benchmark::kMicrosecond);

void certify_with_separation(benchmark::State& state) {
  certify_plan(state, restless_polygon(static_cast<std::size_t>(state.range(0))), {true, false, true});
}
BENCHMARK(certify_with_separation)->RangeMultiplier(2)->Range(4, 64)->Unit(benchmark::kMicrosecond);

void certify_with_stiffness(benchmark::State& state) {
  certify_plan(state, restless_polygon(static_cast<std::size_t>(state.range(0))), {false, true, true, false});
}
BENCHMARK(certify_with_stiffness)->RangeMultiplier(4)->Range(4, 64)->Unit(benchmark::kMicrosecond);

void certify_with_swings(benchmark::State& state) {
  certify_plan(state, restless_polygon(static_cast<std::size_t>(state.range(0))), {false, true, true, true});
}
BENCHMARK(certify_with_swings)->RangeMultiplier(4)->Range(4, 64)->Unit(benchmark::kMicrosecond);

/// Everything, and everything but swings: slow, on cables that settle at once, so that swings are the longest work.
void certify_paper_whole(benchmark::State& state, bool swings) {
  certify_plan(state, test::paper_plan(), {true, true, true, swings});
}
BENCHMARK_CAPTURE(certify_paper_whole, without_swings, false)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(certify_paper_whole, with_swings, true)->Unit(benchmark::kMicrosecond);

void rehearse_change_of_one_carrier(benchmark::State& state) {
  const std::vector<CarrierSlice> below = slices(test::still_plan(test::paper_plan(), 0.0));
  const std::vector<CarrierSlice> above = slices(test::paper_plan());
  const std::vector<TimedLayer> layers = {{&below[0], 0.0, 0.0, 0.0}, {&above[0], 0.0, 0.0, 20.0}};
  for (auto _ : state) benchmark::DoNotOptimize(transition_figures(layers, 0.0, 20.0));
}
BENCHMARK(rehearse_change_of_one_carrier)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace gyre::mechanics
