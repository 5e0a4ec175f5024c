#include "common/dds/clock_options.hpp"

#include "common/base/text.hpp"
#include "common/dds/clock.hpp"

namespace gyre::dds {
namespace {

// CLI::Range lets NaN pass.
CLI::Validator within(double limit) {
  const auto judge = [limit](const std::string& input) {
    double value = 0.0;
    const bool good = CLI::detail::lexical_cast(input, value) && value >= -limit && value <= limit;
    return good ? std::string() : text("\"%s\" is no number from %g to %g", input.c_str(), -limit, limit);
  };
  return {judge, text("%g to %g", -limit, limit)};
}

}  // namespace

void add_clock_options(CLI::App& app, ClockOptions& options) {
  const char* const group = "Laboratory";
  app.add_option("--clock-offset-s", options.offset_s, "make this process's clock wrong by so many seconds")
      ->envname("GYRE_CLOCK_OFFSET_S")
      ->check(within(kMaxClockOffset_s))
      ->group(group);
  app.add_option("--clock-drift-ppm", options.drift_ppm, "make this process's clock run too fast by so many ppm")
      ->envname("GYRE_CLOCK_DRIFT_PPM")
      ->check(within(kMaxClockDrift_ppm))
      ->group(group);
}

Notices apply(const ClockOptions& options) {
  if (options.offset_s == 0.0 && options.drift_ppm == 0.0) return {};
  set_clock_error(from_seconds(options.offset_s), options.drift_ppm);
  return {{Notice::Level::kWarning, text("laboratory: this process's clock is made wrong by %+g s and %+g ppm",
                                         options.offset_s, options.drift_ppm)}};
}

}  // namespace gyre::dds
