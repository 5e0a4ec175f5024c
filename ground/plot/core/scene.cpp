#include "ground/plot/core/scene.hpp"

#include <algorithm>
#include <cmath>

#include "ground/plot/core/labels.hpp"
#include "ground/text_table.hpp"

namespace gyre::ground {
namespace {

constexpr double kAxisFont = 11.0, kTitleFont = 13.0, kFigureFont = 11.5;

Point towards(Point from, Point to) {
  return {to.x - from.x, to.y - from.y};
}

double norm(Point v) {
  return std::hypot(v.x, v.y);
}

/// Twice what the orbit encloses: nothing where it is seen from its edge.
double enclosed(const std::vector<Point>& orbit) {
  double out = 0.0;
  for (std::size_t k = 1; k < orbit.size(); ++k) out += orbit[k - 1].x * orbit[k].y - orbit[k].x * orbit[k - 1].y;
  return std::abs(out);
}

/// Which way the orbit is flown, at two places of it.
void draw_direction(Svg& svg, const std::vector<Point>& orbit, double size) {
  constexpr double kLeastEnclosed = 500.0;
  if (enclosed(orbit) < kLeastEnclosed) return;
  const std::size_t turns = orbit.size() - 1;
  for (const std::size_t at : {turns / 6, 2 * turns / 3}) {
    if (at < 1 || at + 1 >= orbit.size()) continue;
    const Point way = towards(orbit[at - 1], orbit[at + 1]);
    const double length = norm(way);
    if (length < 0.2) continue;
    // an arrow's head, notched at its back
    const Point u{way.x / length * size, way.y / length * size};
    const Point tip = orbit[at];
    svg.area({{tip.x + u.x, tip.y + u.y},
              {tip.x - u.x - 0.8 * u.y, tip.y - u.y + 0.8 * u.x},
              {tip.x - 0.45 * u.x, tip.y - 0.45 * u.y},
              {tip.x - u.x + 0.8 * u.y, tip.y - u.y - 0.8 * u.x}},
             1.0);
  }
}

void draw_carrier(Svg& svg, const CarrierPath& path, std::size_t index, const Frame& frame) {
  const Point attachment = frame(path.attachment_w_m);
  const Point place = frame(path.moments.front().position_w_m);
  const double radius = path.radius_m * frame.px_per_m();
  svg.begin(carrier_tone(index));
  svg.line(attachment, place, {1.6, 1.0, carrier_dash(index)});
  svg.disc(attachment, 1.9, 1.0);
  svg.disc(place, std::clamp(0.5 * radius, 2.4, 3.6), 1.0);
  if (radius > 3.0) {
    svg.disc(place, radius, 0.22);
    svg.ring(place, radius, {1.3});
  }
  svg.end();
}

/// All along: of many carriers an orbit is too short for its dash; the cable has it.
void draw_orbit(Svg& svg, const Motion& motion, std::size_t index, const Frame& frame) {
  const CarrierPath& path = motion.carriers[index];
  std::vector<Point> orbit;
  for (const Moment& moment : path.moments) orbit.push_back(frame(moment.position_w_m));
  svg.begin(carrier_tone(index));
  svg.path(orbit, {few(motion) ? 1.5 : 0.9, 0.75});
  draw_direction(svg, orbit, few(motion) ? 5.0 : 3.0);
  svg.end();
}

/// The two of an approach when they are closest, as faint as what is not now.
void draw_then(Svg& svg, const Nearest::Side& side, const Motion& motion, const Frame& frame) {
  const Point place = frame(side.carrier_w_m);
  svg.begin(carrier_tone(side.index));
  svg.line(frame(side.attachment_w_m), place, {1.1, 0.5, "1.5 2.5"});
  svg.ring(place, std::max(3.0, motion.carriers[side.index].radius_m * frame.px_per_m()), {1.1, 0.6, "1.5 2"});
  svg.end();
}

/// What a carrier's label stands beside: the carrier; of many, its whole orbit.
struct Mark {
  Point place;
  double radius;
};

Mark mark(const CarrierPath& path, const Frame& frame, bool alone) {
  const double own = std::max(3.6, path.radius_m * frame.px_per_m());
  if (alone) return {frame(path.moments.front().position_w_m), own};
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Moment& moment : path.moments) sum += moment.position_w_m;
  Mark out{frame(sum / static_cast<double>(path.moments.size())), 0.0};
  for (const Moment& moment : path.moments)
    out.radius = std::max(out.radius, norm(towards(out.place, frame(moment.position_w_m))));
  out.radius += own;
  return out;
}

/// Of many in the view from above alone: from the side they are behind each other.
void label_carriers(Svg& svg, const Motion& motion, const Frame& frame, Labels& labels) {
  if (!few(motion) && frame.view.up.z() > 0.0) return;
  const double font = few(motion) ? 13.0 : 9.0;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const CarrierPath& path : motion.carriers) middle += path.attachment_w_m;
  const Point centre = frame(middle / static_cast<double>(motion.carriers.size()));
  for (std::size_t i = 0; i < motion.carriers.size(); ++i) {
    const std::string id = std::to_string(motion.carriers[i].id);
    const Mark at = mark(motion.carriers[i], frame, few(motion));
    const auto room = labels.place(id, font, at.place, at.radius + 3.0, towards(centre, at.place));
    if (!room) continue;
    svg.begin(carrier_tone(i));
    svg.words(*room, id, {font, Anchor::kMiddle, true, true});
    svg.end();
  }
}

/// Beside the line from one to the other.
void label_approach(Svg& svg, const Nearest& nearest, const Frame& frame, Labels& labels) {
  const Point a = frame(nearest.first.closest_w_m), b = frame(nearest.second.closest_w_m);
  const std::string words = number_text(nearest.approach.min_m) + " m";
  const Point across{b.y - a.y, a.x - b.x};
  const auto room = labels.place(words, kFigureFont, {0.5 * (a.x + b.x), 0.5 * (a.y + b.y)}, 6.0, across);
  if (!room) return;
  svg.begin(kInk);
  svg.words(*room, words, {kFigureFont, Anchor::kMiddle, true, true});
  svg.end();
}

/// What no words may cover: carriers, and of few of them their cables too.
Labels taken(const Motion& motion, const Frame& frame) {
  Labels labels(frame.plot);
  for (const CarrierPath& path : motion.carriers) {
    const Point place = frame(path.moments.front().position_w_m);
    const double half = std::max(3.6, path.radius_m * frame.px_per_m());
    labels.occupy({place.x - half, place.y - half, place.x + half, place.y + half});
    if (few(motion)) labels.occupy(frame(path.attachment_w_m), place, 2.0);
  }
  return labels;
}

}  // namespace

void draw_frame(Svg& svg, const Frame& frame, const std::string& remark) {
  const Box& plot = frame.plot;
  svg.begin(kInk);
  svg.words({plot.left, plot.top - 11.0}, frame.view.title, {kTitleFont, Anchor::kStart, true});
  svg.end();
  const auto across = ticks(frame.right.shown, 8);
  const auto up = ticks(frame.up.shown, std::max(2, static_cast<int>(plot.height() / 40.0)));
  svg.begin(kGrid);
  for (const Tick& tick : across) {
    const double x = frame.right(tick.figure);
    svg.line({x, plot.top}, {x, plot.bottom}, {0.6});
  }
  for (const Tick& tick : up) {
    const double y = frame.up(tick.figure);
    svg.line({plot.left, y}, {plot.right, y}, {0.6});
  }
  svg.end();
  svg.begin(kMuted);
  for (const Tick& tick : across)
    svg.words({frame.right(tick.figure), plot.bottom + 15.0}, tick.words, {kAxisFont, Anchor::kMiddle});
  for (const Tick& tick : up) {
    svg.words({plot.left - 6.0, frame.up(tick.figure) + 4.0}, shortened(tick.words, kAxisFont, 64.0),
              {kAxisFont, Anchor::kEnd});
  }
  svg.words({plot.left + width_of(frame.view.title, kTitleFont) + 12.0, plot.top - 11.0}, remark, {kAxisFont});
  svg.words({plot.right, plot.bottom + 30.0}, std::string(frame.view.right_name) + ", m", {kAxisFont, Anchor::kEnd});
  svg.words({plot.right, plot.top - 11.0}, std::string(frame.view.up_name) + ", m", {kAxisFont, Anchor::kEnd});
  if (frame.shows_ground) {
    const double ground = frame.up(0.0);
    svg.line({plot.left, ground}, {plot.right, ground}, {1.4});
    svg.box({plot.left, ground, plot.right, plot.bottom}, 0.1);
  }
  svg.end();
}

void draw_load(Svg& svg, const std::vector<Eigen::Vector3d>& corners_w_m, const Frame& frame) {
  std::vector<Point> corners;
  for (const Eigen::Vector3d& corner : corners_w_m) corners.push_back(frame(corner));
  std::vector<Point> outline = hull_of(corners);
  svg.begin(kLoad);
  svg.area(outline, 0.45);
  outline.push_back(outline.front());
  svg.path(outline, {1.4});
  svg.end();
}

void draw_approach(Svg& svg, Point from, Point to, bool of_cables) {
  svg.begin(kInk);
  svg.line(from, to, {1.8, 1.0, of_cables ? "2 1.5" : ""});
  for (const Point& end : {from, to}) {
    if (of_cables) {
      svg.ring(end, 2.2, {1.2});
    } else {
      svg.disc(end, 2.2, 1.0);
    }
  }
  svg.end();
}

void draw_scene(Svg& svg, const Motion& motion, const Frame& frame) {
  std::vector<Nearest> approaches;
  for (const auto* approach : {&motion.places, &motion.cables}) {
    if (*approach) approaches.push_back(**approach);
  }
  draw_frame(svg, frame, approaches.empty() ? "" : "dotted: when closest");
  for (std::size_t i = 0; i < motion.carriers.size(); ++i) draw_orbit(svg, motion, i, frame);
  for (const Nearest& nearest : approaches) {
    draw_then(svg, nearest.first, motion, frame);
    draw_then(svg, nearest.second, motion, frame);
  }
  draw_load(svg, motion.load_w_m, frame);
  for (std::size_t i = 0; i < motion.carriers.size(); ++i) draw_carrier(svg, motion.carriers[i], i, frame);
  Labels labels = taken(motion, frame);
  for (const Nearest& nearest : approaches) {
    const Point a = frame(nearest.first.closest_w_m), b = frame(nearest.second.closest_w_m);
    draw_approach(svg, a, b, nearest.approach.what == mechanics::Touch::kCables);
    labels.occupy(a, b, 2.0);
  }
  label_carriers(svg, motion, frame, labels);
  for (const Nearest& nearest : approaches) label_approach(svg, nearest, frame, labels);
}

}  // namespace gyre::ground
