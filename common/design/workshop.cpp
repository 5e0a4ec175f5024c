#include "common/design/workshop.hpp"

#include <algorithm>
#include <cmath>

#include "common/design/judge.hpp"

namespace gyre::design {
namespace {

constexpr int kFewSamples = 16;
constexpr int kHurry = 4;  // rounds
constexpr int kMostSamples = 64;
constexpr int kSamplesOfAll = 768;  // many carriers say together what few say with many samples

constexpr double kOtherRates[] = {0.85, 1.15, 0.7, 1.4};

bool raises(Objective objective) {
  return objective == Objective::kGreatestSpeed || objective == Objective::kGreatestClearance;
}

}  // namespace

bool before(const Candidate& a, const Candidate& b) {
  if (a.meets() != b.meets()) return a.meets();
  return a.meets() ? a.point.cost < b.point.cost : a.point.worst < b.point.worst;
}

Workshop::Workshop(const Requirements& requirements, std::uint64_t seed, const KeepGoing& keep_going)
    : requirements_(requirements),
      seed_(seed),
      keep_going_(keep_going),
      scales_(scales_of(requirements)),
      bounds_(bounds_of(requirements, scales_)),
      demands_(demands_of(requirements, scales_)) {}

bool Workshop::going(const std::string& doing) {
  if (!stopped_) stopped_ = !keep_going_({doing, best_});
  return !stopped_;
}

int Workshop::samples() const {
  const int carriers = static_cast<int>(requirements_.given.carriers.size());
  return finer_ * std::clamp(kSamplesOfAll / carriers, kFewSamples, kMostSamples);
}

std::vector<std::size_t> Workshop::raised() const {
  const auto wanted = [objective = requirements_.want.objective](const Demand& demand) {
    const bool least = demand.kind == Kind::kCarrier && demand.least;
    if (objective == Objective::kGreatestSpeed) return least && demand.figure == Figure::kSpeed;
    if (objective != Objective::kGreatestClearance) return false;
    // Whatever may touch; of altitudes those above the load.
    return demand.kind == Kind::kClearance || demand.kind == Kind::kLoad ||
           (least && demand.figure == Figure::kAltitude && demand.origin == Origin::kAlways);
  };
  std::vector<std::size_t> out;
  for (std::size_t d = 0; d < demands_.size(); ++d) {
    if (wanted(demands_[d])) out.push_back(d);
  }
  return out;
}

Search Workshop::search_of(const Candidate& candidate, const std::string& doing, int samples) {
  Search search;
  search.plan = &candidate.start.plan;
  search.unknowns = candidate.unknowns;
  search.demands = demands_;
  search.raised = raised();
  search.objective = requirements_.want.objective;
  search.scales = scales_;
  search.gravity_m_s2 = requirements_.given.gravity_m_s2;
  search.samples = samples;
  search.margin = margin_;
  search.keep_going = [this, doing] { return going(doing); };
  return search;
}

double Workshop::figure(const Candidate& candidate) const {
  const Objective objective = requirements_.want.objective;
  if (raises(objective)) return -candidate.point.cost;
  if (objective == Objective::kLeastWinchWork)
    return std::sqrt(candidate.point.cost) * scales_.force_n * scales_.speed_m_s;
  return candidate.point.cost;
}

bool Workshop::better(double figure, double than) const {
  return raises(requirements_.want.objective) ? figure > than : figure < than;
}

void Workshop::note(const Candidate& candidate) {
  if (!own_demands_ || !candidate.meets()) return;
  const double now = figure(candidate);
  if (!best_ || better(now, *best_)) best_ = now;
}

Candidate Workshop::family(const Order& order, double pull) {
  Candidate out;
  out.start = start(order, pull);
  out.unknowns = family_of(out.start.plan, out.start.open, bounds_);
  out.point = meet(search_of(out, "orders of the cycle", kFewSamples), out.unknowns.start, kHurry);
  return out;
}

Candidate Workshop::opened(const Candidate& from) const {
  Candidate out;
  out.family = false;
  out.start = {from.plan(), from.start.open};
  out.unknowns = whole_of(out.start.plan, out.start.open, bounds_);
  out.point.x = out.unknowns.start;
  return out;
}

Candidate Workshop::whole(const Candidate& from) {
  Candidate out = opened(from);
  settle(out, "all that is open");
  return out;
}

Candidate Workshop::whole(const Candidate& from, double shaken, RandomStream& stream) {
  Candidate out = opened(from);
  for (double& x : out.point.x) x += shaken * stream.normal();
  settle(out, "all that is open, shaken");
  return out;
}

void Workshop::meet_demands(Candidate& candidate, const std::string& doing) {
  candidate.point = meet(search_of(candidate, doing, samples()), candidate.point.x);
  note(candidate);
}

void Workshop::settle(Candidate& candidate, const std::string& doing) {
  meet_demands(candidate, doing);
  if (!candidate.meets()) return;
  candidate.point = improve(search_of(candidate, doing, samples()), candidate.point);
  note(candidate);
}

void Workshop::mend(Candidate& candidate, const std::string& doing) {
  Search search = search_of(candidate, doing, samples());
  search.keep_going = nullptr;
  candidate.point = meet(search, candidate.point.x, 2);
  if (!stopped_) settle(candidate, doing);
}

std::vector<Candidate> Workshop::at_other_rates(const Candidate& candidate, const std::string& doing) {
  std::vector<Candidate> out;
  const int rate = candidate.unknowns.rate_rad_s.index;
  for (const double factor : kOtherRates) {
    if (rate < 0 || !going(doing)) break;
    Candidate other = candidate;
    other.swings = false;
    const double bound = factor * other.point.x[rate];
    (factor < 1.0 ? other.unknowns.upper : other.unknowns.lower)[rate] = bound;
    other.point.x[rate] = bound;
    settle(other, doing);
    out.push_back(std::move(other));
  }
  return out;
}

std::vector<double> Workshop::residuals(const Candidate& candidate) const {
  SampledMotion motion(candidate.start.plan, candidate.unknowns, samples());
  motion.evaluate(candidate.point.x);
  const Judge judge(candidate.start.plan, candidate.unknowns, demands_, motion);
  std::vector<double> out(demands_.size(), -std::numeric_limits<double>::infinity());
  for (const Judged& judged : judge.find(candidate.point.x, -std::numeric_limits<double>::infinity()).rows)
    out[judged.row.demand] = std::max(out[judged.row.demand], judged.residual);
  return out;
}

}  // namespace gyre::design
