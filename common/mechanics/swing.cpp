#include "common/mechanics/swing.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>

#include "common/base/angle.hpp"
#include "common/mechanics/reference.hpp"
#include "common/mechanics/stiffness.hpp"

namespace gyre::mechanics {
namespace {

/// Of the paces from rest to 1.
constexpr int kPaces = 25;
/// Of the fastest pendulum swing, in a step [rad]: to begin with.
constexpr double kFirstStepAngle = 1.6;
/// Of two answers, by steps and by their halves.
constexpr double kAgree = 0.05;
constexpr std::size_t kStepsPerTurn = 48;
constexpr std::size_t kMaxSteps = 8192;
/// Twice the softest swing's frequency in the motion's, from which on no resonance is looked for.
constexpr double kQuasiStatic = 28.0;

Matrix6d inertia_of(Load load, double factor) {
  load.inertia_b_kg_m2 *= factor;
  return load_inertia(load);
}

/// The load about its equilibrium, whatever the pace: moments are worked out once for every number of steps.
class LinearMotion {
 public:
  LinearMotion(const Plan& plan, const std::vector<CarrierSlice>& slices, double period_s)
      : plan_(plan), slices_(slices), period_s_(period_s) {}

  [[nodiscard]] double growth(const SwingCase& asked) {
    return floquet_growth(inertia_of(plan_.load, asked.inertia_factor), moments(asked.steps), period_s_, asked.pace);
  }

  /// Of the fastest swing that is a pendulum's, at its fastest [rad/s]: what cables hold by their elasticity is not to
  /// be followed, but to die out.
  [[nodiscard]] double pendulum_rad_s() const {
    Plan slack = plan_;
    slack.cable.stiffness_n_m = 0.0;
    const Matrix6d inertia = load_inertia(plan_.load);
    constexpr std::size_t kLooksPerTurn = 32;
    constexpr std::size_t kTurns = 16;  // laws whose harmonics hardly ever meet again are not followed to the end
    const std::size_t looks = kLooksPerTurn * std::min(turns(), kTurns);
    double greatest = 0.0;
    for (std::size_t i = 0; i < looks; ++i) {
      const double t_s = period_s_ * static_cast<double>(i) / static_cast<double>(looks);
      const Matrix6d k = load_stiffness(slack, slices_, t_s);
      const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix6d> solver(k, inertia, Eigen::EigenvaluesOnly);
      greatest = std::max(greatest, solver.eigenvalues()(5));
    }
    return std::sqrt(greatest);
  }

  [[nodiscard]] std::size_t turns() const {
    return static_cast<std::size_t>(std::max(1l, std::lround(period_s_ * plan_.cycle.rate_rad_s / kTwoPi)));
  }

 private:
  const std::vector<LinearMoment>& moments(std::size_t steps) {
    std::vector<LinearMoment>& known = moments_[steps];
    if (!known.empty()) return known;
    known.reserve(kRadauStages * steps);
    for (std::size_t k = 0; k < steps; ++k) {
      for (const double node : radau_nodes()) {
        const double t_s = period_s_ * (static_cast<double>(k) + node) / static_cast<double>(steps);
        known.push_back(linear_moment(plan_, slices_, t_s));
      }
    }
    return known;
  }

  const Plan& plan_;
  const std::vector<CarrierSlice>& slices_;
  double period_s_;
  std::map<std::size_t, std::vector<LinearMoment>> moments_;
};

/// What is asked of a motion, and how finely.
class SwingLook {
 public:
  SwingLook(const Plan& plan, const std::vector<CarrierSlice>& slices, double period_s, double stiffness_min_1_s2)
      : motion_(plan, slices, period_s), stiffness_min_1_s2_(stiffness_min_1_s2), rate_rad_s_(plan.cycle.rate_rad_s) {
    steps_ = std::max(static_cast<double>(kStepsPerTurn * motion_.turns()),
                      std::ceil(period_s * motion_.pendulum_rad_s() / kFirstStepAngle));
    // Halved until that makes no difference any more: it makes 32 times less each time.
    own_1_s_ = growth(1.0);
    bool enough = false;
    for (; !enough && 2.0 * steps_ <= kMaxSteps; steps_ *= enough ? 1.0 : 2.0) {
      const double finer = motion_.growth({1.0, 1.0, static_cast<std::size_t>(2.0 * steps_)});
      enough = std::abs(finer - own_1_s_) <= kNeutralGrowth_1_s + kAgree * std::abs(finer);
      own_1_s_ = finer;
    }
    if (!enough && as_a_rest(1.0)) own_1_s_ = at_rest();
  }

  [[nodiscard]] double own_1_s() const { return own_1_s_; }

  /// So slow that it is a sequence of rests.
  [[nodiscard]] bool slow(double pace) const {
    return stiffness_min_1_s2_ > 0.0 && 2.0 * std::sqrt(stiffness_min_1_s2_) > kQuasiStatic * pace * rate_rad_s_;
  }

  /// At rest, at most.
  [[nodiscard]] double at_rest() const { return std::sqrt(std::max(0.0, -stiffness_min_1_s2_)); }

  [[nodiscard]] double growth(double pace, double inertia_factor = 1.0) {
    // Doubled where the pace halves, so that few tables of moments serve all paces.
    const double needed = steps_ * std::exp2(std::ceil(std::log2(1.0 / pace) - 0.5));
    if (needed > kMaxSteps && as_a_rest(pace)) return at_rest();
    const auto steps = static_cast<std::size_t>(std::min<double>(needed, kMaxSteps));
    return motion_.growth({pace, inertia_factor, steps});
  }

 private:
  /// What a motion is taken for that takes more steps than there are. Of one that is fast and holds the load at all
  /// moments only the fastest swings are followed too coarsely, and damped.
  [[nodiscard]] bool as_a_rest(double pace) const { return slow(pace) || stiffness_min_1_s2_ <= 0.0; }

  LinearMotion motion_;
  double stiffness_min_1_s2_;
  double rate_rad_s_;
  double steps_ = 0.0;  ///< at full pace
  double own_1_s_ = 0.0;
};

}  // namespace

LinearMoment linear_moment(const Plan& plan, const std::vector<CarrierSlice>& slices, double t_s) {
  LinearMoment moment;
  for (const CarrierSlice& slice : slices) {
    const Reference reference = evaluate(slice, t_s);
    const Eigen::Vector3d r = slice.attachment_w_m - plan.load.position_w_m;
    add_stiffness(plan.cable, reference, r, moment.stiffness);
    const TaylorVector<double>& q = reference.direction_w;
    Eigen::Matrix<double, 6, 1> along;  // J' q
    along << q.value, r.cross(q.value);
    Eigen::Matrix<double, 6, 1> turning;  // J' q˙
    turning << q.first, r.cross(q.first);
    moment.damping += plan.cable.damping_n_s_m * along * along.transpose();
    moment.circulation += plan.cable.damping_n_s_m * along * turning.transpose();
  }
  return moment;
}

double Swings::growth_at(double pace) const {
  if (paces.empty()) return growth_1_s;
  const auto beyond =
      std::lower_bound(paces.begin(), paces.end(), pace, [](const PaceGrowth& p, double x) { return p.pace < x; });
  if (beyond == paces.end()) return paces.back().growth_1_s;
  if (beyond == paces.begin() || beyond->pace == pace) return beyond->growth_1_s;
  return std::max(beyond->growth_1_s, std::prev(beyond)->growth_1_s);
}

Swings swings(const Plan& plan, const std::vector<CarrierSlice>& slices, double period_s, double stiffness_min_1_s2) {
  SwingLook look(plan, slices, period_s, stiffness_min_1_s2);
  Swings out;
  out.growth_1_s = look.own_1_s();
  out.worst_1_s = out.growth_1_s;
  out.paces.push_back({0.0, look.at_rest()});
  if (!look.slow(1.0)) {
    for (const double pace : {1.0 - kSwingMargin, 1.0, 1.0 + kSwingMargin}) {
      for (const double factor : {1.0 - kSwingMargin, 1.0, 1.0 + kSwingMargin}) {
        out.worst_1_s = std::max(out.worst_1_s, look.growth(pace, factor));
      }
    }
    for (int i = 1; i < kPaces; ++i) {
      const double pace = static_cast<double>(i) / kPaces;
      if (!look.slow(pace)) out.paces.push_back({pace, look.growth(pace)});
    }
  }
  out.paces.push_back({1.0, out.growth_1_s});
  return out;
}

double swing_growth(const Plan& plan, const std::vector<CarrierSlice>& slices, double period_s,
                    const SwingCase& asked) {
  return LinearMotion(plan, slices, period_s).growth(asked);
}

}  // namespace gyre::mechanics
