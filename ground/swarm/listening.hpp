#pragma once
// Hears a swarm: what it says goes, stamped, into one inbox, for the one loop that steps a view (core/swarm_view.hpp).
//
// Which carriers there are is the coordinator's to tell, so their topics are read as they become known.

#include <cstddef>
#include <deque>
#include <memory>
#include <set>

#include "common/dds/inbox.hpp"
#include "common/dds/node.hpp"
#include "ground/swarm/core/swarm_view.hpp"

namespace gyre::ground {

/// How much is heard beside what the swarm as a whole says: a stream per carrier has its price where there are many.
enum class Interest {
  kSwarm,     ///< course, coordinator, load, health
  kAgents,    ///< and each agent's word
  kCarriers,  ///< and its plans, and where its vehicle is
};

class Listening {
 public:
  /// `node` outlives this; whatever handlers still run until it is gone may push.
  Listening(dds::Node& node, Interest interest, std::size_t capacity = std::size_t{1} << 16);

  /// Reads the topics of those that are not read yet.
  void attend(const std::vector<CarrierId>& carriers);

  /// As dds::Inbox.
  [[nodiscard]] const std::deque<Heard>& wait_until(LocalTime deadline) { return inbox_->wait_until(deadline); }
  [[nodiscard]] const std::deque<Heard>& sleep_until(LocalTime deadline) { return inbox_->sleep_until(deadline); }
  [[nodiscard]] Duration late() const { return inbox_->late(); }
  [[nodiscard]] std::uint64_t dropped() const { return inbox_->dropped(); }

 private:
  template <class Message>
  void read(std::optional<CarrierId> carrier = std::nullopt);

  dds::Node& node_;
  Interest interest_;
  std::shared_ptr<dds::Inbox<Heard>> inbox_;
  std::set<CarrierId> attended_;
};

}  // namespace gyre::ground
