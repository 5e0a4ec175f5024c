#include "ground/plot/core/svg.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "common/base/ensure.hpp"
#include "common/base/text.hpp"

namespace gyre::ground {
namespace {

constexpr const char* kFonts = "system-ui, -apple-system, 'Segoe UI', Roboto, 'Helvetica Neue', Arial, sans-serif";
constexpr const char* kReplacement = "\xEF\xBF\xBD";
constexpr double kHaloWidth = 3.0;

std::string number(double value, int decimals) {
  std::string out = text("%.*f", decimals, value);
  if (decimals > 0) out.erase(out.find_last_not_of('0') + 1);
  if (out.back() == '.') out.pop_back();
  return out == "-0" ? "0" : out;
}

/// A tenth of a px is finer than anybody sees, and keeps curves short.
std::string places(const std::vector<Point>& points) {
  std::string out;
  for (const Point& point : points) {
    out += (out.empty() ? "" : " ") + number(point.x, 1) + "," + number(point.y, 1);
  }
  return out;
}

/// Bytes of the character that begins here, 0 where none does (UTF-8).
std::size_t character_at(const std::string& words, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(i < words.size() ? words[i] : 0); };
  const std::uint8_t lead = byte(at);
  const std::size_t bytes = lead < 0x80                   ? 1
                            : lead >= 0xC2 && lead < 0xE0 ? 2
                            : (lead & 0xF0) == 0xE0       ? 3
                            : lead >= 0xF0 && lead < 0xF5 ? 4
                                                          : 0;
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(at + i) & 0xC0) != 0x80) return 0;
  }
  const std::uint8_t second = byte(at + 1);
  const bool overlong = (lead == 0xE0 && second < 0xA0) || (lead == 0xF0 && second < 0x90);
  const bool surrogate = lead == 0xED && second >= 0xA0;
  const bool beyond = lead == 0xF4 && second >= 0x90;
  const bool no_character = lead == 0xEF && second == 0xBF && byte(at + 2) >= 0xBE;
  return overlong || surrogate || beyond || no_character ? 0 : bytes;
}

const char* word(Anchor anchor) {
  return anchor == Anchor::kStart ? "start" : anchor == Anchor::kMiddle ? "middle" : "end";
}

}  // namespace

struct Svg::Attribute {
  Attribute(const char* n, double v) : name(n), value(number(v, 2)) {}
  Attribute(const char* n, const char* v) : name(n), value(v) {}
  Attribute(const char* n, std::string v) : name(n), value(std::move(v)) {}

  const char* name;
  std::string value;
};

void Svg::begin(const Tone& tone) {
  out_ += std::string("<g class=\"") + tone.name + "\" color=\"" + tone.light + "\">\n";
  ++open_;
}

void Svg::end() {
  GYRE_ENSURE(open_ > 0, "no group is open");
  out_ += "</g>\n";
  --open_;
}

void Svg::element(const char* tag, const std::vector<Attribute>& attributes, const std::string* content) {
  out_ += std::string("<") + tag;
  for (const Attribute& attribute : attributes)
    out_ += std::string(" ") + attribute.name + "=\"" + escaped(attribute.value) + "\"";
  out_ += content ? ">" + escaped(*content) + "</" + tag + ">\n" : "/>\n";
}

void Svg::outline(const char* tag, std::vector<Attribute> attributes, const Stroke& stroke) {
  attributes.insert(attributes.end(), {{"fill", "none"}, {"stroke", "currentColor"}, {"stroke-width", stroke.width}});
  if (stroke.opacity < 1.0) attributes.emplace_back("opacity", stroke.opacity);
  if (!stroke.dash.empty()) attributes.emplace_back("stroke-dasharray", stroke.dash);
  if (stroke.dash_offset != 0.0) attributes.emplace_back("stroke-dashoffset", stroke.dash_offset);
  element(tag, attributes);
}

void Svg::line(Point from, Point to, const Stroke& stroke) {
  path({from, to}, stroke);
}

void Svg::path(const std::vector<Point>& points, const Stroke& stroke) {
  outline("polyline", {{"points", places(points)}, {"stroke-linejoin", "round"}}, stroke);
}

void Svg::area(const std::vector<Point>& corners, double opacity) {
  element("polygon", {{"points", places(corners)}, {"fill", "currentColor"}, {"opacity", opacity}});
}

void Svg::box(const Box& box, double opacity, double corner_radius) {
  element("rect", {{"x", box.left},
                   {"y", box.top},
                   {"width", box.width()},
                   {"height", box.height()},
                   {"rx", corner_radius},
                   {"fill", "currentColor"},
                   {"opacity", opacity}});
}

void Svg::disc(Point centre, double radius, double opacity) {
  element("circle",
          {{"cx", centre.x}, {"cy", centre.y}, {"r", radius}, {"fill", "currentColor"}, {"opacity", opacity}});
}

void Svg::ring(Point centre, double radius, const Stroke& stroke) {
  outline("circle", {{"cx", centre.x}, {"cy", centre.y}, {"r", radius}}, stroke);
}

void Svg::words(Point place, const std::string& words, const Font& font) {
  std::vector<Attribute> attributes{{"x", place.x}, {"y", place.y}, {"font-size", font.size}, {"fill", "currentColor"}};
  if (font.anchor != Anchor::kStart) attributes.emplace_back("text-anchor", word(font.anchor));
  if (font.bold) attributes.emplace_back("font-weight", "600");
  if (font.halo) {
    attributes.insert(attributes.end(), {{"class", "halo"},
                                         {"stroke", kPaper.light},
                                         {"stroke-width", kHaloWidth},
                                         {"stroke-linejoin", "round"},
                                         {"paint-order", "stroke"}});
  }
  element("text", attributes, &words);
}

std::string Svg::finished(double width, double height, const std::string& title, const std::string& description) && {
  GYRE_ENSURE(open_ == 0, "a group is open");
  const std::string drawn = std::move(out_);
  out_ = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + number(width, 1) + " " + number(height, 1) +
         "\" role=\"img\" font-family=\"" + kFonts + "\">\n";
  element("title", {}, &title);
  element("desc", {}, &description);
  out_ += "<style>\n" + style_sheet() + "</style>\n";
  begin(kPaper);
  box({0.0, 0.0, width, height}, 1.0);
  end();
  return std::move(out_) + drawn + "</svg>\n";
}

std::string escaped(const std::string& words) {
  std::string out;
  for (std::size_t at = 0; at < words.size();) {
    const std::size_t bytes = character_at(words, at);
    const char c = words[at];
    if (bytes == 0 || (bytes == 1 && static_cast<unsigned char>(c) < 0x20 && !std::strchr("\t\n\r", c)) || c == '\0') {
      out += kReplacement;
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '&') {
      out += "&amp;";
    } else if (c == '"') {
      out += "&quot;";
    } else {
      out.append(words, at, bytes);
    }
    at += std::max<std::size_t>(bytes, 1);
  }
  return out;
}

double width_of(const std::string& words, double font_size) {
  const auto em = [](char c) {
    if (std::strchr(" .,:;'|!()[]ijlft-", c) != nullptr) return 0.4;
    if (std::strchr("mwMW", c) != nullptr) return 1.0;
    return (c >= '0' && c <= '9') || c == '_' ? 0.64 : c >= 'A' && c <= 'Z' ? 0.74 : 0.62;
  };
  constexpr double kForeign = 1.0;
  double out = 0.0;
  for (std::size_t at = 0; at < words.size();) {
    const std::size_t bytes = std::max<std::size_t>(character_at(words, at), 1);
    out += bytes == 1 ? em(words[at]) : kForeign;
    at += bytes;
  }
  return out * font_size;
}

std::string shortened(const std::string& words, double font_size, double width) {
  if (width_of(words, font_size) <= width) return words;
  const std::string dots = " ..";
  std::string out;
  for (std::size_t at = 0; at < words.size();) {
    const std::size_t bytes = std::max<std::size_t>(character_at(words, at), 1);
    const std::string longer = out + words.substr(at, bytes);
    if (width_of(longer + dots, font_size) > width) break;
    out = longer;
    at += bytes;
  }
  return out + dots;
}

}  // namespace gyre::ground
