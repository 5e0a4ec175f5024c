#include "simulator/core/simulator.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "common/base/text.hpp"
#include "common/mechanics/reference.hpp"
#include "common/protocol/sanity.hpp"
#include "simulator/core/extrapolation.hpp"
#include "simulator/core/load_integrator.hpp"
#include "simulator/core/push.hpp"
#include "simulator/core/setpoint_judge.hpp"
#include "simulator/core/stall_judge.hpp"
#include "simulator/core/vehicle.hpp"
#include "simulator/core/wind.hpp"

namespace gyre::simulator {
namespace {

/// By then a vehicle has slowed down, whatever it was told.
const Duration kOldest = from_seconds(kExtrapolationHorizon_s);

struct WaitingSetpoint {
  LocalTime arrived;
  LocalTime held;  // when what it says was true
  protocol::Setpoint setpoint;
};

/// Says at most once per kReportPeriod that something is so.
class Reporter {
 public:
  [[nodiscard]] bool due(LocalTime now) {
    if (last_ && now - *last_ < kReportPeriod) return false;
    last_ = now;
    return true;
  }

 private:
  std::optional<LocalTime> last_;
};

std::optional<Error> objection(const mechanics::Plan& plan, const SimulationSettings& settings) {
  if (!(plan.cable.stiffness_n_m > 0.0) || !(plan.cable.damping_n_s_m >= 0.0)) {
    return Error{"cable: to simulate, stiffness_n_m has to be positive and damping_n_s_m not negative"};
  }
  if (settings.tick < std::chrono::microseconds(100) || settings.tick > kPublicationPeriod) {
    return Error{"simulation: the tick has to lie between 0.1 ms and 10 ms"};
  }
  if (settings.carrier_lag_s && !(*settings.carrier_lag_s > 0.0)) {
    return Error{"simulation: the carriers' time constant has to be positive; leave it out for exact carriers"};
  }
  if (!(settings.lag_error >= -1.0)) {
    return Error{"simulation: lags cannot be wrong by more than all of them; lag_error is -1 at least"};
  }
  if (!(settings.wind.gust_time_scale_s > 0.0) || !(settings.wind.gust_deviation_n >= 0.0)) {
    return Error{"simulation: wind gusts need a positive time scale and a deviation that is not negative"};
  }
  return std::nullopt;
}

}  // namespace

struct Simulator::World {
  World(const mechanics::Plan& plan, const SimulationSettings& settings, LocalTime start_time,
        std::vector<Vehicle> all_vehicles, double longest_rest_m)
      : incarnation(settings.incarnation),
        tick(settings.tick),
        ticks_per_publication(std::max<std::int64_t>(1, kPublicationPeriod / settings.tick)),
        start(start_time),
        vehicles(std::move(all_vehicles)),
        judge(plan, longest_rest_m),
        wind(settings.wind, settings.seed, seconds(settings.tick)),
        push(plan.load.mass_kg * plan.gravity_m_s2, settings.tick),
        integrator(
            LoadDynamics(rigid_load(plan)),
            {plan.load.position_w_m, Eigen::Vector3d::Zero(), plan.load.orientation_w_b, Eigen::Vector3d::Zero()}, 0.0,
            [this](double t_s, Surroundings& out) { surroundings(t_s, out); }) {
    for (std::size_t i = 0; i < vehicles.size(); ++i) index[vehicles[i].id] = i;
  }

  void surroundings(double t_s, Surroundings& out) const {
    for (std::size_t i = 0; i < vehicles.size(); ++i) out.anchors[i] = vehicles[i].anchor(t_s);
    out.force_w_n = wind.force_w_n(t_s) + push.force_w_n();
  }

  [[nodiscard]] Duration simulated() const { return ticks * tick; }
  [[nodiscard]] LocalTime time() const { return start + simulated(); }

  void receive(LocalTime arrived, const protocol::Setpoint& setpoint, Outputs& out) {
    // Nobody is believed, not even to be there: an agent that ended meanwhile would be the incumbent for another while.
    if (has_waited(setpoint, arrived)) {
      ++waited_too_long;
      latest_objection = "setpoints that may have waited while this process was stopped";
      unreported_drops = true;
    } else if (auto objection = judge.objection(setpoint, arrived)) {
      latest_objection = std::move(*objection);
      unreported_drops = true;
    } else {
      if (waiting.size() == kMaxWaitingSetpoints) {
        waiting.pop_front();
        ++overrun;
        latest_objection = "more setpoints than the simulator can take up";
        unreported_drops = true;
      }
      Vehicle& vehicle = vehicles[index.at(setpoint.carrier)];
      if (!vehicle.led.ever_heard()) {
        out.notices.push_back({Notice::Level::kInfo, text("carrier %u is led by its agent", setpoint.carrier)});
      }
      vehicle.led.heard(arrived);
      if (judge.began_anew(setpoint.carrier)) vehicle.held_time = {};
      const LocalTime held = vehicle.held_time.of(setpoint.swarm_time.time_since_epoch(), arrived, kOldest);
      waiting.push_back({arrived, held, setpoint});
    }
    report_drops(arrived, out);
  }

  /// Or may have, while this process was stopped.
  [[nodiscard]] bool has_waited(const protocol::Setpoint& setpoint, LocalTime arrived) {
    const auto found = index.find(setpoint.carrier);
    if (found == index.end() || !SetpointJudge::has_plausible_stamp(setpoint)) return false;  // the judge's affair
    HeldTime& held_time = vehicles[found->second].held_time;
    const auto age = held_time.age_by_the_past(setpoint.swarm_time.time_since_epoch(), arrived);
    const bool waited = stalls.doubts(arrived, age);
    if (waited) held_time.keep(arrived);
    return waited;
  }

  void learn(LocalTime arrived, const protocol::AgentStatus& status) {
    const auto found = index.find(status.carrier);
    if (found == index.end()) return;
    // What another agent follows is not what this vehicle goes on by.
    const std::uint64_t followed = judge.follows(status.carrier, arrived);
    if (followed == 0 || followed == status.incarnation) vehicles[found->second].onward.take(status);
  }

  /// Said once, and perhaps before the first setpoint; a number means the same plan whoever tells it.
  void learn(const protocol::HeldPlans& held) {
    const auto found = index.find(held.carrier);
    if (found != index.end()) vehicles[found->second].onward.take(held);
  }

  void receive(LocalTime arrived, const Pushed& pushed, Outputs& out) {
    if (auto objection = push.objection(pushed.force_w_n, pushed.duration)) {
      latest_objection = std::move(*objection);
      unreported_drops = true;
      ++pushes_refused;
      report_drops(arrived, out);
      return;
    }
    push.begin(arrived, pushed.force_w_n, pushed.duration);
    const Eigen::Vector3d& f = pushed.force_w_n;
    out.notices.push_back(
        {Notice::Level::kWarning, text("laboratory: the load is pushed by (%.4g, %.4g, %.4g) N for %.4g s", f.x(),
                                       f.y(), f.z(), seconds(pushed.duration))});
  }

  void report_drops(LocalTime now, Outputs& out) {
    if (!unreported_drops || !drop_reports.due(now)) return;
    unreported_drops = false;
    out.dropped = DropReport{dropped(), latest_objection};
  }

  [[nodiscard]] protocol::DropCounts dropped() const {
    protocol::DropCounts counts = judge.dropped();
    counts.late += overrun + waited_too_long;
    counts.nonsense += pushes_refused;
    return counts;
  }

  [[nodiscard]] std::optional<std::string> complaint(LocalTime now) const {
    std::vector<CarrierId> silent;
    for (const Vehicle& vehicle : vehicles) {
      if (vehicle.led.silent(now)) silent.push_back(vehicle.id);
    }
    if (!silent.empty()) return "no setpoints for " + listed("carrier", silent);
    if (const auto twice = judge.contested(now); !twice.empty()) {
      return "setpoints of two agents for " + listed("carrier", twice) + "; end one of them";
    }
    if (now - time() > kToleratedLag) return text("%.2f s behind real time", seconds(now - time()));
    return std::nullopt;
  }

  void advance(LocalTime now, Outputs& out) {
    notice_lag(now, out);
    for (int i = 0; i < kTicksPerAdvance && time() + tick <= now; ++i) one_tick(out, now);
    report_drops(now, out);

    const std::int64_t publication = ticks / ticks_per_publication;
    const bool caught_up = time() + tick > now;
    const bool long_ago = !published_at || now - *published_at >= kPublicationPeriod;
    if (publication == published || (!caught_up && !long_ago)) return;
    // Whoever begins where his vehicle is would begin where it was before the stall, or on the way from there.
    if (!caught_up && stalls.recent(now)) return;
    published = publication;
    published_at = now;
    publish(out);
  }

  void notice_lag(LocalTime now, Outputs& out) {
    const Duration behind = now - time();
    Duration skip{};
    if (behind > kLongestCatchUp) {
      skip = behind - kLongestCatchUp;
      start += skip;
      skipped += skip;
    }
    if (behind > kToleratedLag && lag_reports.due(now)) out.lag = LagReport{behind, std::exchange(skipped, Duration{})};
  }

  void one_tick(Outputs& out, LocalTime now) {
    const double begin_s = seconds(simulated());
    while (!waiting.empty() && waiting.front().arrived <= time()) {
      const WaitingSetpoint& next = waiting.front();
      vehicles[index.at(next.setpoint.carrier)].take_up(next.setpoint, next.held, time(), start);
      waiting.pop_front();
    }
    for (Vehicle& vehicle : vehicles) vehicle.tick(time(), start);
    wind.tick(begin_s);
    push.tick(time());
    ++ticks;
    if (auto failure = integrator.advance_to(seconds(simulated()))) {
      LoadMotion held = integrator.motion();
      held.velocity_w_m_s.setZero();
      held.angular_velocity_b_rad_s.setZero();
      integrator.restart(held, seconds(simulated()));
      if (failure_reports.due(now)) out.failure = std::move(failure);
    }
  }

  void publish(Outputs& out) {
    ++sequence;
    const LoadMotion& load = integrator.motion();
    for (std::size_t i = 0; i < vehicles.size(); ++i) {
      const Anchor anchor = vehicles[i].anchor(seconds(simulated()));
      const CablePull pull = integrator.dynamics().pull(i, load, anchor);
      out.carriers.push_back({vehicles[i].id, incarnation, judge.follows(vehicles[i].id, time()), sequence, time(),
                              anchor.position_w_m, anchor.velocity_w_m_s, pull.tension_n, pull.length_m,
                              anchor.unstretched_length_m, anchor.unstretched_rate_m_s});
    }
    out.load = protocol::LoadState{incarnation,
                                   sequence,
                                   time(),
                                   load.position_w_m,
                                   load.velocity_w_m_s,
                                   load.orientation_w_b,
                                   load.angular_velocity_b_rad_s};
  }

  std::uint64_t incarnation;
  Duration tick;
  std::int64_t ticks_per_publication;
  LocalTime start;  // of simulated time; later than the real start by what was skipped
  std::int64_t ticks = 0;
  std::vector<Vehicle> vehicles;
  std::map<CarrierId, std::size_t> index;
  SetpointJudge judge;
  StallJudge stalls;
  Wind wind;
  Push push;
  LoadIntegrator integrator;
  std::deque<WaitingSetpoint> waiting;

  std::uint64_t sequence = 0;
  std::int64_t published = 0;
  std::optional<LocalTime> published_at;
  Duration skipped{};
  std::uint64_t overrun = 0;
  std::uint64_t waited_too_long = 0;
  std::uint64_t pushes_refused = 0;
  bool unreported_drops = false;
  std::string latest_objection;
  Reporter lag_reports, drop_reports, failure_reports;
};

Result<Simulator> Simulator::create(const mechanics::Plan& plan, const SimulationSettings& settings, LocalTime start) {
  if (auto error = objection(plan, settings)) return *error;
  std::vector<Vehicle> vehicles;
  double longest_rest_m = 0.0;
  for (const mechanics::CarrierSlice& slice : mechanics::slices(plan)) {
    const mechanics::Reference rest = mechanics::evaluate(slice, 0.0);
    // l0 = l − s / k: the cable, stretched by its tension, is as long as the plan has it.
    const double unstretched_m = rest.length_m.value - rest.tension_n.value / plan.cable.stiffness_n_m;
    if (!(unstretched_m > 0.0) || !rest.position_w_m.value.allFinite()) {
      return Error{"carrier " + std::to_string(slice.id) + ": at rest its cable would be " +
                   std::to_string(rest.length_m.value) + " m long under " + std::to_string(rest.tension_n.value) +
                   " N, which is no cable to simulate; look at its length law, and at cable.stiffness_n_m"};
    }
    const OnSilence on_silence = settings.holds.count(slice.id) != 0 ? OnSilence::kHolds : OnSilence::kGoesOn;
    const double tick_s = seconds(settings.tick);
    const double wrong = 1.0 + settings.lag_error;
    const mechanics::Winch& winch = plan.winch;
    vehicles.push_back(
        {slice.id, on_silence,
         CarrierFollower(rest.position_w_m.value, settings.carrier_lag_s.value_or(wrong * slice.vehicle_lag_s),
                         on_silence, tick_s),
         Winch(unstretched_m, {wrong * winch.time_constant_s, winch.rate_max_m_s, winch.acceleration_max_m_s2, tick_s},
               on_silence)});
    longest_rest_m = std::max(longest_rest_m, (rest.position_w_m.value - plan.load.position_w_m).norm());
  }
  return Simulator(std::make_unique<World>(plan, settings, start, std::move(vehicles), longest_rest_m));
}

Simulator::Simulator(std::unique_ptr<World> world) : world_(std::move(world)) {}
Simulator::~Simulator() = default;
Simulator::Simulator(Simulator&&) noexcept = default;

Outputs Simulator::step(LocalTime now, const Event& event) {
  Outputs out;
  world_->stalls.awake(now);
  if (const auto* setpoint = std::get_if<protocol::Setpoint>(&event)) {
    world_->receive(now, *setpoint, out);
  } else if (const auto* status = std::get_if<protocol::AgentStatus>(&event)) {
    if (sane(*status)) world_->learn(now, *status);
  } else if (const auto* held = std::get_if<protocol::HeldPlans>(&event)) {
    if (sane(*held)) world_->learn(*held);
  } else if (const auto* pushed = std::get_if<Pushed>(&event)) {
    world_->receive(now, *pushed, out);
  } else {
    world_->advance(now, out);
  }
  return out;
}

LocalTime Simulator::next_due() const {
  const World& w = *world_;
  return w.start + (w.published + 1) * w.ticks_per_publication * w.tick;
}

const LoadMotion& Simulator::load() const {
  return world_->integrator.motion();
}

Duration Simulator::simulated() const {
  return world_->simulated();
}

protocol::DropCounts Simulator::dropped() const {
  return world_->dropped();
}

std::optional<std::string> Simulator::complaint(LocalTime now) const {
  return world_->complaint(now);
}

}  // namespace gyre::simulator
