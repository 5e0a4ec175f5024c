#include "common/design/unknowns.hpp"

#include <algorithm>
#include <cmath>

namespace gyre::design {
namespace {

using mechanics::Edge;
using mechanics::LengthLaw;
using mechanics::Plan;

constexpr double kRateSpan = 30.0;  // a variable may change what it stands for by this factor, if nothing else is said
constexpr double kSmallest = 1e-9;  // of what a variable is a factor of

class Builder {
 public:
  explicit Builder(Unknowns& unknowns) : unknowns_(unknowns) {}
  ~Builder() {
    const auto vector = [](const std::vector<double>& v) {
      return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(v.data(), static_cast<Eigen::Index>(v.size())));
    };
    unknowns_.start = vector(start_);
    unknowns_.lower = vector(lower_);
    unknowns_.upper = vector(upper_);
    unknowns_.start = unknowns_.start.cwiseMax(unknowns_.lower).cwiseMin(unknowns_.upper);
  }
  Builder(const Builder&) = delete;
  Builder& operator=(const Builder&) = delete;

  int add(double start, double lower, double upper) {
    start_.push_back(start);
    lower_.push_back(lower);
    upper_.push_back(std::max(lower, upper));
    return static_cast<int>(start_.size()) - 1;
  }

  void bound(int index, double lower, double upper) {
    lower_[static_cast<std::size_t>(index)] = lower;
    upper_[static_cast<std::size_t>(index)] = std::max(lower, upper);
  }

  /// A number by itself, counted in `scale`.
  Slot alone(bool open, double value, double scale, double lower, double upper) {
    if (!open) return {-1, 0.0, value};
    return {add(value / scale, lower / scale, upper / scale), scale, 0.0};
  }

 private:
  Unknowns& unknowns_;
  std::vector<double> start_, lower_, upper_;
};

/// Where the law's profile is zero length: an altitude below which a level carrier cannot be, 0 for a length.
double ground_of(const LengthLaw& law, const Eigen::Vector3d& attachment_w_m) {
  return law.is_projection() ? law.direction.dot(attachment_w_m) : 0.0;
}

Slot rate_slot(Builder& builder, const Plan& plan, bool open, const Bounds& bounds) {
  const double rate = plan.cycle.rate_rad_s;
  return builder.alone(open, rate, rate, std::max(bounds.rate_min_rad_s, rate / kRateSpan),
                       std::min(bounds.rate_max_rad_s, rate * kRateSpan));
}

/// Of a profile along u, or of a length: from where to where its mean may be.
Slot mean_slot(Builder& builder, const LengthLaw& law, double ground, bool open, const Bounds& bounds) {
  const bool level = law.kind == LengthLaw::Kind::kLevel;
  const double lower = level ? std::max(bounds.altitude_min_m, ground) : ground;
  const double upper = level ? bounds.altitude_max_m : ground + bounds.length_max_m;
  if (!open) return {-1, 0.0, law.profile.mean};
  const double scale = std::max(law.profile.mean - ground, kSmallest);
  return {builder.add((law.profile.mean - ground) / scale, (lower - ground) / scale, (upper - ground) / scale), scale,
          ground};
}

}  // namespace

Unknowns family_of(const Plan& plan, const Open& open, const Bounds& bounds) {
  Unknowns out;
  Builder builder(out);
  out.rate_rad_s = rate_slot(builder, plan, open.rate, bounds);

  double strongest = kSmallest;
  double most_offset = kSmallest;
  for (const Edge& edge : plan.cycle.edges) {
    strongest = std::max(strongest, std::abs(edge.amplitude_n));
    most_offset = std::max(most_offset, std::abs(edge.offset_n));
  }
  const int amplitudes = builder.add(1.0, 0.0, bounds.force_n / strongest);
  const int offsets = builder.add(1.0, -bounds.force_n / most_offset, bounds.force_n / most_offset);
  for (std::size_t j = 0; j < plan.cycle.edges.size(); ++j) {
    const Edge& edge = plan.cycle.edges[j];
    const double sine = edge.amplitude_n * std::cos(edge.phase_rad);
    const double cosine = edge.amplitude_n * std::sin(edge.phase_rad);
    const bool free = open.edges[j].amplitude;
    const auto slot = [](bool is_open, int index, double value) {
      return is_open ? Slot{index, value, 0.0} : Slot{-1, 0.0, value};
    };
    out.edges.push_back({slot(open.edges[j].offset, offsets, edge.offset_n), slot(free, amplitudes, sine),
                         slot(free, amplitudes, cosine)});
  }

  const std::vector<Eigen::Vector3d> arms = lever_arms(plan);
  int heights = -1;
  double lower = kSmallest;
  double upper = kRateSpan;
  for (std::size_t i = 0; i < plan.carriers.size(); ++i) {
    const LengthLaw& law = plan.carriers[i].law;
    const double ground = ground_of(law, plan.load.position_w_m + arms[i]);
    const double above = law.profile.mean - ground;
    LawSlots slots{{-1, 0.0, law.profile.mean}, {-1, 0.0, law.profile.swing}, {-1, 0.0, law.profile.phase_rad}};
    if (open.laws[i].mean && above > kSmallest) {
      if (heights < 0) heights = builder.add(1.0, lower, upper);
      slots.mean_m = {heights, above, ground};
      const bool level = law.kind == LengthLaw::Kind::kLevel;
      if (level) lower = std::max(lower, (bounds.altitude_min_m - ground) / above);
      upper = std::min(upper, (level ? bounds.altitude_max_m - ground : bounds.length_max_m) / above);
    }
    if (open.laws[i].swing) {
      slots.swing_m = {builder.add(1.0, -kRateSpan, kRateSpan), law.profile.swing, 0.0};
    }
    out.laws.push_back(slots);
  }
  if (heights >= 0) builder.bound(heights, lower, upper);
  return out;
}

Unknowns whole_of(const Plan& plan, const Open& open, const Bounds& bounds) {
  Unknowns out;
  Builder builder(out);
  out.rate_rad_s = rate_slot(builder, plan, open.rate, bounds);

  double scale = kSmallest;
  for (const Edge& edge : plan.cycle.edges)
    scale = std::max({scale, std::abs(edge.amplitude_n), std::abs(edge.offset_n)});
  for (std::size_t j = 0; j < plan.cycle.edges.size(); ++j) {
    const Edge& edge = plan.cycle.edges[j];
    const OpenEdge& free = open.edges[j];
    const double cosine = std::cos(edge.phase_rad);
    const double sine = std::sin(edge.phase_rad);
    const double most = bounds.force_n;
    EdgeSlots slots;
    slots.offset_n = builder.alone(free.offset, edge.offset_n, scale, -most, most);
    if (free.amplitude && !free.phase) {  // on a line through 0
      const int index = builder.add(edge.amplitude_n / scale, 0.0, most / scale);
      slots.sine_n = {index, scale * cosine, 0.0};
      slots.cosine_n = {index, scale * sine, 0.0};
    } else {  // anywhere, or on a circle, which is a demand (demands.hpp)
      slots.sine_n = builder.alone(free.phase, edge.amplitude_n * cosine, scale, -most, most);
      slots.cosine_n = builder.alone(free.phase, edge.amplitude_n * sine, scale, -most, most);
    }
    out.edges.push_back(slots);
  }

  const std::vector<Eigen::Vector3d> arms = lever_arms(plan);
  for (std::size_t i = 0; i < plan.carriers.size(); ++i) {
    const LengthLaw& law = plan.carriers[i].law;
    const double ground = ground_of(law, plan.load.position_w_m + arms[i]);
    const double swing = std::max(std::abs(law.profile.swing), kSmallest);
    out.laws.push_back(
        {mean_slot(builder, law, ground, open.laws[i].mean, bounds),
         builder.alone(open.laws[i].swing, law.profile.swing, swing, -bounds.length_max_m, bounds.length_max_m),
         builder.alone(open.laws[i].phase, law.profile.phase_rad, 1.0, -10.0, 10.0)});
  }
  return out;
}

Plan plan_at(const Plan& plan, const Unknowns& unknowns, const Eigen::VectorXd& x) {
  Plan out = plan;
  out.cycle.rate_rad_s = unknowns.rate_rad_s.at(x);
  for (std::size_t j = 0; j < out.cycle.edges.size(); ++j) {
    Edge& edge = out.cycle.edges[j];
    const EdgeSlots& slots = unknowns.edges[j];
    const double sine = slots.sine_n.at(x);
    const double cosine = slots.cosine_n.at(x);
    edge.offset_n = slots.offset_n.at(x);
    edge.amplitude_n = std::hypot(sine, cosine);
    // Where both shares are the same variable's, or given, the phase stays what it is, to the bit.
    if (slots.sine_n.index != slots.cosine_n.index) edge.phase_rad = std::atan2(cosine, sine);
  }
  for (std::size_t i = 0; i < out.carriers.size(); ++i) {
    mechanics::Oscillation& profile = out.carriers[i].law.profile;
    profile.mean = unknowns.laws[i].mean_m.at(x);
    profile.swing = unknowns.laws[i].swing_m.at(x);
    profile.phase_rad = unknowns.laws[i].phase_rad.at(x);
  }
  return out;
}

}  // namespace gyre::design
