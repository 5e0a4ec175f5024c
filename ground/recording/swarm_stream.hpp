#pragma once
// A recording as what was heard: message by message, in the order in which a view of the swarm was, or would have been,
// stepped.

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "ground/recording/core/mcap_stream.hpp"
#include "ground/swarm/core/swarm_view.hpp"

namespace gyre::ground {

class SwarmStream {
 public:
  /// `source` outlives it. Errors as McapStream::open.
  [[nodiscard]] static Result<SwarmStream> open(const McapSource& source);

  /// The next that a view understands, with its log time; that of an earlier one where it goes back. Absent: there are
  /// no more, and file() says how it ended.
  [[nodiscard]] std::optional<Heard> next();
  /// The next text of a mission, whatever comes before it.
  [[nodiscard]] std::optional<protocol::MissionText> next_mission();

  [[nodiscard]] const McapStream& file() const { return file_; }
  /// Messages of a type that is known, whose bytes are none: another version of gyre recorded them, or somebody lies.
  [[nodiscard]] std::uint64_t undecodable() const { return undecodable_; }

 private:
  using Decode = std::optional<SwarmMessage> (*)(const std::vector<std::uint8_t>&);

  explicit SwarmStream(McapStream file) : file_(std::move(file)) {}
  /// nullptr: nothing that a view is stepped by.
  [[nodiscard]] Decode decoder(std::uint16_t channel);

  McapStream file_;
  std::map<std::uint16_t, Decode> decoders_;
  LocalTime latest_{};
  std::uint64_t undecodable_ = 0;
};

}  // namespace gyre::ground
