// What a load feels of a bad radio: agents that evaluate their own setpoints, beside what people do today, one process
// that streams every carrier's setpoint at the same rate.
//
// Everything runs on virtual time with the real cores and the simulator's dynamics, so every run is the same. The radio
// is recorded: whether the packet of a link in a slot of 10 ms is lost, and how long it takes, is drawn once from a
// seed and holds for all. From 20 s on 30 % of the packets are lost, from 30 s on all of them for 2 s.
//
//   Gyre         plans, beacons, times and statuses cross the radio; a setpoint does not leave its vehicle. The agents'
//                clocks are off by up to 0.5 s and 100 ppm
//   hold         setpoints cross the radio; a carrier holds the last position
//   extrapolate  setpoints cross the radio; a carrier goes on from the last one with its velocity and acceleration
//
// Carriers and winches follow what they are told with a lag of 50 ms, which all make up for. The residual force is what
// accelerates the load: its mass times the change of velocity over 10 ms.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "agent/core/agent.hpp"
#include "common/base/random_stream.hpp"
#include "common/mechanics/reference.hpp"
#include "common/mission/mission.hpp"
#include "common/protocol/pace.hpp"
#include "coordinator/core/coordinator.hpp"
#include "simulator/core/simulator.hpp"
#include "tests/places.hpp"

namespace {

using gyre::Duration;
using gyre::LocalTime;
using gyre::SwarmTime;
using gyre::simulator::Simulator;
namespace mechanics = gyre::mechanics;
namespace protocol = gyre::protocol;

constexpr std::uint64_t kSeed = 1;
constexpr Duration kStep = std::chrono::microseconds(500);
constexpr Duration kSlot = std::chrono::milliseconds(10);
constexpr Duration kEnd = std::chrono::seconds(50);
constexpr double kLossFrom_s = 20.0;
constexpr double kLoss = 0.3;
constexpr double kOutageFrom_s = 30.0;
constexpr double kOutage_s = 2.0;
constexpr double kLag_s = 0.05;

/// The recorded radio: the fate of a packet that a link sends in a slot.
class Radio {
 public:
  /// How long the packet takes; absent when it is lost. Links to the coordinator have odd numbers.
  [[nodiscard]] static std::optional<Duration> fate(std::uint64_t link, Duration sent) {
    gyre::RandomStream random(kSeed, std::to_string(link) + "/" + std::to_string(sent / kSlot));
    const double chance = random.uniform();
    const Duration delay = gyre::from_seconds(1e-3 + 0.5e-3 * -std::log(random.uniform()));
    const double t_s = gyre::seconds(sent);
    if (t_s >= kOutageFrom_s && t_s < kOutageFrom_s + kOutage_s) return std::nullopt;
    if (t_s >= kLossFrom_s && chance < kLoss) return std::nullopt;
    return delay;
  }
};

/// What is on its way, by the time of its arrival.
template <class Message>
class InFlight {
 public:
  void send(std::uint64_t link, Duration now, Message message) {
    if (const auto delay = Radio::fate(link, now)) packets_.emplace(now + *delay, std::move(message));
  }
  /// A reliable topic: asked for and sent again every 30 ms until it has passed.
  void send_until_heard(std::uint64_t link, Duration now, Message message) {
    constexpr Duration kHeartbeat = std::chrono::milliseconds(30);
    Duration sent = now;
    while (!Radio::fate(link, sent)) sent += kHeartbeat;
    packets_.emplace(sent + *Radio::fate(link, sent), std::move(message));
  }
  [[nodiscard]] std::optional<Message> arrived(Duration now) {
    if (packets_.empty() || packets_.begin()->first > now) return std::nullopt;
    Message message = std::move(packets_.begin()->second);
    packets_.erase(packets_.begin());
    return message;
  }

 private:
  std::multimap<Duration, Message> packets_;
};

struct Felt {
  double force_max_n = 0.0;
  double force_rms_n = 0.0;
  double displacement_max_m = 0.0;
};

/// The twin, and what its load felt since the losses began.
class World {
 public:
  explicit World(const gyre::mission::Mission& mission)
      : mass_kg_(mission.plan.load.mass_kg), home_w_m_(mission.plan.load.position_w_m) {
    auto made = Simulator::create(mission.plan, {}, LocalTime{});
    GYRE_ENSURE(made.ok(), "the mission can be simulated");
    simulator_.emplace(std::move(made).value());
  }

  void hear(Duration now, const protocol::Setpoint& setpoint) {
    static_cast<void>(simulator_->step(LocalTime(now), setpoint));
  }
  [[nodiscard]] std::vector<protocol::CarrierState> advance(Duration now) {
    if (LocalTime(now) < simulator_->next_due()) return {};
    auto out = simulator_->step(LocalTime(now), gyre::simulator::Advance{});
    if (out.load && gyre::seconds(now) >= kLossFrom_s) feel(*out.load);
    return std::move(out.carriers);
  }
  [[nodiscard]] Felt felt() const {
    Felt felt = felt_;
    felt.force_rms_n = std::sqrt(squares_ / static_cast<double>(std::max(1, count_)));
    return felt;
  }

 private:
  void feel(const protocol::LoadState& load) {
    felt_.displacement_max_m = std::max(felt_.displacement_max_m, (load.position_w_m - home_w_m_).norm());
    if (last_) {
      const double dt = gyre::seconds(load.stamp - last_->stamp);
      const double force = mass_kg_ * (load.velocity_w_m_s - last_->velocity_w_m_s).norm() / dt;
      felt_.force_max_n = std::max(felt_.force_max_n, force);
      squares_ += force * force;
      ++count_;
    }
    last_ = load;
  }

  double mass_kg_;
  Eigen::Vector3d home_w_m_;
  std::optional<Simulator> simulator_;
  std::optional<protocol::LoadState> last_;
  Felt felt_;
  double squares_ = 0.0;
  int count_ = 0;
};

// ------------------------------------------------------------------------------------------------------------- Gyre

class GyreFlight {
 public:
  explicit GyreFlight(const gyre::mission::Mission& mission) : world_(mission), coordinator_(job(mission), options()) {
    for (std::size_t i = 0; i < mission.plan.carriers.size(); ++i) {
      gyre::agent::AgentOptions agent;
      agent.carrier = mission.plan.carriers[i].id;
      agent.incarnation = i + 1;
      agents_.push_back(std::make_unique<Member>(agent, i % 2 == 0 ? 0.5 : -0.5, i / 2 == 0 ? 100e-6 : -100e-6));
    }
  }

  Felt fly() {
    for (Duration now{}; now < kEnd; now += kStep) {
      const bool engaged = coordinator_.course().moment(SwarmTime(now)).pace == 1.0;
      GYRE_ENSURE(engaged || gyre::seconds(now) < kLossFrom_s, "the motion is flown when the losses begin");
      while (auto event = to_coordinator_.arrived(now)) conduct(now, *event);
      if (LocalTime(now) >= next_conduct_) conduct(now, gyre::coordinator::Tick{});
      for (std::size_t i = 0; i < agents_.size(); ++i) {
        Member& m = *agents_[i];
        while (auto event = m.inbox.arrived(now)) act(now, i, *event);
        if (m.local(now) >= m.next_tick) act(now, i, gyre::agent::Tick{});
      }
      const auto states = world_.advance(now);
      for (std::size_t i = 0; i < states.size(); ++i) act(now, i, states[i]);
    }
    return world_.felt();
  }

 private:
  struct Member {
    Member(const gyre::agent::AgentOptions& options, double offset, double rate)
        : agent(options), offset_s(offset), drift(rate) {}
    [[nodiscard]] LocalTime local(Duration now) const {
      return LocalTime(now + gyre::from_seconds(offset_s + drift * gyre::seconds(now)));
    }
    gyre::agent::Agent agent;
    double offset_s;
    double drift;
    LocalTime next_tick = LocalTime::min();
    InFlight<gyre::agent::Event> inbox;
  };

  static gyre::coordinator::Job job(const gyre::mission::Mission& mission) {
    gyre::coordinator::Job job;
    job.name = mission.name;
    job.plan = mission.plan;
    job.silence = mission.silence;
    return job;
  }
  static gyre::coordinator::CoordinatorOptions options() {
    gyre::coordinator::CoordinatorOptions options;
    options.engage_when_ready = true;
    return options;
  }
  static std::uint64_t up(std::size_t i) { return 2 * i + 1; }
  static std::uint64_t down(std::size_t i) { return 2 * i; }

  void conduct(Duration now, const gyre::coordinator::Event& event) {
    auto arrived = event;
    if (auto* request = std::get_if<gyre::coordinator::TimeRequestArrived>(&arrived)) request->arrived = LocalTime(now);
    if (auto* status = std::get_if<gyre::coordinator::StatusArrived>(&arrived)) status->arrived = LocalTime(now);
    const auto out = coordinator_.step(LocalTime(now), arrived);
    next_conduct_ = out.next_tick;
    for (std::size_t i = 0; i < agents_.size(); ++i) {
      Member& m = *agents_[i];
      const auto carrier = static_cast<gyre::CarrierId>(i + 1);
      if (out.time_reply && out.time_reply->carrier == carrier) {
        m.inbox.send(down(i), now, gyre::agent::TimeReplyArrived{*out.time_reply, {}});
      }
      for (const auto& offer : out.offers) {
        if (offer.carrier == carrier) m.inbox.send_until_heard(down(i), now, offer);
      }
      if (out.beacon) m.inbox.send(down(i), now, *out.beacon);
    }
  }

  void act(Duration now, std::size_t i, gyre::agent::Event event) {
    Member& m = *agents_[i];
    if (auto* reply = std::get_if<gyre::agent::TimeReplyArrived>(&event)) reply->arrived = m.local(now);
    const auto out = m.agent.step(m.local(now), event);
    m.next_tick = out.next_tick;
    if (out.time_request) {
      to_coordinator_.send(up(i), now, gyre::coordinator::TimeRequestArrived{*out.time_request, {}});
    }
    if (out.setpoint) world_.hear(now, *out.setpoint);
    if (out.held) to_coordinator_.send_until_heard(up(i), now, *out.held);
    if (out.status) to_coordinator_.send_until_heard(up(i), now, gyre::coordinator::StatusArrived{*out.status, {}});
    if (out.question) act(now, i, gyre::agent::judge(*out.question));
  }

  World world_;
  gyre::coordinator::Coordinator coordinator_;
  LocalTime next_conduct_{};
  std::vector<std::unique_ptr<Member>> agents_;
  InFlight<gyre::coordinator::Event> to_coordinator_;
};

// -------------------------------------------------------------------------------------------------------- streaming

enum class Gap { kHold, kExtrapolate };

protocol::Setpoint setpoint_of(const mechanics::CarrierSlice& slice, const protocol::PlanMoment& moment) {
  const mechanics::Reference r = mechanics::evaluate(slice, gyre::seconds(moment.at.time_since_epoch()));
  const auto position =
      mechanics::led(mechanics::paced(r.position_w_m, moment.pace, moment.rate_1_s), slice.vehicle_lag_s);
  protocol::Setpoint s;
  s.position_w_m = position.value;
  s.velocity_w_m_s = position.first;
  s.acceleration_w_m_s2 = position.second;
  s.direction_w = r.direction_w.value;
  s.tension_n = r.tension_n.value;
  s.cable_length_m = r.length_m.value;
  const auto winch =
      mechanics::led(mechanics::paced(mechanics::paid_out(r, slice.cable_stiffness_n_m), moment.pace, moment.rate_1_s),
                     slice.winch_lag_s);
  s.winch_length_m = winch.value;
  s.winch_rate_m_s = winch.first;
  s.winch_acceleration_m_s2 = winch.second;
  return s;
}

/// What a carrier flies now that heard `s` last.
protocol::Setpoint flown(protocol::Setpoint s, SwarmTime now, Gap gap) {
  const double t = gyre::seconds(now - s.swarm_time);
  s.swarm_time = now;
  if (gap == Gap::kHold) {
    s.velocity_w_m_s.setZero();
    s.acceleration_w_m_s2.setZero();
    s.winch_rate_m_s = s.winch_acceleration_m_s2 = 0.0;
    return s;
  }
  s.position_w_m += t * s.velocity_w_m_s + 0.5 * t * t * s.acceleration_w_m_s2;
  s.velocity_w_m_s += t * s.acceleration_w_m_s2;
  s.winch_length_m += t * s.winch_rate_m_s + 0.5 * t * t * s.winch_acceleration_m_s2;
  s.winch_rate_m_s += t * s.winch_acceleration_m_s2;
  return s;
}

Felt stream(const gyre::mission::Mission& mission, Gap gap) {
  World world(mission);
  const auto motion = mechanics::slices(mission.plan);
  // Started as Gyre does, smoothly, from 3 s on.
  const auto pace = protocol::Pace{}.with_ramp(SwarmTime(std::chrono::seconds(3)), std::chrono::seconds(10), 1.0);
  InFlight<protocol::Setpoint> radio;
  std::map<gyre::CarrierId, protocol::Setpoint> heard;
  std::uint64_t sequence = 0;
  for (Duration now{}; now < kEnd; now += kStep) {
    while (const auto s = radio.arrived(now)) {
      auto& last = heard[s->carrier];
      if (s->swarm_time >= last.swarm_time) last = *s;  // one that was overtaken is no news
    }
    if (now % kSlot == Duration::zero()) {
      for (std::size_t i = 0; i < motion.size(); ++i) {
        auto s = setpoint_of(motion[i], pace.at(SwarmTime(now)));
        s.carrier = mission.plan.carriers[i].id;
        s.swarm_time = SwarmTime(now);
        radio.send(2 * i, now, s);
      }
      for (const auto& [carrier, last] : heard) {
        auto s = flown(last, SwarmTime(now), gap);
        s.sequence = ++sequence;
        world.hear(now, s);
      }
    }
    static_cast<void>(world.advance(now));
  }
  return world.felt();
}

void row(const char* what, const Felt& felt, const Felt& gyre) {
  std::printf("    %-26s %10.5f %10.5f %12.4f", what, felt.force_rms_n, felt.force_max_n,
              1e3 * felt.displacement_max_m);
  if (&felt != &gyre) {
    std::printf("   %8.0f %8.0f", felt.force_rms_n / gyre.force_rms_n,
                felt.displacement_max_m / gyre.displacement_max_m);
  }
  std::printf("\n");
}

}  // namespace

int main() {
  const std::string source = gyre::test::source_directory();
  std::printf("30 %% of the packets lost, and all of them for 2 s (aim: at least 100 times less):\n\n");
  std::printf("    %-26s %10s %10s %12s   %8s %8s\n", "", "rms, N", "max, N", "moved, mm", "x force", "x moved");
  for (const char* name : {"/deploy/missions/paper.textproto", "/deploy/missions/paper-headings.textproto",
                           "/tests/processes/missions/faults.textproto"}) {
    const auto read = gyre::mission::read_mission_file(source + name);
    if (!read) {
      std::fprintf(stderr, "%s\n", read.error().text.c_str());
      return 1;
    }
    gyre::mission::Mission mission = read.value();
    mission.plan.winch.time_constant_s = kLag_s;
    for (mechanics::Carrier& carrier : mission.plan.carriers) carrier.vehicle.time_constant_s = kLag_s;
    std::printf("  %s, %.2f rad/s, load of %.2f N\n", mission.name.c_str(), mission.plan.cycle.rate_rad_s,
                mission.plan.load.mass_kg * mission.plan.gravity_m_s2);
    const Felt gyre = GyreFlight(mission).fly();
    row("Gyre", gyre, gyre);
    row("streamed, hold", stream(mission, Gap::kHold), gyre);
    row("streamed, extrapolate", stream(mission, Gap::kExtrapolate), gyre);
  }
  return 0;
}
