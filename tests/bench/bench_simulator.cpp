// How much faster than real time the twin is, beside what the solver alone costs.
//
// The floor: the same CVODE, tolerances and 13 states, but with carriers that stand still, so that neither Gyre's
// references nor the motion they cause cost anything. What the paper's period costs above it is the motion itself.

#include <benchmark/benchmark.h>

#include "common/protocol/pace.hpp"
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
  fly(state, rigs::paper(), rigs::resting(rigs::paper(), rigs::Stretch::kCompensated));
}
BENCHMARK(paper_period_floor_standing_carriers)->Unit(benchmark::kMillisecond);

/// The machine that runs online: 2 ms ticks, 100 Hz setpoints for each of the four carriers.
void online_second(benchmark::State& state) {
  mechanics::Plan plan = rigs::paper();
  if (state.range(0) != 0) plan.winch.time_constant_s = 0.05;
  const std::vector<mechanics::CarrierSlice> slices = mechanics::slices(plan);
  const protocol::Pace pace = protocol::Pace{}.with_ramp(SwarmTime{}, std::chrono::seconds(20), 1.0);
  SimulationSettings settings;
  if (state.range(0) != 0) {
    settings.carrier_lag_s = 0.1;
    settings.wind.gust_deviation_n = 0.05;
  }
  LocalTime now{};
  Simulator simulator = Simulator::create(plan, settings, now).value();
  for (auto _ : state) {
    for (int i = 0; i < 100; ++i) {
      const protocol::PlanMoment moment = pace.at(SwarmTime(now.time_since_epoch()));
      for (std::size_t c = 0; c < slices.size(); ++c) {
        const mechanics::Reference r = mechanics::evaluate(slices[c], seconds(moment.at.time_since_epoch()));
        const auto position = mechanics::paced(r.position_w_m, moment.pace, moment.rate_1_s);
        const auto unpaced = r.length_m - (1.0 / plan.cable.stiffness_n_m) * r.tension_n;
        const auto winch = mechanics::paced(unpaced, moment.pace, moment.rate_1_s);
        protocol::Setpoint s;
        s.carrier = slices[c].id;
        s.swarm_time = SwarmTime(now.time_since_epoch());
        s.position_w_m = position.value;
        s.velocity_w_m_s = position.first;
        s.acceleration_w_m_s2 = position.second;
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
