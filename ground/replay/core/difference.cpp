#include "ground/replay/core/difference.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <optional>
#include <type_traits>
#include <utility>

#include "common/base/text.hpp"
#include "common/protocol/fields.hpp"

namespace gyre::ground {
namespace {

/// More than these of one message tell nobody more.
constexpr std::size_t kFew = 3;

/// Walks two structs at once and keeps the path.
class Walk {
 public:
  std::vector<Difference> found;

  template <class T>
  void compare(const T& then, const T& now) {
    if constexpr (std::is_enum_v<T>) {
      compare(static_cast<int>(then), static_cast<int>(now));
    } else if constexpr (std::is_same_v<T, bool>) {
      leaf(then == now, then ? "yes" : "no", now ? "yes" : "no");
    } else if constexpr (std::is_integral_v<T>) {
      leaf(then == now, std::to_string(then), std::to_string(now));
    } else {
      protocol::for_each_field<T>([&](const auto& field) {
        step(std::string(path_.empty() ? "" : ".") + field.name, then.*field.member, now.*field.member);
      });
    }
  }
  void compare(double then, double now) {
    // Bits, so that NaN is itself and 0 is not -0: the same arithmetic makes the same.
    leaf(std::memcmp(&then, &now, sizeof then) == 0, text("%.12g", then), text("%.12g", now));
  }
  void compare(const std::string& then, const std::string& now) {
    leaf(then == now, "\"" + then + "\"", "\"" + now + "\"");
  }
  void compare(Duration then, Duration now) { leaf(then == now, seconds_text(then), seconds_text(now)); }
  template <class Clock>
  void compare(std::chrono::time_point<Clock, Duration> then, std::chrono::time_point<Clock, Duration> now) {
    compare(then.time_since_epoch(), now.time_since_epoch());
  }
  void compare(const Eigen::Vector3d& then, const Eigen::Vector3d& now) {
    constexpr std::array<const char*, 3> kAxes{".x", ".y", ".z"};
    for (Eigen::Index i = 0; i < 3; ++i) step(kAxes[static_cast<std::size_t>(i)], then[i], now[i]);
  }
  template <class T>
  void compare(const std::vector<T>& then, const std::vector<T>& now) {
    if (then.size() != now.size()) return leaf(false, text("%zu long", then.size()), text("%zu long", now.size()));
    for (std::size_t i = 0; i < then.size(); ++i) step("[" + std::to_string(i) + "]", then[i], now[i]);
  }
  template <class T>
  void compare(const std::optional<T>& then, const std::optional<T>& now) {
    if (then && now) return compare(*then, *now);
    leaf(then.has_value() == now.has_value(), then ? "there" : "none", now ? "there" : "none");
  }

 private:
  template <class T>
  void step(const std::string& name, const T& then, const T& now) {
    const std::size_t length = path_.size();
    path_ += name;
    compare(then, now);
    path_.resize(length);
  }
  void leaf(bool same, std::string then, std::string now) {
    if (!same) found.push_back({path_, std::move(then), std::move(now)});
  }
  static std::string seconds_text(Duration duration) { return text("%.9f s", seconds(duration)); }

  std::string path_;
};

}  // namespace

template <class Message>
std::vector<Difference> differences(const Message& then, const Message& now) {
  Walk walk;
  walk.compare(then, now);
  return std::move(walk.found);
}

std::string told(const std::vector<Difference>& differences) {
  std::string words;
  for (std::size_t i = 0; i < std::min(differences.size(), kFew); ++i) {
    const Difference& difference = differences[i];
    words += (i > 0 ? "; " : "") + difference.field + " is " + difference.now + ", was " + difference.then;
  }
  if (differences.size() > kFew) words += text("; and %zu more", differences.size() - kFew);
  return words;
}

template std::vector<Difference> differences(const protocol::TimeRequest&, const protocol::TimeRequest&);
template std::vector<Difference> differences(const protocol::Setpoint&, const protocol::Setpoint&);
template std::vector<Difference> differences(const protocol::AgentStatus&, const protocol::AgentStatus&);
template std::vector<Difference> differences(const protocol::TimeReply&, const protocol::TimeReply&);
template std::vector<Difference> differences(const protocol::PlanOffer&, const protocol::PlanOffer&);
template std::vector<Difference> differences(const protocol::Beacon&, const protocol::Beacon&);
template std::vector<Difference> differences(const protocol::CoordinatorStatus&, const protocol::CoordinatorStatus&);
template std::vector<Difference> differences(const protocol::MissionText&, const protocol::MissionText&);
template std::vector<Difference> differences(const protocol::CommandReply&, const protocol::CommandReply&);

}  // namespace gyre::ground
