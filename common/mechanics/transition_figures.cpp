#include "common/mechanics/transition_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/base/angle.hpp"
#include "common/mechanics/interval.hpp"

namespace gyre::mechanics {
namespace {

/// Cells narrower than this share of the window are taken as they are: wider than wished, never wrong.
constexpr double kNarrowest = 1e-5;

enum Figure : std::size_t {
  kTension,
  kLength,
  kWinchRate,
  kSpeed,
  kAcceleration,
  kAltitude,
  kVerticalCosine,
  kPaidOut,
  kPaidOutRate,
  kWinchAcceleration,
  kThrust,
  kBank,
  kFigures
};
using Enclosure = std::array<Interval, kFigures>;
using Point = std::array<double, kFigures>;

using IntervalVector = std::array<Interval, 3>;

Interval norm(const IntervalVector& v) {
  return boost::numeric::sqrt(boost::numeric::square(v[0]) + boost::numeric::square(v[1]) +
                              boost::numeric::square(v[2]));
}

/// The angle from the vertical: it grows with what is horizontal and falls with what is upright, so corners bound it.
Interval bank(const IntervalVector& pull) {
  const Interval side = boost::numeric::sqrt(boost::numeric::square(pull[0]) + boost::numeric::square(pull[1]));
  const Interval& up = pull[2];
  return {std::min(std::atan2(side.lower(), up.upper()), std::atan2(side.upper(), up.upper())),
          std::max(std::atan2(side.lower(), up.lower()), std::atan2(side.upper(), up.lower()))};
}

/// What is no number (an infinite length times no direction) is bounded by nothing.
Range range_of(const Interval& interval) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (std::isnan(interval.lower()) || std::isnan(interval.upper())) return {-kInfinity, kInfinity};
  return {interval.lower(), interval.upper()};
}

class Window {
 public:
  Window(const std::vector<TimedLayer>& layers, const std::optional<VehicleWeight>& vehicle)
      : layers_(layers), stiffness_n_m_(layers.front().slice->cable_stiffness_n_m), vehicle_(vehicle) {}

  /// A cell that no transition starts or ends in.
  void enclose(double begin_s, double end_s, double narrowest_s) {
    const double middle = 0.5 * (begin_s + end_s);
    const double h = 0.5 * (end_s - begin_s);
    const Reference at = evaluate_course(layers_.data(), layers_.size(), middle);
    const Point point = figures_at(at);
    for (std::size_t i = 0; i < kFigures; ++i) inner_[i].include(point[i]);

    const Enclosure enclosure = cell(begin_s, end_s, at, point, h);
    if (h > narrowest_s && !tight(enclosure)) {
      enclose(begin_s, middle, narrowest_s);
      enclose(middle, end_s, narrowest_s);
      return;
    }
    for (std::size_t i = 0; i < kFigures; ++i) outer_[i].include(range_of(enclosure[i]));
  }

  [[nodiscard]] const Range& range(Figure figure) const { return outer_[figure]; }

 private:
  /// The greatest magnitude a figure is compared with: a winch that stands still is judged by the speed it is part of,
  /// a level altitude by the length it is kept with, or no cell would ever be small enough.
  [[nodiscard]] double scale(std::size_t figure) const {
    const auto magnitude = [this](std::size_t i) { return std::max(std::abs(inner_[i].min), std::abs(inner_[i].max)); };
    if (figure == kWinchRate || figure == kPaidOutRate) return std::max(magnitude(figure), magnitude(kSpeed));
    if (figure == kWinchAcceleration) return std::max(magnitude(figure), magnitude(kAcceleration));
    if (figure == kBank) return 1.0;
    if (figure == kAltitude) return std::max(magnitude(kAltitude), magnitude(kLength));
    return magnitude(figure);
  }

  [[nodiscard]] static double slack_of(std::size_t figure) {
    if (figure == kWinchAcceleration) return kWinchAccelerationSlack;
    const bool accelerates = figure == kAcceleration || figure == kThrust || figure == kBank;
    return accelerates ? kAccelerationSlack : kTransitionSlack;
  }

  [[nodiscard]] bool tight(const Enclosure& enclosure) const {
    for (std::size_t i = 0; i < kFigures; ++i) {
      const double slack = slack_of(i) * scale(i);
      if (!(enclosure[i].lower() >= inner_[i].min - slack && enclosure[i].upper() <= inner_[i].max + slack))
        return false;
    }
    return true;
  }

  [[nodiscard]] Point figures_at(const Reference& r) const {
    const Taylor<double> winch = paid_out(r, stiffness_n_m_);
    const double mass_kg = vehicle_ ? vehicle_->mass_kg : 0.0;
    const double weight_n = vehicle_ ? mass_kg * vehicle_->gravity_m_s2 : 0.0;
    const Eigen::Vector3d at_rest = r.force_w_n.value + weight_n * Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d pull = at_rest + mass_kg * r.position_w_m.second;
    const auto bank_of = [](const Eigen::Vector3d& n) { return std::atan2(n.head<2>().norm(), n.z()); };
    return {r.tension_n.value,
            r.length_m.value,
            r.length_m.first,
            r.position_w_m.first.norm(),
            r.position_w_m.second.norm(),
            r.position_w_m.value.z(),
            r.direction_w.value.z(),
            winch.value,
            winch.first,
            std::abs(winch.second),
            vehicle_ ? std::max(at_rest.norm(), pull.norm()) : 0.0,
            vehicle_ ? std::max(bank_of(at_rest), bank_of(pull)) : 0.0};
  }

  [[nodiscard]] Enclosure cell(double begin_s, double end_s, const Reference& at, const Point& point, double h) const {
    std::array<Layer<Interval>, kMaxLayers> stack;
    for (std::size_t i = 0; i < layers_.size(); ++i) {
      const TimedLayer& layer = layers_[i];
      stack[i] = {layer.slice, Interval(begin_s - layer.epoch_s, end_s - layer.epoch_s), weight(layer, begin_s, end_s)};
    }
    const std::size_t bottom = complete_layer(layers_.data(), layers_.size(), begin_s);
    const BasicReference<Interval> r = evaluate_mixture(stack.data() + bottom, layers_.size() - bottom);

    // F(t) in F(middle) + F'(cell) [−h, h], which shrinks with h², intersected with the plain enclosure.
    const Interval step(-h, h);
    const auto mean_value = [&step](double value, const Interval& slope, const Interval& plain) {
      const Interval centred = value + slope * step;
      // Where a figure does not move, the two are points that differ by rounding and have nothing in common.
      return boost::numeric::overlap(centred, plain) ? boost::numeric::intersect(centred, plain)
                                                     : boost::numeric::hull(centred, plain);
    };
    IntervalVector v;
    IntervalVector a;
    IntervalVector at_rest;
    IntervalVector pull;
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      v[k] = mean_value(at.position_w_m.first[i], r.position_w_m.second[i], r.position_w_m.first[i]);
      a[k] = r.position_w_m.second[i];
      if (!vehicle_) continue;
      at_rest[k] = mean_value(at.force_w_n.value[i], r.force_w_n.first[i], r.force_w_n.value[i]);
      if (i == 2) at_rest[k] += vehicle_->mass_kg * vehicle_->gravity_m_s2;
      pull[k] = at_rest[k] + vehicle_->mass_kg * a[k];
    }
    const Taylor<Interval> winch = paid_out(r, stiffness_n_m_);
    return {mean_value(point[kTension], r.tension_n.first, r.tension_n.value),
            mean_value(point[kLength], r.length_m.first, r.length_m.value),
            mean_value(point[kWinchRate], r.length_m.second, r.length_m.first),
            norm(v),
            norm(a),
            mean_value(point[kAltitude], r.position_w_m.first[2], r.position_w_m.value[2]),
            mean_value(point[kVerticalCosine], r.direction_w.first[2], r.direction_w.value[2]),
            mean_value(point[kPaidOut], winch.first, winch.value),
            mean_value(point[kPaidOutRate], winch.second, winch.first),
            boost::numeric::abs(winch.second),
            boost::numeric::max(norm(at_rest), norm(pull)),
            vehicle_ ? boost::numeric::max(bank(at_rest), bank(pull)) : Interval(0.0)};
  }

  static Taylor<Interval> weight(const TimedLayer& layer, double begin_s, double end_s) {
    const double from = begin_s - layer.start_s;
    const double to = end_s - layer.start_s;
    if (to <= 0.0) return constant(Interval(0.0));
    if (from >= layer.duration_s) return constant(Interval(1.0));
    const double pace = 1.0 / layer.duration_s;
    const Interval progress(std::max(0.0, from * pace), std::min(1.0, to * pace));
    return smooth_step(Taylor<Interval>{progress, Interval(pace), Interval(0.0)});
  }

  const std::vector<TimedLayer>& layers_;
  double stiffness_n_m_;  // of the bottom plan's slice, as agents go by
  std::optional<VehicleWeight> vehicle_;
  std::array<Range, kFigures> inner_;  // what midpoints attain
  std::array<Range, kFigures> outer_;  // what is proven
};

}  // namespace

CarrierFigures transition_figures(const std::vector<TimedLayer>& layers, double begin_s, double end_s,
                                  const std::optional<VehicleWeight>& vehicle) {
  GYRE_ENSURE(!layers.empty() && layers.size() <= kMaxLayers && end_s > begin_s, "a window over a course");
  std::vector<double> cuts{begin_s, end_s};
  for (std::size_t i = 1; i < layers.size(); ++i) {
    for (const double t : {layers[i].start_s, layers[i].start_s + layers[i].duration_s}) {
      if (t > begin_s && t < end_s) cuts.push_back(t);
    }
  }
  std::sort(cuts.begin(), cuts.end());

  Window window(layers, vehicle);
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    constexpr int kCells = 16;
    const double width = (cuts[i + 1] - cuts[i]) / kCells;
    for (int k = 0; k < kCells && width > 0.0; ++k) {
      window.enclose(cuts[i] + width * k, cuts[i] + width * (k + 1), kNarrowest * (end_s - begin_s));
    }
  }
  CarrierFigures figures;
  figures.id = layers.front().slice->id;
  figures.tension_n = window.range(kTension);
  figures.length_m = window.range(kLength);
  figures.winch_rate_m_s = window.range(kWinchRate);
  figures.speed_m_s = window.range(kSpeed);
  figures.acceleration_max_m_s2 = window.range(kAcceleration).max;
  figures.altitude_m = window.range(kAltitude);
  figures.vertical_cosine = window.range(kVerticalCosine);
  figures.paid_out_m = window.range(kPaidOut);
  figures.paid_out_rate_m_s = window.range(kPaidOutRate);
  figures.winch_acceleration_max_m_s2 = window.range(kWinchAcceleration).max;
  if (vehicle) {
    figures.thrust_max_n = window.range(kThrust).max;
    figures.bank_max_rad = std::min(window.range(kBank).max, kPi);
  }
  return figures;
}

}  // namespace gyre::mechanics
