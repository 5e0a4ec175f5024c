#include "ground/recording/core/visual_messages.hpp"

#include "ground/recording/core/cdr_writer.hpp"

namespace gyre::ground {
namespace {

constexpr const char* kWorld = "world";

void header(CdrWriter& out, std::int64_t stamp_ns, const char* frame) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  out.number(static_cast<std::int32_t>(stamp_ns / kSecond));
  out.number(static_cast<std::uint32_t>(stamp_ns % kSecond));
  out.text(frame);
}

void vector(CdrWriter& out, const Eigen::Vector3d& v) {
  for (const double component : {v.x(), v.y(), v.z()}) out.number(component);
}

void pose(CdrWriter& out, const Pose& p) {
  vector(out, p.position_m);
  const Eigen::Quaterniond& q = p.orientation;
  for (const double component : {q.x(), q.y(), q.z(), q.w()}) out.number(component);
}

void colour(CdrWriter& out, const Colour& c) {
  for (const float component : {c.red, c.green, c.blue, c.alpha}) out.number(component);
}

void marker(CdrWriter& out, std::int64_t stamp_ns, const Marker& m) {
  constexpr std::int32_t kAdd = 0;
  header(out, stamp_ns, kWorld);
  out.text(m.name);
  out.number(m.number);
  out.number(static_cast<std::int32_t>(m.shape));
  out.number(kAdd);
  pose(out, m.pose);
  vector(out, m.size_m);
  colour(out, m.colour);
  out.number(std::int32_t{0});  // lifetime: until it is told anew
  out.number(std::uint32_t{0});
  out.number(false);  // frame_locked
  out.count(m.points_m.size());
  for (const Eigen::Vector3d& point : m.points_m) vector(out, point);
  out.count(m.colours.size());
  for (const Colour& c : m.colours) colour(out, c);
  out.text("");  // texture_resource
  header(out, 0, "");
  out.text("");       // texture's format
  out.count(0);       // and its bytes
  out.count(0);       // uv_coordinates
  out.text("");       // text
  out.text("");       // mesh_resource
  out.text("");       // mesh_file's name
  out.count(0);       // and its bytes
  out.number(false);  // mesh_use_embedded_materials
}

}  // namespace

Bytes transforms_cdr(std::int64_t stamp_ns, const std::vector<NamedPose>& poses) {
  CdrWriter out;
  out.count(poses.size());
  for (const NamedPose& p : poses) {
    header(out, stamp_ns, kWorld);
    out.text(p.frame);
    pose(out, p.pose);
  }
  return out.bytes();
}

Bytes markers_cdr(std::int64_t stamp_ns, const std::vector<Marker>& markers) {
  CdrWriter out;
  out.count(markers.size());
  for (const Marker& m : markers) marker(out, stamp_ns, m);
  return out.bytes();
}

Bytes pose_cdr(std::int64_t stamp_ns, const Pose& p) {
  CdrWriter out;
  header(out, stamp_ns, kWorld);
  pose(out, p);
  return out.bytes();
}

}  // namespace gyre::ground
