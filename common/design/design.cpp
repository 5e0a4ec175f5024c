#include "common/design/design.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/random_stream.hpp"
#include "common/design/closed_form.hpp"
#include "common/design/search.hpp"

namespace gyre::design {
namespace {

using mechanics::Plan;

constexpr double kPulls[] = {0.0, 0.65, 1.3, 2.2, 3.5};
constexpr std::size_t kFamilies = 4;  // that are improved
constexpr std::size_t kWholes = 2;    // families that are searched whole
constexpr int kShaken = 3;            // times that the best is shaken and searched again
constexpr double kShake = 0.15;       // of a variable
constexpr double kWorthIt = 5e-3;     // by how much the whole has to be better than its family
constexpr double kMargins[] = {2e-3, 8e-3, 3e-2};

struct Candidate {
  Start start;
  Unknowns unknowns;
  Point point;
  bool family = true;
};

class Designer {
 public:
  Designer(const Requirements& requirements, std::uint64_t seed, const KeepGoing& keep_going)
      : requirements_(requirements),
        seed_(seed),
        keep_going_(keep_going),
        scales_(scales_of(requirements)),
        bounds_(bounds_of(requirements, scales_)),
        demands_(demands_of(requirements.given, requirements.want, scales_)) {}

  Design run() {
    Design out;
    for (const double margin : kMargins) {
      margin_ = margin;
      std::vector<Candidate> found = margin == kMargins[0] ? candidates() : again(refused_);
      refused_.clear();
      for (const Candidate& candidate : found) {
        if (candidate.point.worst > 0.0) continue;
        Plan plan = plan_at(candidate.start.plan, candidate.unknowns, candidate.point.x);
        mechanics::Certificate certificate = mechanics::certify(plan);
        const bool good = certificate.admissible();
        if (good || out.certificate.carriers.empty()) out.certificate = std::move(certificate);
        if (!good) {
          refused_.push_back(candidate);
          continue;
        }
        out.plan = std::move(plan);
        out.figure = figure_of(candidate);
        out.interrupted = stopped_;
        return out;
      }
      if (refused_.empty() || stopped_) break;
    }
    out.interrupted = stopped_;
    return out;
  }

 private:
  bool going(const std::string& doing) {
    if (!stopped_) stopped_ = !keep_going_({doing, best_});
    return !stopped_;
  }

  Search search_of(const Candidate& candidate, const std::string& doing, int samples) {
    Search search;
    search.plan = &candidate.start.plan;
    search.unknowns = candidate.unknowns;
    search.demands = demands_;
    search.objective = requirements_.want.objective;
    for (std::size_t d = 0; d < demands_.size(); ++d) {
      const bool speed =
          demands_[d].kind == Kind::kCarrier && demands_[d].figure == Figure::kSpeed && demands_[d].least;
      const bool clearance = demands_[d].kind == Kind::kClearance;
      if ((speed && search.objective == Objective::kGreatestSpeed) ||
          (clearance && search.objective == Objective::kGreatestClearance))
        search.raised = d;
    }
    search.scales = scales_;
    search.gravity_m_s2 = requirements_.given.gravity_m_s2;
    search.samples = samples;
    search.margin = margin_;
    search.keep_going = [this, doing] { return going(doing); };
    return search;
  }

  /// Many carriers say together what few say with many samples.
  [[nodiscard]] int samples() const {
    return std::clamp(768 / static_cast<int>(requirements_.given.carriers.size()), 16, 64);
  }

  void note(const Point& point) {
    if (point.worst > 0.0) return;
    const double figure = shown(point.cost);
    if (!best_ || better(figure, *best_)) best_ = figure;
  }
  [[nodiscard]] bool raises() const {
    return requirements_.want.objective == Objective::kGreatestSpeed ||
           requirements_.want.objective == Objective::kGreatestClearance;
  }
  [[nodiscard]] bool better(double a, double b) const { return raises() ? a > b : a < b; }
  [[nodiscard]] double shown(double cost) const {
    if (raises()) return -cost;
    if (requirements_.want.objective == Objective::kLeastWinchWork)
      return std::sqrt(cost) * scales_.force_n * scales_.speed_m_s;
    return cost;
  }
  [[nodiscard]] double figure_of(const Candidate& candidate) const { return shown(candidate.point.cost); }

  /// Those that meet all demands before those that do not, and of either the better ones.
  static bool before(const Candidate& a, const Candidate& b) {
    const bool a_meets = a.point.worst <= 0.0;
    const bool b_meets = b.point.worst <= 0.0;
    if (a_meets != b_meets) return a_meets;
    return a_meets ? a.point.cost < b.point.cost : a.point.worst < b.point.worst;
  }

  void settle(Candidate& candidate, const std::string& doing, int samples_of_turn) {
    const Search search = search_of(candidate, doing, samples_of_turn);
    candidate.point = meet(search, candidate.point.x);
    if (candidate.point.worst <= -0.5 * margin_) candidate.point = improve(search, candidate.point);
    note(candidate.point);
  }

  std::vector<Candidate> families() {
    std::vector<Candidate> out;
    for (const Order& order : orders_of(requirements_, seed_)) {
      for (const double pull : kPulls) {
        if (!going("orders of the cycle")) break;
        Candidate candidate;
        candidate.start = start_of(requirements_, order, scales_, bounds_, pull);
        candidate.unknowns = family_of(candidate.start.plan, candidate.start.open, bounds_);
        candidate.point = meet(search_of(candidate, "orders of the cycle", 16), candidate.unknowns.start, 2);
        out.push_back(std::move(candidate));
      }
    }
    std::stable_sort(out.begin(), out.end(), before);
    if (out.size() > kFamilies) out.resize(kFamilies);
    for (Candidate& candidate : out) settle(candidate, "families", samples());
    std::stable_sort(out.begin(), out.end(), before);
    return out;
  }

  Candidate whole(const Candidate& family, double shake, RandomStream& stream) {
    Candidate out;
    out.family = false;
    out.start = {plan_at(family.start.plan, family.unknowns, family.point.x), family.start.open};
    out.unknowns = whole_of(out.start.plan, out.start.open, bounds_);
    out.point.x = out.unknowns.start;
    if (shake > 0.0)
      for (double& x : out.point.x) x += shake * stream.normal();
    settle(out, shake > 0.0 ? "all that is open, shaken" : "all that is open", samples());
    return out;
  }

  std::vector<Candidate> candidates() {
    const std::vector<Candidate> simple = families();
    std::vector<Candidate> out = simple;
    RandomStream stream(seed_, "shaken");
    for (std::size_t k = 0; k < std::min(kWholes, simple.size()) && going("all that is open"); ++k)
      out.push_back(whole(simple[k], 0.0, stream));
    for (int k = 0; k < kShaken && !simple.empty() && going("all that is open"); ++k)
      out.push_back(whole(simple[static_cast<std::size_t>(k) % simple.size()], kShake, stream));
    std::stable_sort(out.begin(), out.end(), before);
    const auto simplest = std::find_if(out.begin(), out.end(), [](const Candidate& c) { return c.family; });
    if (simplest != out.end() && simplest->point.worst <= 0.0 &&
        simplest->point.cost <= out.front().point.cost + kWorthIt * std::abs(out.front().point.cost))
      std::rotate(out.begin(), simplest, simplest + 1);
    return out;
  }

  /// Those that the certificate refused, with a wider margin.
  std::vector<Candidate> again(std::vector<Candidate> refused) {
    for (Candidate& candidate : refused) settle(candidate, "wider margins", 2 * samples());
    std::stable_sort(refused.begin(), refused.end(), before);
    return refused;
  }

  const Requirements& requirements_;
  std::uint64_t seed_;
  const KeepGoing& keep_going_;
  Scales scales_;
  Bounds bounds_;
  std::vector<Demand> demands_;
  double margin_ = kMargins[0];
  std::vector<Candidate> refused_;
  std::optional<double> best_;
  bool stopped_ = false;
};

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
  return Designer(requirements, seed, keep_going).run();
}

}  // namespace gyre::design
