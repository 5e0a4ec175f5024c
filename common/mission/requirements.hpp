#pragma once
// Requirements: a mission with numbers left out, and what is wanted of it; what `gyre design` makes a mission of.
//
// Read by the same code as a mission, so the same words are wrong in both, and answered in the same way. What is left
// out is open; its numbers in the mission's plan mean nothing. Wanted least speed and clearance are among its limits.
//
// Units and frames are in the names; the schema is idl/mission.proto.

#include "common/design/requirements.hpp"
#include "common/mission/mission.hpp"

namespace gyre::mission {

struct Requirements {
  Mission mission;
  design::Open open;
  design::Want want;

  [[nodiscard]] design::Requirements wanted() const { return {mission.plan, open, want}; }
};

/// `source_name` as for parse_mission.
[[nodiscard]] Result<Requirements> parse_requirements(const std::string& text, const std::string& source_name);

[[nodiscard]] Result<Requirements> read_requirements_file(const std::string& path);

}  // namespace gyre::mission
