#pragma once
// A plan: everything that decides how a load is held, for all time. Immutable once built; no numbers of any process.
//
//   symbol      meaning                                        shape     frame   unit
//   m, J        mass, inertia of the load                      1, 3x3    B       kg, kg m²
//   p_L, R      load pose, held constant                       3, 3x3    W       m
//   b_i         attachment of carrier i on the load            3         B       m
//   lambda_j    internal force along cycle edge j              1         -       N
//   theta       phase of the cycle, rate · t                   1         -       rad
//   k           stiffness of a cable                           1         -       N/m
//
//   lambda_j(t) = offset_j + amplitude_j sin(theta + phase_j)                                   (cycle parameters)
//
// Source: Franchi, Landi, Gabellieri, cycle parameters; docs/design.md, The mechanics.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "common/base/ids.hpp"
#include "common/mechanics/length_law.hpp"

namespace gyre::mechanics {

struct Load {
  double mass_kg = 0.0;
  Eigen::Matrix3d inertia_b_kg_m2 = Eigen::Matrix3d::Zero();
  Eigen::Vector3d position_w_m = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation_w_b = Eigen::Quaterniond::Identity();
  /// Its shape is the convex hull of these points, B; none: nothing but its attachments.
  std::vector<Eigen::Vector3d> hull_b_m;
};

struct Cable {
  double stiffness_n_m = 0.0;
  double damping_n_s_m = 0.0;
  /// The winch gives back what the tension stretches, so that the load hangs where the plan says.
  bool compensate_stretch = true;
};

/// What a winch can do; an absent limit is not judged.
struct Winch {
  double time_constant_s = 0.0;  ///< of its first-order lag, which is made up for
  std::optional<double> rate_max_m_s, acceleration_max_m_s2;
};

/// What flies a carrier; an absent limit is not judged, and neither is without a mass.
struct Vehicle {
  double time_constant_s = 0.0;  ///< of its first-order lag, which is made up for
  std::optional<double> mass_kg, thrust_max_n, bank_max_rad;
};

struct Carrier {
  CarrierId id = 0;
  Eigen::Vector3d attachment_b_m = Eigen::Vector3d::Zero();
  LengthLaw law;
  double radius_m = 0.0;  ///< of the vehicle, rotors and wings included, about its place
  Vehicle vehicle = {};
};

/// e_j = (from, to): the edge pushes +lambda_j d_j at `from` and −lambda_j d_j at `to`, d_j from `to` to `from`.
struct Edge {
  CarrierId from = 0;
  CarrierId to = 0;
  double offset_n = 0.0;
  double amplitude_n = 0.0;
  double phase_rad = 0.0;
};

/// A Hamiltonian cycle over the carriers, in order of travel; two carriers share the one edge they have.
struct Cycle {
  double rate_rad_s = 0.0;
  std::vector<Edge> edges;
};

/// What the motion must respect; an absent limit is not judged.
struct Limits {
  std::optional<double> tension_min_n, tension_max_n;
  std::optional<double> length_min_m, length_max_m;
  std::optional<double> winch_rate_max_m_s;
  std::optional<double> speed_min_m_s, speed_max_m_s;
  std::optional<double> acceleration_max_m_s2;
  std::optional<double> separation_min_m;  ///< of carriers' places
  std::optional<double> clearance_min_m;   ///< of what may touch: cables, vehicles with their radius, the load's hull
  std::optional<double> vertical_cosine_min;
};

/// Built by the mission reader or by hand; valid means: at least one carrier, unique ids, a load with mass and inertia,
/// numbers that are finite, a positive rate, and edges that are a Hamiltonian cycle over the carriers (none for one
/// carrier, one for two). `certify` says whether it is (judgement.hpp, judge_form); whatever else takes a plan takes
/// that for granted.
struct Plan {
  Load load;
  double gravity_m_s2 = 9.81;
  Cable cable;
  Winch winch;  ///< of every carrier
  std::vector<Carrier> carriers;
  Cycle cycle;
  Limits limits;
};

/// The corners of a box along the body axes.
[[nodiscard]] std::vector<Eigen::Vector3d> box_hull(const Eigen::Vector3d& half_edges_m,
                                                    const Eigen::Vector3d& centre_b_m);

/// nullptr where the plan has none of this number.
[[nodiscard]] const Carrier* find(const Plan& plan, CarrierId id);

/// r_i = R b_i for every carrier, W.
[[nodiscard]] std::vector<Eigen::Vector3d> lever_arms(const Plan& plan);

/// Seconds after which the whole motion repeats: the cycle's period times the denominators of the laws' harmonics.
[[nodiscard]] double period_s(const Plan& plan);

}  // namespace gyre::mechanics
