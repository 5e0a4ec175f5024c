#include "ground/page/page_requests.hpp"

#include <cmath>

#include "common/base/angle.hpp"
#include "common/base/text.hpp"
#include "common/mechanics/certificate.hpp"
#include "common/mission/mission.hpp"
#include "common/protocol/disturbance.hpp"
#include "ground/check/certificate_table.hpp"
#include "ground/page/core/utf8.hpp"
#include "ground/page/protobuf_json.hpp"
#include "idl/page.pb.h"

namespace gyre::ground {
namespace {

constexpr double kMostForce_n = 1e6;

bool within(double amount, double most) {
  return std::isfinite(amount) && amount >= 0.0 && amount <= most;
}

}  // namespace

std::string answer_json(const Answer& answer) {
  page::Answer out;
  out.set_done(answer.done);
  out.set_text(utf8(answer.text));
  return json_of(out);
}

Result<protocol::Command> order_of(const std::string& json) {
  const auto read = message_of<page::Order>(json);
  if (!read) return read.error();
  const page::Order& order = read.value();
  protocol::Command command;
  switch (order.kind()) {
    case page::Order::ENGAGE:
      command.kind = protocol::CommandKind::kEngage;
      return command;
    case page::Order::RELEASE:
      command.kind = protocol::CommandKind::kRelease;
      if (!order.has_phase_deg()) return command;
      if (!within(std::abs(order.phase_deg()), 360.0)) return Error{"phase_deg: degrees of the cycle, -360 to 360"};
      command.phase_rad = order.phase_deg() * kPi / 180.0;
      return command;
    case page::Order::FREEZE:
      command.kind = protocol::CommandKind::kFreeze;
      return command;
    case page::Order::PACE:
      if (!order.has_pace() || !within(order.pace(), 1.0)) return Error{"pace: 0 (rest) to 1 (full motion)"};
      command.kind = protocol::CommandKind::kPace;
      command.pace = order.pace();
      return command;
    case page::Order::RETUNE: {
      const auto mission = mission::parse_mission(order.mission(), "mission");
      if (!mission) return mission.error();
      command.kind = protocol::CommandKind::kRetune;
      command.mission = mission::to_text(mission.value());
      if (command.mission.size() <= protocol::kMaxMissionBytes) return command;
      return Error{text("%zu bytes are more than the %zu a retune can carry; fewer carriers, or a new flight",
                        command.mission.size(), protocol::kMaxMissionBytes)};
    }
    default:
      return Error{"kind: ENGAGE, RELEASE, FREEZE, PACE or RETUNE"};
  }
}

Result<std::string> verdict_json(const std::string& request_json) {
  const auto read = message_of<page::CheckRequest>(request_json);
  if (!read) return read.error();
  page::Verdict out;
  const auto mission = mission::parse_mission(read.value().mission(), "mission");
  out.set_readable(mission.ok());
  if (!mission) {
    out.set_text(utf8(mission.error().text));
    return json_of(out);
  }
  const mechanics::Certificate certificate = mechanics::certify(mission.value().plan);
  out.set_admissible(certificate.admissible());
  out.set_name(mission.value().name);
  out.set_text(
      certificate_table(mission.value().name, mission.value().plan.limits, certificate, mission.value().silence));
  return json_of(out);
}

Result<HurtRequest> hurt_of(const std::string& json) {
  const auto read = message_of<page::HurtRequest>(json);
  if (!read) return read.error();
  const page::HurtRequest& asked = read.value();
  if (asked.kind() < page::HurtRequest::KILL || asked.kind() > page::HurtRequest::PUSH) {
    return Error{"kind: KILL, STOP, CONTINUE, RESTART, LOSE, SHIFT_CLOCK or PUSH"};
  }
  HurtRequest request;
  request.kind = static_cast<HurtKind>(asked.kind());
  request.process = asked.process();
  request.amount = asked.amount();
  request.duration_s = asked.duration_s();
  if (request.kind != HurtKind::kPush && request.process.empty())
    return Error{"process: the name of one of this flight"};
  if (request.kind == HurtKind::kLose && !within(request.amount, 100.0)) return Error{"amount: percent, 0 to 100"};
  if (!within(std::abs(request.amount), 1e6)) return Error{"amount: at most a million"};
  if (request.kind != HurtKind::kPush) return request;
  if (asked.force_w_n_size() != 3) return Error{"force_w_n: three numbers, newtons in the world's axes"};
  request.force_w_n = {asked.force_w_n(0), asked.force_w_n(1), asked.force_w_n(2)};
  if (!within(request.force_w_n.norm(), kMostForce_n)) return Error{"force_w_n: at most a meganewton"};
  const double longest_s = seconds(protocol::kLongestPush);
  if (!within(request.duration_s, longest_s)) return Error{text("duration_s: 0 to %.0f s", longest_s)};
  return request;
}

}  // namespace gyre::ground
