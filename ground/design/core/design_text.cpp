#include "ground/design/core/design_text.hpp"

#include <cmath>

#include "common/base/text.hpp"
#include "ground/check/certificate_table.hpp"
#include "ground/text_table.hpp"

namespace gyre::ground {
namespace {

using design::Objective;

/// "effort 1.49", "0.043 m/s".
std::string figure_text(Objective objective, double figure) {
  const char* unit = design::unit(objective);
  return *unit == '\0' ? text("effort %.4g", figure) : text("%.4g %s", figure, unit);
}

/// "0.07 m/s more".
std::string change_text(Objective objective, double figure, double other) {
  const double change = other - figure;
  const char* direction = change < 0.0 ? "less" : "more";
  if (*design::unit(objective) == '\0') return text("%.2g %% %s effort", 100.0 * std::abs(change / figure), direction);
  return text("%.3g %s %s", std::abs(change), design::unit(objective), direction);
}

std::string prices_text(Objective objective, const design::Design& design) {
  if (design.prices.empty()) return "Nothing that was asked for holds it back by much.\n";
  std::string out = "What holds it back, and what a little less of each alone would bring (sampled, not certified):\n";
  for (const design::Price& price : design.prices) {
    out += text("  - %s %.4g -> %.4g %s: ", price.name.c_str(), price.limit, price.relaxed, price.unit) +
           change_text(objective, design.figure, price.figure) + "\n";
  }
  return out;
}

std::string impossible_text(const std::string& name, const design::Design& design) {
  if (!design.conflict.empty()) {
    const bool alone = design.conflict.size() == 1;
    std::string out = name + ": IMPOSSIBLE, as far as the search sees; " +
                      (alone ? "this cannot be met:\n" : "these cannot be met together:\n");
    for (const std::string& demand : design.conflict) out += "  - " + demand + "\n";
    if (design.interrupted) return out + "It was interrupted: not all of these need be in each other's way.\n";
    return out + (alone ? "Without it the others can be met: relax it.\n"
                        : "Without any one of them the others can be met: relax one.\n");
  }
  if (!design.certificate.reasons.empty()) {
    std::string out = name + (design.certificate.carriers.empty()
                                  ? ": IMPOSSIBLE, whatever is chosen:\n"
                                  : ": nothing was found that the certificate admits; the best was refused:\n");
    for (const mechanics::Reason& reason : design.certificate.reasons)
      out += std::string("  - ") + mechanics::name(reason.rule) + ": " + reason.text + "\n";
    return out;
  }
  return name + ": nothing was found" + (design.interrupted ? " in that time; give it more: --seconds\n" : "\n");
}

}  // namespace

std::string progress_line(double elapsed_s, Objective objective, const design::Progress& progress) {
  return text("%6.1f s  %s: ", elapsed_s, progress.doing.c_str()) +
         (progress.best ? "best so far " + figure_text(objective, *progress.best) : "nothing yet");
}

std::string design_report(const mission::Requirements& requirements, const design::Design& design) {
  const mission::Mission& mission = requirements.mission;
  if (!design.plan) return impossible_text(mission.name, design);
  const Objective objective = requirements.want.objective;
  return certificate_table(mission.name, design.plan->limits, design.certificate, mission.silence) + "\n" +
         std::string(design::name(objective)) + ": " + figure_text(objective, design.figure) +
         (design.interrupted ? ", the best that was found in that time" : "") + "\n" + prices_text(objective, design);
}

std::string mission_file(const mission::Requirements& requirements, const design::Design& design,
                         const std::string& source_name, std::uint64_t seed) {
  mission::Mission mission = requirements.mission;
  mission.plan = *design.plan;
  const Objective objective = requirements.want.objective;
  std::string head = "# Designed from " + source_name +
                     text(" with seed %llu: ", static_cast<unsigned long long>(seed)) + design::name(objective) + ", " +
                     figure_text(objective, design.figure) + ".\n";
  for (const design::Price& price : design.prices) {
    head += text("# Held back by %s %.4g %s.\n", price.name.c_str(), price.limit, price.unit);
  }
  return head + "\n" + mission::to_text(mission);
}

}  // namespace gyre::ground
