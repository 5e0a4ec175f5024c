#pragma once
// What is demanded of a motion, as numbers that a search can push below 0.
//
//   symbol    meaning                                                                unit
//   F         a figure of a carrier, a pair or an edge at a sample                   its own
//   L, S      its limit; what it is counted in, the limit's own size as a rule       its own
//
//   residual = ±(F − L) / S          <= 0: met
//
// Everything that the certificate judges is among the demands, and what it takes for granted, too: tension, lengths
// and cosines that keep away from 0. Clearance is the certificate's (docs/design.md, fact 8): how far a carrier may
// stray before its cable touches another. That two cables are not wound around each other no distance tells, since
// cables can pass through each other between two samples. Each pair has a side for that, a horizontal direction u:
//
//   u · (y_j − y_i) >= least      y: where the cables are at the height of the lower carrier
//
// At the attachments, and so all along the cables, carrier j is on that side of carrier i, at every sample. The curve
// of y_j − y_i is an ellipse or nearly so, which either encloses 0, and then the cables braid, or has such a side.

#include <optional>
#include <string>
#include <vector>

#include "common/design/sampled_motion.hpp"

namespace gyre::design {

enum class Kind { kCarrier, kSeparation, kClearance, kSide, kAmplitudeMost, kAmplitudeGiven };

struct Demand {
  Kind kind = Kind::kCarrier;
  Figure figure = Figure::kCount;  ///< of kCarrier
  bool least = false;              ///< the limit is a least one
  double limit = 0.0;
  double scale = 1.0;
  int carrier = -1;  ///< one alone; -1: all
  std::string name;  ///< as the file has it, "speed_min_m_s"; empty: nobody asked for it, it has to be
  const char* unit = "";

  [[nodiscard]] double residual(double value) const { return (least ? limit - value : value - limit) / scale; }
};

/// Sizes that numbers of a mission are counted in.
struct Scales {
  double force_n = 1.0;   ///< a carrier's share of the weight
  double length_m = 1.0;  ///< of a cable
  double speed_m_s = 1.0;
};

[[nodiscard]] std::vector<Demand> demands_of(const mechanics::Plan& given, const Want& want, const Scales& scales);

/// One residual: of a demand, of whom, when.
struct Row {
  std::size_t demand = 0;
  std::size_t first = 0, second = 0;  ///< carriers, or an edge; `second` of pairs only
  std::size_t sample = 0;
};

/// A row and what it is where it was looked at.
struct Judged {
  Row row;
  double residual = 0.0;
};

class Judge {
 public:
  /// All of them live as long as this.
  Judge(const mechanics::Plan& plan, const Unknowns& unknowns, const std::vector<Demand>& demands,
        const SampledMotion& motion);

  /// Gives every pair the side on which it is furthest apart in the motion as it was last evaluated.
  void choose_sides();

  /// Residuals above `least`, and the greatest of all. Of the motion as it was last evaluated, at x.
  struct Findings {
    std::vector<Judged> rows;
    double worst = 0.0;
  };
  [[nodiscard]] Findings find(const Eigen::VectorXd& x, double least) const;

  /// One residual, and gradient = its change by x.
  double residual(const Row& row, const Eigen::VectorXd& x, Eigen::Ref<Eigen::VectorXd> gradient) const;

 private:
  struct Gap {
    double distance_m = 0.0;
    Eigen::Vector3d along = Eigen::Vector3d::Zero();  ///< unit, from the first to the second
    double first_share = 1.0, second_share = 1.0;     ///< how far along their cables the closest points are
  };
  /// How far apart on a side, and how that changes with either carrier's place.
  struct Side {
    double distance_m = 0.0;
    Eigen::Vector3d by_first = Eigen::Vector3d::Zero(), by_second = Eigen::Vector3d::Zero();
  };
  [[nodiscard]] Side side(const Row& row, const Eigen::Vector3d& along) const;
  [[nodiscard]] const Eigen::Vector3d& chosen(const Row& row) const {
    return sides_[row.first * motion_.carriers() + row.second];
  }
  [[nodiscard]] Gap separation(const Row& row) const;
  [[nodiscard]] Gap clearance(const Row& row) const;
  [[nodiscard]] double value(const Row& row, const Eigen::VectorXd& x) const;

  const mechanics::Plan& plan_;
  const Unknowns& unknowns_;
  const std::vector<Demand>& demands_;
  const SampledMotion& motion_;
  std::vector<Eigen::Vector3d> sides_;  ///< of pairs, by first and second
};

}  // namespace gyre::design
