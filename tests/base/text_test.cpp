// Words for people: printf's, and lists of carriers.

#include "common/base/text.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace gyre {
namespace {

std::vector<CarrierId> first(std::size_t count) {
  std::vector<CarrierId> ids(count);
  std::iota(ids.begin(), ids.end(), CarrierId{1});
  return ids;
}

TEST(Text, IsAsLongAsItsWords) {
  const std::string words(5000, 'w');
  EXPECT_EQ(text("%u: %s!", 7U, words.c_str()), "7: " + words + "!");
}

TEST(Listed, ReadsAsAPersonWouldSayIt) {
  EXPECT_EQ(listed("carrier", {3}), "carrier 3");
  EXPECT_EQ(listed("agent", {1, 3}), "agents 1 and 3");
  EXPECT_EQ(listed("carrier", {4, 1, 3}), "carriers 4, 1 and 3");
}

TEST(Listed, OfManyTellsTheFirstAndHowManyMore) {
  EXPECT_EQ(listed("carrier", first(12)), "carriers 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11 and 12");
  EXPECT_EQ(listed("carrier", first(100)), "carriers 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12 and 88 more");
}

}  // namespace
}  // namespace gyre
