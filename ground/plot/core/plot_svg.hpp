#pragma once
// A mission as one picture: what it is and whether it is admissible; the load, cables and carriers from above and from
// the side, with their orbits and how close they ever come; below it what a certificate judges, over one period.

#include <string>

#include "common/mechanics/certificate.hpp"
#include "common/mechanics/plan.hpp"

namespace gyre::ground {

/// An SVG for light and for dark paper. Of a valid plan that has a bounded motion (bounded_motion.hpp), with its whole
/// certificate; a refused one is drawn with its verdict and its first reason.
[[nodiscard]] std::string plot_svg(const std::string& mission_name, const mechanics::Plan& plan,
                                   const mechanics::Certificate& certificate);

}  // namespace gyre::ground
