#include "common/dds/health_reporter.hpp"

#include <utility>

namespace gyre::dds {

HealthReporter::HealthReporter(Node& node, std::string process)
    : node_(node), process_(std::move(process)), writer_(node.writer<protocol::Health>()) {}

void HealthReporter::step(LocalTime now, const protocol::DropCounts& dropped, std::uint64_t overrun) {
  if (published_ && now - *published_ < kPeriod) return;
  published_ = now;
  const Node::Counters counters = node_.counters();
  writer_.write({process_, dropped, counters.undecodable, counters.unsendable, overrun});
}

}  // namespace gyre::dds
