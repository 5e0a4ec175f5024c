#include "tests/recording/said_of.hpp"

#include <memory>
#include <utility>

#include "common/dds/payload.hpp"
#include "common/protocol/messages.hpp"
#include "ground/recording/core/mcap_index.hpp"
#include "ground/recording/core/mcap_stream.hpp"
#include "ground/recording/recording_file.hpp"

namespace gyre::tests {
namespace {

using nlohmann::json;

json list(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

json whole(std::uint64_t number) {
  return std::to_string(number);
}

json fields(const protocol::LoadState& load) {
  const Eigen::Quaterniond& q = load.orientation_w_b;
  return {{"incarnation", whole(load.incarnation)},
          {"sequence_number", whole(load.sequence)},
          {"position_w_m", list(load.position_w_m)},
          {"velocity_w_m_s", list(load.velocity_w_m_s)},
          {"orientation_w_b_xyzw", {q.x(), q.y(), q.z(), q.w()}},
          {"angular_velocity_b_rad_s", list(load.angular_velocity_b_rad_s)}};
}

json fields(const protocol::CarrierState& state) {
  return {{"carrier", state.carrier},
          {"follows", whole(state.follows)},
          {"position_w_m", list(state.position_w_m)},
          {"tension_n", state.tension_n},
          {"cable_length_m", state.cable_length_m},
          {"winch_rate_m_s", state.winch_rate_m_s}};
}

json fields(const protocol::Setpoint& setpoint) {
  return {{"carrier", setpoint.carrier},
          {"swarm_time_ns", std::to_string(setpoint.swarm_time.time_since_epoch().count())},
          {"acceleration_w_m_s2", list(setpoint.acceleration_w_m_s2)},
          {"winch_acceleration_m_s2", setpoint.winch_acceleration_m_s2}};
}

json fields(const protocol::AgentStatus& status) {
  return {{"carrier", status.carrier},
          {"state", static_cast<int>(status.state)},
          {"clock_drift_ppm", status.clock_drift_ppm},
          {"beacons_received", whole(status.beacons_received)},
          {"address", status.address}};
}

json fields(const protocol::CoordinatorStatus& status) {
  return {{"mission", status.mission}, {"carriers", status.carriers}, {"news", status.news}};
}

json fields(const protocol::MissionText& mission) {
  return {{"term", whole(mission.term)}, {"text", mission.text}};
}

template <class Message>
void add(json& samples, const ground::Schema& schema, const std::string& type, const std::string& topic,
         const ground::Message& message) {
  if (schema.name != "gyre_msgs/msg/" + type) return;
  const auto decoded = dds::decode_payload<Message>(message.payload);
  samples[topic] = decoded ? fields(*decoded) : json{{"undecodable", true}};
}

}  // namespace

json said_of(const std::string& path) {
  json said{{"whole", false}, {"messages", 0}, {"topics", json::object()}, {"metadata", json::object()}};
  said["samples"] = json::object();
  said["problems"] = json::array();
  const auto source = ground::open_recording(path);
  if (!source) return said;
  auto opened = ground::McapStream::open(*source.value());
  if (!opened) return said;
  ground::McapStream stream = std::move(opened).value();
  std::map<std::string, ground::Message> last;
  std::map<std::string, ground::Schema> schemas;
  std::map<std::string, std::uint64_t> counts;
  std::map<std::string, std::uint64_t> newest;
  while (auto message = stream.next()) {
    const ground::Channel& channel = stream.directory().channels().at(message->channel);
    ++counts[channel.topic];
    said["messages"] = said["messages"].get<int>() + 1;
    schemas[channel.topic] = stream.directory().schemas().at(channel.schema);
    // By time, as an index gives them; at one time the later in the file.
    if (message->log_ns < newest[channel.topic]) continue;
    newest[channel.topic] = message->log_ns;
    last[channel.topic] = std::move(*message);
  }
  for (const auto& [topic, message] : last) {
    json& samples = said["samples"];
    add<protocol::LoadState>(samples, schemas[topic], "LoadState", topic, message);
    add<protocol::CarrierState>(samples, schemas[topic], "CarrierState", topic, message);
    add<protocol::Setpoint>(samples, schemas[topic], "CarrierSetpoint", topic, message);
    add<protocol::AgentStatus>(samples, schemas[topic], "AgentStatus", topic, message);
    add<protocol::CoordinatorStatus>(samples, schemas[topic], "CoordinatorStatus", topic, message);
    add<protocol::MissionText>(samples, schemas[topic], "MissionText", topic, message);
  }
  said["topics"] = counts;
  said["whole"] = stream.whole();
  for (const ground::Metadata& metadata : stream.directory().metadata())
    said["metadata"][metadata.name] = metadata.entries;
  for (const ground::McapProblem& problem : stream.problems().first()) said["problems"].push_back(told(problem));
  return said;
}

}  // namespace gyre::tests
