// Who has a place at the page's server, what a path is for, and in which words a request gets nothing.

#include "ground/page/core/door.hpp"

#include <gmock/gmock.h>

#include "ground/page/core/place_book.hpp"

namespace gyre::ground {
namespace {

using std::chrono::seconds;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// --------------------------------------------------------------------------------------------------------- words

TEST(DoorPaths, KnowWhatTheyAreFor) {
  for (const char* path : {"/", "/api/events", "/api/time", "/metrics"}) {
    EXPECT_EQ(allow_header(path), "GET, HEAD") << path;
  }
  for (const char* path : {"/api/order", "/api/check", "/api/hurt"})
    EXPECT_THAT(allowed_methods(path), ElementsAre("POST"));
  for (const char* path : {"", "/api", "/api/", "/api/orders", "//", "/metrics/", "*"}) {
    EXPECT_THAT(allowed_methods(path), IsEmpty()) << path;
  }
}

TEST(DoorWords, NameTheCauseAndTheCure) {
  EXPECT_THAT(refusal_words(404, "/nowhere", 1), AllOf(HasSubstr("nothing at /nowhere"), HasSubstr("/api/events")));
  EXPECT_EQ(refusal_words(405, "/api/order", 1), "/api/order is there for POST only");
  EXPECT_THAT(refusal_words(413, "/api/order", 327680), HasSubstr("may have 327680 bytes"));
  EXPECT_THAT(refusal_words(400, "", 1), HasSubstr("a method, an address and HTTP/1.1"));
  EXPECT_THAT(refusal_words(414, "", 1), HasSubstr("the page is at /"));
  EXPECT_THAT(refusal_words(507, "", 1), HasSubstr("507"));
}

TEST(DoorWords, ShowNoMoreOfAPathThanOneReads) {
  const std::string words = refusal_words(404, "/" + std::string(100'000, 'a') + "\xff", 1);
  EXPECT_LT(words.size(), 300U);
  EXPECT_THAT(refusal_words(404, "/\xff\xfe", 1), HasSubstr("/??"));
}

TEST(DoorTokens, AreWhatStandsInAnAddressUnchanged) {
  for (const char* token : {"a", "0123456789abcdef", "A-b._~9"}) EXPECT_TRUE(is_token(token)) << token;
  for (const char* token : {"", " ", "a b", "a%20b", "a+b", "a&b", "a#b", "a/b", "\xc3\xa4", "a\nb"}) {
    EXPECT_FALSE(is_token(token)) << token;
  }
  EXPECT_TRUE(is_token(std::string(128, 'a')));
  EXPECT_FALSE(is_token(std::string(129, 'a')));
}

// --------------------------------------------------------------------------------------------------------- places

class PlaceBookTest : public testing::Test {
 protected:
  void enter(int who) {
    book_.come();
    EXPECT_THAT(book_.send_away(), IsEmpty());
    book_.enter(who);
  }
  static LocalTime at(int second) { return LocalTime(seconds(second)); }

  PlaceBook book_{3};
};

TEST_F(PlaceBookTest, NobodyLeavesWhileThereAreOthersFree) {
  for (int who = 1; who <= 3; ++who) {
    enter(who);
    book_.wait(who, at(who));
  }
  EXPECT_THAT(book_.send_away(), IsEmpty());
  book_.leave(2);
  enter(4);
}

TEST_F(PlaceBookTest, WhoLetTheServerWaitLongestLeavesForANewcomerOnce) {
  for (int who = 1; who <= 3; ++who) enter(who);
  book_.wait(1, at(5));
  book_.wait(2, at(4));
  book_.wait(3, at(6));
  book_.come();
  EXPECT_THAT(book_.send_away(), ElementsAre(2));
  EXPECT_THAT(book_.send_away(), IsEmpty()) << "he is on his way";
  book_.come();
  book_.come();
  EXPECT_THAT(book_.send_away(), ElementsAre(1, 3));
  book_.come();
  EXPECT_THAT(book_.send_away(), IsEmpty()) << "nobody is left who could leave";
  book_.leave(2);
  book_.enter(7);
  book_.wait(7, at(9));
  EXPECT_THAT(book_.send_away(), ElementsAre(7)) << "two places come free, and three wait";
}

TEST_F(PlaceBookTest, WhoIsAnsweredStaysUntilHeLetsWaitHimself) {
  for (int who = 1; who <= 3; ++who) {
    enter(who);
    book_.wait(who, at(who));
    book_.go_on(who);
  }
  book_.come();
  EXPECT_THAT(book_.send_away(), IsEmpty());
  book_.wait(2, at(20));
  EXPECT_THAT(book_.send_away(), ElementsAre(2));
}

TEST_F(PlaceBookTest, WhatIsSaidOfSomebodyWhoIsGoneIsNothing) {
  enter(1);
  book_.leave(1);
  book_.wait(1, at(1));
  book_.go_on(1);
  for (int i = 0; i < 3; ++i) book_.come();
  EXPECT_THAT(book_.send_away(), IsEmpty());
}

}  // namespace
}  // namespace gyre::ground
