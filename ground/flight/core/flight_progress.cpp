#include "ground/flight/core/flight_progress.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/text.hpp"

namespace gyre::ground {
namespace {

std::string how_far(const FlightProgress& progress) {
  switch (progress.phase) {
    case FlightPhase::kMatching:
      return text("%d of %d agents", progress.agents_ready, progress.agents);
    case FlightPhase::kFlying:
    case FlightPhase::kSlowed:
    case FlightPhase::kReleasing:
      if (!std::isfinite(progress.duration_s)) return text("%.1f s", progress.flown_s);
      return text("%.1f of %.1f s", progress.flown_s, progress.duration_s);
    case FlightPhase::kStarting:
    case FlightPhase::kEngaging:
    case FlightPhase::kDeviated:
      break;
  }
  return "";
}

}  // namespace

double FlightProgress::share() const {
  return duration_s > 0.0 ? std::clamp(flown_s / duration_s, 0.0, 1.0) : 0.0;
}

std::string progress_line(const FlightProgress& progress) {
  std::string line = text("%-10s %-17s", name(progress.phase), how_far(progress).c_str());
  if (progress.load) {
    line +=
        text(" load %.3f mm, %.4f deg off", progress.load->displacement_now_m * 1e3, progress.load->rotation_now_deg);
  }
  line.erase(line.find_last_not_of(' ') + 1);
  return line;
}

std::string progress_bar(const FlightProgress& progress) {
  constexpr int kWidth = 24;
  const auto full = static_cast<std::size_t>(progress.share() * kWidth);
  return "[" + std::string(full, '#') + std::string(kWidth - full, '.') + "] " + progress_line(progress);
}

bool ProgressLines::worth_a_line(const FlightProgress& progress) {
  const int tenth = static_cast<int>(progress.share() * 10.0);
  const bool news = phase_ != progress.phase || tenth > tenth_ ||
                    (progress.phase == FlightPhase::kMatching && progress.agents_ready != agents_ready_);
  phase_ = progress.phase;
  agents_ready_ = progress.agents_ready;
  tenth_ = tenth;
  return news;
}

}  // namespace gyre::ground
