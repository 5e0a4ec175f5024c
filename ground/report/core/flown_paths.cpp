#include "ground/report/core/flown_paths.hpp"

#include <algorithm>

#include "ground/plot/core/labels.hpp"
#include "ground/plot/core/polyline.hpp"
#include "ground/plot/core/scene.hpp"

namespace gyre::ground {
namespace {

constexpr double kOff_px = 0.1;
constexpr double kIdFont = 13.0, kFineFont = 9.0;

std::vector<Point> seen(const std::vector<Eigen::Vector3d>& places_w_m, const Frame& frame) {
  std::vector<Point> out;
  out.reserve(places_w_m.size());
  for (const Eigen::Vector3d& place : places_w_m) out.push_back(frame(place));
  return simplified(out, kOff_px);
}

/// Broad and faint, for a fine line to be seen on it.
void draw_plan(Svg& svg, const Motion& motion, const Places& places, const Frame& frame) {
  for (const CarrierPath& path : motion.carriers) {
    std::vector<Eigen::Vector3d> orbit;
    for (const Moment& moment : path.moments) orbit.push_back(moment.position_w_m);
    svg.begin(carrier_tone(places.at(path.id)));
    svg.path(seen(orbit, frame), {few(motion) ? 6.0 : 3.0, 0.25});
    svg.end();
  }
}

void draw_carrier(Svg& svg, const Trace& trace, const Eigen::Vector3d* attachment_w_m, std::size_t place, bool fine,
                  const Frame& frame) {
  svg.begin(carrier_tone(place));
  for (const auto& stroke : trace.strokes()) svg.path(seen(stroke, frame), {fine ? 0.8 : 1.4, 1.0});
  const Point begin = frame(*trace.first_m());
  if (attachment_w_m) {
    const Point attachment = frame(*attachment_w_m);
    svg.line(attachment, begin, {1.1, 0.7, carrier_dash(place)});
    svg.disc(attachment, 1.9, 1.0);
  }
  svg.disc(begin, fine ? 2.4 : 3.6, 1.0);
  svg.end();
}

}  // namespace

Extents flown_extents(const Account& account) {
  Extents out;
  const auto take = [&out](const Trace& trace) {
    const auto& extent = trace.extent();
    if (!trace.first_m()) return;
    out.include(Eigen::Vector3d(extent[0].min, extent[1].min, extent[2].min));
    out.include(Eigen::Vector3d(extent[0].max, extent[1].max, extent[2].max));
  };
  if (account.certified) out = extents(account.certified->motion);
  for (const auto& [id, series] : account.digest->carriers()) take(series.path);
  take(account.digest->load().path);
  if (out.x.span() < 0.0) out.include(Eigen::Vector3d::Zero());
  return out;
}

bool of_one_size(const std::vector<Account>& accounts) {
  constexpr double kMost = 2.5;
  mechanics::Range sizes_m;
  for (const Account& account : accounts) {
    const Extents extents = flown_extents(account);
    sizes_m.include(std::max({extents.x.span(), extents.y.span(), extents.z.span()}));
  }
  return sizes_m.max <= kMost * sizes_m.min;
}

void draw_paths(Svg& svg, const Account& account, const Places& places, const Frame& frame) {
  draw_frame(svg, frame, "");
  const Motion* const motion = account.certified ? &account.certified->motion : nullptr;
  const bool fine = account.digest->carriers().size() > kFewCarriers;
  if (motion) {
    draw_plan(svg, *motion, places, frame);
    draw_load(svg, motion->load_w_m, frame);
  } else if (const auto& load = account.digest->load().path.first_m()) {
    svg.begin(kLoad);
    svg.disc(frame(*load), 5.0, 0.8);
    svg.end();
  }
  Labels labels(frame.plot);
  for (const auto& [id, series] : account.digest->carriers()) {
    const Eigen::Vector3d* attachment_w_m = nullptr;
    for (std::size_t i = 0; motion && i < motion->carriers.size(); ++i) {
      if (motion->carriers[i].id == id) attachment_w_m = &motion->carriers[i].attachment_w_m;
    }
    draw_carrier(svg, series.path, attachment_w_m, places.at(id), fine, frame);
    const Point begin = frame(*series.path.first_m());
    labels.occupy({begin.x - 4.0, begin.y - 4.0, begin.x + 4.0, begin.y + 4.0});
  }
  if (fine && frame.view.up.z() > 0.0) return;  // behind each other
  for (const auto& [id, series] : account.digest->carriers()) {
    const std::string words = std::to_string(id);
    const double font = fine ? kFineFont : kIdFont;
    const auto room = labels.place(words, font, frame(*series.path.first_m()), 7.0, {1.0, -1.0});
    if (!room) continue;
    svg.begin(carrier_tone(places.at(id)));
    svg.words(*room, words, {font, Anchor::kMiddle, true, true});
    svg.end();
  }
}

}  // namespace gyre::ground
