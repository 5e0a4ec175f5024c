#pragma once
// The tones of a picture, each for light and for dark paper, and the style that chooses between them.
//
// A reader that knows no style sheets draws the light ones. Carriers have twelve, in an order that keeps the first ones
// furthest apart for eyes without red or green; after twelve they come again, with another dash.

#include <cstddef>
#include <string>

namespace gyre::ground {

struct Tone {
  const char* name;
  const char* light;
  const char* dark;
};

inline constexpr Tone kPaper{"paper", "#ffffff", "#0d1117"};
inline constexpr Tone kInk{"ink", "#1f2328", "#e6edf3"};
inline constexpr Tone kMuted{"muted", "#59636e", "#9198a1"};
inline constexpr Tone kGrid{"grid", "#d1d9e0", "#30363d"};
inline constexpr Tone kLoad{"load", "#8b949e", "#7d8590"};
inline constexpr Tone kGood{"good", "#1a7f37", "#3fb950"};
inline constexpr Tone kBad{"bad", "#c21f2b", "#ff7b72"};

/// Of the carrier at this place in the plan.
[[nodiscard]] const Tone& carrier_tone(std::size_t index);

/// Of its lines, as in Stroke.
[[nodiscard]] const char* carrier_dash(std::size_t index);

/// Every tone as on light paper, as the declarations of a rule: for what is printed.
[[nodiscard]] std::string light_tones();

/// The style sheet: every tone as a class, by the paper the reader prefers.
[[nodiscard]] std::string style_sheet();

}  // namespace gyre::ground
