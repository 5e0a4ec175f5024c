#pragma once
// Reads an SVG as strictly as XML asks, as far as ours go: elements, attributes, text; no comments, no entities but the
// five. What is drawn becomes a flat list, in the order in which it is drawn.

#include <cctype>
#include <cstring>
#include <map>
#include <string>
#include <vector>

namespace gyre::test {

struct Element {
  std::string tag, text;
  std::map<std::string, std::string> attributes;
  std::string tone;  ///< the class of the innermost group around it

  [[nodiscard]] double number(const std::string& attribute) const { return std::stod(attributes.at(attribute)); }
};

struct SvgFile {
  std::string complaint;  ///< empty: well-formed
  std::vector<Element> elements;

  [[nodiscard]] std::vector<Element> all(const std::string& tag) const {
    std::vector<Element> out;
    for (const Element& element : elements) {
      if (element.tag == tag) out.push_back(element);
    }
    return out;
  }
  /// Whether anything is written that begins so.
  [[nodiscard]] bool says(const std::string& words) const {
    for (const Element& element : all("text")) {
      if (element.text.rfind(words, 0) == 0) return true;
    }
    return false;
  }
};

class SvgReader {
 public:
  explicit SvgReader(const std::string& text) : text_(text) {
    while (file_.complaint.empty() && at_ < text_.size()) step();
    if (file_.complaint.empty() && !open_.empty()) complain("not closed: " + open_.back().tag);
    if (file_.complaint.empty() && roots_ != 1) complain("one root is needed");
  }
  [[nodiscard]] SvgFile file() && { return std::move(file_); }

 private:
  struct Open {
    std::string tag;
    std::size_t element;
    std::string tone;
  };

  void complain(const std::string& what) { file_.complaint = what + ", before byte " + std::to_string(at_); }

  /// `raw` without its entities.
  std::string plain(const std::string& raw) {
    static const std::map<std::string, char> kEntities{
        {"lt", '<'}, {"gt", '>'}, {"amp", '&'}, {"quot", '"'}, {"apos", '\''}};
    std::string out;
    for (std::size_t i = 0; i < raw.size(); ++i) {
      const auto byte = static_cast<unsigned char>(raw[i]);
      if (byte == 0 || (byte < 0x20 && !std::strchr("\t\n\r", raw[i]))) complain("a control character");
      if (raw[i] != '&') {
        out += raw[i];
        continue;
      }
      const std::size_t end = std::min(raw.find(';', i), raw.size());
      const auto entity = kEntities.find(raw.substr(i + 1, end - i - 1));
      if (entity == kEntities.end()) return complain("a bare ampersand"), out;
      out += entity->second;
      i = end;
    }
    return out;
  }

  void step() {
    const std::size_t tag = std::min(text_.find('<', at_), text_.size());
    const std::string words = plain(text_.substr(at_, tag - at_));
    if (!open_.empty()) file_.elements[open_.back().element].text += words;
    if (open_.empty() && words.find_first_not_of(" \n") != std::string::npos) complain("text outside the root");
    at_ = tag;
    if (at_ < text_.size()) read_tag();
  }

  void read_tag() {
    const bool closes = text_.compare(at_, 2, "</") == 0;
    at_ += closes ? 2 : 1;
    const std::string tag = name();
    if (tag.empty()) return complain("a tag without a name");
    if (closes) {
      if (open_.empty() || open_.back().tag != tag) return complain("closes what is not open: " + tag);
      open_.pop_back();
      return expect(">");
    }
    Element element{tag, {}, {}, open_.empty() ? "" : open_.back().tone};
    while (at_ < text_.size() && text_[at_] == ' ') {
      ++at_;
      const std::string attribute = name();
      expect("=\"");
      const std::size_t end = text_.find('"', at_);
      if (attribute.empty() || end == std::string::npos) return complain("a bad attribute");
      const std::string raw = text_.substr(at_, end - at_);
      if (raw.find('<') != std::string::npos) complain("< in an attribute");
      if (!element.attributes.emplace(attribute, plain(raw)).second) complain("an attribute twice: " + attribute);
      at_ = end + 1;
    }
    if (open_.empty()) ++roots_;
    file_.elements.push_back(element);
    if (text_.compare(at_, 2, "/>") == 0) return expect("/>");
    const auto tone = element.attributes.find("class");
    open_.push_back({tag, file_.elements.size() - 1, tone == element.attributes.end() ? element.tone : tone->second});
    expect(">");
  }

  std::string name() {
    std::size_t end = at_;
    while (end < text_.size() &&
           (std::isalnum(static_cast<unsigned char>(text_[end])) || std::strchr("-:_", text_[end])))
      ++end;
    std::string out = text_.substr(at_, end - at_);
    at_ = end;
    return out;
  }

  void expect(const std::string& words) {
    if (text_.compare(at_, words.size(), words) != 0) return complain("no " + words);
    at_ += words.size();
  }

  const std::string text_;
  std::size_t at_ = 0;
  int roots_ = 0;
  std::vector<Open> open_;
  SvgFile file_;
};

inline SvgFile read_svg(const std::string& text) {
  return SvgReader(text).file();
}

}  // namespace gyre::test
