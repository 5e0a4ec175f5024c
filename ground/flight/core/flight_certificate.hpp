#pragma once
// What a flight is held against: the certificate of everything it is made of.
//
// A flight hangs at rest, mixes into the motion, flies it, and mixes back. The certificate of the motion alone does
// not hold for the rest plan or for the mixtures, so each transition that was really flown (the beacons' course tells)
// is enclosed too, and the whole flight is held against the hull of all of them.

#include <vector>

#include "common/mechanics/certificate.hpp"
#include "common/protocol/messages.hpp"
#include "ground/flight/core/mission_plans.hpp"

namespace gyre::ground {

class FlightCertificate {
 public:
  explicit FlightCertificate(const mechanics::Plan& motion);

  void see(const protocol::CoordinatorStatus& status) { plans_.learn(status); }
  /// Remembers the transitions of a course that are go. Cheap; the same course may come any number of times, and has
  /// to: before the coordinator has told which plan is which, it says nothing.
  void include(const protocol::Course& course);

  /// A plan the flight went to that this mission does not tell: what follows cannot be judged.
  [[nodiscard]] bool knows_all_plans() const { return knows_all_plans_; }

  struct CarrierBounds {
    CarrierId id = 0;
    mechanics::CarrierFigures motion;  ///< while no transition is under way
    mechanics::CarrierFigures whole;   ///< rest, transitions, and motion
  };
  /// In the mission's order. Encloses the transitions: up to some milliseconds for each carrier and transition.
  [[nodiscard]] std::vector<CarrierBounds> bounds() const;

 private:
  mechanics::Certificate motion_;
  mechanics::Certificate rest_;
  std::vector<mechanics::CarrierSlice> motion_slices_;
  std::vector<mechanics::CarrierSlice> rest_slices_;
  MissionPlans plans_;
  std::vector<protocol::Course> courses_;  // each with at least one transition, all of them go
  bool knows_all_plans_ = true;
};

}  // namespace gyre::ground
