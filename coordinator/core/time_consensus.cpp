#include "coordinator/core/time_consensus.hpp"

#include <algorithm>

namespace gyre::coordinator {
namespace {

Duration magnitude(Duration d) {
  return d < Duration::zero() ? -d : d;
}

}  // namespace

void TimeConsensus::take(SwarmTime time, const protocol::AgentStatus& status) {
  Word& word = words_[status.carrier];
  if (status.course.none() || status.clock_uncertainty > kLongest) {  // it has no swarm time yet
    word = {};
    return;
  }
  const Duration ahead = status.swarm_time - time;
  const bool same = word.in_a_row > 0 && magnitude(ahead - word.first) <= kSame && status.swarm_time > word.told;
  word = {ahead, same ? word.first : ahead, status.clock_uncertainty, status.swarm_time, same ? word.in_a_row + 1 : 1};
}

bool TimeConsensus::Word::another() const {
  return in_a_row > 0 && magnitude(ahead) > kDifferent + uncertainty;
}

bool TimeConsensus::doubtful(const std::vector<CarrierId>& carriers) const {
  const auto differs = [](const auto& entry) { return entry.second.another(); };
  return 2 * static_cast<std::size_t>(std::count_if(words_.begin(), words_.end(), differs)) > carriers.size();
}

std::optional<Duration> TimeConsensus::correction(const std::vector<CarrierId>& carriers) {
  std::vector<Duration> told;
  Duration uncertainty{};
  for (const auto& [carrier, word] : words_) {
    if (word.in_a_row < kInARow || !word.another()) continue;
    told.push_back(word.ahead);
    uncertainty = std::max(uncertainty, word.uncertainty);
  }
  if (2 * told.size() <= carriers.size()) return std::nullopt;
  // They were on their way for a while: the freshest of them is nearest. And all have to mean the same.
  const auto [least, most] = std::minmax_element(told.begin(), told.end());
  if (*most - *least > kDifferent + 2 * uncertainty) return std::nullopt;
  const Duration correction = *most;
  words_.clear();
  return correction;
}

}  // namespace gyre::coordinator
