#pragma once
// The load's motion through time: SUNDIALS CVODE, variable-order BDF with the exact dense Jacobian.
//
// Intuition: the stiff modes (a cable stretching) die within microseconds, the motion we want takes seconds. An
// implicit multistep method walks at the pace of the slow motion and shortens its stride only where something happens:
// a cable that goes slack or taut, a setpoint that jumps. Inputs may jump between calls; the error control notices and
// needs no restart, which would throw away the history for every one of hundreds of setpoints per second.
//
// Errors of one step are held below 1e-7 relative plus, absolutely, 1e-10 m, 1e-9 m/s, 1e-10 (quaternion) and
// 1e-9 rad/s: each a thousandth of what moves a stiff cable's force by a millinewton (1e4 N/m, 1e3 N s/m).

#include <functional>
#include <memory>
#include <optional>

#include "common/base/result.hpp"
#include "simulator/core/load_dynamics.hpp"

namespace gyre::simulator {

/// What surrounds the load at time t, for any t inside the interval being integrated; anchors come sized.
using SurroundingsAt = std::function<void(double t_s, Surroundings& out)>;

struct IntegratorStatistics {
  long steps = 0;
  long evaluations = 0;
};

class LoadIntegrator {
 public:
  LoadIntegrator(LoadDynamics dynamics, const LoadMotion& start, double start_s, SurroundingsAt surroundings);
  ~LoadIntegrator();

  /// Integrates to exactly t (never beyond: inputs after t need not exist yet). When CVODE gives up, it is started
  /// afresh from the motion before the call; when it gives up again, this returns why, and the motion is as before the
  /// call.
  [[nodiscard]] std::optional<Error> advance_to(double t_s);

  /// Goes on from another motion, at another time.
  void restart(const LoadMotion& motion, double t_s);

  [[nodiscard]] double time_s() const;
  [[nodiscard]] const LoadMotion& motion() const;
  [[nodiscard]] const LoadDynamics& dynamics() const;
  [[nodiscard]] IntegratorStatistics statistics() const;

 private:
  struct Solver;
  std::unique_ptr<Solver> solver_;
};

}  // namespace gyre::simulator
