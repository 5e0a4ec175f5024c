#pragma once
// Progress on stderr: a bar that moves on a terminal, a line now and then elsewhere. The table has stdout to itself.

#include "ground/flight/core/flight_progress.hpp"

namespace gyre::ground {

class FlightDisplay {
 public:
  FlightDisplay();
  ~FlightDisplay() { finish(); }
  FlightDisplay(const FlightDisplay&) = delete;
  FlightDisplay& operator=(const FlightDisplay&) = delete;

  void show(const FlightProgress& progress);
  /// Leaves the bar's last state standing; whatever is printed next begins a line.
  void finish();

 private:
  bool terminal_;
  bool line_open_ = false;
  ProgressLines lines_;
};

}  // namespace gyre::ground
