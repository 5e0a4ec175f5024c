#include "ground/flight/core/starvation.hpp"

#include <algorithm>

namespace gyre::ground {
namespace {

/// Longer than any wait that leaves something to judge.
constexpr Duration kRemembered = std::chrono::seconds(30);

}  // namespace

void StarvationJudge::see(LocalTime now, const ProcessorAccount& account) {
  const bool first = used_.empty();
  Duration by_us = first ? Duration{} : used_.back().by_us;
  Duration wait{};
  for (const auto& [pid, process] : account.processes) {
    ProcessorAccount::Process& before = before_.processes[pid];
    if (process.used < before.used) before = {};  // another process, under the number of one that ended
    by_us += process.used - before.used;
    wait = std::max(wait, process.waited - before.waited);
    before = process;
  }
  before_.stolen.resize(account.stolen.size());
  for (std::size_t i = 0; i < account.stolen.size(); ++i) {
    wait = std::max(wait, account.stolen[i] - before_.stolen[i]);
    before_.stolen[i] = account.stolen[i];
  }
  used_.push_back({now, by_us});
  while (used_.size() > 2 && now - used_[1].at > kRemembered) used_.pop_front();
  if (first) return;  // what was before is of no flight
  late_max_ = std::max(late_max_, wait - used_by_us(wait) / account.processors);
}

Duration StarvationJudge::used_by_us(Duration wait) const {
  const Used& now = used_.back();
  auto then = std::prev(used_.end(), 2);
  while (then != used_.begin() && now.at - then->at < wait) --then;
  return now.by_us - then->by_us;
}

}  // namespace gyre::ground
