#pragma once
// The verdict on a flight: what was flown against what was certified.
//
// The motion at full pace is held against its certificate, the whole flight against that of every pace from rest to
// full (flight_certificate.hpp). The least speed is judged for the motion only: a flight begins and ends at rest.

#include <string>
#include <vector>

#include "common/mechanics/certificate.hpp"
#include "common/mission/mission.hpp"
#include "ground/flight/core/flight_certificate.hpp"
#include "ground/flight/core/flight_record.hpp"

namespace gyre::ground {

/// How far a measured figure may lie outside its certified range and still confirm it. The certificate is of the
/// reference; the flight has an elastic cable, sampled setpoints and clocks that agree to a millisecond at best.
struct FlightTolerance {
  double relative = 0.01;   ///< of the figure's greatest certified magnitude
  double length_m = 1e-3;   ///< lengths and altitudes; and where stretch is not compensated, what it explains, s / k
  double speed_m_s = 1e-3;  ///< speeds and winch rates
  double tension_n = 5e-3;
};

/// One figure of one carrier, certified and flown, in the motion proper.
struct JudgedRange {
  mechanics::Range certified;
  mechanics::Range flown;
  bool inside = true;  ///< of both the motion's certificate and, in the whole flight, of the hull
};

struct CarrierReport {
  CarrierId id = 0;
  JudgedRange tension_n;
  JudgedRange length_m;
  JudgedRange speed_m_s;
  JudgedRange winch_rate_m_s;
  JudgedRange altitude_m;  ///< its span is the altitude swing
};

struct FlightReport {
  std::string mission;
  double flown_s = 0.0;  ///< of full motion
  std::vector<CarrierReport> carriers;
  LoadRecord load;
  mission::LoadTolerance load_tolerance;
  bool load_inside = true;
  TimingRecord timing;
  std::vector<std::string> violations;  ///< every figure outside, in words

  [[nodiscard]] bool good() const { return violations.empty(); }
};

/// A flight without a single sample of a carrier's motion, or of the load, is not a good one.
[[nodiscard]] FlightReport judge_flight(const mission::Mission& mission, const FlightCertificate& certificate,
                                        const FlightRecord& record, double flown_s,
                                        const FlightTolerance& tolerance = {});

}  // namespace gyre::ground
