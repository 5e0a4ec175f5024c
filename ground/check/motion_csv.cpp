#include "ground/check/motion_csv.hpp"

#include <charconv>

#include "common/base/ensure.hpp"
#include "common/mechanics/carrier_slice.hpp"
#include "common/mechanics/reference.hpp"

namespace gyre::ground {
namespace {

constexpr const char* kHeader =
    "t_s,carrier,fx_N,fy_N,fz_N,tension_N,qx,qy,qz,qdx,qdy,qdz,length_m,length_rate_mps,"
    "px_m,py_m,pz_m,vx_mps,vy_mps,vz_mps\n";

/// The shortest digits that read back to the same bits.
void append(std::string& out, double value) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  out.append(digits, end);
}

template <class Vector>
void append_vector(std::string& out, const Vector& v) {
  for (int i = 0; i < 3; ++i) {
    out += ',';
    append(out, v[i]);
  }
}

void append_row(std::string& out, double t_s, const mechanics::CarrierSlice& slice) {
  const mechanics::Reference now = mechanics::evaluate(slice, t_s);
  append(out, t_s);
  out += "," + std::to_string(slice.id);
  append_vector(out, now.force_w_n.value);
  out += ',';
  append(out, now.tension_n.value);
  append_vector(out, now.direction_w.value);
  append_vector(out, now.direction_w.first);
  out += ',';
  append(out, now.length_m.value);
  out += ',';
  append(out, now.length_m.first);
  append_vector(out, now.position_w_m.value);
  append_vector(out, now.position_w_m.first);
  out += '\n';
}

}  // namespace

std::string motion_csv(const mechanics::Plan& plan, int count) {
  GYRE_ENSURE(count >= 2, "a period has two ends");
  const std::vector<mechanics::CarrierSlice> slices = mechanics::slices(plan);
  const double period = mechanics::period_s(plan);
  std::string out = kHeader;
  for (int k = 0; k < count; ++k) {
    const double t_s = period * k / (count - 1);
    for (const mechanics::CarrierSlice& slice : slices) append_row(out, t_s, slice);
  }
  return out;
}

}  // namespace gyre::ground
