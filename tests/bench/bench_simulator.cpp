// How much faster than real time the twin is, beside what the solver alone costs.
//
// The floor: the same CVODE, tolerances and 13 states, but with carriers that stand still, so that neither Gyre's
// references nor the motion they cause cost anything. What the paper's period costs above it is the motion itself.

#include <benchmark/benchmark.h>

#include "common/mechanics/rest_plan.hpp"
#include "common/mechanics/transition.hpp"
#include "simulator/core/simulator.hpp"
#include "tests/simulator/rigs.hpp"

namespace gyre::simulator {
namespace {

constexpr double kSample_s = 0.1;

void fly(benchmark::State& state, const mechanics::Plan& plan, const SurroundingsAt& surroundings) {
  const double period_s = mechanics::period_s(rigs::paper());
  const LoadMotion start{plan.load.position_w_m, Eigen::Vector3d::Zero(), plan.load.orientation_w_b,
                         Eigen::Vector3d::Zero()};
  IntegratorStatistics statistics;
  for (auto _ : state) {
    LoadIntegrator integrator(LoadDynamics(rigid_load(plan)), start, 0.0, surroundings);
    for (double t_s = kSample_s; t_s < period_s; t_s += kSample_s) {
      if (integrator.advance_to(t_s)) state.SkipWithError("CVODE gave up");
    }
    statistics = integrator.statistics();
  }
  state.counters["times_real_time"] =
      benchmark::Counter(period_s * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
  state.counters["steps"] = static_cast<double>(statistics.steps);
  state.counters["evaluations"] = static_cast<double>(statistics.evaluations);
}

void paper_period(benchmark::State& state) {
  fly(state, rigs::paper(), rigs::planned(rigs::paper(), rigs::Stretch::kCompensated));
}
BENCHMARK(paper_period)->Unit(benchmark::kMillisecond);

void paper_period_floor_standing_carriers(benchmark::State& state) {
  const mechanics::Plan rest = mechanics::rest_plan(rigs::paper());
  Surroundings still;
  still.anchors.resize(rest.carriers.size());
  rigs::planned(rest, rigs::Stretch::kCompensated)(0.0, still);
  fly(state, rest, rigs::fixed(still.anchors));
}
BENCHMARK(paper_period_floor_standing_carriers)->Unit(benchmark::kMillisecond);

/// The machine that runs online: 2 ms ticks, 100 Hz setpoints for each of the four carriers.
void online_second(benchmark::State& state) {
  const mechanics::Plan plan = rigs::paper();
  const std::vector<mechanics::CarrierSlice> slices = mechanics::slices(plan);
  const std::vector<mechanics::CarrierSlice> rest = mechanics::slices(mechanics::rest_plan(plan));
  SimulationSettings settings;
  if (state.range(0) != 0) {
    settings.carrier_lag_s = 0.1;
    settings.winch_time_constant_s = 0.05;
    settings.wind.gust_deviation_n = 0.05;
  }
  LocalTime now{};
  Simulator simulator = Simulator::create(plan, settings, now).value();
  for (auto _ : state) {
    for (int i = 0; i < 100; ++i) {
      const double t_s = seconds(now.time_since_epoch());
      for (std::size_t c = 0; c < slices.size(); ++c) {
        const std::array<mechanics::Layer<double>, 2> layers = {
            mechanics::Layer<double>{&rest[c], t_s, mechanics::constant(1.0)},
            mechanics::Layer<double>{&slices[c], t_s, mechanics::smooth_step(t_s, 20.0)}};
        const mechanics::Reference r = mechanics::evaluate_mixture(layers.data(), layers.size());
        const auto winch = r.length_m - (1.0 / plan.cable.stiffness_n_m) * r.tension_n;
        protocol::Setpoint s;
        s.carrier = slices[c].id;
        s.swarm_time = SwarmTime(now.time_since_epoch());
        s.position_w_m = r.position_w_m.value;
        s.velocity_w_m_s = r.position_w_m.first;
        s.acceleration_w_m_s2 = r.position_w_m.second;
        s.winch_length_m = winch.value;
        s.winch_rate_m_s = winch.first;
        s.winch_acceleration_m_s2 = winch.second;
        benchmark::DoNotOptimize(simulator.step(now, s));
      }
      now += kPublicationPeriod;
      benchmark::DoNotOptimize(simulator.step(now, Advance{}));
    }
  }
  state.counters["times_real_time"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK(online_second)->Arg(0)->Arg(1)->ArgName("lag_and_gusts")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace gyre::simulator
