#include "common/mechanics/transition_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>

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
  kFigures
};
using Enclosure = std::array<Interval, kFigures>;
using Point = std::array<double, kFigures>;

Point figures_at(const Reference& r) {
  return {r.tension_n.value,
          r.length_m.value,
          r.length_m.first,
          r.position_w_m.first.norm(),
          r.position_w_m.second.norm(),
          r.position_w_m.value.z(),
          r.direction_w.value.z()};
}

Interval norm(const std::array<Interval, 3>& v) {
  return boost::numeric::sqrt(boost::numeric::square(v[0]) + boost::numeric::square(v[1]) +
                              boost::numeric::square(v[2]));
}

/// What is no number (an infinite length times no direction) is bounded by nothing.
Range range_of(const Interval& interval) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (std::isnan(interval.lower()) || std::isnan(interval.upper())) return {-kInfinity, kInfinity};
  return {interval.lower(), interval.upper()};
}

class Window {
 public:
  explicit Window(const std::vector<TimedLayer>& layers) : layers_(layers) {}

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
    if (figure == kWinchRate) return std::max(magnitude(kWinchRate), magnitude(kSpeed));
    if (figure == kAltitude) return std::max(magnitude(kAltitude), magnitude(kLength));
    return magnitude(figure);
  }

  [[nodiscard]] bool tight(const Enclosure& enclosure) const {
    for (std::size_t i = 0; i < kFigures; ++i) {
      const double slack = (i == kAcceleration ? kAccelerationSlack : kTransitionSlack) * scale(i);
      if (!(enclosure[i].lower() >= inner_[i].min - slack && enclosure[i].upper() <= inner_[i].max + slack))
        return false;
    }
    return true;
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
    std::array<Interval, 3> v;
    std::array<Interval, 3> a;
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      v[k] = mean_value(at.position_w_m.first[i], r.position_w_m.second[i], r.position_w_m.first[i]);
      a[k] = r.position_w_m.second[i];
    }
    return {mean_value(point[kTension], r.tension_n.first, r.tension_n.value),
            mean_value(point[kLength], r.length_m.first, r.length_m.value),
            mean_value(point[kWinchRate], r.length_m.second, r.length_m.first),
            norm(v),
            norm(a),
            mean_value(point[kAltitude], r.position_w_m.first[2], r.position_w_m.value[2]),
            mean_value(point[kVerticalCosine], r.direction_w.first[2], r.direction_w.value[2])};
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
  std::array<Range, kFigures> inner_;  // what midpoints attain
  std::array<Range, kFigures> outer_;  // what is proven
};

}  // namespace

CarrierFigures transition_figures(const std::vector<TimedLayer>& layers, double begin_s, double end_s) {
  GYRE_ENSURE(!layers.empty() && layers.size() <= kMaxLayers && end_s > begin_s, "a window over a course");
  std::vector<double> cuts{begin_s, end_s};
  for (std::size_t i = 1; i < layers.size(); ++i) {
    for (const double t : {layers[i].start_s, layers[i].start_s + layers[i].duration_s}) {
      if (t > begin_s && t < end_s) cuts.push_back(t);
    }
  }
  std::sort(cuts.begin(), cuts.end());

  Window window(layers);
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
  return figures;
}

}  // namespace gyre::mechanics
