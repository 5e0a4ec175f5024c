#pragma once
// What a core says when it is stepped through its journal again, against what its process said then: which outputs came
// of each step, as the journal tells, and their content, as far as it was recorded. Of held plans only whether they
// were told: nothing in them says which of several a recorded one was.

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "common/base/notice.hpp"
#include "common/base/time.hpp"
#include "common/protocol/messages.hpp"

namespace gyre::ground {

/// By what the messages of one kind are told apart: carrier or term, incarnation, sequence.
using MessageKey = std::array<std::uint64_t, 3>;
[[nodiscard]] MessageKey key_of(const protocol::TimeRequest& message);
[[nodiscard]] MessageKey key_of(const protocol::Setpoint& message);
[[nodiscard]] MessageKey key_of(const protocol::AgentStatus& message);
[[nodiscard]] MessageKey key_of(const protocol::TimeReply& message);
[[nodiscard]] MessageKey key_of(const protocol::PlanOffer& message);
[[nodiscard]] MessageKey key_of(const protocol::Beacon& message);
[[nodiscard]] MessageKey key_of(const protocol::CoordinatorStatus& message);
[[nodiscard]] MessageKey key_of(const protocol::MissionText& message);
[[nodiscard]] MessageKey key_of(const protocol::CommandReply& message);

/// What was recorded of what the cores say, by kind.
using RecordedWords =
    std::tuple<std::map<MessageKey, protocol::TimeRequest>, std::map<MessageKey, protocol::Setpoint>,
               std::map<MessageKey, protocol::AgentStatus>, std::map<MessageKey, protocol::TimeReply>,
               std::map<MessageKey, protocol::PlanOffer>, std::map<MessageKey, protocol::Beacon>,
               std::map<MessageKey, protocol::CoordinatorStatus>, std::map<MessageKey, protocol::MissionText>,
               std::map<MessageKey, protocol::CommandReply>>;

template <class Message>
void keep(RecordedWords& words, const Message& message) {
  std::get<std::map<MessageKey, Message>>(words).emplace(key_of(message), message);
}

class Comparison {
 public:
  struct Count {
    std::uint64_t said = 0;      ///< by the core that is stepped now
    std::uint64_t recorded = 0;  ///< of those
    std::uint64_t same = 0;      ///< of those, to the bit
  };
  struct Line {
    LocalTime at{};
    std::string words;
  };

  explicit Comparison(std::shared_ptr<const RecordedWords> recorded) : recorded_(std::move(recorded)) {}

  /// Of one step: `then` and `now` are which outputs it had, a bit each, `outputs` their names by bit.
  void step(LocalTime at, std::uint8_t then, std::uint8_t now, const std::vector<std::string>& outputs);
  /// What the core says now; `kind` names it for people: "setpoints".
  template <class Message>
  void said(LocalTime at, const std::string& kind, const Message& message);
  /// A decision that no message shows.
  void otherwise(LocalTime at, std::string words);
  void noticed(LocalTime at, const Notices& notices);

  [[nodiscard]] std::uint64_t steps() const { return steps_; }
  [[nodiscard]] LocalTime first() const { return first_; }
  [[nodiscard]] LocalTime last() const { return last_; }
  [[nodiscard]] const std::map<std::string, Count>& counts() const { return counts_; }
  /// Where it decides otherwise: all are counted, the first are kept.
  [[nodiscard]] std::uint64_t different() const { return different_; }
  [[nodiscard]] const std::vector<Line>& differences() const { return differences_; }
  [[nodiscard]] const std::vector<Line>& notices() const { return notices_; }
  /// How far apart two setpoints of one number are, at most.
  [[nodiscard]] double apart_max_m() const { return apart_max_m_; }

 private:
  std::shared_ptr<const RecordedWords> recorded_;
  std::uint64_t steps_ = 0;
  LocalTime first_{};
  LocalTime last_{};
  std::map<std::string, Count> counts_;
  std::uint64_t different_ = 0;
  std::vector<Line> differences_;
  std::vector<Line> notices_;
  double apart_max_m_ = 0.0;
};

}  // namespace gyre::ground
