#pragma once
// One flight from the first process to the last: starts them, watches them, asks for the release, judges.
//
// The judging is in pure parts (flight_monitor, flight_record, flight_certificate, flight_report); here is the one
// loop that feeds them and acts.

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/mission/mission.hpp"
#include "ground/flight/core/flight_certificate.hpp"
#include "ground/flight/core/flight_monitor.hpp"
#include "ground/flight/core/flight_record.hpp"
#include "ground/flight/core/flight_report.hpp"
#include "ground/flight/core/starvation.hpp"
#include "ground/flight/flight_display.hpp"
#include "ground/flight/flight_network.hpp"
#include "ground/flight/hurting.hpp"
#include "ground/flight/supervisor.hpp"
#include "ground/page/page.hpp"
#include "ground/swarm/core/swarm_view.hpp"
#include "ground/swarm/listening.hpp"

namespace gyre::ground {

/// Why a flight ended before its time, and whose log tells more.
struct FlightFailure {
  std::string text;
  std::optional<std::string> culprit;  ///< a program's name
};

class Flight {
 public:
  /// `duration_s` of full motion; infinite: until somebody ends it. All of them have to outlive the flight.
  Flight(const mission::Mission& mission, double duration_s, dds::Node& node, Supervisor& supervisor,
         FlightDisplay& display);

  /// Before run(): shows it from then on.
  void show_at(Page& page, Hurting& hurting) {
    page_ = &page;
    hurting_ = &hurting;
  }
  [[nodiscard]] const SwarmView& view() const { return view_; }

  /// Returns when the swarm is at rest and the coordinator has ended, or when something went wrong. The other
  /// processes still run then.
  [[nodiscard]] std::optional<FlightFailure> run();

  /// Absent when the flight was ended before the motion was complete: there is nothing to judge.
  [[nodiscard]] std::optional<FlightReport> report() const;

  /// What a person at the page ordered or hurt, in words; empty: nothing, and the flight is judged.
  [[nodiscard]] const std::vector<std::string>& by_hand() const { return by_hand_; }

  /// Whether the machine had time for it.
  [[nodiscard]] const StarvationJudge& starvation() const { return starvation_; }

 private:
  void take(const Heard& heard);
  [[nodiscard]] std::optional<FlightFailure> look_after_processes();
  void release(LocalTime now);
  void show(LocalTime now);
  void turn_page(LocalTime now);

  const mission::Mission& mission_;
  double duration_s_;
  dds::Node& node_;
  Supervisor& supervisor_;
  FlightDisplay& display_;
  Page* page_ = nullptr;        ///< where it is shown, if it is
  Hurting* hurting_ = nullptr;  ///< with the page
  std::vector<std::string> by_hand_;
  Listening listening_;
  SwarmView view_;
  FlightMonitor monitor_;
  FlightRecord record_;
  FlightCertificate certificate_;
  StarvationJudge starvation_;
  std::optional<LocalTime> release_deadline_;
  bool released_ = false;
  std::set<std::uint64_t> ordered_;  ///< commands that were heard: each is said again until it is answered
  int interrupts_ = 0;
};

}  // namespace gyre::ground
