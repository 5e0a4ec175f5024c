#include "ground/swarm/health.hpp"

#include <cstdio>
#include <memory>
#include <optional>

#include "common/dds/node.hpp"
#include "common/program/program.hpp"

namespace gyre::ground {
namespace {

/// All together: a main loop answers within its beat, and a health check that hangs helps nobody.
constexpr Duration kPatience = std::chrono::milliseconds(1500);

int ask(const std::optional<int>& option) {
  const Result<int> domain = dds::choose_domain(option);
  if (!domain) {
    std::fprintf(stderr, "%s\n", domain.error().text.c_str());
    return program::kBadUsage;
  }
  bool healthy = true;
  int asked = 0;
  for (const dds::SeatCall& call : dds::ask_all_seats(domain.value(), kPatience)) {
    if (call.elsewhere) continue;  // containers that share this network are asked by themselves
    ++asked;
    if (!call.answer) {
      healthy = false;
      std::printf("%s: does not answer\n", call.owner.c_str());
      continue;
    }
    const bool well = call.answer->complaint.empty();
    healthy = healthy && well;
    std::printf("%s: %s\n", call.answer->process.c_str(), well ? "healthy" : call.answer->complaint.c_str());
  }
  if (asked == 0) std::printf("no process of a swarm runs here on domain %d\n", domain.value());
  return healthy && asked > 0 ? program::kGood : program::kFailed;
}

}  // namespace

program::Command health_command() {
  const auto domain = std::make_shared<std::optional<int>>();
  return {"health",
          "Ask the processes of a swarm that run here whether they do their work.",
          {program::own({program::domain_option(*domain)})},
          [domain] { return ask(*domain); }};
}

}  // namespace gyre::ground
