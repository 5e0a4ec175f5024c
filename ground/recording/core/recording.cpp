#include "ground/recording/core/recording.hpp"

#include <utility>

#include "common/base/text.hpp"
#include "ground/recording/core/schemas.hpp"
#include "ground/text_table.hpp"

namespace gyre::ground {
namespace {

/// As rosbag2 keeps it, so that `ros2 bag play` offers the topic as it was offered. The numbers are those of rmw.
std::string qos_profile(const RecordedQos& qos) {
  constexpr int kReliable = 1;
  constexpr int kBestEffort = 2;
  constexpr int kTransientLocal = 1;
  constexpr int kVolatile = 2;
  const std::string forever = "\n    sec: 9223372036\n    nsec: 854775807\n";
  return text("- history: 1\n  depth: %d\n  reliability: %d\n  durability: %d\n",
              qos.retained || !qos.reliable ? 1 : 16, qos.reliable ? kReliable : kBestEffort,
              qos.retained ? kTransientLocal : kVolatile) +
         "  deadline:" + forever + "  lifespan:" + forever + "  liveliness: 1\n  liveliness_lease_duration:" + forever +
         "  avoid_ros_namespace_conventions: false\n";
}

McapWriterOptions writer_options(const std::string& version) {
  McapWriterOptions options;
  options.library = "gyre " + version;
  return options;
}

std::string grouped(std::uint64_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t at = digits.size(); at > 3; at -= 3) digits.insert(at - 3, 1, ' ');
  return digits;
}

}  // namespace

Recording::Recording(const std::string& version, std::map<std::string, std::string> about)
    : about_(std::move(about)), writer_(writer_options(version)) {
  about_["version"] = version;
}

std::optional<std::uint16_t> Recording::channel(const std::string& topic, const std::string& type,
                                                const RecordedQos& qos) {
  const auto known = channels_.find(topic);
  if (known != channels_.end()) return known->second;
  std::optional<std::uint16_t>& channel = channels_[topic];
  // Every type that has a topic has a text, as a test says.
  const auto text = schema_text(type);
  if (!text) return channel;
  channel = writer_.channel(writer_.schema(type, "ros2msg", *text), topic, "cdr",
                            {{"offered_qos_profiles", qos_profile(qos)}});
  return channel;
}

void Recording::add(const Arrival& arrival) {
  const std::string topic = topic_of_wire_name(arrival.topic);
  TopicCount& count = counts_[topic];
  const std::uint64_t missing = ledgers_[topic].see(arrival.writer, arrival.sequence);
  (arrival.qos.retained ? count.skipped : count.lost) += missing;
  const auto type = type_of_wire_name(arrival.type);
  const auto number = type ? channel(topic, *type, arrival.qos) : std::nullopt;
  if (!number) return;
  ++count.messages;
  const std::uint64_t sent_ns = arrival.source_ns > 0 ? static_cast<std::uint64_t>(arrival.source_ns) : arrival.log_ns;
  writer_.add({*number, static_cast<std::uint32_t>(arrival.sequence), arrival.log_ns, sent_ns, arrival.payload});
}

void Recording::add_visual(const char* topic, const char* type, std::uint64_t log_ns, Bytes payload) {
  const auto number = channel(topic, type, {true, false});
  if (!number) return;
  TopicCount& count = counts_[topic];
  ++count.messages;
  writer_.add({*number, static_cast<std::uint32_t>(count.messages), log_ns, log_ns, std::move(payload)});
}

void Recording::add(const Scene& scene, std::uint64_t log_ns) {
  const auto stamp_ns = static_cast<std::int64_t>(log_ns);
  if (!scene.frames.empty())
    add_visual("/tf", "tf2_msgs/msg/TFMessage", log_ns, transforms_cdr(stamp_ns, scene.frames));
  if (!scene.markers.empty()) {
    add_visual("/gyre/scene", "visualization_msgs/msg/MarkerArray", log_ns, markers_cdr(stamp_ns, scene.markers));
  }
  if (scene.load)
    add_visual("/gyre/load_pose", "geometry_msgs/msg/PoseStamped", log_ns, pose_cdr(stamp_ns, *scene.load));
}

void Recording::add_orbits(const std::vector<Marker>& orbits, std::uint64_t log_ns) {
  if (orbits.empty()) return;
  add_visual("/gyre/orbits", "visualization_msgs/msg/MarkerArray", log_ns,
             markers_cdr(static_cast<std::int64_t>(log_ns), orbits));
}

std::uint64_t Recording::lost() const {
  std::uint64_t sum = 0;
  for (const auto& [topic, count] : counts_) sum += count.lost;
  return sum;
}

Metadata Recording::last_word(const RecordingTroubles& troubles) const {
  Metadata word{"gyre_recording", {}};
  word.entries["lost"] = std::to_string(lost());
  word.entries["lost_because_the_disk_was_slow"] = std::to_string(troubles.overrun);
  word.entries["not_written"] = std::to_string(troubles.unwritten);
  for (const auto& [topic, count] : counts_) {
    if (count.lost > 0) word.entries["lost " + topic] = std::to_string(count.lost);
    if (count.skipped > 0) word.entries["skipped " + topic] = std::to_string(count.skipped);
  }
  return word;
}

std::string topic_of_all_carriers(const std::string& topic) {
  const std::string before = "/gyre/carrier_";
  if (topic.rfind(before, 0) != 0) return topic;
  const std::size_t end = topic.find_first_not_of("0123456789", before.size());
  return end == std::string::npos ? topic : before + "N" + topic.substr(end);
}

std::string recording_table(const std::map<std::string, TopicCount>& counts) {
  std::map<std::string, TopicCount> kinds;
  for (const auto& [topic, count] : counts) {
    TopicCount& kind = kinds[topic_of_all_carriers(topic)];
    kind.messages += count.messages;
    kind.lost += count.lost;
    kind.skipped += count.skipped;
  }
  std::vector<std::vector<std::string>> rows{{"topic", "messages", "lost"}};
  for (const auto& [topic, kind] : kinds) rows.push_back({topic, grouped(kind.messages), grouped(kind.lost)});
  return aligned(rows);
}

std::string recording_line(const Recording& recording, const Statistics& written, std::uint64_t file_bytes,
                           const RecordingTroubles& troubles) {
  const double duration_s = static_cast<double>(written.end_ns - written.start_ns) * 1e-9;
  std::string line = text("%.1f s, %s messages, %.1f MB", duration_s, grouped(written.messages).c_str(),
                          static_cast<double>(file_bytes) * 1e-6);
  line += "; lost on the wire: " + grouped(recording.lost());
  if (troubles.overrun > 0) {
    line += ", " + grouped(troubles.overrun) + " of them because the disk was too slow";
  }
  if (troubles.unwritten > 0) {
    line += "; not written, because the disk was full or failed: " + grouped(troubles.unwritten);
  }
  return line;
}

}  // namespace gyre::ground
