#include "ground/flight/flight_display.hpp"

#include <unistd.h>

#include <cstdio>

namespace gyre::ground {

FlightDisplay::FlightDisplay() : terminal_(::isatty(STDERR_FILENO) == 1) {}

void FlightDisplay::show(const FlightProgress& progress) {
  if (terminal_) {
    std::fprintf(stderr, "\r\033[K%s", progress_bar(progress).c_str());
    std::fflush(stderr);
    line_open_ = true;
  } else if (lines_.worth_a_line(progress)) {
    std::fprintf(stderr, "%s\n", progress_line(progress).c_str());
  }
}

void FlightDisplay::finish() {
  if (line_open_) std::fputs("\n", stderr);
  line_open_ = false;
}

}  // namespace gyre::ground
