#pragma once
// What requirements want, and whether that asks for anything.

#include "common/design/requirements.hpp"
#include "common/mission/located.hpp"
#include "idl/mission.pb.h"

namespace gyre::mission {

/// Wanted least speed and clearance go among the plan's limits. `want` is the message where it stands.
[[nodiscard]] design::Want read_want(const schema::Want& message, const Located& want, mechanics::Plan& plan);

/// Complains about wishes without an end, and about such that ask for nothing.
void judge_want(const Located& place, const design::Want& want, const design::Open& open, const mechanics::Plan& plan);

/// Complains where nobody can choose attachments that are left out: without a shape, or with edges between them.
void judge_open_attachments(const Located& root, const mechanics::Load& load, const std::vector<Located>& edges);

}  // namespace gyre::mission
