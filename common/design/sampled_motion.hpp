#pragma once
// What every carrier does at some phases of the cycle, with the change of each figure by each variable of a search.
//
//   symbol     meaning                                                                      shape   unit
//   x          variables (unknowns.hpp)
//   y          what decides one carrier's motion: offset, sine and cosine share of          10      N, rad/s, m, rad
//              both its edges, the rate, mean, swing and phase of its law
//   F(y)       a figure of the carrier, with dF/dy (dual.hpp)
//
//   dF/dx_g = sum over k with slot k on g of factor_k dF/dy_k
//
// Samples, not proofs: what is found with them is judged by the certificate.
//
// Source: Franchi, Landi, Gabellieri, as in reference.hpp, whose formulas these are.

#include <array>
#include <vector>

#include "common/design/dual.hpp"
#include "common/design/unknowns.hpp"
#include "common/mechanics/reference.hpp"

namespace gyre::design {

inline constexpr int kShare = 10;
using Number = Dual<kShare>;
using NumberVector = Eigen::Matrix<Number, 3, 1>;

enum class Figure {
  kTension,
  kLength,
  kWinchRate,
  kPaidOut,
  kPaidOutRate,
  kPaidOutAcceleration,
  kSpeed,
  kAcceleration,
  kAltitude,
  kVerticalCosine,
  kDirectionCosine,  ///< 1 where the law has no direction
  kThrust,           ///< what a vehicle pulls, its own weight included; 0 without a mass
  kUprightness,      ///< cosine of that pull's angle to the vertical; 1 without a mass
  kThrustAtRest,     ///< the same where the phase stands still
  kUprightnessAtRest,
  kCount,
};

struct Moment {
  NumberVector position_w_m;
  NumberVector internal_force_w_n;  ///< beyond the particular force
  std::array<Number, static_cast<std::size_t>(Figure::kCount)> figures;

  [[nodiscard]] const Number& operator[](Figure figure) const { return figures[static_cast<std::size_t>(figure)]; }
  [[nodiscard]] Number& operator[](Figure figure) { return figures[static_cast<std::size_t>(figure)]; }
};

class SampledMotion {
 public:
  /// `plan` lives as long as this. `samples` of each turn of the phase.
  SampledMotion(const mechanics::Plan& plan, const Unknowns& unknowns, int samples);

  void evaluate(const Eigen::VectorXd& x);

  [[nodiscard]] std::size_t carriers() const { return slices_.size(); }
  [[nodiscard]] std::size_t samples() const { return phases_rad_.size(); }
  [[nodiscard]] const Moment& moment(std::size_t carrier, std::size_t sample) const {
    return moments_[carrier * samples() + sample];
  }
  [[nodiscard]] const Eigen::Vector3d& attachment_w_m(std::size_t carrier) const {
    return slices_[carrier].attachment_w_m;
  }

  /// gradient += weight · dF/dx of a carrier's figure with this slope.
  void scatter(std::size_t carrier, const Number::Slope& slope, double weight,
               Eigen::Ref<Eigen::VectorXd> gradient) const;

 private:
  [[nodiscard]] Moment moment_at(std::size_t carrier, const std::array<Number, kShare>& y, double phase_rad) const;

  const mechanics::Plan& plan_;
  std::vector<mechanics::CarrierSlice> slices_;
  std::vector<std::array<Slot, kShare>> slots_;
  std::vector<double> phases_rad_;
  std::vector<Moment> moments_;
};

}  // namespace gyre::design
