#pragma once
// A recording in the making: what arrives becomes messages of an MCAP file, and is counted.
//
//   sample -> its topic's channel, with its type's schema, its bytes as they are
//   scene  -> /tf, /gyre/scene, /gyre/load_pose; and /gyre/orbits, now and then, because orbits are long and hardly
//   change
//
// Two times are kept: when a message arrived here, on a clock that never steps (log time), and when its sender sent it,
// by the sender's own wall clock (publish time).
//
// Pure: the shell gives samples, writes the pieces, and says what became of them (mcap_writer.hpp).

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "ground/recording/core/loss_ledger.hpp"
#include "ground/recording/core/mcap_writer.hpp"
#include "ground/recording/core/scene.hpp"

namespace gyre::ground {

/// How a topic is delivered, as far as a recording needs to know.
struct RecordedQos {
  bool reliable = false;
  bool retained = false;  ///< transient local, and older samples may be skipped
};

struct Arrival {
  std::string topic;  ///< as on the wire, "rt/gyre/phase"
  std::string type;   ///< as on the wire, "gyre_msgs::msg::dds_::Beacon_"
  RecordedQos qos;
  WriterId writer{};
  std::uint64_t sequence = 0;
  std::int64_t source_ns = 0;  ///< since 1970; not positive: the writer did not say
  std::uint64_t log_ns = 0;    ///< since 1970
  std::vector<std::uint8_t> payload;
};

/// What became of a topic's messages.
struct TopicCount {
  std::uint64_t messages = 0;
  std::uint64_t lost = 0;     ///< did not arrive, where each sample is sent once
  std::uint64_t skipped = 0;  ///< older ones, where the newest counts
};

/// What went wrong on this side of the wire.
struct RecordingTroubles {
  std::uint64_t overrun = 0;    ///< messages that found the queue full: they are among the lost
  std::uint64_t unwritten = 0;  ///< messages of chunks that the disk did not take
  std::uint64_t chunks = 0;     ///< of those
};

class Recording {
 public:
  /// `about` is the file's first word about itself.
  Recording(const std::string& version, std::map<std::string, std::string> about);

  [[nodiscard]] Bytes begin() { return writer_.begin({"gyre", about_}); }
  void add(const Arrival& arrival);
  void add(const Scene& scene, std::uint64_t log_ns);
  void add_orbits(const std::vector<Marker>& orbits, std::uint64_t log_ns);

  [[nodiscard]] McapWriter& writer() { return writer_; }
  [[nodiscard]] const std::map<std::string, TopicCount>& counts() const { return counts_; }
  [[nodiscard]] std::uint64_t lost() const;

  /// The file's last word about itself: what is missing in it.
  [[nodiscard]] Metadata last_word(const RecordingTroubles& troubles) const;

 private:
  void add_visual(const char* topic, const char* type, std::uint64_t log_ns, Bytes payload);
  [[nodiscard]] std::optional<std::uint16_t> channel(const std::string& topic, const std::string& type,
                                                     const RecordedQos& qos);

  std::map<std::string, std::string> about_;
  McapWriter writer_;
  std::map<std::string, std::optional<std::uint16_t>> channels_;  // by topic
  std::map<std::string, LossLedger> ledgers_;                     // by topic
  std::map<std::string, TopicCount> counts_;                      // by topic
};

/// A topic with its carrier's number left out: "/gyre/carrier_N/setpoint".
[[nodiscard]] std::string topic_of_all_carriers(const std::string& topic);

/// What was recorded, kind by kind, as a table.
[[nodiscard]] std::string recording_table(const std::map<std::string, TopicCount>& counts);
/// In one line: how long, how much, what is missing.
[[nodiscard]] std::string recording_line(const Recording& recording, const Statistics& written,
                                         std::uint64_t file_bytes, const RecordingTroubles& troubles);

}  // namespace gyre::ground
