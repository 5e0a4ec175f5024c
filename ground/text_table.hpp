#pragma once
// Rows of words in columns that line up, and numbers as a person reads them.

#include <string>
#include <vector>

#include "common/mechanics/range.hpp"

namespace gyre::ground {

/// Columns as wide as their widest word, three blanks between them, two before the first; no blanks at a line's end.
[[nodiscard]] std::string aligned(const std::vector<std::vector<std::string>>& rows);

/// Words filled into lines of at most so many characters; a word that is longer has one for itself.
[[nodiscard]] std::vector<std::string> wrapped(const std::string& words, std::size_t width);

/// Four digits; what is smaller than `smallest` is 0.
[[nodiscard]] std::string number_text(double value, double smallest = 1e-12);

/// Both ends, or one number when a reader could not tell them apart.
[[nodiscard]] std::string range_text(const mechanics::Range& range, double smallest = 1e-12);

}  // namespace gyre::ground
