#pragma once
// Options that take seconds within bounds.

#include <CLI/CLI.hpp>

#include "common/base/text.hpp"

namespace gyre::ground {

/// `what` is what such a number is called, for who gave another: "duration". CLI::Range would let NaN through.
[[nodiscard]] inline CLI::Validator seconds_within(const char* what, double least_s, double most_s) {
  const auto judge = [=](const std::string& words) {
    double value_s = 0.0;
    const bool good = CLI::detail::lexical_cast(words, value_s) && value_s >= least_s && value_s <= most_s;
    return good ? std::string() : words + text(" is no %s: give seconds from %.9g to %.9g", what, least_s, most_s);
  };
  return {judge, "SECONDS"};
}

}  // namespace gyre::ground
