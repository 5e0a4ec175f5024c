#pragma once
// The page itself, put into the program when it was built: one HTML file with all it needs, compressed.

#include <string_view>

namespace gyre::ground {

struct PageBundle {
  std::string_view html_gzip;  ///< empty: built without Node or npm, there is no page
  std::string_view policy;     ///< which scripts and styles a browser may run: the value of Content-Security-Policy
};

[[nodiscard]] PageBundle page_bundle();

}  // namespace gyre::ground
