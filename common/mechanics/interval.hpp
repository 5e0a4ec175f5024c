#pragma once
// Interval arithmetic for proofs: a number known to lie between two others. Boost's, taught to Eigen.
//
// Rounding is not directed: the slack of every proof that uses it (kTransitionSlack and the like) is a billion times
// wider than what rounding to nearest can lose, and switching the processor's rounding mode would cost the speed.

#include <Eigen/Core>
#include <boost/numeric/interval.hpp>

namespace gyre::mechanics {

using Interval = boost::numeric::interval<
    double, boost::numeric::interval_lib::policies<boost::numeric::interval_lib::save_state_nothing<
                                                       boost::numeric::interval_lib::rounded_transc_exact<double>>,
                                                   boost::numeric::interval_lib::checking_base<double>>>;

}  // namespace gyre::mechanics

namespace Eigen {
template <>
struct NumTraits<gyre::mechanics::Interval> : GenericNumTraits<double> {
  using Real = gyre::mechanics::Interval;
  using NonInteger = gyre::mechanics::Interval;
  using Nested = gyre::mechanics::Interval;
  // NOLINTBEGIN(readability-identifier-naming): Eigen's names
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 2,
    AddCost = 2,
    MulCost = 8
  };
  // NOLINTEND(readability-identifier-naming)
};
}  // namespace Eigen
