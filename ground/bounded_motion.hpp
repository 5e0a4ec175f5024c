#pragma once
// Whether there is anything to show of a mission: a refused motion can be looked at, as far as it stays somewhere.

#include <string>

#include "common/mechanics/certificate.hpp"

namespace gyre::ground {

[[nodiscard]] bool has_bounded_motion(const mechanics::Certificate& certificate);

/// Why there is none: every broken rule, a line each.
[[nodiscard]] std::string unbounded_text(const std::string& mission_file, const mechanics::Certificate& certificate);

}  // namespace gyre::ground
