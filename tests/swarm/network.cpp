#include "tests/swarm/network.hpp"

#include <cmath>

namespace gyre::swarm {
namespace {

Duration scaled(Duration d, double by) {
  return Duration(std::llround(static_cast<double>(d.count()) * by));
}

}  // namespace

Network::Network(std::uint64_t seed, std::size_t processes) : random_(seed, "network"), links_(processes * processes) {
  // Loopback and a local network lie between these; the way there need not be the way back.
  for (std::size_t i = 0; i < processes; ++i) {
    outward_.push_back(std::chrono::microseconds(10) + scaled(std::chrono::microseconds(300), random_.uniform()));
    inward_.push_back(std::chrono::microseconds(10) + scaled(std::chrono::microseconds(300), random_.uniform()));
  }
}

Duration Network::delay(std::size_t from, std::size_t to) {
  Duration out = outward_[from] + inward_[to] + scaled(weather.jitter, -std::log(random_.uniform()));
  if (chance(weather.overtaken)) {
    ++counts.held_back;
    out += scaled(weather.held_back, random_.uniform());
  }
  return out;
}

Network::Fate Network::send(TrueTime now, std::size_t from, std::size_t to) {
  ++counts.sent;
  Fate fate;
  if (parted(from, to)) {
    ++counts.parted;
    return fate;
  }
  if (weather.bursts_per_s > 0.0) {
    Link& link = links_[from * outward_.size() + to];
    const double since_s = seconds(now - link.last_sent);
    link.last_sent = now;
    if (now >= link.burst_until && chance(1.0 - std::exp(-weather.bursts_per_s * std::min(since_s, 0.1)))) {
      link.burst_until = now + scaled(weather.burst, -std::log(random_.uniform()));
    }
    if (now < link.burst_until) {
      ++counts.lost_in_burst;
      return fate;
    }
  }
  if (chance(weather.loss)) {
    ++counts.lost;
    return fate;
  }
  fate.delays[0] = delay(from, to);
  fate.copies = 1;
  if (chance(weather.duplicated)) {
    ++counts.duplicated;
    fate.delays[1] = delay(from, to);
    fate.copies = 2;
  }
  return fate;
}

bool Network::asked_again(std::size_t from, std::size_t to) {
  if (parted(from, to)) return false;
  return weather.loss <= 0.0 || random_.uniform() < (1.0 - weather.loss) * (1.0 - weather.loss);
}

}  // namespace gyre::swarm
