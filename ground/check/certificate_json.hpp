#pragma once
// A certificate for programs: the keys are a contract (tests/ground/command_test.cpp), units are in them.

#include <nlohmann/json.hpp>
#include <string>

#include "common/mechanics/certificate.hpp"

namespace gyre::ground {

/// A figure that does not exist, was not computed, or is infinite, is null.
[[nodiscard]] nlohmann::ordered_json certificate_json(const std::string& mission_name,
                                                      const mechanics::Certificate& certificate);

}  // namespace gyre::ground
