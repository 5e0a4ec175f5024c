#include "coordinator/core/readiness.hpp"

namespace gyre::coordinator {
namespace {

/// Said once per second (health_reporter.hpp), and some of it is lost: three in a row once in 37 when 30 %
/// of all packets are, ten in a row once in 170 000.
constexpr Duration kForgotten = std::chrono::seconds(10);

}  // namespace

Readiness::Readiness(const std::vector<CarrierId>& carriers) {
  words_.emplace("simulator", Word{protocol::Liveness(kForgotten), ""});
  for (const CarrierId id : carriers) {
    words_.emplace("agent " + std::to_string(id), Word{protocol::Liveness(kForgotten), ""});
  }
}

void Readiness::take(LocalTime now, const protocol::Health& health) {
  const auto found = words_.find(health.process);
  if (found == words_.end()) return;
  found->second.fresh.heard(now);
  found->second.complaint = health.complaint;
}

std::optional<std::string> Readiness::complaint(LocalTime now) const {
  for (const auto& [process, word] : words_) {
    if (!word.complaint.empty() && !word.fresh.silent(now)) return process + ": " + word.complaint;
  }
  return std::nullopt;
}

}  // namespace gyre::coordinator
