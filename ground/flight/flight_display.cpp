#include "ground/flight/flight_display.hpp"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace gyre::ground {

namespace {

/// One that is dumb knows no escape sequences, and shows them as letters.
bool moves_its_cursor() {
  const char* const kind = std::getenv("TERM");
  return ::isatty(STDERR_FILENO) == 1 && kind != nullptr && *kind != '\0' && std::string_view(kind) != "dumb";
}

}  // namespace

FlightDisplay::FlightDisplay() : terminal_(moves_its_cursor()) {}

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
