#pragma once
// Hears everything a flight says and keeps it, with the time it arrived: the measuring instrument of the fault flights.
//
// It sits in the ground's seat. Nothing in it knows what should be seen; flight_figures.hpp measures, tests judge.

#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "common/dds/node.hpp"
#include "common/protocol/messages.hpp"

namespace gyre::test {

template <class Message>
struct Heard {
  LocalTime arrived{};  ///< this process's clock
  Message message;
};

template <class Message>
using Heards = std::vector<Heard<Message>>;

/// What one agent, and its vehicle, has said.
struct CarrierRecord {
  Heards<protocol::Setpoint> setpoints;
  Heards<protocol::CarrierState> states;
  Heards<protocol::AgentStatus> statuses;
  Heards<protocol::TimeRequest> time_requests;
};

struct FlightRecord {
  Heards<protocol::Beacon> beacons;
  Heards<protocol::CommandReply> replies;
  Heards<protocol::LoadState> load;
  Heards<protocol::Health> healths;
  std::map<CarrierId, CarrierRecord> carriers;
};

/// A large swarm is watched by its statuses alone: to hear all of it would be the most of its traffic.
enum class Watch { kEverything, kStatuses };

class FlightObserver {
 public:
  /// Errors as dds::Node::open.
  [[nodiscard]] static Result<std::unique_ptr<FlightObserver>> open(const std::vector<CarrierId>& carriers,
                                                                    Watch watch) {
    auto node = dds::Node::open({{dds::Hub::kGround, std::nullopt}, 0, "127.0.0.1", {}});
    if (!node) return node.error();
    return std::unique_ptr<FlightObserver>(new FlightObserver(std::move(node).value(), carriers, watch));
  }

  /// Its number, to find the reply by.
  std::uint64_t command(protocol::CommandKind kind, double pace = 1.0) {
    protocol::Command command;
    command.id = ++last_command_;
    command.kind = kind;
    command.pace = pace;
    commands_.write(command);
    return command.id;
  }

  void disturb(const protocol::Disturbance& disturbance) { disturbances_.write(disturbance); }
  /// Processes that were found to listen to them.
  [[nodiscard]] int disturbed() const { return disturbances_.readers(); }

  /// What `question(const FlightRecord&)` answers, while nothing is added.
  template <class Question>
  [[nodiscard]] auto ask(const Question& question) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return question(std::as_const(record_));
  }

 private:
  FlightObserver(std::unique_ptr<dds::Node> node, const std::vector<CarrierId>& carriers, Watch watch)
      : node_(std::move(node)) {
    commands_ = node_->writer<protocol::Command>();
    disturbances_ = node_->writer<protocol::Disturbance>();
    for (const CarrierId id : carriers) keep(record_.carriers[id].statuses, id);
    if (watch == Watch::kStatuses) return;
    keep(record_.beacons, std::nullopt);
    keep(record_.replies, std::nullopt);
    keep(record_.load, std::nullopt);
    keep(record_.healths, std::nullopt);
    for (const CarrierId id : carriers) {
      CarrierRecord& carrier = record_.carriers[id];  // a map's elements stay where they are
      keep(carrier.setpoints, id);
      keep(carrier.states, id);
      keep(carrier.time_requests, id);
    }
  }

  template <class Message>
  void keep(Heards<Message>& in, std::optional<CarrierId> carrier) {
    node_->read<Message>(
        [this, &in](Message message, LocalTime arrived) {
          const std::lock_guard<std::mutex> lock(mutex_);
          in.push_back({arrived, std::move(message)});
        },
        carrier);
  }

  dds::Writer<protocol::Command> commands_;
  dds::Writer<protocol::Disturbance> disturbances_;
  std::uint64_t last_command_ = 0;
  mutable std::mutex mutex_;
  FlightRecord record_;
  std::unique_ptr<dds::Node> node_;  // gone first: its handlers write above
};

}  // namespace gyre::test
