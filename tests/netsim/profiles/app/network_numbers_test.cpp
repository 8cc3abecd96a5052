#include "netsim/profiles/app/network_numbers.h"

#include <gtest/gtest.h>

namespace tandem::netsim {
namespace {

using namespace std::chrono_literals;

TEST(NetworkNumbers, ReplaceOnlyTheGivenParametersInBothDirections) {
  LinkSpec link = link_from({.delay = 7ms, .loss = 0.5});
  NetworkNumbers numbers;
  numbers.delay_ms = 20;
  numbers.reorder_percent = 3;
  numbers.apply(link);
  for (const Direction direction : {Direction::kUp, Direction::kDown}) {
    EXPECT_EQ(link[direction].floor, 20ms);
    EXPECT_EQ(link[direction].loss.probability, 0.5) << "not given";
    EXPECT_EQ(link[direction].reorder.probability, 0.03);
  }
}

TEST(NetworkNumbers, AJitterOfZeroReplacesTheDelayOfAProfile) {
  LinkSpec link = link_from({.jitter = 5ms});
  NetworkNumbers numbers;
  numbers.jitter_ms = 0;
  numbers.apply(link);
  EXPECT_EQ(link, LinkSpec{});
}

TEST(NetworkNumbers, TextNamesTheGivenNumbersInOrder) {
  EXPECT_EQ(NetworkNumbers{}.text(), "");
  EXPECT_EQ((NetworkNumbers{
                .delay_ms = 0.5, .jitter_ms = 5, .loss_percent = 1.25, .duplicate_percent = 0, .reorder_percent = 100}
                 .text()),
            "delay 0.5 ms, jitter 0 to 5 ms, loss 1.25 %, duplicates 0 %, reordered 100 %");
}

TEST(NetworkNumbers, FirstProblemNamesDirectionAndKey) {
  LinkSpec link;
  EXPECT_EQ(first_problem(link), "");
  link.down.loss.probability = 2;
  EXPECT_TRUE(first_problem(link).starts_with("down: ")) << first_problem(link);
}

}  // namespace
}  // namespace tandem::netsim
