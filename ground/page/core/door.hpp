#pragma once
// Who may come in: what a request has to show before anything is done for it.
//
// Intuition: a page in another tab may send requests to this machine, too, in the name of the person who sits before
// it. It does not know the token, cannot set the header that carries it without asking first, and gets no answer it may
// read. What is left is a name that is made to point here (DNS rebinding): so the host has to be an address, or
// "localhost", and not just any name.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/time.hpp"

namespace gyre::ground {

/// Whether this can be one: letters, digits, - . _ ~ (RFC 3986, unreserved), at most 128 of them. It stands in an
/// address and in a header, where other characters would have to be written as something else; and who writes them
/// otherwise than the next one has another token.
[[nodiscard]] bool is_token(std::string_view words);

/// Takes as long whatever is wrong with it.
[[nodiscard]] bool same_token(std::string_view told, std::string_view token);

/// Of a Host header: "127.0.0.1:8480", "[::1]:8480", "localhost", or one of `names`, by which this machine is called.
/// Other names are nobody's whom we know; an empty one is refused as well.
[[nodiscard]] bool is_own_host(std::string_view host, const std::vector<std::string>& names = {});

/// Of an Origin header, "http://127.0.0.1:8480": whether it is the host's own page; an empty one is no browser's.
[[nodiscard]] bool is_same_origin(std::string_view origin, std::string_view host);

/// What a path is for: "GET" and "HEAD", or "POST"; nothing: there is no such path.
[[nodiscard]] std::vector<std::string> allowed_methods(std::string_view path);
/// As the header Allow says it: "GET, HEAD".
[[nodiscard]] std::string allow_header(std::string_view path);

/// Why a request got nothing, and what would be right, by the status of the answer; for what no handler has words for.
/// `request_bytes`: the most that one may have.
[[nodiscard]] std::string refusal_words(int status, std::string_view path, std::size_t request_bytes);

/// So many at once, and so many a second.
class RateJudge {
 public:
  RateJudge(double burst, double per_second) : burst_(burst), per_second_(per_second), left_(burst) {}
  [[nodiscard]] bool admits(LocalTime now);

 private:
  double burst_, per_second_, left_;
  LocalTime last_{};
};

}  // namespace gyre::ground
