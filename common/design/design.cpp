#include "common/design/design.hpp"

#include <algorithm>
#include <cmath>

#include "common/design/attachments.hpp"
#include "common/design/conflict.hpp"
#include "common/design/prices.hpp"
#include "common/design/workshop.hpp"
#include "common/mechanics/judgement.hpp"

namespace gyre::design {
namespace {

using mechanics::Plan;

constexpr double kPulls[] = {0.0, 0.65, 1.3, 2.2, 3.5};
constexpr std::size_t kFamilies = 5;  // that are improved
constexpr std::size_t kWholes = 3;    // families that are searched whole
constexpr std::size_t kShaken = 3;    // times that a family is shaken and searched again
constexpr double kShake = 0.15;       // of a variable
constexpr double kAlike = 1e-3;       // of the cost
constexpr double kWorthIt = 5e-3;     // by how much a motion has to be better to be taken for it
constexpr double kWorthMore = 5e-2;   // the same, to leave a family for the whole, where effort is what counts
/// Of a search, and of those that the certificate sent back.
struct Care {
  double margin;
  int finer;
};
constexpr Care kCares[] = {{2e-3, 1}, {4e-3, 2}, {1e-2, 4}};

/// Whether a candidate is better than another by enough; a family may even be a little worse than a whole.
bool preferred(const Candidate& a, const Candidate& b, Objective objective) {
  const double more = objective == Objective::kLeastEverything ? kWorthMore : kWorthIt;
  const double margin = a.family == b.family ? kWorthIt : a.family ? -more : more;
  return a.point.cost < b.point.cost - margin * std::abs(b.point.cost);
}

/// Of motions that cost the same, which are mirror images of each other as a rule, or the same found twice, one; the
/// best first.
std::vector<Candidate> distinct(std::vector<Candidate> candidates) {
  std::stable_sort(candidates.begin(), candidates.end(), before);
  const auto alike = [](const Candidate& a, const Candidate& b) {
    const auto near = [](double x, double y) { return std::abs(x - y) <= kAlike * std::max(std::abs(x), std::abs(y)); };
    return a.family == b.family && a.meets() == b.meets() && near(a.point.cost, b.point.cost) &&
           (a.meets() || near(a.point.worst, b.point.worst));
  };
  std::vector<Candidate> out;
  for (Candidate& candidate : candidates) {
    if (out.empty() || !alike(out.back(), candidate)) out.push_back(std::move(candidate));
  }
  return out;
}

/// The best families over all orders and pulls.
std::vector<Candidate> families(Workshop& workshop) {
  std::vector<Candidate> out;
  for (const Order& order : workshop.orders()) {
    for (const double pull : kPulls) {
      if (!workshop.going("orders of the cycle") && !out.empty()) break;
      out.push_back(workshop.family(order, pull));
    }
  }
  out = distinct(std::move(out));
  if (out.size() > kFamilies) out.resize(kFamilies);
  for (Candidate& candidate : out) workshop.settle(candidate, "families");
  return distinct(std::move(out));
}

/// Families and wholes, the ones to be judged first in front.
std::vector<Candidate> candidates(Workshop& workshop, std::uint64_t seed) {
  const std::vector<Candidate> simple = families(workshop);
  std::vector<Candidate> out = simple;
  RandomStream stream(seed, "shaken");
  const std::size_t wholes = std::min(kWholes, simple.size());
  for (std::size_t k = 0; k < wholes && workshop.going("all that is open"); ++k)
    out.push_back(workshop.whole(simple[k]));
  for (std::size_t k = 0; k < kShaken && !simple.empty() && workshop.going("all that is open, shaken"); ++k)
    out.push_back(workshop.whole(simple[k % simple.size()], kShake, stream));
  out = distinct(std::move(out));
  const auto simplest = std::find_if(out.begin(), out.end(), [](const Candidate& c) { return c.family; });
  if (simplest != out.end() && simplest->meets() &&
      preferred(*simplest, out.front(), workshop.requirements().want.objective))
    std::rotate(out.begin(), simplest, simplest + 1);
  return out;
}

bool grows(const mechanics::Certificate& certificate) {
  return std::any_of(certificate.reasons.begin(), certificate.reasons.end(),
                     [](const mechanics::Reason& reason) { return reason.rule == mechanics::Rule::kSwing; });
}

/// What the certificate refused, again: with more care, and at other rates where a swing grew.
std::vector<Candidate> mended(Workshop& workshop, std::vector<Candidate> refused, const Care& care) {
  const std::string doing = "what the certificate refused";
  workshop.tighten(care.margin, care.finer);
  std::vector<Candidate> out;
  for (Candidate& candidate : refused) {
    if (candidate.swings) {
      for (Candidate& other : workshop.at_other_rates(candidate, doing)) out.push_back(std::move(other));
    } else {
      workshop.mend(candidate, doing);
      out.push_back(std::move(candidate));
    }
  }
  return distinct(std::move(out));
}

/// Takes the candidates to the certificate: the design is the first that it admits, and then any that is better by
/// enough to be worth it.
class Desk {
 public:
  Desk(const Workshop& workshop, Design& out) : workshop_(workshop), out_(out) {}

  /// Those that it refuses, and that would be better than what it admitted.
  std::vector<Candidate> judge(const std::vector<Candidate>& found) {
    std::vector<Candidate> refused;
    for (const Candidate& candidate : found) {
      if (!candidate.meets() || !worth_it(candidate)) continue;
      mechanics::Plan plan = candidate.plan();
      mechanics::Certificate certificate = mechanics::certify(plan);
      if (!certificate.admissible()) {
        refused.push_back(candidate);
        refused.back().swings = grows(certificate);
        if (!best_ && refused.size() == 1) out_.certificate = std::move(certificate);
        continue;
      }
      out_.plan = std::move(plan);
      out_.certificate = std::move(certificate);
      out_.figure = workshop_.figure(candidate);
      best_ = candidate;
    }
    refused.erase(std::remove_if(refused.begin(), refused.end(), [this](const Candidate& c) { return !worth_it(c); }),
                  refused.end());
    return refused;
  }

  [[nodiscard]] const std::optional<Candidate>& best() const { return best_; }

 private:
  [[nodiscard]] bool worth_it(const Candidate& candidate) const {
    return !best_ || preferred(candidate, *best_, workshop_.requirements().want.objective);
  }

  const Workshop& workshop_;
  Design& out_;
  std::optional<Candidate> best_;
};

/// What keeps any motion from being one, whatever numbers are chosen: too few carriers, edges that do not turn.
std::vector<mechanics::Reason> obstructions(const Workshop& workshop) {
  const std::vector<Order> orders = workshop.orders();
  const Order order = orders.empty() ? order_of(workshop.requirements().given) : orders.front();
  const Plan plan = workshop.start(order, kPulls[1]).plan;
  std::vector<mechanics::Reason> out;
  mechanics::judge_equilibrium(plan, out);
  mechanics::judge_construction(plan, mechanics::slices(plan), out);
  return out;
}

/// With attachments that are given.
Design designed(const Requirements& requirements, std::uint64_t seed, const KeepGoing& keep_going) {
  Workshop workshop(requirements, seed, keep_going);
  Design out;
  out.certificate.reasons = obstructions(workshop);
  if (!out.certificate.reasons.empty()) return out;
  Desk desk(workshop, out);
  std::vector<Candidate> found = candidates(workshop, seed);
  const std::optional<Candidate> nearest = found.empty() ? std::nullopt : std::optional<Candidate>(found.front());
  for (const Care& care : kCares) {
    if (care.finer > 1) found = mended(workshop, std::move(found), care);
    found = desk.judge(found);
    if (found.empty() || (desk.best() && workshop.stopped())) break;
  }
  if (desk.best()) out.prices = prices(workshop, *desk.best());
  // What was not searched to its end says nothing of what is impossible.
  if (!out.plan && nearest && !nearest->meets() && !workshop.stopped()) out.conflict = conflict(workshop, *nearest);
  out.interrupted = workshop.stopped();
  return out;
}

/// The attachments whose families are best.
Requirements best_attached(const Requirements& requirements, std::uint64_t seed, const KeepGoing& keep_going) {
  std::vector<Requirements> all = attached(requirements);
  if (all.size() == 1) return std::move(all.front());
  std::size_t best = 0;
  std::optional<Candidate> found;
  for (std::size_t k = 0; k < all.size(); ++k) {
    Workshop workshop(all[k], seed, keep_going);
    const std::vector<Candidate> simple = families(workshop);
    if (simple.empty() || (found && !before(simple.front(), *found))) continue;
    best = k;
    found = simple.front();
    if (workshop.stopped()) break;
  }
  return std::move(all[best]);
}

}  // namespace

const char* name(Objective objective) {
  switch (objective) {
    case Objective::kLeastEverything:
      return "least everything";
    case Objective::kGreatestSpeed:
      return "greatest speed";
    case Objective::kLeastWinchWork:
      return "least winch work";
    case Objective::kGreatestClearance:
      return "greatest clearance";
  }
  return "";
}

const char* unit(Objective objective) {
  switch (objective) {
    case Objective::kLeastEverything:
      return "";
    case Objective::kGreatestSpeed:
      return "m/s";
    case Objective::kLeastWinchWork:
      return "W";
    case Objective::kGreatestClearance:
      return "m";
  }
  return "";
}

Design design(const Requirements& requirements, std::uint64_t seed, const KeepGoing& keep_going) {
  return designed(best_attached(requirements, seed, keep_going), seed, keep_going);
}

}  // namespace gyre::design
