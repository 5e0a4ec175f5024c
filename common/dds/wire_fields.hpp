#pragma once
// The parts messages are made of, between protocol and wire: the bricks of codec.cpp, of no use elsewhere.

#include <array>
#include <cstdint>
#include <optional>

#include "common/dds/fastdds_version.hpp"
#include "common/protocol/messages.hpp"

namespace gyre::dds {

[[nodiscard]] inline std::int64_t ns(SwarmTime time) {
  return time.time_since_epoch().count();
}
[[nodiscard]] inline std::int64_t ns(LocalTime time) {
  return time.time_since_epoch().count();
}
[[nodiscard]] inline std::int64_t ns(PlanTime time) {
  return time.time_since_epoch().count();
}
[[nodiscard]] inline PlanTime plan_time(std::int64_t ns) {
  return PlanTime(Duration(ns));
}
[[nodiscard]] inline SwarmTime swarm(std::int64_t ns) {
  return SwarmTime(Duration(ns));
}
[[nodiscard]] inline LocalTime local(std::int64_t ns) {
  return LocalTime(Duration(ns));
}

[[nodiscard]] inline std::array<double, 3> numbers(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}
[[nodiscard]] inline Eigen::Vector3d vector(const std::array<double, 3>& a) {
  return {a[0], a[1], a[2]};
}

/// Enumerators are consecutive from `first` to `last`, on the wire as in the protocol.
template <class Enum>
[[nodiscard]] std::optional<Enum> enumerator(std::uint8_t value, Enum first, Enum last) {
  if (value < static_cast<std::uint8_t>(first) || value > static_cast<std::uint8_t>(last)) return std::nullopt;
  return static_cast<Enum>(value);
}

[[nodiscard]] fast::idl::PlanNumber to_wire(const protocol::PlanNumber& number);
[[nodiscard]] std::optional<fast::idl::Course> to_wire(const protocol::Course& course);
[[nodiscard]] fast::idl::CarrierSlice to_wire(const mechanics::CarrierSlice& slice);
[[nodiscard]] fast::idl::DropCounts to_wire(const protocol::DropCounts& counts);

[[nodiscard]] protocol::PlanNumber from_wire(const fast::idl::PlanNumber& wire);
[[nodiscard]] std::optional<protocol::Course> from_wire(const fast::idl::Course& wire);
[[nodiscard]] std::optional<mechanics::CarrierSlice> from_wire(const fast::idl::CarrierSlice& wire);
[[nodiscard]] protocol::DropCounts from_wire(const fast::idl::DropCounts& wire);

}  // namespace gyre::dds
