#pragma once
// The laboratory's options: --clock-offset-s and --clock-drift-ppm make a process's clock wrong, so that tests can show
// that it does not matter.

#include <CLI/CLI.hpp>

#include "common/base/notice.hpp"

namespace gyre::dds {

struct ClockOptions {
  double offset_s = 0.0;
  double drift_ppm = 0.0;
};

/// `options` has to live until `app` has parsed.
void add_clock_options(CLI::App& app, ClockOptions& options);

/// Makes the process's clock wrong as told, and says so; silent when there is nothing to do. Call before a node opens
/// and before anything reads the clock.
[[nodiscard]] Notices apply(const ClockOptions& options);

}  // namespace gyre::dds
