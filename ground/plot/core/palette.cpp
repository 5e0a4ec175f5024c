#include "ground/plot/core/palette.hpp"

#include <array>

namespace gyre::ground {
namespace {

constexpr std::array<Tone, 12> kCarriers{{{"c0", "#0072b2", "#4ea8e8"},
                                          {"c1", "#d55e00", "#ff8f45"},
                                          {"c2", "#009e73", "#2fd0a0"},
                                          {"c3", "#b5489a", "#ee8fd0"},
                                          {"c4", "#b8860b", "#e6c229"},
                                          {"c5", "#3fa0d8", "#a6dcff"},
                                          {"c6", "#332288", "#8f85ff"},
                                          {"c7", "#882255", "#d4547c"},
                                          {"c8", "#0b6b2b", "#5fae57"},
                                          {"c9", "#7a7a7a", "#b4b4b4"},
                                          {"c10", "#7a4a1e", "#c1895a"},
                                          {"c11", "#e0607a", "#ffb3ba"}}};

constexpr std::array<const char*, 6> kDashes{"", "6 3", "2 3", "9 3 2 3", "12 4", "1 4"};

constexpr std::array<const Tone*, 7> kOthers{&kPaper, &kInk, &kMuted, &kGrid, &kLoad, &kGood, &kBad};

template <class Say>
std::string for_every_tone(const Say& say) {
  std::string out;
  for (const Tone* tone : kOthers) out += say(*tone);
  for (const Tone& tone : kCarriers) out += say(tone);
  return out;
}

}  // namespace

const Tone& carrier_tone(std::size_t index) {
  return kCarriers[index % kCarriers.size()];
}

const char* carrier_dash(std::size_t index) {
  return kDashes[index / kCarriers.size() % kDashes.size()];
}

std::string style_sheet() {
  const auto variable = [](const char* name, const char* value) {
    return "--" + std::string(name) + ":" + value + ";";
  };
  std::string out = ":root{color-scheme:light dark;";
  out += for_every_tone([&](const Tone& tone) { return variable(tone.name, tone.light); });
  out += "}\n@media (prefers-color-scheme:dark){:root{";
  out += for_every_tone([&](const Tone& tone) { return variable(tone.name, tone.dark); });
  out += "}}\n";
  out += for_every_tone([](const Tone& tone) {
    const std::string name = tone.name;
    return "." + name + "{color:var(--" + name + ")}";
  });
  return out + "\n.halo{stroke:var(--paper)}\n";
}

}  // namespace gyre::ground
