#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/text_format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "common/base/angle.hpp"
#include "common/mechanics/load_hull.hpp"
#include "common/mission/complaints.hpp"
#include "common/mission/load_reader.hpp"
#include "common/mission/located.hpp"
#include "common/mission/mission.hpp"
#include "common/mission/nesting.hpp"
#include "common/mission/requirements.hpp"
#include "common/mission/schema_complaint.hpp"
#include "common/mission/spans.hpp"
#include "common/mission/topology.hpp"
#include "common/mission/want_reader.hpp"
#include "idl/mission.pb.h"

namespace gyre::mission {
namespace {

namespace pb = ::gyre::mission::schema;
using mechanics::Harmonic;
using mechanics::kMaxDenominator;
using mechanics::kMaxNumerator;
using mechanics::LengthLaw;
using mechanics::Oscillation;

constexpr double kHarmonicTolerance = 1e-9;  // relative, of a rate against a multiple of the cycle's
constexpr std::size_t kMaxNameBytes = 64;

/// The cycle's rate, where it has been complained about: rates cannot be judged against it.
constexpr double kUnknownRate = 0.0;

class ParseErrors : public google::protobuf::io::ErrorCollector {
 public:
  explicit ParseErrors(Complaints& complaints) : complaints_(complaints) {}
  void AddError(int line, int column, const std::string& message) override {
    complaints_.add(line, column, "", with_cure(message));
  }
  /// Unknown fields arrive here, so that parsing goes on behind them; they are errors all the same.
  void AddWarning(int line, int column, const std::string& message) override { AddError(line, column, message); }

 private:
  Complaints& complaints_;
};

/// The multiple of the cycle's rate that is closest to this ratio.
Harmonic closest_harmonic(double ratio) {
  Harmonic best;
  for (int q = 1; q <= kMaxDenominator; ++q) {
    const double p = std::round(ratio * q);
    const Harmonic candidate{static_cast<int>(std::clamp(p, 1.0, static_cast<double>(kMaxNumerator))), q};
    // Strictly closer by more than rounding, so that 2/1 is never written 4/2.
    if (std::abs(candidate.ratio() - ratio) < std::abs(best.ratio() - ratio) - 1e-12 * ratio) best = candidate;
  }
  return best;
}

Harmonic read_harmonic(const Located& law, double cycle_rate_rad_s) {
  if (!law.has("rate_rad_s")) return {};
  const double rate = law.number("rate_rad_s", kRate);
  if (cycle_rate_rad_s == kUnknownRate || !law.sound("rate_rad_s", kRate)) return {};
  const double ratio = rate / cycle_rate_rad_s;
  const Harmonic harmonic = closest_harmonic(ratio);
  if (std::abs(harmonic.ratio() - ratio) > kHarmonicTolerance * ratio) {
    law.complain("rate_rad_s", "is " + show(ratio) +
                                   " times the cycle's rate, so the motion would have no period; the "
                                   "closest rate p/q times the cycle's, p up to " +
                                   std::to_string(kMaxNumerator) + " and q up to " + std::to_string(kMaxDenominator) +
                                   ", is " + show(harmonic.ratio() * cycle_rate_rad_s));
  }
  return harmonic;
}

/// A number that requirements may leave out: then it is open, and 0 until it is chosen.
double number_or_open(const Located& node, const char* field, const Span& span, bool may_be_open, bool& open,
                      std::optional<double> absent = std::nullopt) {
  open = may_be_open && !node.has(field);
  return open ? 0.0 : node.number(field, span, absent);
}

/// What belongs to every number of a plan: whether a file may leave it out, and the cycle's rate.
struct Reading {
  bool may_be_open;
  double cycle_rate_rad_s;
};

Oscillation read_length(const Located& law, const Reading& reading, design::OpenLaw& open) {
  Oscillation out;
  out.mean = number_or_open(law, "mean_m", kLengthM, reading.may_be_open, open.mean);
  out.swing = number_or_open(law, "swing_m", kPlaceM, reading.may_be_open, open.swing);
  out.harmonic = read_harmonic(law, reading.cycle_rate_rad_s);
  out.phase_rad = number_or_open(law, "phase_rad", kPhaseRad, reading.may_be_open, open.phase, 0.0);
  return out;
}

Oscillation read_profile(const Located& law, const Reading& reading, design::OpenLaw& open) {
  Oscillation out;
  out.mean = number_or_open(law, "mean_m", kPlaceM, reading.may_be_open, open.mean);
  out.swing = law.number("swing_m", kPlaceM, 0.0);
  out.harmonic = read_harmonic(law, reading.cycle_rate_rad_s);
  out.phase_rad = law.number("phase_rad", kPhaseRad, 0.0);
  return out;
}

LengthLaw read_law(const Located& carrier, const Reading& reading, design::OpenLaw& open) {
  if (carrier.has("level")) {
    return LengthLaw::level(
        number_or_open(carrier.child("level"), "altitude_m", kPlaceM, reading.may_be_open, open.mean));
  }
  if (carrier.has("fixed")) {
    return LengthLaw::fixed(
        number_or_open(carrier.child("fixed"), "length_m", kLengthM, reading.may_be_open, open.mean));
  }
  if (carrier.has("sine")) return LengthLaw::sine(read_length(carrier.child("sine"), reading, open));
  if (carrier.has("directional")) {
    const Located law = carrier.child("directional");
    Eigen::Vector3d direction = law.vector("direction", kComponent);
    if (!(direction.norm() > 1e-9)) {
      law.complain("direction",
                   "has no length; give the direction the profile runs along, for instance { x: 0 y: 0 z: 1 }");
      direction = Eigen::Vector3d::UnitZ();
    }
    return LengthLaw::directional(direction, read_profile(law, reading, open));
  }
  open.kind = reading.may_be_open;
  if (open.kind) return {};
  carrier.complain(
      "has no length law; give one of level { altitude_m }, directional { direction mean_m .. }, "
      "sine { mean_m swing_m .. }, fixed { length_m }");
  return {};
}

mechanics::Vehicle read_vehicle(const Located& vehicle) {
  mechanics::Vehicle out;
  out.time_constant_s = vehicle.number("time_constant_s", kTimeConstantS, 0.0);
  out.mass_kg = vehicle.optional_number("mass_kg", kMassKg);
  out.thrust_max_n = vehicle.optional_number("thrust_max_n", kPositiveForceN);
  const std::optional<double> bank_max_deg = vehicle.optional_number("bank_max_deg", kBankDeg);
  if (bank_max_deg) out.bank_max_rad = radians(*bank_max_deg);
  for (const char* limit : {"thrust_max_n", "bank_max_deg"}) {
    if (!vehicle.has(limit) || vehicle.has("mass_kg")) continue;
    vehicle.complain(limit, "cannot be judged without the vehicle's mass; give mass_kg");
  }
  return out;
}

mechanics::Winch read_winch(const Located& winch) {
  return {winch.number("time_constant_s", kTimeConstantS, 0.0), winch.optional_number("rate_max_m_s", kSpeed),
          winch.optional_number("acceleration_max_m_s2", kAcceleration)};
}

std::vector<mechanics::Carrier> read_carriers(const std::vector<Located>& nodes, const mechanics::Load& load,
                                              const Reading& reading, design::Open& open) {
  std::vector<mechanics::Carrier> out;
  std::set<CarrierId> seen;
  for (const Located& node : nodes) {
    mechanics::Carrier carrier;
    carrier.id = node.whole_number("id", 1, kMaxCarrierId);
    if (carrier.id != 0 && !seen.insert(carrier.id).second) {
      node.complain("id",
                    "is " + std::to_string(carrier.id) + ", which another carrier has; give every carrier its own id");
    }
    if (!open.attachments)
      (void)node.required_child("attachment_m", "give attachment_m { x: .. y: .. z: .. } in the body frame");
    carrier.attachment_b_m = node.vector("attachment_m", kPlaceM);
    if (node.has("attachment_m") && !load.hull_b_m.empty() &&
        !mechanics::LoadCone::seen_from(carrier.attachment_b_m, load.hull_b_m)) {
      node.complain("attachment_m", "is inside the load's shape; give a place on it, or a smaller shape");
    }
    carrier.law = read_law(node, reading, open.laws.emplace_back());
    carrier.radius_m = node.number("radius_m", kLengthM, 0.0);
    carrier.vehicle = read_vehicle(node.child("vehicle"));
    out.push_back(std::move(carrier));
  }
  return out;
}

std::vector<mechanics::Edge> read_edges(const std::vector<Located>& nodes, bool may_be_open,
                                        std::vector<design::OpenEdge>& open) {
  std::vector<mechanics::Edge> out;
  for (const Located& node : nodes) {
    mechanics::Edge edge;
    edge.from = node.whole_number("from", 1, kMaxCarrierId);
    edge.to = node.whole_number("to", 1, kMaxCarrierId);
    design::OpenEdge& gaps = open.emplace_back();
    edge.offset_n = number_or_open(node, "offset_n", kForceN, may_be_open, gaps.offset, 0.0);
    edge.amplitude_n = number_or_open(node, "amplitude_n", kForceN, may_be_open, gaps.amplitude);
    edge.phase_rad = number_or_open(node, "phase_rad", kPhaseRad, may_be_open, gaps.phase);
    out.push_back(edge);
  }
  return out;
}

mechanics::Limits read_limits(const Located& limits) {
  mechanics::Limits out;
  out.tension_min_n = limits.optional_number("tension_min_n", kPositiveForceN);
  out.tension_max_n = limits.optional_number("tension_max_n", kPositiveForceN);
  out.length_min_m = limits.optional_number("length_min_m", kLengthM);
  out.length_max_m = limits.optional_number("length_max_m", kLengthM);
  out.winch_rate_max_m_s = limits.optional_number("winch_rate_max_m_s", kSpeed);
  out.speed_min_m_s = limits.optional_number("speed_min_m_s", kSpeed);
  out.speed_max_m_s = limits.optional_number("speed_max_m_s", kSpeed);
  out.acceleration_max_m_s2 = limits.optional_number("acceleration_max_m_s2", kAcceleration);
  out.separation_min_m = limits.optional_number("separation_min_m", kLengthM);
  out.clearance_min_m = limits.optional_number("clearance_min_m", kLengthM);
  out.vertical_cosine_min = limits.optional_number("vertical_cosine_min", kCosine);

  const auto judge_order = [&](const char* min_field, const std::optional<double>& min, const char* max_field,
                               const std::optional<double>& max) {
    if (!min || !max || *min <= *max) return;
    limits.complain(min_field, "is " + show(*min) + ", above " + max_field + ", " + show(*max) +
                                   "; nothing can be inside: raise the one or lower the other");
  };
  judge_order("tension_min_n", out.tension_min_n, "tension_max_n", out.tension_max_n);
  judge_order("length_min_m", out.length_min_m, "length_max_m", out.length_max_m);
  judge_order("speed_min_m_s", out.speed_min_m_s, "speed_max_m_s", out.speed_max_m_s);
  return out;
}

bool too_many(const Located& place, const char* field) {
  if (place.count(field) <= static_cast<int>(kMaxCarrierId)) return false;
  place.complain(field, "there are " + std::to_string(place.count(field)) + "; a mission has at most " +
                            std::to_string(kMaxCarrierId));
  return true;
}

/// `gaps`: what is open, of requirements; null for a mission, in which nothing is.
mechanics::Plan read_plan(const Located& root, design::Open* gaps) {
  const bool may_be_open = gaps != nullptr;
  design::Open none;
  design::Open& open = may_be_open ? *gaps : none;
  mechanics::Plan plan;
  plan.load = read_load(root.required_child("load", "a mission has load { mass_kg: .. inertia_kg_m2 { .. } .. }"));
  plan.gravity_m_s2 = root.number("gravity_m_s2", kGravity, plan.gravity_m_s2);
  const Located cable = root.child("cable");
  plan.cable.stiffness_n_m = cable.number("stiffness_n_m", kStiffness, 1e4);
  plan.cable.damping_n_s_m = cable.number("damping_n_s_m", kDamping, 1e3);
  plan.cable.compensate_stretch = cable.flag("compensate_stretch", true);
  plan.winch = read_winch(root.child("winch"));
  plan.limits = read_limits(root.child("limits"));

  const Located cycle = may_be_open
                            ? root.child("cycle")
                            : root.required_child("cycle", "a mission has cycle { rate_rad_s: .. edge { .. } .. }");
  plan.cycle.rate_rad_s =
      root.has("cycle") || may_be_open ? number_or_open(cycle, "rate_rad_s", kRate, may_be_open, open.rate) : 1.0;
  if (too_many(root, "carrier") || too_many(cycle, "edge")) return plan;
  if (root.count("carrier") == 0) {
    root.complain("carrier", "is missing; a mission has at least one carrier { id: .. attachment_m { .. } .. }");
    return plan;
  }
  const std::vector<Located> nodes = root.children("carrier");
  open.attachments = may_be_open && std::none_of(nodes.begin(), nodes.end(),
                                                 [](const Located& node) { return node.has("attachment_m"); });
  const bool rate_known = cycle.sound("rate_rad_s", kRate);
  plan.carriers =
      read_carriers(nodes, plan.load, {may_be_open, rate_known ? plan.cycle.rate_rad_s : kUnknownRate}, open);
  const std::vector<Located> edges = cycle.children("edge");
  open.order = may_be_open && edges.empty();
  if (open.attachments) judge_open_attachments(root, plan.load, edges);
  if (!root.has("cycle") || open.order) return plan;
  plan.cycle.edges = read_edges(edges, may_be_open, open.edges);
  judge_cycle(plan, {cycle, edges});
  return plan;
}

std::set<CarrierId> read_holds(const pb::Mission& message) {
  std::set<CarrierId> out;
  for (const pb::Carrier& carrier : message.carrier()) {
    if (carrier.vehicle().on_silence() == pb::Vehicle::HOLD) out.insert(carrier.id());
  }
  return out;
}

Simulation read_simulation(const Located& simulation) {
  Simulation out;
  out.carrier_time_constant_s = simulation.optional_number("carrier_time_constant_s", kTimeConstantS);
  out.lag_error = simulation.number("lag_error", kLagError, 0.0);
  if (!simulation.has("wind")) return out;
  const Located node = simulation.child("wind");
  Wind wind;
  wind.force_w_n = node.vector("force_n", kForceN);
  wind.gust_n = node.number("gust_n", kPositiveForceN, 0.0);
  wind.gust_time_s = node.number("gust_time_s", kGustTimeS, wind.gust_time_s);
  out.wind = wind;
  return out;
}

std::string read_name(const Located& root, const std::string& name) {
  const bool printable = std::all_of(name.begin(), name.end(), [](char c) { return c >= 0x20 && c <= 0x7e; });
  if (!name.empty() && name.size() <= kMaxNameBytes && printable) return name;
  root.complain("name", "is empty, longer than " + std::to_string(kMaxNameBytes) +
                            " characters or not printable ASCII; give a short name");
  return {};
}

protocol::Silence read_silence(const pb::Mission& message, const Located& root) {
  protocol::Silence silence;
  if (!message.has_silence()) return silence;
  const Located place = root.child("silence");
  switch (message.silence().policy_case()) {
    case pb::Silence::kFlyOn:
      silence.stop_after.reset();
      break;
    case pb::Silence::kStopAfterS:
      silence.stop_after = from_seconds(place.number("stop_after_s", kLeaseS));
      break;
    case pb::Silence::POLICY_NOT_SET:
      place.complain("says nothing; give stop_after_s: 5 or fly_on {}");
  }
  return silence;
}

/// Judges every field, so that all complaints come at once; the mission is worth nothing if there are any.
Mission read_mission(const pb::Mission& message, const Located& root, design::Open* gaps) {
  Mission mission;
  if (message.has_name()) mission.name = read_name(root, message.name());
  mission.plan = read_plan(root, gaps);
  mission.simulation = read_simulation(root.child("simulation"));
  mission.holds = read_holds(message);
  if (mission.simulation.wind) mission.simulation.wind->seed = message.simulation().wind().seed();
  mission.transition_duration_s = root.child("transition").optional_number("duration_s", kDurationS);
  mission.silence = read_silence(message, root);
  const Located limits = root.child("limits");
  LoadTolerance& tolerance = mission.load_tolerance;
  tolerance.displacement_max_m = limits.number("load_displacement_max_m", kLengthM, tolerance.displacement_max_m);
  tolerance.rotation_max_deg = limits.number("load_rotation_max_deg", kRotationDeg, tolerance.rotation_max_deg);
  return mission;
}

/// What no parser needs to look at.
const char* unreadable(const std::string& text) {
  if (text.size() > kMaxMissionBytes)
    return "is larger than 1 MiB; a mission of a hundred carriers takes a few kilobytes";
  if (text.find('\0') != std::string::npos)
    return "is not text; give a mission in Protobuf text format, as deploy/missions has";
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) {
    return "is empty; a mission has at least load, carrier and cycle, as in deploy/missions";
  }
  return nullptr;
}

/// Parses a text, and has it read and judged.
template <class Read>
auto parse(const std::string& text, const std::string& source_name, const Read& read)
    -> Result<decltype(read(pb::Mission(), std::declval<const Located&>()))> {
  Complaints complaints(source_name);
  if (const char* why = unreadable(text)) {
    complaints.add(-1, -1, "", why);
    return complaints.error();
  }
  if (const std::optional<Place> place = too_deep(text)) {
    complaints.add(place->line, place->column, "",
                   "blocks inside blocks, more than " + std::to_string(kMaxDepth) +
                       " deep; a mission needs 4: close the braces before this one");
    return complaints.error();
  }
  pb::Mission message;
  Located::Locations locations;
  ParseErrors errors(complaints);
  google::protobuf::TextFormat::Parser parser;
  parser.RecordErrorsTo(&errors);
  parser.WriteLocationsTo(&locations);
  parser.AllowUnknownField(true);  // reported, see ParseErrors; the parser would stop at the first one otherwise
  if (!parser.ParseFromString(text, &message)) {
    if (complaints.none()) complaints.add(-1, -1, "", "is not a mission in Protobuf text format");
    return complaints.error();
  }
  auto out = read(message, Located(message, locations, complaints));
  if (!complaints.none()) return complaints.error();
  return out;
}

}  // namespace

Result<Mission> parse_mission(const std::string& text, const std::string& source_name) {
  return parse(text, source_name, [](const pb::Mission& message, const Located& root) {
    if (message.has_want()) {
      root.complain("want",
                    "is of requirements, which are no mission yet; make one of them by gyre design, or leave it out");
    }
    return read_mission(message, root, nullptr);
  });
}

Result<Requirements> parse_requirements(const std::string& text, const std::string& source_name) {
  return parse(text, source_name, [](const pb::Mission& message, const Located& root) {
    Requirements out;
    out.mission = read_mission(message, root, &out.open);
    const Located want = root.required_child(
        "want", "requirements have want { speed_min_m_s: .. }; what has all its numbers is a mission: gyre check");
    if (!message.has_want()) return out;
    out.want = read_want(message.want(), want, out.mission.plan);
    judge_want(want, out.want, out.open, out.mission.plan);
    return out;
  });
}

}  // namespace gyre::mission
