#pragma once
// A process on the wire: one Fast DDS participant that speaks Gyre's topics and nothing else.
//
// Discovery is a unicast star without multicast: hubs sit at fixed participant ids, agents right behind them, and
// everybody's initial peers are the hubs. Fast DDS moves silently to another port when one is taken, so a lock per
// participant id and domain (an abstract unix socket, gone with its process, private to its network namespace like the
// ports themselves) turns two coordinators on one domain into a clear message.
//
// Writers and readers exist for the messages of protocol/messages.hpp only; each message knows its topic and QoS
// (topics.hpp). A handler runs in a Fast DDS thread: it stamps and enqueues (inbox.hpp) and does nothing else.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/base/ids.hpp"
#include "common/base/result.hpp"
#include "common/base/time.hpp"
#include "common/dds/recorded_sample.hpp"
#include "common/dds/seat_lock.hpp"

namespace gyre::dds {

/// Participant ids of the hubs of the star.
enum class Hub { kCoordinator = 0, kStandby = 1, kSimulator = 2, kGround = 3 };

/// Who this process is in the star: a hub, an agent (id 3 + carrier), or, with neither, a visitor: a tool at any free
/// id above the agents, which looks for all of them.
struct Seat {
  std::optional<Hub> hub;
  std::optional<CarrierId> carrier;
};

struct NodeOptions {
  Seat seat;
  int domain = 0;                       ///< 0..100
  std::string interface = "127.0.0.1";  ///< the one to use, by its IPv4 address or its name
  std::vector<std::string> peers;       ///< further hosts (IPv4) where hubs may sit; the own interface is always one
  bool laboratory = false;              ///< packets may be lost on purpose
};

/// The highest domain whose ports stay below the range the system hands out (32768 upwards).
inline constexpr int kMaxDomain = 100;

/// The given one (--domain or GYRE_DOMAIN), else ROS_DOMAIN_ID, else 0. An error names the source and the allowed
/// range.
[[nodiscard]] Result<int> choose_domain(std::optional<int> option);

class Node;

template <class Message>
class Writer {
 public:
  Writer() = default;
  /// Never blocks for long and never throws; a message that cannot be sent is counted by the node. One thread writes.
  /// After its node is gone, a writer does nothing.
  void write(const Message& message) const;
  /// How many readers it has found. For tools that send once and leave; a flight needs no such question.
  [[nodiscard]] int readers() const;

  struct State;
  explicit Writer(std::shared_ptr<State> state) : state_(std::move(state)) {}

 private:
  std::shared_ptr<State> state_;
};

class Node {
 public:
  /// Fails when the seat is taken (the error names the process that has it) or does not exist, the domain is out of
  /// range, the interface does not exist, or another program has the ports. One node per process, save in tests.
  [[nodiscard]] static Result<std::unique_ptr<Node>> open(const NodeOptions& options);
  ~Node();
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  /// `carrier` is required for the carrier_N topics and absent for the others.
  template <class Message>
  [[nodiscard]] Writer<Message> writer(std::optional<CarrierId> carrier = std::nullopt);

  /// `handler(message, arrived)` runs in a Fast DDS thread. Samples that do not decode are counted, not delivered.
  template <class Message>
  void read(std::function<void(Message, LocalTime)> handler, std::optional<CarrierId> carrier = std::nullopt);

  /// Every topic of the swarm, or with a carrier every topic of that one, as bytes: `handler` runs in a Fast DDS thread
  /// for each sample that arrives, whatever is in it. A node that records reads nothing of the same topics. Without
  /// `journals` no process sends its own: they are nearly half of what is recorded.
  void record(const std::function<void(RecordedSample)>& handler, std::optional<CarrierId> carrier = std::nullopt,
              bool journals = true);

  [[nodiscard]] int domain() const;
  /// Tells one life of a process from the next, and from another's: the moment at which this node was opened. Not 0.
  [[nodiscard]] std::uint64_t incarnation() const;
  /// Where this process is, for people: "10.0.0.3 (vehicle-3, pid 4711)".
  [[nodiscard]] const std::string& address() const;

  /// Answers everybody who asks at this node's seat (seat_lock.hpp); call it as often as the main loop turns.
  void answer_callers(const SeatAnswer& answer);

  /// From now on so many of the packets, in and out alike, are lost; 0: none. For nodes of a laboratory only.
  void lose_packets(double share);

  struct Counters {
    std::uint64_t unsendable = 0;   ///< write refused by Fast DDS or message too large
    std::uint64_t undecodable = 0;  ///< sample arrived that is no such message; one over the type's bound Fast DDS logs
  };
  [[nodiscard]] Counters counters() const;

  struct Impl;

 private:
  explicit Node(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// Whether a seat is free on a domain, without taking it; `holder` describes who has it otherwise.
struct SeatHolder {
  bool taken = false;
  std::string holder;  ///< "pid 1234 (gyre-coordinator)"
};
[[nodiscard]] SeatHolder seat_holder(const Seat& seat, int domain);

/// Asks every hub and agent of a domain that shares this network how it is, in the order of their seats; whoever has
/// not answered when `patience` is used up is listed without an answer. Visitors are not asked: they come and go.
[[nodiscard]] std::vector<SeatCall> ask_all_seats(int domain, Duration patience);

}  // namespace gyre::dds
