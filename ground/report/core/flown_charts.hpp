#pragma once
// The figures of a flight over time, each a chart, with what is certified of them drawn in.

#include <map>
#include <vector>

#include "ground/plot/core/chart.hpp"
#include "ground/report/core/account.hpp"

namespace gyre::ground {

/// One figure of every carrier, or of the load.
enum class Quantity { kAltitude, kSpeed, kLength, kWinchRate, kTension, kDisplacement, kRotation };

/// A carrier's place among all that a report speaks of: its tone is the same wherever it is drawn.
using Places = std::map<CarrierId, std::size_t>;
[[nodiscard]] Places places(const std::vector<Account>& accounts);

/// Time counts from the first moment of the motion at full pace, and where there is none from the recording's begin.
/// Lines have the points that a chart of this width can show.
[[nodiscard]] Chart flown_chart(Quantity quantity, const Account& account, const Places& places, double width_px);

/// Charts of one quantity, brought to the same scales.
void bring_to_one_scale(std::vector<Chart>& charts);

}  // namespace gyre::ground
