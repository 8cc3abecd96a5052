#include "client/app/authority_script_player.h"

#include <gtest/gtest.h>

namespace tandem::client {
namespace {

using namespace std::chrono_literals;
using wire::TransferNotice;

constexpr double kHz = 1000;  // 50 ticks ahead are 50 ms
constexpr double kFirst = 1, kSecond = 1.01, kThird = 2;

AuthorityScriptPlayer player() {
  std::vector<AuthorityScript::Change> changes;
  for (const double at : {kFirst, kSecond, kThird}) changes.push_back({at, {at}});  // alpha[0] names the change
  return {std::move(changes), kHz};
}

/// Returns the requested change at session time `t` [s]; 0: none.
double request(AuthorityScriptPlayer& script, double t, Duration silence = 1ms,
               TransferNotice transfer = TransferNotice::kNone) {
  const control::MasterArray* const alpha = script.due(Time{} + from_seconds(10 + t), silence, transfer, t);
  return alpha != nullptr ? (*alpha)[0] : 0;
}

TEST(AuthorityScriptPlayer, RequestsEachChangeOnceFiftyTicksAhead) {
  AuthorityScriptPlayer script = player();
  EXPECT_EQ(request(script, 0.949), 0);
  EXPECT_EQ(request(script, 0.9501), kFirst);
  EXPECT_EQ(request(script, 0.9511), 0);
  EXPECT_EQ(request(script, 0.9601), kSecond);
  EXPECT_EQ(request(script, 1.9501), kThird);
  EXPECT_EQ(request(script, 9), 0);
}

TEST(AuthorityScriptPlayer, RequestsOnlyTheNewestOfSeveralDueChanges) {
  AuthorityScriptPlayer script = player();
  EXPECT_EQ(request(script, 1.5), kSecond);
  EXPECT_EQ(request(script, 1.501), 0);
}

TEST(AuthorityScriptPlayer, RequestsTheNewestPastChangeOfALateClientOnce) {
  AuthorityScriptPlayer between = player();
  EXPECT_EQ(request(between, 1.6), kSecond) << "the authority that the script states for this time";
  EXPECT_EQ(request(between, 1.94), 0);
  EXPECT_EQ(request(between, 1.96), kThird) << "later changes keep their time";
  AuthorityScriptPlayer after = player();
  EXPECT_EQ(request(after, 3000), kThird);
  EXPECT_EQ(request(after, 3001), 0);
}

TEST(AuthorityScriptPlayer, WaitsForTheSessionAndForASilentServer) {
  AuthorityScriptPlayer script = player();
  EXPECT_EQ(script.due(Time{10s}, 1ms, TransferNotice::kNone, std::nullopt), nullptr);
  EXPECT_EQ(request(script, 1.5, 201ms), 0);
  EXPECT_EQ(request(script, 1.5, 200ms), kSecond);
}

TEST(AuthorityScriptPlayer, RepeatsARejectedRequestAfter200MsUnlessTheUserRequestedOtherAuthority) {
  AuthorityScriptPlayer script = player();
  ASSERT_EQ(request(script, 0.96), kSecond);
  EXPECT_EQ(request(script, 1.10, 1ms, TransferNotice::kCancelled), 0) << "too early";
  EXPECT_EQ(request(script, 1.17, 1ms, TransferNotice::kLosing), 0) << "granted";
  EXPECT_EQ(request(script, 1.17, 1ms, TransferNotice::kCancelled), kSecond);
  EXPECT_EQ(request(script, 1.18, 1ms, TransferNotice::kCancelled), 0) << "repeated just now";
  script.cancel_retry();
  EXPECT_EQ(request(script, 1.5, 1ms, TransferNotice::kCancelled), 0);
}

TEST(AuthorityScriptPlayer, TakesALateRejectionForThatOfAnotherRequest) {
  AuthorityScriptPlayer script{{{1, {1}}}, kHz};
  ASSERT_EQ(request(script, 1), 1);
  EXPECT_EQ(request(script, 2.501, 1ms, TransferNotice::kCancelled), 0);
}

}  // namespace
}  // namespace tandem::client
