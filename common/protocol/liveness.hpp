#pragma once
// Judges silence. Somebody is silent when nothing was heard of them for longer than a timeout.
//
// Told the time, never asking for it: the same judge serves a process on its steady clock and a test on virtual time.
// DDS has liveliness of its own; it cannot be relied on (docs/interop.md "Delivery"), and it could not be tested
// like this.

#include <optional>

#include "common/base/time.hpp"

namespace gyre::protocol {

class Liveness {
 public:
  explicit Liveness(Duration timeout) : timeout_(timeout) {}

  void heard(LocalTime now) { last_ = now; }

  [[nodiscard]] std::optional<LocalTime> last() const { return last_; }
  [[nodiscard]] bool ever_heard() const { return last_.has_value(); }
  /// Never heard counts as silent.
  [[nodiscard]] bool silent(LocalTime now) const { return !last_ || now - *last_ > timeout_; }

 private:
  Duration timeout_;
  std::optional<LocalTime> last_;
};

}  // namespace gyre::protocol
