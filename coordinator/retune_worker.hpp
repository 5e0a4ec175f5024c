#pragma once
// Reads and judges the missions of retunes beside the beat.
//
// One at a time. Whoever asks for another meanwhile is told to try again; whoever repeats himself, as everybody does
// until he is answered, is told once.

#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "common/program/worker.hpp"
#include "coordinator/core/job.hpp"

namespace gyre::coordinator {

class RetuneWorker {
 public:
  using Judge = std::function<Result<Job>(const std::string& mission)>;

  explicit RetuneWorker(Judge judge)
      : worker_([judge = std::move(judge)](const protocol::Command& command) {
          return Retune{command.id, judge(command.mission)};
        }) {}

  /// What is known at once.
  [[nodiscard]] std::optional<Retune> ask(const protocol::Command& command) {
    if (last_ && last_->command == command.id) return last_;  // its answer was lost: the core gives it again
    if (under_way_ == command.id) return std::nullopt;
    if (!worker_.begin(command)) return Retune{command.id, Error{"another retune is being judged; try again"}};
    under_way_ = command.id;
    return std::nullopt;
  }

  /// What has been judged since the last call.
  [[nodiscard]] std::optional<Retune> finished() {
    auto retune = worker_.finished();
    if (!retune) return std::nullopt;
    last_ = retune;
    under_way_.reset();
    return retune;
  }

 private:
  std::optional<std::uint64_t> under_way_;  ///< the command whose mission is being judged
  std::optional<Retune> last_;
  program::Worker<protocol::Command, Retune> worker_;
};

}  // namespace gyre::coordinator
