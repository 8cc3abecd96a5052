#include "common/base/suggestions.h"

#include <gtest/gtest.h>

namespace tandem {
namespace {

const std::vector<std::string> kLaws{"replica", "set_position", "tdpa", "wave", "pd", "raw"};

std::string nearest(const std::string& word) {
  const std::string* const found = nearest_match(word, kLaws);
  return found == nullptr ? "" : *found;
}

TEST(Suggestions, FindAMisspeltWord) {
  EXPECT_EQ(nearest("replcia"), "replica") << "neighbours are swapped: distance 1";
  EXPECT_EQ(nearest("WAVES"), "wave");
  EXPECT_EQ(nearest("set-position"), "set_position");
}

TEST(Suggestions, FindAWordByItsBeginning) {
  EXPECT_EQ(nearest("repl"), "replica") << "distance 3, of which spelling allows 2";
  EXPECT_EQ(nearest("set_pos"), "set_position");
  EXPECT_EQ(nearest("SET"), "set_position");
}

TEST(Suggestions, OfferNothingFarAway) {
  EXPECT_EQ(nearest("impedance"), "");
  EXPECT_EQ(suggest("impedance", kLaws), "known here: replica, set_position, tdpa, wave, pd, raw");
  EXPECT_EQ(suggest("x", {}), "none is available");
}

TEST(Suggestions, TakeHostileWordsOfAnyLength) {
  EXPECT_EQ(nearest(std::string(1 << 20, 'w')), "");
  EXPECT_EQ(nearest(std::string("wav\0", 4)), "wave") << "distance 1";
}

}  // namespace
}  // namespace tandem
