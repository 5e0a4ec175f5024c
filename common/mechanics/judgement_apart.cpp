#include "common/mechanics/judgement.hpp"

// Holds what must not touch against the limits, and says what would pull it apart.

#include <cstdlib>

#include "common/base/text.hpp"

namespace gyre::mechanics {
namespace {

const char* cure(Touch what) {
  return what == Touch::kCableAndLoad ? "move its attachment to an edge that the cable leaves outwards, raise the "
                                        "carrier, or lower the amplitudes"
                                      : "pull them apart by offsets or attachments, or lower the amplitudes";
}

}  // namespace

const char* name(Touch what) {
  switch (what) {
    case Touch::kPlaces:
      return "carriers";
    case Touch::kCables:
    case Touch::kStrayingCable:
      return "cables";
    case Touch::kVehicleAndCable:
      return "vehicle and cable";
    case Touch::kVehicles:
      return "vehicles";
    case Touch::kCableAndLoad:
      return "cable and load";
  }
  return "unknown";
}

std::string who(const Approach& c) {
  switch (c.what) {
    case Touch::kPlaces:
      return text("carriers %u and %u", c.first, c.second);
    case Touch::kVehicles:
      return text("the vehicles of carriers %u and %u", c.first, c.second);
    case Touch::kCables:
    case Touch::kStrayingCable:
      return text("the cables of carriers %u and %u", c.first, c.second);
    case Touch::kVehicleAndCable:
      return text("the vehicle of carrier %u and the cable of carrier %u", c.first, c.second);
    case Touch::kCableAndLoad:
      return text("the cable of carrier %u and the load", c.first);
  }
  return {};
}

void judge_separation(const Approach& s, const Limits& limits, std::vector<Reason>& reasons) {
  if (!limits.separation_min_m || s.min_m >= *limits.separation_min_m) return;
  reasons.push_back(
      {Rule::kSeparation, s.first,
       text("carriers %u and %u come as close as %.6g m, below separation_min_m %.6g; set their altitudes "
            "or attachments further apart, or lower the amplitudes",
            s.first, s.second, s.min_m, *limits.separation_min_m)});
}

void judge_braids(const std::vector<Braid>& braids, std::vector<Reason>& reasons) {
  for (const Braid& b : braids) {
    const std::string where = text("%.3g m up the cable of carrier %u, at %.4g s, with the carriers %.3g m apart",
                                   b.up_m, b.first, b.at_s, b.apart_m);
    if (b.winding != 0) {
      const int turns = std::abs(b.winding);
      reasons.push_back(
          {Rule::kBraid, b.first,
           text("carriers %u and %u wind around each other %s per period: their cables braid, and have to "
                "pass through each other, first %s; pull them apart by offsets until the circles do not "
                "enclose each other",
                b.first, b.second, turns == 1 ? "once" : text("%d times", turns).c_str(), where.c_str())});
    } else {
      reasons.push_back({Rule::kBraid, b.first,
                         text("the cables of carriers %u and %u pass through each other and back, first %s; pull them "
                              "apart by offsets, or lower the amplitudes",
                              b.first, b.second, where.c_str())});
    }
  }
}

void judge_clearance(const Approach& c, const Limits& limits, std::vector<Reason>& reasons) {
  const std::string both = who(c);
  if (c.min_m <= 0.0) {
    reasons.push_back({Rule::kClearance, c.first, text("%s touch at %.4g s; %s", both.c_str(), c.at_s, cure(c.what))});
  } else if (limits.clearance_min_m && c.min_m < *limits.clearance_min_m) {
    reasons.push_back({Rule::kClearance, c.first,
                       text("%s touch when carrier %u strays by %.6g m at %.4g s, less than clearance_min_m %.6g; %s",
                            both.c_str(), c.first, c.min_m, c.at_s, *limits.clearance_min_m, cure(c.what))});
  }
}

void judge_above_load(double above_load_min_m, const Limits& limits, std::vector<Reason>& reasons) {
  const double least_m = limits.clearance_min_m.value_or(0.0);
  if (above_load_min_m > 0.0 && above_load_min_m >= least_m) return;
  reasons.push_back({Rule::kClearance, std::nullopt,
                     text("the lowest vehicle is %.6g m above the load's highest corner, and has to be %s%.6g m; raise "
                          "the carriers, or lengthen the cables",
                          above_load_min_m, least_m > 0.0 ? "at least " : "more than ", least_m)});
}

}  // namespace gyre::mechanics
