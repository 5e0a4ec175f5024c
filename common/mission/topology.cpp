#include "common/mission/topology.hpp"

#include <map>
#include <string>

#include "common/base/text.hpp"

namespace gyre::mission {
namespace {

using mechanics::Edge;
using mechanics::Plan;

/// Attachments closer than this give an edge no direction that means anything.
constexpr double kLeastEdgeLengthM = 1e-6;

std::string edge_text(CarrierId from, CarrierId to) {
  return "edge { from: " + std::to_string(from) + " to: " + std::to_string(to) + " }";
}

class CycleJudge {
 public:
  CycleJudge(const Plan& plan, const LocatedEdges& edges) : plan_(plan), edges_(edges) {
    for (const mechanics::Carrier& carrier : plan.carriers) {
      if (carrier.id == 0) continue;
      ids_.push_back(carrier.id);
      attachments_.emplace(carrier.id, carrier.attachment_b_m);
    }
  }

  void judge() {
    if (ids_.size() < plan_.carriers.size()) return;  // with ids unknown, everything would look like a stranger
    if (ids_.size() == 1) return judge_single();
    judge_ends();
    if (ids_.size() == 2) return judge_pair();
    judge_order();
    judge_visits();
  }

 private:
  void judge_single() const {
    if (edges_.places.empty()) return;
    edges_.places.front().complain("a single carrier has no edge; leave the edges out");
  }

  void judge_pair() const {
    if (edges_.places.size() == 1) return;
    edges_.cycle.complain("edge", "two carriers share exactly one edge, here are " +
                                      std::to_string(edges_.places.size()) + "; write " + edge_text(ids_[0], ids_[1]));
  }

  void judge_ends() {
    for (std::size_t j = 0; j < edges_.places.size(); ++j) {
      const Edge& edge = plan_.cycle.edges[j];
      const bool from_known = judge_end(edges_.places[j], "from", edge.from);
      const bool to_known = judge_end(edges_.places[j], "to", edge.to);
      if (!from_known || !to_known) continue;
      if (edge.from == edge.to) {
        edges_.places[j].complain("to", "carrier " + std::to_string(edge.to) +
                                            " has an edge to itself; an edge joins two different carriers");
      } else if ((attachments_.at(edge.from) - attachments_.at(edge.to)).norm() < kLeastEdgeLengthM) {
        edges_.places[j].complain("carriers " + std::to_string(edge.from) + " and " + std::to_string(edge.to) +
                                  " have the same attachment point, so their edge has no direction; move one of the "
                                  "attachments, or order the cycle so that they are not neighbours");
      }
    }
  }

  bool judge_end(const Located& place, const char* end, CarrierId id) {
    if (id == 0) {
      ends_unknown_ = true;
      return false;
    }
    if (attachments_.count(id) != 0) return true;
    ends_unknown_ = true;
    place.complain(end, "no carrier has id " + std::to_string(id) + "; there are " + listed("carrier", ids_));
    return false;
  }

  void judge_order() const {
    const std::vector<Edge>& edges = plan_.cycle.edges;
    for (std::size_t j = 0; j < edges.size(); ++j) {
      const Edge& before = edges[j == 0 ? edges.size() - 1 : j - 1];
      if (edges[j].from == 0 || before.to == 0 || edges[j].from == before.to) continue;
      const char* which = j == 0 ? ", but the last edge ends at " : ", but the edge before it ends at ";
      edges_.places[j].complain("from", "starts at " + std::to_string(edges[j].from) + which +
                                            std::to_string(before.to) +
                                            "; write the edges in order of travel, each from where the one before "
                                            "ended, and the last one back to the first carrier");
    }
  }

  void judge_visits() const {
    if (ends_unknown_) return;
    std::map<CarrierId, int> departures;
    for (const Edge& edge : plan_.cycle.edges) ++departures[edge.from];
    const std::string rule = "; a Hamiltonian cycle over " + std::to_string(ids_.size()) + " carriers has " +
                             std::to_string(ids_.size()) + " edges and visits every carrier exactly once";
    for (const CarrierId id : ids_) {
      const int times = departures[id];
      if (times == 1) continue;
      edges_.cycle.complain("edge", "carrier " + std::to_string(id) + " is visited " +
                                        (times == 0   ? std::string("never")
                                         : times == 2 ? std::string("twice")
                                                      : std::to_string(times) + " times") +
                                        rule);
    }
  }

  const Plan& plan_;
  const LocatedEdges& edges_;
  std::vector<CarrierId> ids_;
  std::map<CarrierId, Eigen::Vector3d> attachments_;
  bool ends_unknown_ = false;
};

}  // namespace

void judge_cycle(const Plan& plan, const LocatedEdges& edges) {
  CycleJudge(plan, edges).judge();
}

}  // namespace gyre::mission
