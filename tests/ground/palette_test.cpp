// Tones that are told apart: by eyes that lack red, green or blue, on light paper and on dark.

#include "ground/plot/core/palette.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <string>

namespace gyre::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d rows(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  return (Matrix3d() << a.transpose(), b.transpose(), c.transpose()).finished();
}

/// "#rrggbb" in linear light.
Vector3d linear(const std::string& tone) {
  Vector3d out;
  for (int k = 0; k < 3; ++k) {
    const double c = std::stoi(tone.substr(1 + 2 * static_cast<std::size_t>(k), 2), nullptr, 16) / 255.0;
    out[k] = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  }
  return out;
}

/// Oklab (Ottosson), lightness from 0 to 100: what is as far apart looks as far apart.
Vector3d perceived(const Vector3d& light) {
  static const Matrix3d kCones =
      rows({0.4122214708, 0.5363325363, 0.0514459929}, {0.2119034982, 0.6806995451, 0.1073969566},
           {0.0883024619, 0.2817188376, 0.6299787005});
  static const Matrix3d kOpponents =
      rows({0.2104542553, 0.7936177850, -0.0040720468}, {1.9779984951, -2.4285922050, 0.4505937099},
           {0.0259040371, 0.7827717662, -0.8086757660});
  const Vector3d cones = kCones * light.cwiseMax(0.0).cwiseMin(1.0);
  return 100.0 * (kOpponents * cones.unaryExpr([](double c) { return std::cbrt(c); }));
}

/// What such eyes see (Machado, Oliveira, Fernandes: severity 1).
const Matrix3d kEyes[] = {
    Matrix3d::Identity(),
    rows({0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}),
    rows({0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}),
    rows({1.255528, -0.076749, -0.178779}, {-0.078411, 0.930809, 0.147602}, {0.004733, 0.691367, 0.303900})};

double luminance(const std::string& tone) {
  return linear(tone).dot(Vector3d(0.2126, 0.7152, 0.0722));
}

double contrast(const std::string& a, const std::string& b) {
  const double x = luminance(a), y = luminance(b);
  return (std::max(x, y) + 0.05) / (std::min(x, y) + 0.05);
}

TEST(Palette, CarriersAreToldApartByAllEyes) {
  constexpr double kClearly = 9.0, kJust = 4.5;  // 2 is what is just seen side by side
  for (const bool dark : {false, true}) {
    for (const Matrix3d& eye : kEyes) {
      for (std::size_t i = 0; i < 12; ++i) {
        for (std::size_t j = 0; j < i; ++j) {
          const ground::Tone &a = ground::carrier_tone(i), &b = ground::carrier_tone(j);
          const double apart =
              (perceived(eye * linear(dark ? a.dark : a.light)) - perceived(eye * linear(dark ? b.dark : b.light)))
                  .norm();
          EXPECT_GE(apart, i < 6 ? kClearly : kJust) << a.name << " and " << b.name << (dark ? ", dark" : ", light");
        }
      }
    }
  }
}

TEST(Palette, LinesAndWordsStandOutFromThePaper) {
  for (std::size_t i = 0; i < 12; ++i) {
    const ground::Tone& tone = ground::carrier_tone(i);
    EXPECT_GE(contrast(tone.light, ground::kPaper.light), 3.0) << tone.name;
    EXPECT_GE(contrast(tone.dark, ground::kPaper.dark), 3.0) << tone.name;
  }
  for (const ground::Tone& tone : {ground::kInk, ground::kMuted, ground::kGood, ground::kBad}) {
    EXPECT_GE(contrast(tone.light, ground::kPaper.light), 4.5) << tone.name;
    EXPECT_GE(contrast(tone.dark, ground::kPaper.dark), 4.5) << tone.name;
  }
}

TEST(Palette, TwelveComeAgainWithAnotherDash) {
  EXPECT_STREQ(ground::carrier_tone(13).name, ground::carrier_tone(1).name);
  for (std::size_t i = 0; i < 64; ++i) {
    for (std::size_t j = i % 12; j < i; j += 12)
      EXPECT_STRNE(ground::carrier_dash(i), ground::carrier_dash(j)) << i << " and " << j;
  }
}

}  // namespace
}  // namespace gyre::test
