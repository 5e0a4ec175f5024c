#pragma once
// The thread that writes a recording, behind a queue: whatever the disk does, nobody who hears the swarm waits for it.
//
// The queue is bounded by the memory it takes. When it is full, what comes is dropped and counted; when the disk is
// full, chunks are dropped and counted, and the recording goes on as soon as there is room again.

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "common/dds/recorded_sample.hpp"
#include "common/mission/mission.hpp"
#include "ground/recording/core/recording.hpp"
#include "ground/recording/message_decoder.hpp"
#include "ground/recording/recording_file.hpp"

namespace gyre::ground {

/// When it began, on the clock that people read and on the one that never steps.
struct RecordingBegin {
  std::uint64_t wall_ns = 0;  ///< since 1970
  LocalTime local{};
};

class Recorder {
 public:
  /// `mission`: what is flown, as far as it is known before the swarm tells it.
  Recorder(RecordingFile file, const RecordingBegin& begin, std::map<std::string, std::string> about,
           std::optional<mission::Mission> mission);
  /// Without finish() the file ends as if its process had been killed.
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// From any thread; returns at once.
  void push(dds::RecordedSample sample);
  /// The carriers that the coordinator told.
  [[nodiscard]] std::set<CarrierId> carriers() const;

  struct End {
    std::string table, line;
    bool complete = false;  ///< all that came was written, and the summary
  };
  /// Writes what is left, and the summary. Once; nobody pushes any more.
  [[nodiscard]] End finish();

 private:
  /// What a scene is made of; the rest is not decoded.
  using SceneMessage = std::variant<protocol::CarrierState, protocol::LoadState, protocol::Beacon, protocol::HeldPlans,
                                    protocol::CoordinatorStatus, protocol::MissionText>;

  void run();
  void take(dds::RecordedSample sample);
  void look(const dds::RecordedSample& sample);
  void learn_mission();
  void show(std::uint64_t log_ns);
  void write_chunk();
  /// Whether the disk took it.
  [[nodiscard]] bool write(const Bytes& piece);
  [[nodiscard]] std::uint64_t log_ns(LocalTime time) const;

  // The writing thread's, until it has ended.
  RecordingFile file_;
  const RecordingBegin begin_;
  Recording recording_;
  std::map<std::shared_ptr<const dds::RecordedTopic>, MessageDecoder<SceneMessage>> decoders_;
  SwarmView view_;
  std::optional<mission::Mission> mission_;
  std::string mission_text_;
  std::uint64_t next_scene_ns_ = 0;
  std::uint64_t next_orbits_ns_ = 0;
  RecordingTroubles troubles_;
  bool disk_complained_ = false;
  bool unwritten_beginning_ = true;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<dds::RecordedSample> queue_;
  std::uint64_t queued_bytes_ = 0;
  std::uint64_t overrun_ = 0;
  std::set<CarrierId> carriers_;
  bool over_ = false;
  std::thread thread_;
};

}  // namespace gyre::ground
