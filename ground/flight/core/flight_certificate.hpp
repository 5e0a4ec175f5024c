#pragma once
// What a flight is held against: the certificate of the mission's motion, at every pace from rest to full.
//
// A flight rests, speeds up, flies, and slows down, all along one path: places, lengths and tensions are those of the
// motion throughout, speeds and winch rates are those of the motion times the pace (protocol/pace.hpp).

#include <vector>

#include "common/mechanics/certificate.hpp"
#include "common/protocol/messages.hpp"
#include "ground/flight/core/mission_plan.hpp"

namespace gyre::ground {

class FlightCertificate {
 public:
  explicit FlightCertificate(const mechanics::Plan& motion);

  void see(const protocol::CoordinatorStatus& status) { plan_.learn(status); }
  /// Any number of times; before the coordinator has told which plan is the mission's, it says nothing.
  void include(const protocol::Course& course);

  /// False: the flight went to a plan that this mission does not tell; what follows cannot be judged.
  [[nodiscard]] bool knows_all_plans() const { return knows_all_plans_; }

  struct CarrierBounds {
    CarrierId id = 0;
    mechanics::CarrierFigures motion;  ///< at full pace
    mechanics::CarrierFigures whole;   ///< from rest to rest
  };
  /// In the mission's order.
  [[nodiscard]] std::vector<CarrierBounds> bounds() const;

 private:
  mechanics::Certificate motion_;
  MissionPlan plan_;
  bool knows_all_plans_ = true;
};

}  // namespace gyre::ground
