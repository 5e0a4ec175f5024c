#include "ground/page/page_bundle.hpp"

// The build puts them there (CMakeLists.txt): two files as they are, or nothing where there is no page.
#ifdef GYRE_PAGE_FOLDER
// NOLINTBEGIN(cppcoreguidelines-macro-usage, hicpp-no-assembler): C++17 has no other way to put a file into a program
#define GYRE_EMBED(name, file)               \
  __asm__(                                   \
      ".section .rodata\n"                   \
      ".global " #name "\n" #name            \
      ":\n"                                  \
      ".incbin \"" GYRE_PAGE_FOLDER "/" file \
      "\"\n"                                 \
      ".global " #name "_end\n" #name "_end:\n.byte 0\n.previous\n")
GYRE_EMBED(gyre_page_html, "index.html.gz");
GYRE_EMBED(gyre_page_policy, "csp.txt");
// NOLINTEND(cppcoreguidelines-macro-usage, hicpp-no-assembler)
extern "C" {
extern const char gyre_page_html[], gyre_page_html_end[];      // NOLINT: as the assembler names them
extern const char gyre_page_policy[], gyre_page_policy_end[];  // NOLINT
}
#endif

namespace gyre::ground {

PageBundle page_bundle() {
#ifdef GYRE_PAGE_FOLDER
  std::string_view policy(gyre_page_policy, static_cast<std::size_t>(gyre_page_policy_end - gyre_page_policy));
  policy = policy.substr(0, policy.find('\n'));  // a header is one line
  return {{gyre_page_html, static_cast<std::size_t>(gyre_page_html_end - gyre_page_html)}, policy};
#else
  return {};
#endif
}

}  // namespace gyre::ground
