#include "tests/swarm/scenario.hpp"

#include <algorithm>

#include "common/base/text.hpp"

namespace gyre::swarm {
namespace {

using protocol::CommandKind;

class Writer {
 public:
  Writer(std::uint64_t seed, std::size_t load) : random_(seed, "scenario") {
    s_.seed = seed;
    s_.load = load;
  }

  double draw(double low, double high) { return low + (high - low) * random_.uniform(); }
  std::size_t pick(std::size_t count) { return static_cast<std::size_t>(random_.next() % count); }
  bool chance(double share) { return random_.uniform() < share; }
  Duration span(double low_s, double high_s) { return from_seconds(draw(low_s, high_s)); }
  std::size_t carriers() const { return loads()[s_.load].size(); }
  std::size_t any_agent() { return kCoordinators + pick(carriers()); }

  Action& add(double at_s, Deed deed) {
    s_.actions.emplace_back();
    Action& action = s_.actions.back();
    action.at = TrueTime(from_seconds(at_s));
    action.deed = deed;
    return action;
  }

  Scenario& scenario() { return s_; }
  void clocks();
  void start_all(double within_s);
  void fault(double begin_s, double end_s);
  void kill(double begin_s, double end_s);
  void order(double at_s);
  void costs(double share) { s_.residual_budget += share; }
  void sum_up();

  Scenario finish(double heal_s) {
    s_.heal = TrueTime(from_seconds(heal_s));
    add(heal_s, Deed::kHeal);
    std::stable_sort(s_.actions.begin(), s_.actions.end(),
                     [](const Action& a, const Action& b) { return a.at < b.at; });
    return std::move(s_);
  }

 private:
  Scenario s_;
  RandomStream random_;
};

void Writer::clocks() {
  for (std::size_t i = 0; i < kCoordinators + carriers(); ++i) {
    s_.clock_offsets.push_back(std::chrono::duration_cast<Duration>(std::chrono::seconds(1)) *
                                   static_cast<int>(draw(-5e5, 1e6)) +
                               span(0.0, 1.0));
    s_.clock_drifts.push_back(draw(-kDriftMax, kDriftMax));
  }
  s_.clock_wander_per_sqrt_s = chance(0.5) ? 0.05e-6 : 0.0;
}

void Writer::start_all(double within_s) {
  for (std::size_t p = 0; p < kCoordinators + carriers(); ++p) {
    if (p != 1) add(draw(0.0, within_s), Deed::kStart).process = p;
  }
}

void Writer::kill(double begin_s, double end_s) {
  // Agents are lost more often than they come back in time; a supervisor brings a coordinator back at once or late.
  costs(cost::kProcess);
  const bool coordinator = chance(0.5);
  const std::size_t process = coordinator ? 0 : any_agent();
  if (coordinator && chance(0.5)) {
    add(begin_s, Deed::kKillInChange).offset = span(-0.6, 2.0);
  } else {
    add(begin_s, Deed::kKill).process = process;
  }
  if (chance(0.7)) add(std::min(end_s, begin_s + draw(0.1, 6.0)), Deed::kStart).process = process;
}

void Writer::fault(double begin_s, double end_s) {
  const double until_s = std::min(end_s, begin_s + draw(0.5, 10.0));
  switch (pick(8)) {
    case 0:
    case 1: {  // bad weather of any kind
      Weather weather;
      if (chance(0.6)) weather.loss = chance(0.3) ? draw(0.6, 0.9) : draw(0.0, 0.6);
      if (chance(0.4)) weather.bursts_per_s = draw(0.1, 2.0);
      weather.burst = span(0.05, 0.6);
      if (chance(0.4)) weather.duplicated = draw(0.0, 0.5);
      if (chance(0.4)) weather.overtaken = draw(0.0, 0.3);
      weather.held_back = chance(0.2) ? span(0.3, 3.0) : span(0.0, 0.3);
      weather.jitter = from_seconds(draw(0.0, 1.0) < 0.3 ? draw(1e-3, 2e-2) : draw(1e-5, 1e-3));
      if (chance(0.3)) weather.garbage = draw(0.0, 0.2);
      if (chance(0.2)) weather.lies = draw(0.0, 0.1);
      const bool bad = weather.loss > 0.3 || weather.bursts_per_s > 0.0 || weather.overtaken > 0.0 ||
                       weather.lies > 0.0 || weather.jitter > std::chrono::milliseconds(5);
      costs(bad ? cost::kLink : cost::kProcess);
      add(begin_s, Deed::kWeather).weather = weather;
      add(until_s, Deed::kWeather);
      break;
    }
    case 2: {
      std::vector<int> groups;
      for (std::size_t i = 0; i < kCoordinators + carriers(); ++i) groups.push_back(chance(0.5) ? 1 : 0);
      costs(cost::kLink);
      add(begin_s, Deed::kPartition).groups = groups;
      add(until_s, Deed::kPartition);
      break;
    }
    case 3:
    case 4:
      kill(begin_s, end_s);
      break;
    case 5: {
      costs(cost::kProcess);
      Action& suspend = add(begin_s, Deed::kSuspend);
      suspend.process = chance(0.3) ? 0 : any_agent();
      suspend.length = span(0.1, 3.0);
      break;
    }
    case 6: {
      costs(cost::kProcess);
      Action& stall = add(begin_s, Deed::kStall);
      stall.process = chance(0.3) ? 0 : any_agent();
      stall.length = chance(0.7) ? span(0.02, 0.3) : span(0.3, 2.0);
      break;
    }
    default:
      if (chance(0.5)) {
        add(begin_s, Deed::kStart).process = 1;  // a second coordinator by mistake
      } else if (chance(0.7)) {
        costs(cost::kProcess);
        Action& twin = add(begin_s, Deed::kTwin);
        twin.process = any_agent();
        twin.length = span(0.1, 10.0);
      } else {
        add(begin_s, Deed::kSecondWorld).length = span(0.1, 10.0);
      }
      break;
  }
}

/// A plan is known to the coordinator, to each agent for itself, and to its neighbour. From the mission's file anybody
/// learns the first one again, but no other.
void Writer::sum_up() {
  bool retuned = false;
  bool coordinator_died = false;
  std::size_t agents_died = 0;
  for (const Action& a : s_.actions) {
    retuned = retuned || a.deed == Deed::kRetune;
    coordinator_died = coordinator_died || a.deed == Deed::kKillInChange || (a.deed == Deed::kKill && a.process == 0);
    agents_died += a.deed == Deed::kKill && a.process >= kCoordinators ? 1 : 0;
  }
  if (coordinator_died && agents_died > 0 && (retuned || agents_died >= carriers())) costs(cost::kForgotten);
}

void Writer::order(double at_s) {
  const std::size_t kind = pick(5);
  if (kind < 2) {
    add(at_s, Deed::kCommand).command = CommandKind::kEngage;
  } else if (kind == 2) {
    add(at_s, Deed::kCommand).command = CommandKind::kRelease;
  } else if (kind == 3) {
    add(at_s, Deed::kCommand).command = CommandKind::kFreeze;
  } else {
    add(at_s, Deed::kRetune).motion = pick(loads()[s_.load].motions.size() + 1);
  }
}

}  // namespace

Scenario scenario(std::uint64_t seed) {
  RandomStream choice(seed, "load");
  // The paper's load in one flight of four, the others evenly.
  const std::size_t load = choice.uniform() < 0.25 ? 0 : static_cast<std::size_t>(choice.next() % loads().size());
  Writer w(seed, load);
  w.clocks();
  w.start_all(w.chance(0.8) ? 0.5 : 4.0);
  Scenario& s = w.scenario();
  if (w.chance(0.5)) s.silence.stop_after.reset();
  s.transition = w.span(2.0, 6.0);
  s.engage_when_ready = w.chance(0.6);
  s.rehearse = w.chance(0.005);
  RandomStream judging(seed, "judging");
  if (judging.uniform() < 0.3) s.judging = from_seconds(judging.uniform());  // processors that others want as well
  const double begin_s = w.chance(0.2) ? 0.0 : 4.0;                          // some swarms start into bad weather
  const double heal_s = w.draw(10.0, 20.0);
  const std::size_t faults = w.pick(6);
  for (std::size_t i = 0; i < faults; ++i) w.fault(w.draw(begin_s, heal_s), heal_s);
  const std::size_t orders = w.pick(5);
  for (std::size_t i = 0; i < orders; ++i) w.order(w.draw(3.0, heal_s));
  w.sum_up();
  return w.finish(heal_s);
}

Scenario calm_scenario(std::uint64_t seed, std::size_t load) {
  Writer w(seed, load);
  w.clocks();
  w.start_all(0.5);
  w.scenario().transition = std::chrono::seconds(4);
  w.scenario().engage_when_ready = true;
  w.add(9.0, Deed::kRetune).motion = 1;
  w.add(15.0, Deed::kCommand).command = CommandKind::kFreeze;
  w.add(20.0, Deed::kCommand).command = CommandKind::kEngage;
  return w.finish(26.0);
}

const char* name(Deed deed) {
  switch (deed) {
    case Deed::kWeather:
      return "weather";
    case Deed::kPartition:
      return "partition";
    case Deed::kKill:
      return "kill";
    case Deed::kKillInChange:
      return "kill in the next change";
    case Deed::kStart:
      return "start";
    case Deed::kSuspend:
      return "suspend";
    case Deed::kStall:
      return "stall";
    case Deed::kClockStop:
      return "clock stops";
    case Deed::kClockLeap:
      return "clock leaps";
    case Deed::kTwin:
      return "a second agent";
    case Deed::kSecondWorld:
      return "a second world";
    case Deed::kCut:
      return "cut";
    case Deed::kCommand:
      return "command";
    case Deed::kRetune:
      return "retune";
    case Deed::kHeal:
      return "heal";
  }
  return "unknown";
}

std::string describe(const Action& a) {
  std::string out = name(a.deed);
  const auto process = [&] {
    return a.process < kCoordinators ? text(" coordinator %zu", a.process)
                                     : text(" agent %zu", a.process - kCoordinators + 1);
  };
  switch (a.deed) {
    case Deed::kWeather:
      return out + text(
                       ": loss %.2f, bursts %.2f/s of %.2f s, twice %.2f, held back %.2f by %.2f s, jitter %.2f ms, "
                       "garbage %.2f, "
                       "lies %.2f",
                       a.weather.loss, a.weather.bursts_per_s, seconds(a.weather.burst), a.weather.duplicated,
                       a.weather.overtaken, seconds(a.weather.held_back), 1e3 * seconds(a.weather.jitter),
                       a.weather.garbage, a.weather.lies);
    case Deed::kPartition:
      if (a.groups.empty()) return out + " ends";
      for (const int group : a.groups) out += text(" %d", group);
      return out;
    case Deed::kKillInChange:
      return out + text(", %.3f s after its start", seconds(a.offset));
    case Deed::kKill:
    case Deed::kStart:
      return out + process();
    case Deed::kCut:
      for (const Network::Cut& cut : a.cuts) out += text(" %zu->%zu", cut.from, cut.to);
      return out;
    case Deed::kSuspend:
    case Deed::kStall:
      return out + process() + text(" for %.3f s", seconds(a.length));
    case Deed::kSecondWorld:
      return out + text(" for %.3f s", seconds(a.length));
    case Deed::kTwin:
    case Deed::kClockStop:
    case Deed::kClockLeap:
      return out + process() + text(" for %.3f s", seconds(a.length));
    case Deed::kCommand:
      return out + text(" %d", static_cast<int>(a.command));
    case Deed::kRetune:
      return out + text(" to motion %zu", a.motion);
    case Deed::kHeal:
      return out;
  }
  return out;
}

}  // namespace gyre::swarm
