#include "common/dds/health_reporter.hpp"

#include <algorithm>
#include <utility>

namespace gyre::dds {

HealthReporter::HealthReporter(Node& node, std::string process)
    : node_(node), process_(std::move(process)), writer_(node.writer<protocol::Health>()) {}

void HealthReporter::step(LocalTime now, const std::optional<std::string>& complaint,
                          const protocol::DropCounts& dropped, std::uint64_t overrun, Duration late) {
  node_.answer_callers({process_, complaint.value_or("")});
  late_max_ = std::max(late_max_, late);
  const bool turned = complaint.has_value() != complained_;
  if (published_ && now - *published_ < kPeriod && !turned) return;
  published_ = now;
  complained_ = complaint.has_value();
  const Node::Counters counters = node_.counters();
  writer_.write(
      {process_, complaint.value_or(""), dropped, counters.undecodable, counters.unsendable, overrun, late_max_});
  late_max_ = {};
}

}  // namespace gyre::dds
