#pragma once
// The standard messages by which rviz, Foxglove and others show a scene without knowing Gyre, as plain data and as CDR.
// Their .msg texts are in idl/standard_msgs/; what a message has and we never use is written as nothing.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

#include "ground/recording/core/mcap_format.hpp"

namespace gyre::ground {

struct Pose {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
};

/// Of a frame in the world.
struct NamedPose {
  std::string frame;
  Pose pose;
};

struct Colour {
  float red = 0.0F, green = 0.0F, blue = 0.0F, alpha = 1.0F;
};

/// As visualization_msgs/Marker numbers them.
enum class MarkerShape : std::int32_t { kCube = 1, kSphere = 2, kLineStrip = 4, kLineList = 5 };

/// In the world's frame. Name and number together stay what they are from one scene to the next.
struct Marker {
  std::string name;
  std::int32_t number = 0;
  MarkerShape shape = MarkerShape::kCube;
  Pose pose;
  Eigen::Vector3d size_m = Eigen::Vector3d::Ones();  ///< of a line: x is its width
  Colour colour;
  std::vector<Eigen::Vector3d> points_m;  ///< of a line
  std::vector<Colour> colours;            ///< one for each point, or none
};

/// tf2_msgs/TFMessage.
[[nodiscard]] Bytes transforms_cdr(std::int64_t stamp_ns, const std::vector<NamedPose>& poses);
/// visualization_msgs/MarkerArray.
[[nodiscard]] Bytes markers_cdr(std::int64_t stamp_ns, const std::vector<Marker>& markers);
/// geometry_msgs/PoseStamped.
[[nodiscard]] Bytes pose_cdr(std::int64_t stamp_ns, const Pose& pose);

}  // namespace gyre::ground
