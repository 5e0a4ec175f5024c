#include "common/mechanics/judgement.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

#include "common/base/angle.hpp"
#include "common/base/text.hpp"
#include "common/mechanics/grasp.hpp"
#include "common/mechanics/load_hull.hpp"

namespace gyre::mechanics {
namespace {

/// Sines of angles below this are rounding of the file's digits, not geometry.
constexpr double kAlmostZero = 1e-9;

void refuse(std::vector<Reason>& reasons, Rule rule, std::optional<CarrierId> carrier, std::string text) {
  reasons.push_back({rule, carrier, std::move(text)});
}

/// No length, force, mass or rate of this world is greater, and products of a dozen numbers that are not stay finite.
constexpr double kGreatest = 1e12;
/// How far a unit vector or quaternion may be from one.
constexpr double kUnitTolerance = 1e-6;

bool sound(double x) {
  return std::abs(x) <= kGreatest;  // not so for what is no number
}
bool sound(const Eigen::Vector3d& v) {
  return sound(v.x()) && sound(v.y()) && sound(v.z());
}
bool lag(double x) {
  return sound(x) && x >= 0.0;
}
bool unit(double norm) {
  return std::abs(norm - 1.0) <= kUnitTolerance;
}
bool sound(const Oscillation& o) {
  const Harmonic& h = o.harmonic;
  return sound(o.mean) && sound(o.swing) && sound(o.phase_rad) && h.numerator >= 1 && h.numerator <= kMaxNumerator &&
         h.denominator >= 1 && h.denominator <= kMaxDenominator;
}
bool sound(const Load& load) {
  const Eigen::Matrix3d& inertia = load.inertia_b_kg_m2;
  return sound(load.mass_kg) && load.mass_kg > 0.0 && sound(load.position_w_m) && unit(load.orientation_w_b.norm()) &&
         inertia.array().abs().maxCoeff() <= kGreatest && inertia.isApprox(inertia.transpose()) &&
         inertia.llt().info() == Eigen::Success;
}

/// Hamiltonian, in order of travel; one edge for two carriers, none for one.
bool is_cycle(const std::vector<Edge>& edges, const std::set<CarrierId>& carriers) {
  if (edges.size() != (carriers.size() > 2 ? carriers.size() : carriers.size() - 1)) return false;
  std::set<CarrierId> left;
  for (std::size_t j = 0; j < edges.size(); ++j) {
    const Edge& next = edges[(j + 1) % edges.size()];
    if (edges[j].from == edges[j].to || carriers.count(edges[j].to) == 0) return false;
    if (carriers.count(edges[j].from) == 0 || !left.insert(edges[j].from).second) return false;
    if (edges.size() > 1 && edges[j].to != next.from) return false;
  }
  return true;
}

template <class Malformed>
void judge_shape(const Plan& plan, const Malformed& malformed) {
  const std::vector<Eigen::Vector3d>& hull = plan.load.hull_b_m;
  if (hull.empty()) return;
  if (!std::all_of(hull.begin(), hull.end(), [](const Eigen::Vector3d& corner) { return sound(corner); })) {
    return malformed(std::nullopt, "a corner of the load's shape is in no numbers of this world; give metres");
  }
  for (const Carrier& c : plan.carriers) {
    if (!sound(c.attachment_b_m) || LoadCone::seen_from(c.attachment_b_m, hull)) continue;
    malformed(c.id, text("carrier %u: its attachment is inside the load's shape; attach it at the surface", c.id));
  }
}

void judge_pair(const std::vector<CarrierSlice>& slices, std::vector<Reason>& reasons) {
  for (const CarrierSlice& c : slices) {
    const LengthLaw& law = c.law;
    const Eigen::Vector3d d = c.incoming.direction + c.outgoing.direction;  // one of them is zero
    if (law.is_projection() && law.profile.constant()) {
      refuse(reasons, Rule::kTwoCarrierObstruction, c.id,
             text("carrier %u: two carriers on a periodic %s motion both stop whenever d(lambda)/dt = 0; give both a "
                  "sine length law that is moving at those moments, or add a third carrier",
                  c.id, name(law.kind)));
    } else if (law.profile.constant()) {
      refuse(reasons, Rule::kTwoCarrierConstruction, c.id,
             text("carrier %u: with two carriers the length has to swing (b_i != 0), or the carrier stops whenever "
                  "d(lambda)/dt = 0; its length law is %s with no swing; use sine with a swing other than 0",
                  c.id, name(law.kind)));
    }
    if (c.particular_force_w_n.normalized().cross(d).norm() < kAlmostZero) {
      refuse(reasons, Rule::kTwoCarrierConstruction, c.id,
             text("carrier %u: its particular force f0 lies along the line between the attachments, so its cable "
                  "direction cannot change; move the attachments so that the load does not hang along their line",
                  c.id));
    }
  }
}

void judge_many(const std::vector<CarrierSlice>& slices, std::vector<Reason>& reasons) {
  for (const CarrierSlice& c : slices) {
    if (!c.law.profile.constant()) continue;  // a length that moves can keep a carrier going by itself
    const Eigen::Vector3d normal = c.incoming.direction.cross(c.outgoing.direction);
    if (normal.norm() < kAlmostZero) {
      refuse(reasons, Rule::kRank, c.id,
             text("carrier %u: rank [delta deltabar] = 1: its attachment is in line with both neighbours in the cycle; "
                  "move an attachment or order the cycle so that its two edges differ in direction",
                  c.id));
      continue;
    }
    if (std::abs(c.particular_force_w_n.normalized().dot(normal.normalized())) < kAlmostZero) {
      refuse(reasons, Rule::kPlane, c.id,
             text("carrier %u: its particular force f0 lies in the plane of its two edges, span{delta, deltabar}; "
                  "tilt the load or move attachments out of the vertical plane",
                  c.id));
    }
    const bool still = c.incoming.amplitude_n == 0.0 || c.outgoing.amplitude_n == 0.0;
    if (still || std::abs(std::sin(c.incoming.phase_rad - c.outgoing.phase_rad)) < kAlmostZero) {
      refuse(reasons, Rule::kPhaseCondition, c.id,
             text("carrier %u: the phases of its two edges (%.6g and %.6g rad) differ by a multiple of pi, or one of "
                  "them has no amplitude: its force runs back and forth on a line and stops at the ends; give both "
                  "edges an amplitude and phases that differ by anything but a multiple of pi",
                  c.id, c.incoming.phase_rad, c.outgoing.phase_rad));
    }
  }
}

bool slack(const CarrierFigures& f) {
  return f.tension_n.min <= 1e-6 * f.tension_n.max;
}

/// Its cable becomes perpendicular to what its length law projects on.
bool loses_its_law(const CarrierFigures& f) {
  return f.direction_cosine_min && *f.direction_cosine_min <= 0.0;
}

/// One line per limit: the figure, the limit it breaks, and the cure.
struct Bound {
  Rule rule;
  const char* what;
  const char* unit;
  const char* limit_name;
  const char* cure;
};

void at_least(const Bound& b, double figure, const std::optional<double>& limit, CarrierId id,
              std::vector<Reason>& reasons) {
  if (!limit || figure >= *limit) return;
  refuse(reasons, b.rule, id,
         text("carrier %u: %s falls to %.6g%s, below %s %.6g; %s", id, b.what, figure, b.unit, b.limit_name, *limit,
              b.cure));
}

void at_most(const Bound& b, double figure, const std::optional<double>& limit, CarrierId id,
             std::vector<Reason>& reasons) {
  if (!limit || figure <= *limit) return;
  refuse(reasons, b.rule, id,
         text("carrier %u: %s reaches %.6g%s, above %s %.6g; %s", id, b.what, figure, b.unit, b.limit_name, *limit,
              b.cure));
}

}  // namespace

const char* name(Rule rule) {
  switch (rule) {
    case Rule::kMalformedPlan:
      return "malformed plan";
    case Rule::kOneCarrierImpossibility:
      return "one-carrier impossibility";
    case Rule::kTwoCarrierObstruction:
      return "two-carrier obstruction";
    case Rule::kTwoCarrierConstruction:
      return "two-carrier construction";
    case Rule::kRank:
      return "rank";
    case Rule::kPlane:
      return "plane";
    case Rule::kPhaseCondition:
      return "phase condition";
    case Rule::kInfeasibleEquilibrium:
      return "infeasible equilibrium";
    case Rule::kNonStop:
      return "non-stop";
    case Rule::kTension:
      return "tension";
    case Rule::kVerticalCosine:
      return "vertical cosine";
    case Rule::kDirectionCosine:
      return "direction cosine";
    case Rule::kLengthBounds:
      return "length bounds";
    case Rule::kWinchRate:
      return "winch rate";
    case Rule::kWinch:
      return "winch";
    case Rule::kSpeed:
      return "speed";
    case Rule::kAcceleration:
      return "acceleration";
    case Rule::kThrust:
      return "thrust";
    case Rule::kBank:
      return "bank";
    case Rule::kSeparation:
      return "separation";
    case Rule::kBraid:
      return "braid";
    case Rule::kClearance:
      return "clearance";
    case Rule::kStiffness:
      return "stiffness";
    case Rule::kSwing:
      return "swing";
  }
  return "unknown";
}

void judge_form(const Plan& plan, std::vector<Reason>& reasons) {
  const auto malformed = [&reasons](std::optional<CarrierId> carrier, std::string words) {
    refuse(reasons, Rule::kMalformedPlan, carrier, std::move(words));
  };
  if (plan.carriers.empty()) return malformed(std::nullopt, "no carrier holds the load; add some");
  if (!sound(plan.load) || !sound(plan.gravity_m_s2)) {
    malformed(std::nullopt,
              "the load's mass, inertia, place, orientation or gravity is no such thing; give a positive mass, a "
              "symmetric and positive definite inertia, a unit quaternion, and numbers of this world");
  }
  if (!sound(plan.cable.stiffness_n_m) || plan.cable.stiffness_n_m < 0.0) {
    malformed(std::nullopt, "the cables' stiffness is no number, or negative; give it in N/m");
  }
  if (!sound(plan.cable.damping_n_s_m) || plan.cable.damping_n_s_m < 0.0) {
    malformed(std::nullopt, "the cables' damping is no number, or negative; give it in N s/m");
  }
  if (!lag(plan.winch.time_constant_s)) {
    malformed(std::nullopt, "the winches' time constant is no number, or negative; give it in seconds");
  }
  std::set<CarrierId> carriers;
  for (const Carrier& c : plan.carriers) {
    if (!lag(c.vehicle.time_constant_s) ||
        (c.vehicle.mass_kg && !(sound(*c.vehicle.mass_kg) && *c.vehicle.mass_kg > 0.0))) {
      malformed(c.id, text("carrier %u: its vehicle's mass or time constant is no number, or negative; give a positive "
                           "mass in kilograms, and the time constant in seconds",
                           c.id));
    }
    if (!carriers.insert(c.id).second) malformed(c.id, text("two carriers are carrier %u; number each its own", c.id));
    if (!sound(c.radius_m) || c.radius_m < 0.0) {
      malformed(c.id, text("carrier %u: its radius is no length; give the vehicle's, in metres", c.id));
    }
    if (!sound(c.attachment_b_m) || !sound(c.law.profile) || (c.law.is_projection() && !unit(c.law.direction.norm()))) {
      malformed(c.id, text("carrier %u: its attachment or its length law is not in numbers of this world, the law's "
                           "direction no unit vector, or its rate not p/q of the cycle's; give such numbers, a unit "
                           "vector, and p up to %d and q up to %d",
                           c.id, kMaxNumerator, kMaxDenominator));
    }
  }
  judge_shape(plan, malformed);
  if (!sound(plan.cycle.rate_rad_s) || !(plan.cycle.rate_rad_s > 0.0)) {
    malformed(std::nullopt,
              "the cycle's rate is no positive number; a plan that stands still has a rate and no amplitudes");
  }
  for (const Edge& e : plan.cycle.edges) {
    if (sound(e.offset_n) && sound(e.amplitude_n) && sound(e.phase_rad)) continue;
    malformed(std::nullopt, text("the edge from %u to %u has an offset, amplitude or phase that is no number of this "
                                 "world; give one",
                                 e.from, e.to));
  }
  if (!is_cycle(plan.cycle.edges, carriers)) {
    malformed(std::nullopt,
              "the edges are no cycle through every carrier; let one edge begin at each, in order of travel, the last "
              "one back to the first carrier; two carriers have one edge, a single one has none");
  }
}

void judge_equilibrium(const Plan& plan, std::vector<Reason>& reasons) {
  const Vector6d wrench = holding_wrench(plan.load.mass_kg, plan.gravity_m_s2);
  const ParticularForce particular = particular_force(lever_arms(plan), wrench);
  if (particular.residual <= kAlmostZero * wrench.norm()) return;
  refuse(reasons, Rule::kInfeasibleEquilibrium, std::nullopt,
         text("no cable forces at these attachments hold the load in this pose: a moment of %.6g N m stays unbalanced; "
              "place the attachments so that the centre of mass is under (or over) their point, line or polygon, or "
              "tilt the load",
              particular.residual));
}

void judge_construction(const Plan& plan, const std::vector<CarrierSlice>& slices, std::vector<Reason>& reasons) {
  if (plan.carriers.size() == 1) {
    refuse(reasons, Rule::kOneCarrierImpossibility, plan.carriers.front().id,
           "one carrier cannot hold a load still without stopping: its force has to be the weight, so its cable keeps "
           "one direction and any motion along it is unbounded or turns back; use two carriers with sine lengths, or "
           "three and more");
  } else if (plan.carriers.size() == 2) {
    judge_pair(slices, reasons);
  } else {
    judge_many(slices, reasons);
  }
}

void judge_carrier(const CarrierFigures& f, const Limits& limits, bool non_stop, std::vector<Reason>& reasons) {
  const CarrierId id = f.id;
  if (slack(f)) {
    refuse(reasons, Rule::kTension, id,
           text("carrier %u: its tension falls to zero and the cable goes slack; lower the amplitudes of its edges or "
                "raise their offsets",
                id));
    return;  // without a direction no other figure means anything
  }
  if (loses_its_law(f)) {
    const bool vertical = !(f.vertical_cosine.min > 0.0 || f.vertical_cosine.max < 0.0);
    refuse(reasons, vertical ? Rule::kVerticalCosine : Rule::kDirectionCosine, id,
           text("carrier %u: its cable becomes perpendicular to the direction its length law projects on (u·q passes "
                "through zero), so no finite length keeps the profile; lower the amplitudes of its edges, or raise "
                "the share of the weight it carries",
                id));
    return;
  }
  if (f.length_m.min <= 0.0) {
    refuse(reasons, Rule::kLengthBounds, id,
           text("carrier %u: its cable length falls to %.6g m; a cable has to be longer than nothing: raise the "
                "carrier's altitude (or profile, or mean length) above its attachment",
                id, f.length_m.min));
  } else if (f.paid_out_m.min <= 0.0) {
    refuse(reasons, Rule::kLengthBounds, id,
           text("carrier %u: its winch would have to have paid out %.6g m, because its tension stretches the cable by "
                "as much as it is long; use stiffer cables, or longer ones",
                id, f.paid_out_m.min));
  } else if (!limits.length_min_m || f.length_m.min >= *limits.length_min_m) {
    at_least({Rule::kLengthBounds, "paid-out length", " m", "length_min_m",
              "use stiffer cables, or raise its altitude, profile or mean length"},
             f.paid_out_m.min, limits.length_min_m, id, reasons);
  }
  at_least({Rule::kTension, "tension", " N", "tension_min_n", "lower the amplitudes of its edges or raise offsets"},
           f.tension_n.min, limits.tension_min_n, id, reasons);
  at_most({Rule::kTension, "tension", " N", "tension_max_n", "lower the amplitudes or offsets of its edges"},
          f.tension_n.max, limits.tension_max_n, id, reasons);
  at_least({Rule::kLengthBounds, "length", " m", "length_min_m", "raise its altitude, profile or mean length"},
           f.length_m.min, limits.length_min_m, id, reasons);
  at_most({Rule::kLengthBounds, "length", " m", "length_max_m", "lower its altitude, profile or mean length"},
          f.length_m.max, limits.length_max_m, id, reasons);
  at_most({Rule::kWinchRate, "winch rate", " m/s", "winch_rate_max_m_s",
           "lower the cycle's rate, or choose phases nearer to the edge headings"},
          f.winch_rate_max_m_s(), limits.winch_rate_max_m_s, id, reasons);
  at_most({Rule::kSpeed, "speed", " m/s", "speed_max_m_s", "lower the cycle's rate or the amplitudes"}, f.speed_m_s.max,
          limits.speed_max_m_s, id, reasons);
  at_most({Rule::kAcceleration, "acceleration", " m/s²", "acceleration_max_m_s2",
           "lower the cycle's rate or the amplitudes"},
          f.acceleration_max_m_s2, limits.acceleration_max_m_s2, id, reasons);
  if (limits.vertical_cosine_min) {
    const double least = std::max({0.0, f.vertical_cosine.min, -f.vertical_cosine.max});  // |q_z|; 0 if it turns over
    at_least({Rule::kVerticalCosine, "vertical cosine |q_z|", "", "vertical_cosine_min",
              "lower the amplitudes of its edges"},
             least, limits.vertical_cosine_min, id, reasons);
  }
  if (!non_stop) return;
  if (f.speed_m_s.min <= 1e-6 * f.speed_m_s.max) {
    refuse(reasons, Rule::kNonStop, id,
           text("carrier %u: it stops once or more in every period; choose phases, amplitudes and rate so that its "
                "cable direction or its length is always moving",
                id));
  }
  at_least({Rule::kSpeed, "speed", " m/s", "speed_min_m_s",
            "raise the cycle's rate, or choose phases nearer to the edge headings"},
           f.speed_m_s.min, limits.speed_min_m_s, id, reasons);
}

void judge_machines(const CarrierFigures& f, const Winch& winch, const Vehicle& vehicle, std::vector<Reason>& reasons) {
  if (slack(f) || loses_its_law(f)) return;  // judge_carrier says what there is to say
  at_most({Rule::kWinch, "rate of what the winch pays out", " m/s", "winch.rate_max_m_s",
           "lower the cycle's rate, choose phases nearer to the edge headings, or take a faster winch"},
          f.paid_out_rate_max_m_s(), winch.rate_max_m_s, f.id, reasons);
  at_most({Rule::kWinch, "acceleration of what the winch pays out", " m/s²", "winch.acceleration_max_m_s2",
           "lower the cycle's rate, choose phases nearer to the edge headings, or take a stronger winch"},
          f.winch_acceleration_max_m_s2, winch.acceleration_max_m_s2, f.id, reasons);
  if (f.thrust_max_n) {
    at_most({Rule::kThrust, "thrust", " N", "vehicle.thrust_max_n",
             "lower the amplitudes or offsets of its edges, or the cycle's rate, or take a stronger vehicle"},
            *f.thrust_max_n, vehicle.thrust_max_n, f.id, reasons);
  }
  if (f.bank_max_rad && vehicle.bank_max_rad) {
    at_most({Rule::kBank, "bank", " degrees", "vehicle.bank_max_deg",
             "lower the amplitudes or offsets of its edges, or the cycle's rate, or take a heavier vehicle"},
            degrees(*f.bank_max_rad), degrees(*vehicle.bank_max_rad), f.id, reasons);
  }
}

}  // namespace gyre::mechanics
