#include "common/design/design.hpp"

#include <algorithm>
#include <cmath>

#include "common/design/conflict.hpp"
#include "common/design/prices.hpp"
#include "common/design/workshop.hpp"

namespace gyre::design {
namespace {

constexpr double kPulls[] = {0.0, 0.65, 1.3, 2.2, 3.5};
constexpr std::size_t kFamilies = 4;  // that are improved
constexpr std::size_t kWholes = 2;    // families that are searched whole
constexpr std::size_t kShaken = 3;    // times that a family is shaken and searched again
constexpr double kShake = 0.15;       // of a variable
constexpr double kWorthIt = 5e-3;     // by how much the whole has to be better than its family
/// Of a search, and of those that the certificate sent back.
struct Care {
  double margin;
  int finer;
};
constexpr Care kCares[] = {{2e-3, 1}, {4e-3, 2}, {1e-2, 4}};

/// The best families over all orders and pulls.
std::vector<Candidate> families(Workshop& workshop) {
  std::vector<Candidate> out;
  for (const Order& order : workshop.orders()) {
    for (const double pull : kPulls) {
      if (!workshop.going("orders of the cycle") && !out.empty()) break;
      out.push_back(workshop.family(order, pull));
    }
  }
  std::stable_sort(out.begin(), out.end(), before);
  if (out.size() > kFamilies) out.resize(kFamilies);
  for (Candidate& candidate : out) workshop.settle(candidate, "families");
  std::stable_sort(out.begin(), out.end(), before);
  return out;
}

/// Families and wholes, the ones to be judged first in front.
std::vector<Candidate> candidates(Workshop& workshop, std::uint64_t seed) {
  const std::vector<Candidate> simple = families(workshop);
  std::vector<Candidate> out = simple;
  RandomStream stream(seed, "shaken");
  const std::size_t wholes = std::min(kWholes, simple.size());
  for (std::size_t k = 0; k < wholes && workshop.going("all that is open"); ++k)
    out.push_back(workshop.whole(simple[k]));
  for (std::size_t k = 0; k < kShaken && !simple.empty() && workshop.going("all that is open, shaken"); ++k)
    out.push_back(workshop.whole(simple[k % simple.size()], kShake, stream));
  std::stable_sort(out.begin(), out.end(), before);
  const auto simplest = std::find_if(out.begin(), out.end(), [](const Candidate& c) { return c.family; });
  if (simplest != out.end() && simplest->meets() &&
      simplest->point.cost <= out.front().point.cost + kWorthIt * std::abs(out.front().point.cost))
    std::rotate(out.begin(), simplest, simplest + 1);
  return out;
}

/// Takes the first that the certificate admits into the design; the others, which it refuses, are returned.
std::optional<Candidate> certified(const std::vector<Candidate>& found, Design& out, std::vector<Candidate>& refused) {
  for (const Candidate& candidate : found) {
    if (!candidate.meets()) continue;
    mechanics::Plan plan = candidate.plan();
    mechanics::Certificate certificate = mechanics::certify(plan);
    if (certificate.admissible()) {
      out.plan = std::move(plan);
      out.certificate = std::move(certificate);
      return candidate;
    }
    if (refused.empty()) out.certificate = std::move(certificate);
    refused.push_back(candidate);
  }
  return std::nullopt;
}

}  // namespace

const char* name(Objective objective) {
  switch (objective) {
    case Objective::kLeastEverything:
      return "least everything";
    case Objective::kGreatestSpeed:
      return "greatest speed";
    case Objective::kLeastWinchWork:
      return "least winch work";
    case Objective::kGreatestClearance:
      return "greatest clearance";
  }
  return "";
}

const char* unit(Objective objective) {
  switch (objective) {
    case Objective::kLeastEverything:
      return "";
    case Objective::kGreatestSpeed:
      return "m/s";
    case Objective::kLeastWinchWork:
      return "W";
    case Objective::kGreatestClearance:
      return "m";
  }
  return "";
}

Design design(const Requirements& requirements, std::uint64_t seed, const KeepGoing& keep_going) {
  Workshop workshop(requirements, seed, keep_going);
  Design out;
  std::vector<Candidate> found = candidates(workshop, seed);
  const std::optional<Candidate> nearest = found.empty() ? std::nullopt : std::optional<Candidate>(found.front());
  for (const Care& care : kCares) {
    if (care.finer > 1) {  // what was refused, again
      workshop.tighten(care.margin, care.finer);
      for (Candidate& candidate : found) workshop.settle(candidate, "what the certificate refused");
      std::stable_sort(found.begin(), found.end(), before);
    }
    std::vector<Candidate> refused;
    const std::optional<Candidate> best = certified(found, out, refused);
    if (best) {
      out.figure = workshop.figure(*best);
      out.prices = prices(workshop, *best);
      break;
    }
    found = std::move(refused);
    if (found.empty() || workshop.stopped()) break;
  }
  if (!out.plan && nearest && !nearest->meets()) out.conflict = conflict(workshop, *nearest);
  out.interrupted = workshop.stopped();
  return out;
}

}  // namespace gyre::design
