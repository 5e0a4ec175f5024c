#include "ground/flight/core/flight_report.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/text.hpp"

namespace gyre::ground {
namespace {

using mechanics::CarrierFigures;
using mechanics::Range;

double magnitude(const Range& range) {
  return std::max(std::abs(range.min), std::abs(range.max));
}

/// One carrier against its bounds; collects what is outside in words.
class Judge {
 public:
  Judge(CarrierId id, std::vector<std::string>& violations, const FlightTolerance& tolerance)
      : id_(id), violations_(violations), tolerance_(tolerance) {}

  struct Bound {
    const char* figure;
    const char* unit;
    double floor;
  };

  JudgedRange judge(const Bound& bound, const Range& certified, const Range& flown, const Range& hull,
                    const Range& whole) {
    const bool motion_inside = inside(bound, "in the motion", certified, flown);
    // What the motion broke already need not be said twice.
    const bool whole_inside = !motion_inside || inside(bound, "on the way", hull, whole);
    return {certified, flown, motion_inside && whole_inside};
  }

 private:
  bool inside(const Bound& bound, const char* when, const Range& certified, const Range& flown) {
    const double slack = bound.floor + tolerance_.relative * magnitude(certified);
    const bool high = !(flown.max <= certified.max + slack);
    const bool low = !(flown.min >= certified.min - slack);
    if (high) complain(bound, when, flown.max, "most", certified.max);
    if (low) complain(bound, when, flown.min, "least", certified.min);
    return !high && !low;
  }

  void complain(const Bound& bound, const char* when, double flown, const char* end, double certified) {
    violations_.push_back(text("carrier %u: %s %.4g %s %s, certified at %s %.4g %s", id_, bound.figure, flown,
                               bound.unit, when, end, certified, bound.unit));
  }

  CarrierId id_;
  std::vector<std::string>& violations_;
  const FlightTolerance& tolerance_;
};

CarrierReport judge_carrier(const FlightCertificate::CarrierBounds& bounds, const CarrierRecord& record,
                            double stretch_m, const FlightTolerance& tolerance, std::vector<std::string>& violations) {
  const CarrierFigures& motion = bounds.motion;
  const CarrierFigures& hull = bounds.whole;
  const FlownFigures& flown = record.motion;
  const FlownFigures& whole = record.whole;
  Judge judge(bounds.id, violations, tolerance);
  CarrierReport report;
  report.id = bounds.id;
  report.tension_n = judge.judge({"tension", "N", tolerance.tension_n}, motion.tension_n, flown.tension_n,
                                 hull.tension_n, whole.tension_n);
  report.length_m = judge.judge({"cable length", "m", tolerance.length_m + stretch_m}, motion.length_m, flown.length_m,
                                hull.length_m, whole.length_m);
  report.speed_m_s = judge.judge({"speed", "m/s", tolerance.speed_m_s}, motion.speed_m_s, flown.speed_m_s,
                                 hull.speed_m_s, whole.speed_m_s);
  report.winch_rate_m_s = judge.judge({"winch rate", "m/s", tolerance.speed_m_s}, motion.winch_rate_m_s,
                                      flown.winch_rate_m_s, hull.winch_rate_m_s, whole.winch_rate_m_s);
  report.altitude_m = judge.judge({"altitude", "m", tolerance.length_m}, motion.altitude_m, flown.altitude_m,
                                  hull.altitude_m, whole.altitude_m);
  return report;
}

void judge_load(FlightReport& report) {
  const auto before = report.violations.size();
  const LoadRecord& load = report.load;
  const mission::LoadTolerance& limit = report.load_tolerance;
  if (load.samples == 0) report.violations.emplace_back("load: its state was never received");
  if (!(load.displacement_max_m <= limit.displacement_max_m)) {
    report.violations.push_back(text("load: displaced by %.4g mm, the mission allows %.4g mm",
                                     load.displacement_max_m * 1e3, limit.displacement_max_m * 1e3));
  }
  if (!(load.rotation_max_deg <= limit.rotation_max_deg)) {
    report.violations.push_back(
        text("load: turned by %.4g degrees, the mission allows %.4g", load.rotation_max_deg, limit.rotation_max_deg));
  }
  report.load_inside = report.violations.size() == before;
}

}  // namespace

FlightReport judge_flight(const mission::Mission& mission, const FlightCertificate& certificate,
                          const FlightRecord& record, double flown_s, const FlightTolerance& tolerance) {
  FlightReport report;
  report.mission = mission.name;
  report.flown_s = flown_s;
  report.load = record.load();
  report.load_tolerance = mission.load_tolerance;
  report.timing = record.timing();
  if (!certificate.knows_all_plans()) {
    report.violations.emplace_back("the swarm went to a plan that is not of this mission");
  }
  const auto bounds = certificate.bounds();
  const auto& cable = mission.plan.cable;
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    const CarrierRecord& carrier = record.carriers()[i];
    GYRE_ENSURE(carrier.id == bounds[i].id, "record and certificate are of one mission, in its order");
    if (carrier.motion.samples == 0) {
      report.violations.push_back(text("carrier %u: its state was never received in the motion", carrier.id));
      continue;
    }
    const bool stretches = !cable.compensate_stretch && cable.stiffness_n_m > 0.0;
    const double stretch_m = stretches ? bounds[i].whole.tension_n.max / cable.stiffness_n_m : 0.0;
    report.carriers.push_back(judge_carrier(bounds[i], carrier, stretch_m, tolerance, report.violations));
  }
  judge_load(report);
  return report;
}

}  // namespace gyre::ground
