#include "coordinator/judged_job.hpp"

namespace gyre::coordinator {

Job job_of(const mission::Mission& mission, const mechanics::Certificate& certificate) {
  Job job;
  job.name = mission.name;
  job.plan = mission.plan;
  job.mission_text = mission::to_text(mission);
  job.swings = certificate.swings;
  if (mission.transition_duration_s) job.transition = from_seconds(*mission.transition_duration_s);
  job.silence = mission.silence;
  return job;
}

Result<Job> judged_job(const std::string& text) {
  const auto mission = mission::parse_mission(text, "mission");
  if (!mission) return mission.error();
  const mechanics::Certificate certificate = mechanics::certify(mission.value().plan);
  if (!certificate.admissible()) return Error{"refused: " + certificate.reasons.front().text};
  return job_of(mission.value(), certificate);
}

}  // namespace gyre::coordinator
