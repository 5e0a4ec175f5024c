#pragma once
// A mission's text as what a coordinator is told to do: read, certified, or refused in words.

#include <string>

#include "common/base/result.hpp"
#include "common/mechanics/certificate.hpp"
#include "common/mission/mission.hpp"
#include "coordinator/core/job.hpp"

namespace gyre::coordinator {

/// `certificate`: of the mission's plan, which is admissible.
[[nodiscard]] Job job_of(const mission::Mission& mission, const mechanics::Certificate& certificate);

/// A mission that came over the wire is read and judged like one from a file.
[[nodiscard]] Result<Job> judged_job(const std::string& text);

}  // namespace gyre::coordinator
