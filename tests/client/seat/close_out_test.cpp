#include "client/seat/close_out.h"

#include <gtest/gtest.h>

namespace tandem::client {
namespace {

TEST(CloseOut, SendsThreeClosesOnceTheForceIsReleased) {
  CloseOut end;
  end.leave();
  EXPECT_TRUE(end.leaving());
  EXPECT_FALSE(end.take_close()) << "the gate still ramps the force to zero";
  end.on_released();
  for (int k = 1; k <= 3; ++k) {
    EXPECT_FALSE(end.closed()) << k;
    EXPECT_TRUE(end.take_close()) << k;
    end.on_released();  // each later tick without force
  }
  EXPECT_TRUE(end.closed());
  EXPECT_EQ(end.reason(), wire::CloseReason::kLeaving);
  EXPECT_FALSE(end.take_close());
}

TEST(CloseOut, SendsNothingForASeatThatStaysOrThatTheServerClosed) {
  CloseOut end;
  end.on_released();
  EXPECT_FALSE(end.take_close());
  end.on_close(wire::CloseReason::kServerReturns);
  EXPECT_EQ(end.reason(), wire::CloseReason::kServerReturns);
  end.leave();
  end.on_released();
  EXPECT_FALSE(end.take_close());
}

TEST(CloseOut, OpensAgainOnANewConnectionUnlessTheSeatLeaves) {
  CloseOut end;
  end.on_close(wire::CloseReason::kServerReturns);
  end.on_reconnect();
  EXPECT_FALSE(end.closed());
  end.leave();
  end.on_close(wire::CloseReason::kServerReturns);
  end.on_reconnect();
  EXPECT_TRUE(end.closed());
}

}  // namespace
}  // namespace tandem::client
