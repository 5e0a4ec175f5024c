#pragma once
// A certificate for a person: the verdict first, then each carrier's figures under the limits they are held to, then
// every broken rule with its cure. A figure outside its limit has a `!` behind it.

#include <string>

#include "common/mechanics/certificate.hpp"
#include "common/mechanics/plan.hpp"
#include "common/protocol/silence.hpp"

namespace gyre::ground {

[[nodiscard]] std::string certificate_table(const std::string& mission_name, const mechanics::Limits& limits,
                                            const mechanics::Certificate& certificate,
                                            const protocol::Silence& silence);

}  // namespace gyre::ground
