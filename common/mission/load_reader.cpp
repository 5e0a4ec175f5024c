#include "common/mission/load_reader.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "common/mission/spans.hpp"

namespace gyre::mission {
namespace {

constexpr double kUnitTolerance = 1e-6;     // of the norm of a quaternion
constexpr double kInertiaTolerance = 1e-5;  // moments of a flat body, written with six digits
constexpr Span kEdgeM{1e-6, 1e5, "m"};
constexpr int kMaxVertices = 64;

Eigen::Matrix3d read_inertia(const Located& inertia) {
  const auto entry = [&](const char* field) { return inertia.number(field, kInertia, 0.0); };
  const double xy = entry("xy");
  const double xz = entry("xz");
  const double yz = entry("yz");
  Eigen::Matrix3d matrix;
  matrix << entry("x"), xy, xz,  //
      xy, entry("y"), yz,        //
      xz, yz, entry("z");
  const Eigen::Vector3d principal =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
  const std::string moments =
      "the principal moments are " + show(principal[0]) + ", " + show(principal[1]) + ", " + show(principal[2]);
  if (principal[0] <= 0.0) {
    inertia.complain(moments + "; all three have to be positive");
  } else if (principal[0] + principal[1] < principal[2] * (1.0 - kInertiaTolerance)) {
    inertia.complain(moments + "; no body has one that is greater than the sum of the other two: check the units");
  }
  return matrix;
}

Eigen::Quaterniond read_orientation(const Located& load) {
  if (!load.has("orientation")) return Eigen::Quaterniond::Identity();
  const Located node = load.child("orientation");
  const auto component = [&](const char* field) { return node.number(field, kComponent, 0.0); };
  const Eigen::Quaterniond q(component("w"), component("x"), component("y"), component("z"));
  const double norm = q.norm();
  if (std::abs(norm - 1.0) > kUnitTolerance) {
    std::string cure = "give a unit quaternion (to " + show(kUnitTolerance) + ")";
    if (norm > 0.0) {
      cure += ", for instance w: " + show(q.w() / norm) + " x: " + show(q.x() / norm) + " y: " + show(q.y() / norm) +
              " z: " + show(q.z() / norm);
    }
    node.complain("has norm " + show(norm) + "; " + cure);
    return Eigen::Quaterniond::Identity();
  }
  return q.normalized();
}

std::vector<Eigen::Vector3d> read_box(const Located& box) {
  const Eigen::Vector3d half =
      0.5 * Eigen::Vector3d(box.number("x_m", kEdgeM), box.number("y_m", kEdgeM), box.number("z_m", kEdgeM));
  return mechanics::box_hull(half, box.vector("centre_m", kPlaceM));
}

std::vector<Eigen::Vector3d> read_hull(const Located& hull) {
  std::vector<Eigen::Vector3d> out;
  const int count = hull.count("vertex_m");
  if (count < 4 || count > kMaxVertices) {
    hull.complain("vertex_m", "there are " + std::to_string(count) + "; a hull has 4 to " +
                                  std::to_string(kMaxVertices) + " vertices");
    return out;
  }
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Located& vertex : hull.children("vertex_m")) {
    const auto coordinate = [&vertex](const char* field) { return vertex.number(field, kPlaceM, 0.0); };
    mean += out.emplace_back(coordinate("x"), coordinate("y"), coordinate("z")) / count;
  }
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& v : out) spread += (v - mean) * (v - mean).transpose();
  const Eigen::Vector3d extent =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread, Eigen::EigenvaluesOnly).eigenvalues();
  if (!(extent[0] > 1e-12 * extent[2])) {
    hull.complain("vertex_m", "all vertices are in one plane; a load has a volume: give its hull thickness");
  }
  return out;
}

std::vector<Eigen::Vector3d> read_shape(const Located& shape) {
  if (shape.has("box")) return read_box(shape.child("box"));
  if (shape.has("hull")) return read_hull(shape.child("hull"));
  shape.complain("says nothing; give box { x_m: .. y_m: .. z_m: .. } or hull { vertex_m { .. } .. }");
  return {};
}

}  // namespace

mechanics::Load read_load(const Located& load) {
  mechanics::Load out;
  out.mass_kg = load.number("mass_kg", kMassKg);
  const Located inertia =
      load.required_child("inertia_kg_m2", "give inertia_kg_m2 { x: .. y: .. z: .. } in the body frame");
  if (load.has("inertia_kg_m2")) out.inertia_b_kg_m2 = read_inertia(inertia);
  out.position_w_m = load.vector("position_m", kPlaceM);
  out.orientation_w_b = read_orientation(load);
  if (load.has("shape")) out.hull_b_m = read_shape(load.child("shape"));
  return out;
}

}  // namespace gyre::mission
