#pragma once
// A certificate for programs: the keys are a contract (tests/ground/command_test.cpp), units are in them.

#include <nlohmann/json.hpp>
#include <string>

#include "common/mechanics/certificate.hpp"
#include "common/protocol/silence.hpp"

namespace gyre::ground {

/// A figure that does not exist, was not computed, or is infinite, is null; so is silence_stop_after_s where
/// the swarm flies on.
[[nodiscard]] nlohmann::ordered_json certificate_json(const std::string& mission_name,
                                                      const mechanics::Certificate& certificate,
                                                      const protocol::Silence& silence);

}  // namespace gyre::ground
