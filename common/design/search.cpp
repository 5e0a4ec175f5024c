#include "common/design/search.hpp"

#include <nlopt.h>

#include <algorithm>
#include <memory>

#include "common/design/judge.hpp"

namespace gyre::design {
namespace {

using Vector = Eigen::VectorXd;

constexpr int kRounds = 12;
// Of one round. A step costs rows times variables squared, so that what has many variables gets fewer of both.
constexpr int kSteps = 60, kFewestSteps = 15, kStepsOfAll = 3000;
constexpr double kNear = 0.3;  // rows with more than this to spare are left out
constexpr int kRows = 1000, kFewestRows = 300, kRowsOfAll = 50000;
constexpr double kFirstReach = 0.5;  // how far a round may go, as a share of each variable, or of 1 where it is less
constexpr double kMostReach = 2.0;
constexpr double kLeastReach = 5e-3;
constexpr double kShorter = 0.3;  // after a round that brought nothing: rows that were left out stood in its way
constexpr double kEnough = 1e-4;  // of the cost, relative: not worth another round

enum class Goal { kMeet, kImprove, kRaise };

/// S0, in which limits are raised: a size that makes steps of t like those of other variables.
double raised_by(const Search& search) {
  return search.demands[search.raised.front()].scale;
}

bool is_raised(const Search& search, std::size_t demand) {
  return std::find(search.raised.begin(), search.raised.end(), demand) != search.raised.end();
}

/// One round: the rows that are looked at, and what NLopt is told of them.
class Round {
 public:
  Round(const Search& search, Goal goal, SampledMotion& motion, const Judge& judge, std::vector<Judged> rows)
      : search_(search), goal_(goal), motion_(motion), judge_(judge), rows_(std::move(rows)) {
    const int most = shared(kRowsOfAll, kFewestRows, kRows);
    if (rows_.size() > static_cast<std::size_t>(most)) {
      std::nth_element(rows_.begin(), rows_.begin() + most, rows_.end(),
                       [](const Judged& a, const Judged& b) { return a.residual > b.residual; });
      rows_.resize(static_cast<std::size_t>(most));
    }
  }

  /// (x, t) after the round, from (x, t).
  Vector run(const Vector& start, double least_t, double most_t, double reach) {
    const auto n = static_cast<unsigned>(start.size());
    const std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> opt(nlopt_create(NLOPT_LD_SLSQP, n), nlopt_destroy);
    opt_ = opt.get();
    Vector lower(n);
    Vector upper(n);
    const Eigen::Index own = search_.unknowns.start.size();
    const Vector far = reach * start.head(own).cwiseAbs().cwiseMax(1.0);
    lower.head(own) = search_.unknowns.lower.cwiseMax(start.head(own) - far);
    upper.head(own) = search_.unknowns.upper.cwiseMin(start.head(own) + far);
    if (goal_ != Goal::kImprove) {
      lower[own] = least_t;
      upper[own] = most_t;
    }
    nlopt_set_lower_bounds(opt_, lower.data());
    nlopt_set_upper_bounds(opt_, upper.data());
    nlopt_set_min_objective(opt_, &Round::cost, this);
    const std::vector<double> tolerances(rows_.size(), 0.1 * search_.margin);
    nlopt_add_inequality_mconstraint(opt_, static_cast<unsigned>(rows_.size()), &Round::constraints, this,
                                     tolerances.data());
    nlopt_set_maxeval(opt_, shared(kStepsOfAll, kFewestSteps, kSteps));
    // Only by x: a search along a line that has to turn back at first changes the cost by nothing, and is not at its
    // end.
    nlopt_set_xtol_rel(opt_, 1e-12);
    Vector x = start.cwiseMax(lower).cwiseMin(upper);
    double least = 0.0;
    (void)nlopt_optimize(opt_, x.data(), &least);  // whatever it says, x is judged by who asked
    opt_ = nullptr;
    return x;
  }

 private:
  /// So much for all variables together, within bounds.
  [[nodiscard]] int shared(int all, int fewest, int most) const {
    return std::clamp(all / std::max(1, static_cast<int>(search_.unknowns.start.size())), fewest, most);
  }

  static double cost(unsigned n, const double* x, double* gradient, void* round) {
    auto& self = *static_cast<Round*>(round);
    const Eigen::Map<const Vector> at(x, n);
    if (self.search_.keep_going && !self.search_.keep_going()) nlopt_force_stop(self.opt_);
    Vector slope = Vector::Zero(n);
    double value = 0.0;
    if (self.goal_ == Goal::kImprove) {
      self.evaluate(at);
      value = effort(self.search_.objective, self.motion_, self.search_.scales, self.search_.gravity_m_s2, slope);
    } else {
      const double sign = self.goal_ == Goal::kMeet ? 1.0 : -1.0;
      value = sign * at[n - 1];
      slope[n - 1] = sign;
    }
    if (gradient != nullptr) Eigen::Map<Vector>(gradient, n) = slope;
    return value;
  }

  static void constraints(unsigned m, double* result, unsigned n, const double* x, double* gradient, void* round) {
    auto& self = *static_cast<Round*>(round);
    const Eigen::Map<const Vector> at(x, n);
    self.evaluate(at);
    const Eigen::Index own = self.search_.unknowns.start.size();
    Vector slope(own);
    for (unsigned k = 0; k < m; ++k) {
      const Row& row = self.rows_[k].row;
      result[k] = self.judge_.residual(row, at.head(own), slope);
      double by_t = 0.0;
      if (self.goal_ == Goal::kMeet) {
        by_t = -1.0;
        result[k] -= at[own];
      } else if (self.goal_ == Goal::kRaise && is_raised(self.search_, row.demand)) {
        // r = (L + t S0 − F) / S; no margin: the limit is what is looked for.
        by_t = raised_by(self.search_) / self.search_.demands[row.demand].scale;
        result[k] += by_t * at[own];
      } else {
        result[k] += self.search_.margin;
      }
      if (gradient == nullptr) continue;
      Eigen::Map<Vector> out(gradient + static_cast<std::size_t>(k) * n, n);
      out.head(own) = slope;
      if (n > static_cast<unsigned>(own)) out[own] = by_t;
    }
  }

  void evaluate(const Eigen::Map<const Vector>& at) {
    const Vector x = at.head(search_.unknowns.start.size());
    if (evaluated_.size() == x.size() && evaluated_ == x) return;
    motion_.evaluate(x);
    evaluated_ = x;
  }

  const Search& search_;
  Goal goal_;
  SampledMotion& motion_;
  const Judge& judge_;
  std::vector<Judged> rows_;
  Vector evaluated_;
  nlopt_opt opt_ = nullptr;
};

/// A motion, its judge, and what a point is worth.
class Bench {
 public:
  explicit Bench(const Search& search)
      : search_(search),
        motion_(*search.plan, search.unknowns, search.samples),
        judge_(*search.plan, search.unknowns, search.demands, motion_) {}

  Point look(const Vector& x) {
    Point out;
    out.x = x;
    motion_.evaluate(x);
    judge_.choose_sides();
    const Judge::Findings findings = judge_.find(x, std::numeric_limits<double>::infinity());
    out.worst = findings.worst;
    if (!search_.raised.empty()) {
      out.cost = -(search_.demands[search_.raised.front()].limit + raise(x));
    } else {
      Vector slope(x.size());
      out.cost = effort(search_.objective, motion_, search_.scales, search_.gravity_m_s2, slope);
    }
    return out;
  }

  Vector round(Goal goal, const Vector& x, double least_residual, double reach) {
    motion_.evaluate(x);
    judge_.choose_sides();
    Judge::Findings findings = judge_.find(x, least_residual);
    Vector start = x;
    double least_t = 0.0;
    double most_t = 0.0;
    if (goal != Goal::kImprove) {
      start.conservativeResize(x.size() + 1);
      if (goal == Goal::kMeet) {
        start[x.size()] = findings.worst;
        least_t = -4.0 * search_.margin - 0.01;
        most_t = std::max(1.0, 2.0 * findings.worst);
      } else {
        const double by = raise(x);
        start[x.size()] = by / raised_by(search_);
        most_t = 1e3 * std::max(1.0, start[x.size()]);
        add_raised(x, by, findings.rows);
      }
    }
    Round round(search_, goal, motion_, judge_, std::move(findings.rows));
    return round.run(start, least_t, most_t, reach).head(x.size());
  }

 private:
  /// By how much the raised demands' limits could be higher and still be met.
  double raise(const Vector& x) {
    double least = std::numeric_limits<double>::infinity();
    for (const Judged& judged : judge_.find(x, -std::numeric_limits<double>::infinity()).rows) {
      if (is_raised(search_, judged.row.demand)) least = std::min(least, room(judged));
    }
    return least;
  }

  /// Their rows that are near to what they can be raised by, and not among those near the limit.
  void add_raised(const Vector& x, double by, std::vector<Judged>& rows) {
    rows.erase(std::remove_if(rows.begin(), rows.end(),
                              [&](const Judged& judged) { return is_raised(search_, judged.row.demand); }),
               rows.end());
    for (const Judged& judged : judge_.find(x, -std::numeric_limits<double>::infinity()).rows) {
      if (!is_raised(search_, judged.row.demand)) continue;
      const double scale = search_.demands[judged.row.demand].scale;
      const double over = (by - room(judged)) / scale;
      if (over > -kNear * std::max(1.0, std::abs(by) / scale)) rows.push_back({judged.row, over});
    }
  }

  /// Of a raised demand's row: what its limit could be higher by.
  [[nodiscard]] double room(const Judged& judged) const {
    return -judged.residual * search_.demands[judged.row.demand].scale;
  }

  const Search& search_;
  SampledMotion motion_;
  Judge judge_;
};

bool met(const Search& search, const Point& point) {
  return point.worst <= -0.5 * search.margin;
}

bool going(const Search& search) {
  return !search.keep_going || search.keep_going();
}

}  // namespace

Point meet(const Search& search, const Vector& x, int rounds) {
  Bench bench(search);
  Point best = bench.look(x.cwiseMax(search.unknowns.lower).cwiseMin(search.unknowns.upper));
  double reach = kMostReach;
  for (int round = 0; round < rounds && reach > kLeastReach && !met(search, best) && going(search); ++round) {
    const double least = best.worst - 0.5 - 0.5 * std::abs(best.worst);
    const Point next = bench.look(bench.round(Goal::kMeet, best.x, std::isfinite(least) ? least : -kNear, reach));
    if (!(next.worst < best.worst - 1e-3 * std::max(1.0, std::abs(best.worst)))) reach *= kShorter;
    if (next.worst < best.worst) best = next;
  }
  return best;
}

Point improve(const Search& search, const Point& from) {
  Bench bench(search);
  const Goal goal = search.raised.empty() ? Goal::kImprove : Goal::kRaise;
  Point best = from;
  double reach = kFirstReach;
  for (int round = 0; round < kRounds && reach > kLeastReach && going(search); ++round) {
    Point next = bench.look(bench.round(goal, best.x, -kNear, reach));
    if (!met(search, next)) next = meet(search, next.x, 1);  // rows that were left out are near now
    const double gain = met(search, next) ? best.cost - next.cost : 0.0;
    if (gain > 0.0) best = next;
    if (gain > kEnough * std::abs(best.cost)) {
      reach = std::min(kMostReach, 2.0 * reach);
    } else if (gain > 0.0) {
      break;
    } else {
      reach *= kShorter;
    }
  }
  return best;
}

}  // namespace gyre::design
