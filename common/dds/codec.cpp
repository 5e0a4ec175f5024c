#include "common/dds/codec.hpp"

#include "common/dds/wire_fields.hpp"

namespace gyre::dds {

namespace idl = fast::idl;

// The bounds of gyre_msgs.idl, which has to repeat the protocol's as literals.
static_assert(protocol::kMaxTransitions == 4 && protocol::kMaxRamps == 4 && protocol::kMaxPlans == 7,
              "the sequences of gyre_msgs.idl");
static_assert(kMaxCarrierId == 100, "the silent carriers of gyre_msgs.idl");
static_assert(protocol::kMaxTextBytes == 255 && protocol::kMaxMissionBytes == 32768, "the strings of gyre_msgs.idl");
static_assert(protocol::kMaxJournalBytes == 1000, "the bytes of gyre_msgs.idl");

namespace {

// The lists of slices that an offer and what is held of it have in common.
template <class WireSlices>
[[nodiscard]] bool put_slices(const std::vector<protocol::NumberedSlice>& slices, WireSlices& wire) {
  if (slices.size() > protocol::kMaxPlans) return false;
  for (const protocol::NumberedSlice& numbered : slices) {
    idl::NumberedSlice& entry = wire.emplace_back();
    entry.number(to_wire(numbered.number));
    entry.slice(to_wire(numbered.slice));
  }
  return true;
}

template <class WireSlices>
[[nodiscard]] std::optional<std::vector<protocol::NumberedSlice>> slices_of(const WireSlices& wire) {
  if (wire.size() > protocol::kMaxPlans) return std::nullopt;
  std::vector<protocol::NumberedSlice> slices;
  for (const idl::NumberedSlice& entry : wire) {
    const auto slice = from_wire(entry.slice());
    if (!slice) return std::nullopt;
    slices.push_back({from_wire(entry.number()), *slice});
  }
  return slices;
}

}  // namespace

std::string fitting_text(const std::string& text, std::size_t bytes) {
  std::size_t end = text.find('\0');
  if (end == std::string::npos) end = text.size();
  if (end > bytes) {
    end = bytes;
    // Bytes 10xxxxxx continue a character; at most three do, so text that is no UTF-8 loses no more than that.
    const auto continues = [&](std::size_t i) { return (static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80U; };
    for (int step = 0; step < 3 && end > 0 && continues(end); ++step) --end;
  }
  return text.substr(0, end);
}

std::optional<idl::Beacon> encode(const protocol::Beacon& message) {
  const auto course = to_wire(message.course);
  if (!course) return std::nullopt;
  idl::Beacon wire;
  wire.term(message.term);
  wire.sequence_number(message.sequence);
  wire.swarm_time_ns(ns(message.swarm_time));
  wire.course(*course);
  if (message.proposal) {
    const auto proposal = to_wire(*message.proposal);
    if (!proposal) return std::nullopt;
    wire.proposal().push_back(*proposal);
  }
  wire.skew_budget_ns(message.skew_budget.count());
  return wire;
}

std::optional<protocol::Beacon> decode(const idl::Beacon& wire) {
  const auto course = from_wire(wire.course());
  if (!course || wire.proposal().size() > 1) return std::nullopt;
  protocol::Beacon message{wire.term(), wire.sequence_number(), swarm(wire.swarm_time_ns()),
                           *course,     std::nullopt,           Duration(wire.skew_budget_ns())};
  if (!wire.proposal().empty()) {
    message.proposal = from_wire(wire.proposal().front());
    if (!message.proposal) return std::nullopt;
  }
  return message;
}

std::optional<idl::PlanOffer> encode(const protocol::PlanOffer& message) {
  idl::PlanOffer wire;
  wire.carrier(message.carrier);
  wire.term(message.term);
  wire.sequence_number(message.sequence);
  if (!put_slices(message.slices, wire.slices()) || !put_slices(message.neighbour, wire.neighbour())) {
    return std::nullopt;
  }
  return wire;
}

std::optional<protocol::PlanOffer> decode(const idl::PlanOffer& wire) {
  const auto slices = slices_of(wire.slices());
  const auto neighbour = slices_of(wire.neighbour());
  if (!slices || !neighbour) return std::nullopt;
  return protocol::PlanOffer{wire.carrier(), wire.term(), wire.sequence_number(), *slices, *neighbour};
}

std::optional<idl::HeldPlans> encode(const protocol::HeldPlans& message) {
  idl::HeldPlans wire;
  wire.carrier(message.carrier);
  wire.incarnation(message.incarnation);
  if (!put_slices(message.slices, wire.slices()) || !put_slices(message.neighbour, wire.neighbour())) {
    return std::nullopt;
  }
  return wire;
}

std::optional<protocol::HeldPlans> decode(const idl::HeldPlans& wire) {
  const auto slices = slices_of(wire.slices());
  const auto neighbour = slices_of(wire.neighbour());
  if (!slices || !neighbour) return std::nullopt;
  return protocol::HeldPlans{wire.carrier(), wire.incarnation(), *slices, *neighbour};
}

std::optional<idl::TimeRequest> encode(const protocol::TimeRequest& message) {
  idl::TimeRequest wire;
  wire.carrier(message.carrier);
  wire.incarnation(message.incarnation);
  wire.sequence_number(message.sequence);
  wire.local_sent_ns(ns(message.sent));
  return wire;
}

std::optional<protocol::TimeRequest> decode(const idl::TimeRequest& wire) {
  return protocol::TimeRequest{wire.carrier(), wire.incarnation(), wire.sequence_number(), local(wire.local_sent_ns())};
}

std::optional<idl::TimeReply> encode(const protocol::TimeReply& message) {
  idl::TimeReply wire;
  wire.carrier(message.carrier);
  wire.incarnation(message.incarnation);
  wire.sequence_number(message.sequence);
  wire.term(message.term);
  wire.local_request_sent_ns(ns(message.request_sent));
  wire.swarm_request_received_ns(ns(message.request_received));
  wire.swarm_reply_sent_ns(ns(message.reply_sent));
  wire.believed(message.believed);
  wire.rival(fitting_text(message.rival, protocol::kMaxTextBytes));
  return wire;
}

std::optional<protocol::TimeReply> decode(const idl::TimeReply& wire) {
  return protocol::TimeReply{wire.carrier(),
                             wire.incarnation(),
                             wire.sequence_number(),
                             wire.term(),
                             local(wire.local_request_sent_ns()),
                             swarm(wire.swarm_request_received_ns()),
                             swarm(wire.swarm_reply_sent_ns()),
                             wire.believed(),
                             wire.rival().to_string()};
}

std::optional<idl::AgentStatus> encode(const protocol::AgentStatus& message) {
  const auto course = to_wire(message.course);
  if (!course || message.accepted.size() > protocol::kMaxPlans) return std::nullopt;
  idl::AgentStatus wire;
  wire.carrier(message.carrier);
  wire.incarnation(message.incarnation);
  wire.sequence_number(message.sequence);
  wire.term(message.term);
  wire.state(static_cast<std::uint8_t>(message.state));
  wire.swarm_time_ns(ns(message.swarm_time));
  wire.clock_uncertainty_ns(message.clock_uncertainty.count());
  wire.clock_drift_ppm(message.clock_drift_ppm);
  wire.course(*course);
  wire.confirmed(message.confirmed);
  for (const protocol::PlanNumber& number : message.accepted) wire.accepted().push_back(to_wire(number));
  wire.refused(to_wire(message.refused));
  wire.refusal(fitting_text(message.refusal, protocol::kMaxTextBytes));
  wire.beacons_received(message.beacons_received);
  wire.beacons_missed(message.beacons_missed);
  wire.dropped(to_wire(message.dropped));
  wire.address(fitting_text(message.address, protocol::kMaxTextBytes));
  return wire;
}

std::optional<protocol::AgentStatus> decode(const idl::AgentStatus& wire) {
  const auto state = enumerator(wire.state(), protocol::AgentState::kWaiting, protocol::AgentState::kAlone);
  const auto course = from_wire(wire.course());
  if (!state || !course || wire.accepted().size() > protocol::kMaxPlans) return std::nullopt;
  protocol::AgentStatus message;
  message.carrier = wire.carrier();
  message.incarnation = wire.incarnation();
  message.sequence = wire.sequence_number();
  message.term = wire.term();
  message.state = *state;
  message.swarm_time = swarm(wire.swarm_time_ns());
  message.clock_uncertainty = Duration(wire.clock_uncertainty_ns());
  message.clock_drift_ppm = wire.clock_drift_ppm();
  message.course = *course;
  message.confirmed = wire.confirmed();
  for (const idl::PlanNumber& number : wire.accepted()) message.accepted.push_back(from_wire(number));
  message.refused = from_wire(wire.refused());
  message.refusal = wire.refusal().to_string();
  message.beacons_received = wire.beacons_received();
  message.beacons_missed = wire.beacons_missed();
  message.dropped = from_wire(wire.dropped());
  message.address = wire.address().to_string();
  return message;
}

std::optional<idl::CarrierSetpoint> encode(const protocol::Setpoint& message) {
  idl::CarrierSetpoint wire;
  wire.carrier(message.carrier);
  wire.incarnation(message.incarnation);
  wire.sequence_number(message.sequence);
  wire.swarm_time_ns(ns(message.swarm_time));
  wire.position_w_m(numbers(message.position_w_m));
  wire.velocity_w_m_s(numbers(message.velocity_w_m_s));
  wire.acceleration_w_m_s2(numbers(message.acceleration_w_m_s2));
  wire.direction_w(numbers(message.direction_w));
  wire.tension_n(message.tension_n);
  wire.cable_length_m(message.cable_length_m);
  wire.winch_length_m(message.winch_length_m);
  wire.winch_rate_m_s(message.winch_rate_m_s);
  wire.winch_acceleration_m_s2(message.winch_acceleration_m_s2);
  return wire;
}

std::optional<protocol::Setpoint> decode(const idl::CarrierSetpoint& wire) {
  protocol::Setpoint message;
  message.carrier = wire.carrier();
  message.incarnation = wire.incarnation();
  message.sequence = wire.sequence_number();
  message.swarm_time = swarm(wire.swarm_time_ns());
  message.position_w_m = vector(wire.position_w_m());
  message.velocity_w_m_s = vector(wire.velocity_w_m_s());
  message.acceleration_w_m_s2 = vector(wire.acceleration_w_m_s2());
  message.direction_w = vector(wire.direction_w());
  message.tension_n = wire.tension_n();
  message.cable_length_m = wire.cable_length_m();
  message.winch_length_m = wire.winch_length_m();
  message.winch_rate_m_s = wire.winch_rate_m_s();
  message.winch_acceleration_m_s2 = wire.winch_acceleration_m_s2();
  return message;
}

std::optional<idl::CarrierState> encode(const protocol::CarrierState& message) {
  idl::CarrierState wire;
  wire.carrier(message.carrier);
  wire.incarnation(message.incarnation);
  wire.follows(message.follows);
  wire.sequence_number(message.sequence);
  wire.local_stamp_ns(ns(message.stamp));
  wire.position_w_m(numbers(message.position_w_m));
  wire.velocity_w_m_s(numbers(message.velocity_w_m_s));
  wire.tension_n(message.tension_n);
  wire.cable_length_m(message.cable_length_m);
  wire.winch_length_m(message.winch_length_m);
  wire.winch_rate_m_s(message.winch_rate_m_s);
  return wire;
}

std::optional<protocol::CarrierState> decode(const idl::CarrierState& wire) {
  protocol::CarrierState message;
  message.carrier = wire.carrier();
  message.incarnation = wire.incarnation();
  message.follows = wire.follows();
  message.sequence = wire.sequence_number();
  message.stamp = local(wire.local_stamp_ns());
  message.position_w_m = vector(wire.position_w_m());
  message.velocity_w_m_s = vector(wire.velocity_w_m_s());
  message.tension_n = wire.tension_n();
  message.cable_length_m = wire.cable_length_m();
  message.winch_length_m = wire.winch_length_m();
  message.winch_rate_m_s = wire.winch_rate_m_s();
  return message;
}

std::optional<idl::LoadState> encode(const protocol::LoadState& message) {
  const Eigen::Quaterniond& q = message.orientation_w_b;
  idl::LoadState wire;
  wire.incarnation(message.incarnation);
  wire.sequence_number(message.sequence);
  wire.local_stamp_ns(ns(message.stamp));
  wire.position_w_m(numbers(message.position_w_m));
  wire.velocity_w_m_s(numbers(message.velocity_w_m_s));
  wire.orientation_w_b_xyzw({q.x(), q.y(), q.z(), q.w()});
  wire.angular_velocity_b_rad_s(numbers(message.angular_velocity_b_rad_s));
  return wire;
}

std::optional<protocol::LoadState> decode(const idl::LoadState& wire) {
  const std::array<double, 4>& xyzw = wire.orientation_w_b_xyzw();
  protocol::LoadState message;
  message.incarnation = wire.incarnation();
  message.sequence = wire.sequence_number();
  message.stamp = local(wire.local_stamp_ns());
  message.position_w_m = vector(wire.position_w_m());
  message.velocity_w_m_s = vector(wire.velocity_w_m_s());
  message.orientation_w_b = Eigen::Quaterniond(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
  message.angular_velocity_b_rad_s = vector(wire.angular_velocity_b_rad_s());
  return message;
}

}  // namespace gyre::dds
