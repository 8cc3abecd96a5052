#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "netsim/network.h"
#include "netsim/profiles.h"
#include "netsim/testing/scene_run.h"

namespace tandem::netsim {

/// Something that came out of the network.
struct Received {
  std::vector<std::byte> bytes;
  Time sent, at;
  std::uint64_t index = 0;  ///< of the datagram on its way, from 0; a copy has the index of its original
  [[nodiscard]] Duration delay() const noexcept { return at - sent; }
  [[nodiscard]] std::string text() const;
};

/// A GoogleTest fixture: own bytes through a bad network, in virtual time. Nothing sleeps, nothing depends on the machine.
///
///     struct ToyTest : tandem::netsim::NetworkTest {};
///     TEST_F(ToyTest, Survives) {
///       use_profile("wifi-busy");
///       run_for(10s, 1ms, [&] {
///         send(Direction::kUp, "hello");
///         while (const auto got = receive(Direction::kUp)) EXPECT_LT(got->delay(), 500ms);
///       });
///     }
///
/// A test that fails prints its network, its seed and the command that repeats it. The environment variable TANDEM_SEED
/// replaces every seed but those a test gives to `run_scene` itself.
class NetworkTest : public ::testing::Test {
 protected:
  /// Until told otherwise: one link without delay or loss, seed 1, clock at 0.
  /// @throws std::invalid_argument when TANDEM_SEED is no whole number.
  NetworkTest();
  ~NetworkTest() override;

  // ---- Which network. Each of these begins anew: nothing under way, clock at 0. -----------------------------------------
  /// A shipped profile. @throws std::invalid_argument naming the nearest and listing all.
  void use_profile(std::string_view name);
  /// The text of a profile (proto/profile.proto). @throws std::invalid_argument listing all mistakes.
  void use_profile_text(std::string_view text, std::string_view name = "own.textproto");
  void use_numbers(const SimpleNetwork& numbers) { use_link(link_from(numbers), "own numbers"); }
  /// @throws std::invalid_argument listing all problems of the spec.
  void use_link(const LinkSpec& link, std::string description = "own numbers");
  void use_seed(std::uint64_t seed);
  [[nodiscard]] std::uint64_t seed() const noexcept { return seed_; }

  /// Another client's link of the same kind. @return its number: 1, 2, ...
  std::uint32_t add_link() { return network_->add_link(link_); }

  /// Runs `body` with the seeds 1 ... `count`, stopping at the first that fails; with TANDEM_SEED set, with that one alone.
  template <typename Body>
  void for_seeds(std::uint64_t count, Body body) {
    const std::uint64_t first = seed_asked_.value_or(1), last = seed_asked_.value_or(count);
    for (std::uint64_t seed = first; seed <= last && !HasFailure(); ++seed) {
      use_seed(seed);
      body();
    }
  }

  // ---- Time. --------------------------------------------------------------------------------------------------------------
  [[nodiscard]] Time now() const noexcept { return now_; }
  /// @param by  0 or more
  void advance(Duration by) { now_ += std::max(by, Duration::zero()); }
  /// To the moment the next datagram comes out. @return false if nothing is under way
  bool advance_to_next();
  /// Calls `body()` at now, now + step, ... for `length`; the clock is at the end of it afterwards.
  /// @param step  above 0
  template <typename Body>
  void run_for(Duration length, Duration step, Body body) {
    const Time end = now_ + length;
    ASSERT_GT(step, Duration::zero());
    while (now_ < end && !HasFatalFailure()) {
      body();
      now_ = std::max(now_, std::min(now_ + step, end));
    }
  }

  // ---- Datagrams: of at most 1500 bytes. ------------------------------------------------------------------------------------
  Outcome send(Direction direction, std::span<const std::byte> bytes, std::uint32_t link = 0);
  Outcome send(Direction direction, std::string_view text, std::uint32_t link = 0);
  /// The next one that has come out by now, in order of arrival; call until empty.
  [[nodiscard]] std::optional<Received> receive(Direction direction, std::uint32_t link = 0);
  /// What was sent, lost (by cause), copied and delivered so far.
  [[nodiscard]] const PathCounters& counters(Direction direction, std::uint32_t link = 0) const {
    return network_->counters(link, direction);
  }
  [[nodiscard]] Network& network() noexcept { return *network_; }

  // ---- Whole sessions: Tandem's own server, clients and devices over a network, in virtual time. --------------------------
  /// @throws std::runtime_error when the names are wrong or the session does not begin.
  server::RunReport run_scene(const SceneRun& run);
  server::RunReport run_scene(std::string_view scene, std::string_view profile, std::uint64_t seed) {
    return run_scene({std::string(scene), std::string(profile), seed, 0});
  }
  server::RunReport run_scene(std::string_view scene, std::string_view profile) {
    return run_scene(scene, profile, seed_);
  }

  /// What is printed when a test fails.
  [[nodiscard]] std::string replay() const;

 private:
  void restart();

  std::optional<std::uint64_t> seed_asked_;
  std::uint64_t seed_ = 1;
  LinkSpec link_;
  std::string description_ = "without delay or loss";
  std::unique_ptr<Network> network_;
  Time now_{};
  std::vector<std::byte> buffer_;
  std::vector<SceneRun> scenes_;
};

}  // namespace tandem::netsim
