#pragma once
// How a flight shows that it goes on: one line that says the phase, how far, and how still the load hangs.

#include <optional>
#include <string>

#include "ground/flight/core/flight_monitor.hpp"
#include "ground/flight/core/flight_record.hpp"

namespace gyre::ground {

struct FlightProgress {
  FlightPhase phase = FlightPhase::kStarting;
  int agents = 0;
  int agents_ready = 0;
  double flown_s = 0.0;
  double duration_s = 0.0;         ///< infinite: until somebody ends it
  std::optional<LoadRecord> load;  ///< absent: not heard of yet

  [[nodiscard]] double share() const;  ///< of the motion's duration, 0..1
};

/// "flying     12.4 of 78.5 s   load 0.002 mm, 0.0001 deg off", without a newline.
[[nodiscard]] std::string progress_line(const FlightProgress& progress);
/// The same behind a bar.
[[nodiscard]] std::string progress_bar(const FlightProgress& progress);

/// Decides what is worth a line where lines stay: a new phase, another agent, another tenth of the motion.
class ProgressLines {
 public:
  [[nodiscard]] bool worth_a_line(const FlightProgress& progress);

 private:
  std::optional<FlightPhase> phase_;
  int agents_ready_ = 0;
  int tenth_ = 0;
};

}  // namespace gyre::ground
