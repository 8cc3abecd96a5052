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

#include "netsim/engine/network.h"
#include "netsim/profiles/profile_loader.h"
#include "netsim/system/scene_run.h"

namespace tandem::netsim {

/// A datagram that the network delivered.
struct Received {
  std::vector<std::byte> bytes;  ///< content
  Time sent,                     ///< time of sending
      at;                        ///< time of delivery
  std::uint64_t index = 0;  ///< number of the sent datagram on this link and direction, from 0; the same for a copy
  /// Returns the time from sending to delivery.
  [[nodiscard]] Duration delay() const noexcept { return at - sent; }
  /// Returns the bytes as characters.
  [[nodiscard]] std::string text() const;
};

/// GoogleTest fixture that sends a test's own bytes through a simulated network in virtual time.
/// No call sleeps, and no result depends on the machine.
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
/// A failing test prints its network, its seed and the command that repeats it. The environment variable TANDEM_SEED
/// replaces every seed except those that a test passes to `run_scene`.
class NetworkTest : public ::testing::Test {
 protected:
  /// Starts with one link without delay or loss, seed 1, clock at 0.
  /// @throws std::invalid_argument if TANDEM_SEED is not a whole number in [0, 2^64).
  NetworkTest();
  ~NetworkTest() override;

  // ---- Choice of the network. Each of these calls drops all datagrams under way and sets the clock to 0.
  /// Uses a shipped profile. @throws std::invalid_argument naming the nearest profile and listing all.
  void use_profile(std::string_view name);
  /// Uses the text of a profile (proto/schema/profile.proto). @throws std::invalid_argument listing all errors.
  void use_profile_text(std::string_view text, std::string_view name = "own.textproto");
  /// Uses the same delay, jitter, loss, duplicates, reordering and outages in both directions.
  /// @throws std::invalid_argument listing all problems of the resulting link.
  void use_numbers(const SimpleNetwork& numbers) { use_link(link_from(numbers), "own numbers"); }
  /// Uses a link specification. @throws std::invalid_argument listing all problems of the specification.
  /// @param link         both directions of each link
  /// @param description  name of the network in the text of a failing test
  void use_link(const LinkSpec& link, std::string description = "own numbers");
  /// Uses this seed, or TANDEM_SEED if that is set.
  void use_seed(std::uint64_t seed);
  /// Returns the seed in use.
  [[nodiscard]] std::uint64_t seed() const noexcept { return seed_; }

  /// Adds the link of another client, with the same specification. @return its number: 1, 2, ...
  std::uint32_t add_link() { return network_->add_link(link_); }

  /// Runs `body` with the seeds 1 ... `count` and stops at the first seed that fails. If TANDEM_SEED is set, only that
  /// seed runs.
  template <typename Body>
  void for_seeds(std::uint64_t count, Body body) {
    const std::uint64_t first = seed_asked_.value_or(1), last = seed_asked_.value_or(count);
    for (std::uint64_t seed = first; seed <= last && !HasFailure(); ++seed) {
      use_seed(seed);
      body();
    }
  }

  // ---- Time.
  /// Returns the virtual clock; 0 is the start of the network.
  [[nodiscard]] Time now() const noexcept { return now_; }
  /// Advances the clock. @param by  0 or more; a negative value counts as 0
  void advance(Duration by) { now_ += std::max(by, Duration::zero()); }
  /// Advances the clock to the next delivery. @return false if no datagram is under way
  bool advance_to_next();
  /// Calls `body()` at now, now + step, ... for `length`; afterwards the clock is at the end of that interval.
  /// @param length  duration, 0 or more
  /// @param step    above 0
  /// @param body    callable without arguments
  template <typename Body>
  void run_for(Duration length, Duration step, Body body) {
    const Time end = now_ + length;
    ASSERT_GT(step, Duration::zero());
    while (now_ < end && !HasFatalFailure()) {
      body();
      now_ = std::max(now_, std::min(now_ + step, end));
    }
  }

  // ---- Datagrams, each of at most 1500 bytes.
  /// Sends a datagram at `now`.
  /// @param direction  from the client (kUp) or from the server (kDown)
  /// @param bytes      content
  /// @param link       0, or a result of `add_link`
  /// @return the decision about the datagram; an unknown link drops it (kOverflow)
  Outcome send(Direction direction, std::span<const std::byte> bytes, std::uint32_t link = 0);
  /// The same with characters.
  Outcome send(Direction direction, std::string_view text, std::uint32_t link = 0);
  /// Returns the next datagram delivered by now, in order of arrival; nullopt if there is none.
  [[nodiscard]] std::optional<Received> receive(Direction direction, std::uint32_t link = 0);
  /// Returns how many datagrams were sent, lost (by cause), copied and delivered so far.
  [[nodiscard]] const PathCounters& counters(Direction direction, std::uint32_t link = 0) const {
    return network_->counters(link, direction);
  }
  /// Returns the network itself, for calls that the fixture does not offer.
  [[nodiscard]] Network& network() noexcept { return *network_; }

  // ---- Whole sessions: Tandem's own server, clients and devices over a network, in virtual time.
  /// Runs a session and returns its report. A later failure of the test prints the command that repeats the run.
  /// @throws std::runtime_error if a name is unknown or the session does not begin.
  server::RunReport run_scene(const SceneRun& run);
  /// Runs a shipped scene over a shipped profile, for the scene's own length.
  server::RunReport run_scene(std::string_view scene, std::string_view profile, std::uint64_t seed) {
    return run_scene({std::string(scene), std::string(profile), seed, 0});
  }
  /// Runs it with the seed of this fixture.
  server::RunReport run_scene(std::string_view scene, std::string_view profile) {
    return run_scene(scene, profile, seed_);
  }

  /// Returns the text that a failing test prints: network, seed and the commands that repeat it.
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
