// Messages that no honest process sends.

#include <cmath>
#include <limits>

#include "tests/swarm/swarm_parts.hpp"

namespace gyre::swarm {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
constexpr Duration kForever = Duration(std::numeric_limits<Duration::rep>::max() / 2);

class Breaker {
 public:
  explicit Breaker(RandomStream& random) : random_(random) {}

  protocol::Beacon operator()(protocol::Beacon b) {
    switch (pick(9)) {
      case 4:
        b.sequence = count();
        break;
      case 5:
        b.term = b.course.term = count();
        if (b.proposal) b.proposal->term = b.term;
        break;
      case 6:
        b.course.revision = count();
        break;
      case 7:
        if (b.proposal) b.proposal->revision = count();
        break;
      case 8:
        b.course.base.number.revision = count();
        break;
      case 0:
        b.swarm_time += kForever - b.swarm_time.time_since_epoch();
        break;
      case 1:
        b.term = b.term == 0 ? 0 : b.term - 1;  // a coordinator that nobody follows any more
        ++b.course.revision;
        break;
      case 2:
        b.course.transitions.resize(protocol::kMaxTransitions + 3);
        break;
      default:
        b.swarm_time += std::chrono::hours(random_.uniform() < 0.5 ? 5 : -5);
        break;
    }
    return b;
  }
  protocol::PlanOffer operator()(protocol::PlanOffer o) {
    if (const auto which = pick(8); which == 0) {
      o.sequence = count();
    } else if (which == 1) {
      o.term = count();
    } else if (which == 2 && !o.slices.empty()) {
      o.slices.front().number.revision = kMost;
    } else if (o.slices.empty() || which == 3) {
      o.carrier = 99;
    } else if (pick(2) == 0) {
      o.slices.front().slice.particular_force_w_n.x() = kNaN;
    } else {
      o.slices.front().slice.incoming.direction *= 2.0;
      o.slices.front().slice.incoming.direction.x() += 0.5;
    }
    return o;
  }
  protocol::HeldPlans operator()(protocol::HeldPlans h) {
    if (h.slices.empty()) {
      h.carrier = 99;
    } else {
      h.slices.front().slice.rate_rad_s = pick(2) == 0 ? kNaN : -1.0;
    }
    return h;
  }
  protocol::TimeRequest operator()(protocol::TimeRequest r) {
    (pick(2) == 0 ? r.incarnation : r.sequence) = kMost;
    if (pick(2) == 0) r.carrier = 99;
    return r;
  }
  protocol::TimeReply operator()(protocol::TimeReply r) {
    switch (pick(6)) {
      case 4:
        r.sequence = kMost;
        break;
      case 5:
        r.term = count();
        break;
      case 0:
        r.carrier = 99;
        break;
      case 1:
        r.reply_sent = SwarmTime(-kForever);
        r.request_received = SwarmTime(kForever);
        break;
      case 2:
        r.request_sent = LocalTime(-kForever);
        break;
      default:
        r.incarnation ^= 1U;
        break;
    }
    return r;
  }
  protocol::AgentStatus operator()(protocol::AgentStatus s) {
    switch (pick(9)) {
      case 3:
        s.sequence = count();
        break;
      case 4:
        s.term = count();
        break;
      case 5:
        s.confirmed = count();
        break;
      case 6:
        s.incarnation = kMost;
        break;
      case 7:
        s.course.revision = kMost;
        break;
      case 8:
        s.course.term = kMost;
        break;
      case 0:
        s.carrier = 99;
        break;
      case 1:
        s.swarm_time = SwarmTime(kForever);
        break;
      default:
        s.clock_drift_ppm = kNaN;
        break;
    }
    return s;
  }
  protocol::CarrierState operator()(protocol::CarrierState s) {
    s.position_w_m.z() = kNaN;
    return s;
  }
  template <class T>
  T operator()(T message) {
    return message;
  }

 private:
  /// The largest there is, and some that only nobody would have come to.
  std::uint64_t count() { return pick(2) == 0 ? kMost : std::uint64_t{1} << (20 + pick(44)); }
  std::uint64_t pick(std::uint64_t count) { return random_.next() % count; }
  RandomStream& random_;
};

}  // namespace

Message garbage(RandomStream& random, const Message& message) {
  return std::visit([&](const auto& m) { return Message{Breaker(random)(m)}; }, message.content);
}

void lie(RandomStream& random, protocol::TimeReply& reply) {
  const double magnitude_s = std::pow(10.0, -5.0 + 9.0 * random.uniform());
  const Duration by = from_seconds(random.uniform() < 0.5 ? magnitude_s : -magnitude_s);
  reply.request_received += by;
  if (random.uniform() < 0.8) reply.reply_sent += by;
}

}  // namespace gyre::swarm
