#include "ground/plot/core/palette.hpp"

#include <array>

namespace gyre::ground {
namespace {

constexpr std::array<Tone, 12> kCarriers{{{"c0", "#1547a2", "#4ea8f4"},
                                          {"c1", "#b72400", "#f05c12"},
                                          {"c2", "#18a088", "#5df3a3"},
                                          {"c3", "#d65fd7", "#da72b7"},
                                          {"c4", "#a9911f", "#d5ba25"},
                                          {"c5", "#30789d", "#c4e5fc"},
                                          {"c6", "#32047c", "#965ee3"},
                                          {"c7", "#8c0050", "#b65c8b"},
                                          {"c8", "#4e8b08", "#3a9c2d"},
                                          {"c9", "#63625a", "#b9bcd7"},
                                          {"c10", "#512a0a", "#ae8a74"},
                                          {"c11", "#dc6174", "#f6988f"}}};

constexpr std::array<const char*, 6> kDashes{"", "6 3", "2 3", "9 3 2 3", "12 4", "1 4"};

constexpr std::array<const Tone*, 7> kOthers{&kPaper, &kInk, &kMuted, &kGrid, &kLoad, &kGood, &kBad};

template <class Say>
std::string for_every_tone(const Say& say) {
  std::string out;
  for (const Tone* tone : kOthers) out += say(*tone);
  for (const Tone& tone : kCarriers) out += say(tone);
  return out;
}

std::string variable(const char* name, const char* value) {
  return "--" + std::string(name) + ":" + value + ";";
}

}  // namespace

const Tone& carrier_tone(std::size_t index) {
  return kCarriers[index % kCarriers.size()];
}

const char* carrier_dash(std::size_t index) {
  return kDashes[index / kCarriers.size() % kDashes.size()];
}

std::string light_tones() {
  return for_every_tone([](const Tone& tone) { return variable(tone.name, tone.light); });
}

std::string style_sheet() {
  std::string out = ":root{color-scheme:light dark;" + light_tones();
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
