#include "ground/page/core/door.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include "common/base/text.hpp"
#include "ground/page/core/utf8.hpp"

namespace gyre::ground {
namespace {

/// A name has up to 253 letters (RFC 1035), and a port six more.
constexpr std::size_t kLongestHost = 260;

constexpr std::array<std::string_view, 4> kShown{"/", "/api/events", "/api/time", "/metrics"};
constexpr std::array<std::string_view, 3> kAsked{"/api/order", "/api/check", "/api/hurt"};

template <std::size_t n>
std::string listed(const std::array<std::string_view, n>& paths) {
  std::string words;
  for (const std::string_view path : paths) {
    if (path != "/") words.append(words.empty() ? "" : ", ").append(path);
  }
  return words;
}

bool all_of(std::string_view text, std::string_view allowed) {
  return !text.empty() && text.find_first_not_of(allowed) == std::string_view::npos;
}

bool same_name(std::string_view a, std::string_view b) {
  const auto same = [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), same);
}

/// "host:port" without ":port".
std::string_view without_port(std::string_view host) {
  const std::size_t colon = host.rfind(':');
  if (colon == std::string_view::npos || host.back() == ']') return host;
  return all_of(host.substr(colon + 1), "0123456789") ? host.substr(0, colon) : std::string_view();
}

}  // namespace

bool is_token(std::string_view words) {
  constexpr std::size_t kLongest = 128;
  return words.size() <= kLongest &&
         all_of(words, "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ-._~");
}

bool same_token(std::string_view told, std::string_view token) {
  std::size_t differs = told.size() ^ token.size();
  for (std::size_t i = 0; i < told.size(); ++i) {
    differs |= static_cast<std::size_t>(told[i] ^ (token.empty() ? '\0' : token[i % token.size()]));
  }
  return differs == 0 && !token.empty();
}

bool is_own_host(std::string_view host, const std::vector<std::string>& names) {
  if (host.empty() || host.size() > kLongestHost) return false;
  const std::string_view name = without_port(host);
  if (name.empty()) return false;
  const auto called = [name](const std::string& one) { return same_name(name, one); };
  if (same_name(name, "localhost") || std::any_of(names.begin(), names.end(), called)) return true;
  if (name.size() > 2 && name.front() == '[' && name.back() == ']') {
    return all_of(name.substr(1, name.size() - 2), "0123456789abcdefABCDEF:.");
  }
  return all_of(name, "0123456789.") && std::count(name.begin(), name.end(), '.') == 3 && name.front() != '.' &&
         name.back() != '.' && name.find("..") == std::string_view::npos;
}

bool is_same_origin(std::string_view origin, std::string_view host) {
  if (origin.empty()) return true;
  constexpr std::string_view kScheme = "http://";
  return !host.empty() && origin.substr(0, kScheme.size()) == kScheme && origin.substr(kScheme.size()) == host;
}

std::vector<std::string> allowed_methods(std::string_view path) {
  if (std::find(kShown.begin(), kShown.end(), path) != kShown.end()) return {"GET", "HEAD"};
  if (std::find(kAsked.begin(), kAsked.end(), path) != kAsked.end()) return {"POST"};
  return {};
}

std::string allow_header(std::string_view path) {
  std::string words;
  for (const std::string& method : allowed_methods(path)) words += (words.empty() ? "" : ", ") + method;
  return words;
}

std::string refusal_words(int status, std::string_view path, std::size_t request_bytes) {
  constexpr std::size_t kShownOfPath = 80;
  const std::string shown = utf8(path.substr(0, kShownOfPath)) + (path.size() > kShownOfPath ? ".." : "");
  switch (status) {
    case 400:
      return "this is no HTTP request that the server can read: a method, an address and HTTP/1.1 in the first "
             "line, then headers, each in a line of its own";
    case 404:
      return "there is nothing at " + shown + ": the page is at /, what it asks for at " + listed(kShown) + " and " +
             listed(kAsked);
    case 405:
      return shown + " is there for " + allow_header(path) + " only";
    case 413:
      return text("a request may have %zu bytes, and this has more: send a smaller one", request_bytes);
    case 414:
      return "this address is longer than any that is here: the page is at /";
    default:
      return text("the server could not do that (HTTP status %d): the page is at /", status);
  }
}

bool RateJudge::admits(LocalTime now) {
  left_ = std::min(burst_, left_ + std::max(0.0, seconds(now - last_)) * per_second_);
  last_ = now;
  if (left_ < 1.0) return false;
  left_ -= 1.0;
  return true;
}

}  // namespace gyre::ground
