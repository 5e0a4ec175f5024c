// Every field of every message, visited in order: once to fill it at random, once to read it back bit by bit.

#include "tests/dds/random_messages.hpp"

#include <rapidcheck.h>

#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "common/protocol/fields.hpp"

namespace gyre::tests {
namespace {

template <class Message, class Visitor>
void each_field(Message& message, Visitor& visitor) {
  protocol::for_each_field<Message>([&](const auto& field) { visitor(message.*field.member); });
}

template <class Visitor, class... Numbers>
void visit_all(Visitor& visitor, Numbers&... numbers) {
  (visitor(numbers), ...);
}

/// Fills fields with anything their type can hold; a third of the numbers are extremes. Runs inside a property.
struct Randomiser {
  std::size_t text_bytes = protocol::kMaxTextBytes;

  template <class T>
  void operator()(T& field) {
    if constexpr (std::is_same_v<T, bool>) {
      field = *rc::gen::arbitrary<bool>();
    } else if constexpr (std::is_integral_v<T>) {
      field = *rc::gen::weightedOneOf<T>(
          {{2, rc::gen::arbitrary<T>()},
           {1, rc::gen::element(std::numeric_limits<T>::min(), std::numeric_limits<T>::max())}});
    } else {
      each_field(field, *this);
    }
  }
  void operator()(double& field) {
    // Any bits are a double: infinities, NaN with payload, denormals, negative zero.
    const auto bits = *rc::gen::arbitrary<std::uint64_t>();
    std::memcpy(&field, &bits, sizeof field);
    if (bits % 3 == 0) {
      using Limits = std::numeric_limits<double>;
      field = *rc::gen::element(0.0, -0.0, Limits::max(), Limits::lowest(), Limits::denorm_min(), Limits::infinity(),
                                Limits::quiet_NaN());
    }
  }
  void operator()(Eigen::Vector3d& field) { visit_all(*this, field.x(), field.y(), field.z()); }
  void operator()(Eigen::Quaterniond& field) { visit_all(*this, field.w(), field.x(), field.y(), field.z()); }
  void operator()(Duration& field) { field = Duration(random_ns()); }
  void operator()(LocalTime& field) { field = LocalTime(Duration(random_ns())); }
  void operator()(SwarmTime& field) { field = SwarmTime(Duration(random_ns())); }
  void operator()(PlanTime& field) { field = PlanTime(Duration(random_ns())); }
  void operator()(std::string& field) {
    const auto size = *rc::gen::weightedOneOf<std::size_t>(
        {{3, rc::gen::inRange<std::size_t>(0, text_bytes + 1)}, {1, rc::gen::just(text_bytes)}});
    field.assign(size, *rc::gen::inRange<char>('a', 'z'));
  }
  void operator()(protocol::Wisher& e) {
    using Wisher = protocol::Wisher;
    e = *rc::gen::element(Wisher::kNobody, Wisher::kStart, Wisher::kPerson, Wisher::kSilence, Wisher::kEvidence);
  }
  void operator()(protocol::AgentState& e) {
    using State = protocol::AgentState;
    e = *rc::gen::element(State::kWaiting, State::kReady, State::kFlying, State::kAlone);
  }
  void operator()(protocol::CommandKind& e) {
    using Kind = protocol::CommandKind;
    e = *rc::gen::element(Kind::kEngage, Kind::kRelease, Kind::kFreeze, Kind::kRetune, Kind::kPace);
  }
  void operator()(protocol::DisturbanceKind& e) {
    using Kind = protocol::DisturbanceKind;
    e = *rc::gen::element(Kind::kLosePackets, Kind::kShiftClock, Kind::kPushLoad);
  }
  void operator()(mechanics::LengthLaw::Kind& e) {
    using Kind = mechanics::LengthLaw::Kind;
    e = *rc::gen::element(Kind::kLevel, Kind::kDirectional, Kind::kSine, Kind::kFixed);
  }
  template <class T>
  void operator()(std::vector<T>& field) {
    constexpr std::size_t kBound = std::is_same_v<T, protocol::Transition> ? protocol::kMaxTransitions
                                   : std::is_same_v<T, protocol::Ramp>     ? protocol::kMaxRamps
                                   : std::is_same_v<T, CarrierId>          ? kMaxCarrierId
                                   : std::is_same_v<T, std::uint8_t>       ? protocol::kMaxJournalBytes
                                                                           : protocol::kMaxPlans;
    field.resize(*rc::gen::inRange<std::size_t>(0, kBound + 1));
    for (T& entry : field) (*this)(entry);
  }
  template <class T>
  void operator()(std::optional<T>& field) {
    field.reset();
    if (*rc::gen::arbitrary<bool>()) (*this)(field.emplace());
  }

  static std::int64_t random_ns() {
    std::int64_t ns = 0;
    Randomiser()(ns);
    return ns;
  }
};

/// The bits of every field, one after the other. Equal for two messages exactly when they are the same, NaN included.
struct Flattener {
  std::string bits;

  template <class T>
  void operator()(T& field) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      bits.append(reinterpret_cast<const char*>(&field), sizeof field);
    } else {
      each_field(field, *this);
    }
  }
  void operator()(Eigen::Vector3d& field) { visit_all(*this, field.x(), field.y(), field.z()); }
  void operator()(Eigen::Quaterniond& field) { visit_all(*this, field.w(), field.x(), field.y(), field.z()); }
  void operator()(Duration& field) { flatten_ns(field.count()); }
  void operator()(LocalTime& field) { flatten_ns(field.time_since_epoch().count()); }
  void operator()(SwarmTime& field) { flatten_ns(field.time_since_epoch().count()); }
  void operator()(PlanTime& field) { flatten_ns(field.time_since_epoch().count()); }
  void operator()(std::string& field) { bits += std::to_string(field.size()) + ":" + field; }
  template <class T>
  void operator()(std::vector<T>& field) {
    bits += std::to_string(field.size()) + "#";
    for (T& entry : field) (*this)(entry);
  }
  template <class T>
  void operator()(std::optional<T>& field) {
    bits += field ? "+" : "-";
    if (field) (*this)(*field);
  }
  void flatten_ns(std::int64_t ns) { (*this)(ns); }
};

}  // namespace

template <class Message>
Message random_message() {
  Message message;
  Randomiser randomiser;
  constexpr bool kHoldsAMission =
      std::is_same_v<Message, protocol::Command> || std::is_same_v<Message, protocol::MissionText>;
  if constexpr (kHoldsAMission) randomiser.text_bytes = protocol::kMaxMissionBytes;
  each_field(message, randomiser);
  return message;
}

template <class Message>
std::string bits_of(const Message& message) {
  Flattener flattener;
  Message visited = message;  // the visitors of both kinds take fields that can be written
  each_field(visited, flattener);
  return std::move(flattener.bits);
}

bool holds(const std::function<void()>& law) {
  return rc::check(law);
}

template protocol::Beacon random_message<protocol::Beacon>();
template std::string bits_of(const protocol::Beacon&);
template protocol::PlanOffer random_message<protocol::PlanOffer>();
template std::string bits_of(const protocol::PlanOffer&);
template protocol::HeldPlans random_message<protocol::HeldPlans>();
template std::string bits_of(const protocol::HeldPlans&);
template protocol::TimeRequest random_message<protocol::TimeRequest>();
template std::string bits_of(const protocol::TimeRequest&);
template protocol::TimeReply random_message<protocol::TimeReply>();
template std::string bits_of(const protocol::TimeReply&);
template protocol::AgentStatus random_message<protocol::AgentStatus>();
template std::string bits_of(const protocol::AgentStatus&);
template protocol::Setpoint random_message<protocol::Setpoint>();
template std::string bits_of(const protocol::Setpoint&);
template protocol::CarrierState random_message<protocol::CarrierState>();
template std::string bits_of(const protocol::CarrierState&);
template protocol::LoadState random_message<protocol::LoadState>();
template std::string bits_of(const protocol::LoadState&);
template protocol::Command random_message<protocol::Command>();
template std::string bits_of(const protocol::Command&);
template protocol::CommandReply random_message<protocol::CommandReply>();
template std::string bits_of(const protocol::CommandReply&);
template protocol::CoordinatorStatus random_message<protocol::CoordinatorStatus>();
template std::string bits_of(const protocol::CoordinatorStatus&);
template protocol::MissionText random_message<protocol::MissionText>();
template std::string bits_of(const protocol::MissionText&);
template protocol::Health random_message<protocol::Health>();
template std::string bits_of(const protocol::Health&);
template protocol::Disturbance random_message<protocol::Disturbance>();
template std::string bits_of(const protocol::Disturbance&);
template protocol::JournalPiece random_message<protocol::JournalPiece>();
template std::string bits_of(const protocol::JournalPiece&);

}  // namespace gyre::tests
