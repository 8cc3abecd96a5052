#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>

#include "client/app/join_client.h"
#include "common/auth/io/control_client.h"

namespace tandem::test {

/// A server reports this of a session that it restores.
constexpr const char* kStaysStopped = "it was stopped, and stays stopped";

/// An operator's console in this process, so that nothing is between the confirmation and the kill.
class Operator {
 public:
  /// @param asking  server, and ticket and keys if it is not a server of this user
  explicit Operator(client::JoinOptions asking) {
    asking.console = AccessRole::kOperator;
    asking.timeout = kTimeout;
    auto joined = client::join_console(asking);
    EXPECT_TRUE(joined) << (joined ? "" : joined.error().reason);
    if (joined) console_ = std::move(*joined);
  }
  [[nodiscard]] const rpc::Id& session() const { return console_.welcome.session_id; }
  /// The reply to an order or question.
  rpc::Body ask(const rpc::Body& body) {
    if (!console_.connection) return rpc::ErrorReply{};
    auto answer = console_.connection->ask(body, kTimeout);
    EXPECT_TRUE(answer) << (answer ? "" : answer.error().text);
    return answer ? std::move(*answer) : rpc::Body{rpc::ErrorReply{}};
  }
  /// Gives an order. @return why it is not stored; nullopt: it was not carried out
  std::optional<std::string> order(const rpc::Body& body) {
    const auto reply = ask(body);
    const auto* const done = std::get_if<rpc::Ok>(&reply);
    return done == nullptr ? std::nullopt : std::optional(done->not_stored);
  }
  rpc::Status status() {
    const auto reply = ask(rpc::StatusRequest{session()});
    const auto* const status = std::get_if<rpc::Status>(&reply);
    EXPECT_NE(status, nullptr);
    return status == nullptr ? rpc::Status{} : *status;
  }

 private:
  static constexpr std::chrono::seconds kTimeout{10};
  client::Console console_;
};

/// Times of confirmations.
struct ConfirmationTimes {
  void add(std::chrono::steady_clock::duration took) {
    const double ms = std::chrono::duration<double, std::milli>(took).count();
    sum += ms;
    worst = std::max(worst, ms);
    ++count;
  }
  void print(const char* what, std::size_t kept) const {
    std::printf("[ measured ] %s: %zu of %zu kills kept it; confirmed after %.1f ms on average, %.1f ms at most\n",
                what, kept, count, count == 0 ? 0 : sum / static_cast<double>(count), worst);
  }
  double sum = 0, worst = 0;
  std::size_t count = 0;
};

}  // namespace tandem::test
