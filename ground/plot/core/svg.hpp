#pragma once
// An SVG as it is drawn: elements that nest and close by themselves, text that is escaped, numbers with few digits.
//
// Lengths and places are px of the picture, x to the right and y down. Everything is drawn in the tone of the group it
// is in (palette.hpp); what is drawn later covers what was drawn before.

#include <string>
#include <vector>

#include "ground/plot/core/palette.hpp"

namespace gyre::ground {

struct Point {
  double x = 0.0, y = 0.0;
};

struct Box {
  double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;

  [[nodiscard]] double width() const { return right - left; }
  [[nodiscard]] double height() const { return bottom - top; }
};

struct Stroke {
  double width = 1.0;
  double opacity = 1.0;
  std::string dash = {};  ///< lengths drawn and left out; empty: drawn all along
  double dash_offset = 0.0;
};

enum class Anchor { kStart, kMiddle, kEnd };

struct Font {
  double size = 12.0;
  Anchor anchor = Anchor::kStart;
  bool bold = false;
  bool halo = false;  ///< a rim of paper, for text across lines
};

class Svg {
 public:
  void begin(const Tone& tone);
  void end();

  void line(Point from, Point to, const Stroke& stroke);
  void path(const std::vector<Point>& points, const Stroke& stroke);
  void area(const std::vector<Point>& corners, double opacity);
  void box(const Box& box, double opacity, double corner_radius = 0.0);
  void disc(Point centre, double radius, double opacity);
  void ring(Point centre, double radius, const Stroke& stroke);
  /// `place` is on the baseline.
  void words(Point place, const std::string& words, const Font& font);

  /// The whole file; `title` and `description` are what a screen reader reads.
  [[nodiscard]] std::string finished(double width, double height, const std::string& title,
                                     const std::string& description) &&;

 private:
  struct Attribute;
  void element(const char* tag, const std::vector<Attribute>& attributes, const std::string* content = nullptr);
  void outline(const char* tag, std::vector<Attribute> attributes, const Stroke& stroke);

  std::string out_;
  int open_ = 0;
};

/// In any text or attribute; what XML cannot say is replaced by the sign for that (U+FFFD).
[[nodiscard]] std::string escaped(const std::string& words);

/// As wide as a wide font draws it: rather too long than too short.
[[nodiscard]] double width_of(const std::string& words, double font_size);

/// As much of the words as fits, with dots where some are left out.
[[nodiscard]] std::string shortened(const std::string& words, double font_size, double width);

}  // namespace gyre::ground
