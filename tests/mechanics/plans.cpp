#include "tests/mechanics/plans.hpp"

#include <rapidcheck.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>

#include "common/mechanics/grasp.hpp"
#include "common/mechanics/orbit_figures.hpp"
#include "tests/places.hpp"

namespace gyre::mechanics::test {
namespace {

using Json = nlohmann::json;

Eigen::Vector3d vector(const Json& j) {
  return {j.at(0).get<double>(), j.at(1).get<double>(), j.at(2).get<double>()};
}

/// A number for all edges, or one for each.
double of_edge(const Json& j, std::size_t edge) {
  return j.is_array() ? j.at(edge).get<double>() : j.get<double>();
}

Harmonic harmonic(double rate_rad_s, double cycle_rate_rad_s) {
  for (int denominator = 1; denominator <= 16; ++denominator) {
    const double numerator = rate_rad_s / cycle_rate_rad_s * denominator;
    if (std::abs(numerator - std::round(numerator)) < 1e-12)
      return {static_cast<int>(std::lround(numerator)), denominator};
  }
  return {};
}

LengthLaw law(const Json& j, double cycle_rate_rad_s) {
  const auto kind = j.at("law").get<std::string>();
  if (kind == "level") return LengthLaw::level(j.at("altitude").get<double>());
  if (kind == "fixed") return LengthLaw::fixed(j.at("length").get<double>());
  const Oscillation profile{j.at("mean").get<double>(), j.at("swing").get<double>(),
                            harmonic(j.at("rate").get<double>(), cycle_rate_rad_s), j.at("phase").get<double>()};
  return kind == "sine" ? LengthLaw::sine(profile) : LengthLaw::directional(vector(j.at("direction")), profile);
}

LengthLaw random_law(const Eigen::Vector3d& attachment_w_m, bool mixed) {
  const LengthLaw level = LengthLaw::level(attachment_w_m.z() + real(3.0, 8.0));
  if (!mixed) return level;
  const Harmonic harmonic{static_cast<int>(whole(1, 3)), static_cast<int>(whole(1, 3))};
  const double phase_rad = real(-kPi, kPi);
  switch (whole(0, 4)) {
    case 0:
      return level;
    case 1:
      return LengthLaw::sine({real(3.0, 6.0), real(-1.0, 1.0), harmonic, phase_rad});
    case 2:
      return LengthLaw::fixed(real(1.0, 6.0));
    default:
      const Eigen::Vector3d u = Eigen::Vector3d(real(-0.4, 0.4), real(-0.4, 0.4), 1.0).normalized();
      return LengthLaw::directional(u, {u.dot(attachment_w_m) + real(4.0, 8.0), real(-1.0, 1.0), harmonic, phase_rad});
  }
}

/// Whether every cable stays well away from slack, from the horizontal and from the plane its law projects on.
bool well_away(const Plan& plan) {
  for (const CarrierSlice& slice : slices(plan)) {
    const CarrierFigures figures = orbit_figures(slice);
    if (figures.vertical_cosine.min < 0.25 || figures.direction_cosine_min.value_or(1.0) < 0.25) return false;
  }
  return true;
}

}  // namespace

double real(double low, double high) {
  constexpr int kSteps = 1'000'000;
  // Full size always: a property about geometry has no small cases to start from.
  return low + (high - low) * *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(0, kSteps + 1)) / kSteps;
}

std::size_t whole(std::size_t low, std::size_t high) {
  return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(low, high + 1));
}

Plan reference_plan(const std::string& name) {
  std::ifstream file(gyre::test::source_directory() + "/tests/data/reference/cases/" + name + ".json");
  const Json j = Json::parse(file);
  Plan plan;
  plan.load.mass_kg = j.at("mass").get<double>();
  plan.load.inertia_b_kg_m2 = 0.01 * Eigen::Matrix3d::Identity();
  if (j.contains("position")) plan.load.position_w_m = vector(j.at("position"));
  if (j.contains("rotation")) {
    Eigen::Matrix3d rotation;
    for (int i = 0; i < 3; ++i) rotation.row(i) = vector(j.at("rotation").at(static_cast<std::size_t>(i)));
    plan.load.orientation_w_b = Eigen::Quaterniond(rotation);
  }
  plan.gravity_m_s2 = j.at("gravity").get<double>();
  plan.cable = {1e4, 1e3};
  plan.cycle.rate_rad_s = j.at("rate").get<double>();
  CarrierId id = 0;
  for (const Json& attachment : j.at("attachments")) {
    plan.carriers.push_back({id + 1, vector(attachment), law(j.at("length").at(id), plan.cycle.rate_rad_s)});
    ++id;
  }
  const auto order = j.at("cycle").get<std::vector<CarrierId>>();
  for (std::size_t e = 0; e < (order.size() == 2 ? 1 : order.size()); ++e) {
    plan.cycle.edges.push_back({order[e], order[(e + 1) % order.size()], of_edge(j.at("offset"), e),
                                of_edge(j.at("amplitude"), e), of_edge(j.at("phase"), e)});
  }
  return plan;
}

Plan paper_plan() {
  return reference_plan("paper-level");
}

Plan polygon_plan(std::size_t n) {
  Plan plan;
  plan.load.mass_kg = 2.0;
  plan.load.inertia_b_kg_m2 = Eigen::Vector3d(0.2, 0.3, 0.4).asDiagonal();
  plan.cable = {1e4, 1e3};
  plan.cycle.rate_rad_s = 0.5;
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = 2.0 * kPi * static_cast<double>(i) / static_cast<double>(n);
    const auto id = static_cast<CarrierId>(i + 1);
    plan.carriers.push_back({id, {2.0 * std::cos(angle), 2.0 * std::sin(angle), 0.3}, LengthLaw::level(3.0)});
    plan.cycle.edges.push_back({id, static_cast<CarrierId>((i + 1) % n + 1), 0.0, 4.0 / static_cast<double>(n), 0.0});
  }
  take_edge_headings(plan);
  return plan;
}

void take_edge_headings(Plan& plan) {
  const std::vector<Eigen::Vector3d> arms = lever_arms(plan);
  const auto arm = [&](CarrierId id) {
    for (std::size_t i = 0; i < arms.size(); ++i) {
      if (plan.carriers[i].id == id) return arms[i];
    }
    return Eigen::Vector3d(Eigen::Vector3d::Zero());
  };
  for (Edge& edge : plan.cycle.edges) {
    const Eigen::Vector3d travelled = arm(edge.to) - arm(edge.from);
    edge.phase_rad = std::atan2(travelled.y(), travelled.x());
  }
}

Plan random_plan(const RandomPlan& wish) {
  const std::size_t n = whole(wish.carriers_min, wish.carriers_max);
  Plan plan;
  plan.load.mass_kg = real(0.2, 20.0);
  plan.load.inertia_b_kg_m2 = Eigen::Vector3d(real(0.01, 1.0), real(0.01, 1.0), real(0.01, 1.0)).asDiagonal();
  plan.load.position_w_m = {real(-10.0, 10.0), real(-10.0, 10.0), real(-10.0, 10.0)};
  if (wish.tilted) {
    const Eigen::Vector3d axis(real(-1.0, 1.0), real(-1.0, 1.0), real(0.1, 1.0));
    plan.load.orientation_w_b = Eigen::AngleAxisd(real(0.0, 0.3), axis.normalized());
  }
  plan.gravity_m_s2 = real(1.0, 20.0);
  plan.cable = {real(1e3, 1e5), 1e3};
  // The centre of mass stays inside the polygon, or some cables would have to push.
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = 2.0 * kPi * (static_cast<double>(i) + real(-0.3, 0.3)) / static_cast<double>(n);
    const double radius = real(0.8, 1.2);
    const Eigen::Vector3d b(radius * std::cos(angle), radius * std::sin(angle), real(0.1, 0.5));
    plan.carriers.push_back({static_cast<CarrierId>(i + 1), b, {}});
  }
  return random_motion(plan, wish.mixed_laws);
}

Plan random_motion(Plan plan, bool mixed_laws) {
  const std::size_t n = plan.carriers.size();
  const std::vector<Eigen::Vector3d> arms = lever_arms(plan);
  for (std::size_t i = 0; i < n; ++i) {
    plan.carriers[i].law = random_law(plan.load.position_w_m + arms[i], mixed_laws);
  }
  std::vector<CarrierId> order(n);
  std::iota(order.begin(), order.end(), 1U);
  for (std::size_t i = n - 1; i > 0; --i) std::swap(order[i], order[whole(0, i)]);
  const double share = plan.load.mass_kg * plan.gravity_m_s2 / static_cast<double>(n);
  plan.cycle = {real(0.05, 2.0), {}};
  for (std::size_t e = 0; e < (n == 2 ? 1 : n); ++e) {
    plan.cycle.edges.push_back(
        {order[e], order[(e + 1) % n], share * real(-0.5, 0.5), share * real(0.1, 0.6), real(-kPi, kPi)});
  }
  for (int attempt = 0; attempt < 6 && !well_away(plan); ++attempt) {
    for (Edge& edge : plan.cycle.edges) {
      edge.offset_n *= 0.5;
      edge.amplitude_n *= 0.5;
    }
  }
  RC_PRE(well_away(plan));
  return plan;
}

Plan still_plan(const Plan& plan, double theta_rad) {
  Plan still = plan;
  for (Edge& edge : still.cycle.edges) {
    edge.offset_n += edge.amplitude_n * std::sin(theta_rad + edge.phase_rad);
    edge.amplitude_n = 0.0;
  }
  for (Carrier& carrier : still.carriers) {
    Oscillation& profile = carrier.law.profile;
    profile.mean += profile.swing * std::sin(profile.harmonic.ratio() * theta_rad + profile.phase_rad);
    profile.swing = 0.0;
  }
  return still;
}

Eigen::Matrix<double, 6, 1> wrench(const Plan& plan, const std::vector<Eigen::Vector3d>& forces_w_n) {
  Eigen::VectorXd stacked(3 * static_cast<Eigen::Index>(forces_w_n.size()));
  for (std::size_t i = 0; i < forces_w_n.size(); ++i)
    stacked.segment<3>(3 * static_cast<Eigen::Index>(i)) = forces_w_n[i];
  return grasp_map(lever_arms(plan)) * stacked;
}

Vector6d wrench_of_moving(const Plan& plan, const std::vector<CarrierSlice>& all, double t_s, double pace,
                          const Vector6d& moved, const Vector6d& velocity) {
  const Eigen::Vector3d turn = moved.tail<3>();
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  if (turn.norm() > 0.0) rotation = Eigen::AngleAxisd(turn.norm(), turn.normalized());
  Vector6d sum = Vector6d::Zero();
  for (const CarrierSlice& slice : all) {
    const Reference r = evaluate(slice, t_s);
    const Eigen::Vector3d arm = rotation * (slice.attachment_w_m - plan.load.position_w_m);
    const Eigen::Vector3d cable = r.position_w_m.value - (plan.load.position_w_m + moved.head<3>() + arm);
    const Eigen::Vector3d arm_rate = velocity.head<3>() + velocity.tail<3>().cross(arm);
    const double rate = cable.normalized().dot(pace * r.position_w_m.first - arm_rate) - pace * r.length_m.first;
    const double tension = r.tension_n.value + plan.cable.stiffness_n_m * (cable.norm() - r.length_m.value) +
                           plan.cable.damping_n_s_m * rate;
    const Eigen::Vector3d f = tension * cable.normalized();
    sum.head<3>() += f;
    sum.tail<3>() += arm.cross(f);
  }
  return sum;
}

void sample(double begin_s, double end_s, int count, const std::function<void(double t_s)>& visit) {
  for (int i = 0; i <= count; ++i) visit(begin_s + (end_s - begin_s) * i / count);
}

}  // namespace gyre::mechanics::test
