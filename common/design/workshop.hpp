#pragma once
// A place where candidates are made and searched: what a designer, a price and a conflict have in common.
//
//   symbol     meaning
//   family     a plan's shape with a few factors (unknowns.hpp)
//   whole      every open number by itself
//   meets      its worst residual at the samples is at most 0
//
// Reference: search.hpp.

#include <cstdint>

#include "common/base/random_stream.hpp"
#include "common/design/closed_form.hpp"
#include "common/design/design.hpp"
#include "common/design/search.hpp"

namespace gyre::design {

struct Candidate {
  Start start;
  Unknowns unknowns;
  Point point;
  bool family = true;
  bool swings = false;  ///< the certificate refused it for a swing that grows

  [[nodiscard]] bool meets() const { return point.worst <= 0.0; }
  [[nodiscard]] mechanics::Plan plan() const { return plan_at(start.plan, unknowns, point.x); }
};

/// Those that meet all demands before those that do not, and of either the better ones.
[[nodiscard]] bool before(const Candidate& a, const Candidate& b);

class Workshop {
 public:
  /// `requirements` and `keep_going` live as long as this.
  Workshop(const Requirements& requirements, std::uint64_t seed, const KeepGoing& keep_going);

  [[nodiscard]] const Requirements& requirements() const { return requirements_; }
  [[nodiscard]] const std::vector<Demand>& demands() const { return demands_; }
  /// Demands other than the requirements': what meets them is not told as progress any more.
  void demand(std::vector<Demand> demands) {
    demands_ = std::move(demands);
    own_demands_ = false;
  }
  /// Another margin, and so many times the samples, after the certificate saw what they did not.
  void tighten(double margin, int finer) {
    margin_ = margin;
    finer_ = finer;
  }

  /// Asks whether to go on, with what is being done; once it was told no, the answer stays no.
  [[nodiscard]] bool going(const std::string& doing);
  [[nodiscard]] bool stopped() const { return stopped_; }

  [[nodiscard]] std::vector<Order> orders() const { return orders_of(requirements_, seed_); }
  /// A closed form in that order.
  [[nodiscard]] Start start(const Order& order, double pull) const {
    return start_of(requirements_, order, scales_, bounds_, pull);
  }
  /// The family of a closed form, met in a hurry.
  [[nodiscard]] Candidate family(const Order& order, double pull);
  /// All that is open, from a family or another whole, met and improved; the second one from `shaken` away of it, by so
  /// much of each variable.
  [[nodiscard]] Candidate whole(const Candidate& from);
  [[nodiscard]] Candidate whole(const Candidate& from, double shaken, RandomStream& stream);
  /// Meets and improves a candidate from where it is.
  void settle(Candidate& candidate, const std::string& doing);
  /// Meets what was all but met, though it is time to end, and improves it if it is not.
  void mend(Candidate& candidate, const std::string& doing);
  /// The same, slower and faster by enough to leave a resonance; none where the rate is given.
  [[nodiscard]] std::vector<Candidate> at_other_rates(const Candidate& candidate, const std::string& doing);
  /// Only meets.
  void meet_demands(Candidate& candidate, const std::string& doing);

  /// The objective's figure as a person is told it.
  [[nodiscard]] double figure(const Candidate& candidate) const;
  /// Whether one figure is better than another.
  [[nodiscard]] bool better(double figure, double than) const;
  /// At the samples: the greatest residual of each demand.
  [[nodiscard]] std::vector<double> residuals(const Candidate& candidate) const;
  /// The demand whose limit is the objective.
  [[nodiscard]] std::vector<std::size_t> raised() const;

 private:
  [[nodiscard]] Candidate opened(const Candidate& from) const;
  [[nodiscard]] Search search_of(const Candidate& candidate, const std::string& doing, int samples);
  [[nodiscard]] int samples() const;
  void note(const Candidate& candidate);

  const Requirements& requirements_;
  std::uint64_t seed_;
  const KeepGoing& keep_going_;
  Scales scales_;
  Bounds bounds_;
  std::vector<Demand> demands_;
  double margin_ = 2e-3;
  int finer_ = 1;
  bool own_demands_ = true;
  std::optional<double> best_;
  bool stopped_ = false;
};

}  // namespace gyre::design
