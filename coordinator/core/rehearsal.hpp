#pragma once
// Before a transition is proposed, it is rehearsed: proven to keep every carrier within the mission's limits, its winch
// and its vehicle within what they can do, and all from touching anything, at every moment of it. The least speed
// excepted: it is the motion's, and a transition may begin or end at rest. What to do when a limit breaks is for the
// agreement to say.
//
// A rehearsal is done one carrier at a time, because a proof takes tens of milliseconds and the beacon must not wait.

#include <vector>

#include "common/mechanics/certificate.hpp"
#include "common/mechanics/transition.hpp"

namespace gyre::coordinator {

class Rehearsal {
 public:
  /// `stacks[i]`: carrier i's layers with the transition on top, in seconds on one clock; the slices must outlive this.
  /// `plan`: whose limits, winches and vehicles they are held to, and how big vehicles and load are.
  Rehearsal(std::vector<std::vector<mechanics::TimedLayer>> stacks, mechanics::Plan plan);

  /// One carrier's proof, or at the end that of all: nothing touches. True when nothing is left to do.
  bool advance();

  [[nodiscard]] const std::vector<mechanics::Reason>& reasons() const { return reasons_; }
  [[nodiscard]] const std::vector<mechanics::CarrierFigures>& figures() const { return figures_; }

 private:
  void judge_apart();

  std::vector<std::vector<mechanics::TimedLayer>> stacks_;
  mechanics::Plan plan_;
  std::vector<mechanics::CarrierFigures> figures_;
  std::vector<mechanics::Reason> reasons_;
  double begin_s_ = 0.0;
  double end_s_ = 0.0;
  bool apart_ = false;
};

}  // namespace gyre::coordinator
