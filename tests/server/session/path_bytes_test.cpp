// An insider that forges source addresses. Towards an address that has not answered a challenge, the server never
// sends more bytes than it received from there. This holds in every scene, for any knowledge of the insider.
#include <gtest/gtest.h>

#include "tests/server/session/forging_client.h"

namespace tandem::server {
namespace {

using namespace test;

constexpr std::uint8_t kVictim = 99;
constexpr std::size_t kHeaders = 28;  ///< of IPv4 and UDP, which count as traffic

/// Datagrams and bytes to and from one address.
struct Traffic {
  std::size_t datagrams = 0, bytes = 0;
  void add(const Bytes& d) {
    ++datagrams;
    bytes += d.size();
  }
  [[nodiscard]] std::size_t on_the_line() const { return bytes + kHeaders * datagrams; }
};

/// A session whose clients are honest except seat 0: the insider has its keys.
class Insider {
 public:
  explicit Insider(const std::string& scene) : rig(scene, 3), liar(rig, 0) { rig.run(200ms); }

  /// Runs one millisecond. The STATE of seat 0 comes from `from`. Its answers to challenges, with these tokens, come
  /// from the victim's address.
  void tick(std::uint8_t from, const std::vector<std::uint64_t>& guesses) {
    for (std::size_t i = 0; i < rig.seats.size(); ++i)
      for (const Bytes& d : rig.client_tick(i)) {
        if (i > 0) {
          rig.session->on_datagram(rig.now, address(rig.seats[i].at), d);
        } else if (transport::read_header(d)->type == wire::Type::kState) {
          const auto [preamble, message] = liar.read(d);
          send(from, liar.say(counter_++, wire::Type::kState, preamble, message));
          for (const std::uint64_t token : guesses)
            send(kVictim, liar.say(counter_++, wire::Type::kPathResponse, preamble, wire::PathMessage{token}));
        }
      }
    const auto sent = rig.server_tick();
    for (const auto& [to, bytes] : sent)
      if (to == kVictim) to_victim.add(bytes);
    rig.to_clients(sent);
    rig.now += 1ms;
    worst = std::max(worst, static_cast<double>(to_victim.on_the_line()) /
                                static_cast<double>(std::max<std::size_t>(1, from_victim.on_the_line())));
    ASSERT_LE(to_victim.bytes, from_victim.bytes);
    ASSERT_LE(to_victim.on_the_line(), from_victim.on_the_line());
  }

  SessionFixture rig;
  ForgingClient liar;
  Traffic to_victim, from_victim;
  double worst = 0;  ///< bytes sent to the victim per byte received in its name

 private:
  void send(std::uint8_t from, const Bytes& d) {
    if (from == kVictim) from_victim.add(d);
    rig.session->on_datagram(rig.now, address(from), d);
  }
  std::uint64_t counter_ = 10'000;
};

class PathBytes : public testing::TestWithParam<std::string> {};

TEST_P(PathBytes, StayWithinTheBytesOfAForgedState) {
  Insider insider(GetParam());
  insider.tick(kVictim, {});
  EXPECT_GT(insider.to_victim.datagrams, 0U) << "it is asked";
  for (int ms = 0; ms < 1000; ++ms) {
    insider.tick(1, {});
    if (HasFatalFailure()) return;
  }
}

// All tokens that an insider can derive: tokens sent to it, tokens made from values that both ends know, and guesses.
TEST_P(PathBytes, ValidateNoForgedSourceByGuessedTokens) {
  Insider insider(GetParam());
  const std::uint32_t cid = insider.rig.session->seat(0).link()->own_cid();
  std::vector<std::uint64_t> known{0, 1, ~std::uint64_t{0}, cid};
  insider.rig.seats[0].at = 50;  // it moves to another address of its own, and answers there
  for (int ms = 0; ms < 5; ++ms)
    for (const auto& [to, d] : [&] {
           for (const Bytes& up : insider.rig.client_tick(0))
             insider.rig.session->on_datagram(insider.rig.now, address(50), up);
           auto sent = insider.rig.server_tick();
           insider.rig.to_clients(sent);
           insider.rig.now += 1ms;
           return sent;
         }())
      if (to == 50 && transport::read_header(d)->type == wire::Type::kPathChallenge)
        known.push_back(insider.liar.token(d));
  EXPECT_GE(known.size(), 5U) << "the insider saw no token of its own";
  RandomStream luck{11};
  for (std::uint64_t n = 0; n < 32; ++n) known.push_back(RandomKey{cid}.bits(n));
  for (std::uint64_t n = 1; n < 8; ++n) known.push_back(known[4] + n);
  for (std::size_t ms = 0; ms < 1000; ++ms) {
    std::vector<std::uint64_t> guesses;  // as many as its rate limit accepts
    if (ms % 5 == 0) guesses.push_back(ms % 2 == 0 ? known[ms / 10 % known.size()] : luck.bits());
    insider.tick(kVictim, guesses);
    if (HasFatalFailure()) return;
  }
  EXPECT_EQ(insider.rig.refused(transport::DropReason::kRate), 0U) << "guesses were not even looked at";
  EXPECT_LE(insider.worst, 1);
  EXPECT_EQ(insider.rig.forces[kVictim], 0);
}

std::vector<std::string> scenes() {
  std::vector<std::string> names;
  for (const EmbeddedFile& scene : shipped_scenes()) names.emplace_back(scene.name);
  return names;
}
INSTANTIATE_TEST_SUITE_P(EveryShippedScene, PathBytes, testing::ValuesIn(scenes()),
                         [](const auto& scene) { return scene.param; });

TEST(PathBytesOfLinkTestPeers, AreBoundedTheSameWay) {
  SessionFixture rig("one_axis");
  const auto joined = netsim::simulate_link_test_join(*rig.session, rig.now, RandomKey{9}, 1);
  ASSERT_TRUE(joined);
  ForgingClient liar(joined->channel_params, body_layout(joined->setup));
  Traffic to, from;
  RandomStream luck{12};
  std::uint64_t counter = 0;
  for (int ms = 0; ms < 500; ++ms) {
    const wire::Preamble preamble{~std::uint64_t{0}, 0, static_cast<std::uint32_t>(ms)};
    if (ms % 100 == 0) {  // rarely: each costs the insider as many bytes as it causes
      const Bytes probe = liar.say(counter++, wire::Type::kLinkProbe, preamble, wire::LinkProbe{});
      from.add(probe);
      rig.session->on_datagram(rig.now, address(kVictim), probe);
    }
    const Bytes answer = liar.say(counter++, wire::Type::kPathResponse, preamble, wire::PathMessage{luck.bits()});
    rig.session->on_datagram(rig.now, address(kVictim), answer);
    for (const auto& [at, bytes] : rig.server_tick())
      if (at == kVictim) to.add(bytes);
    rig.now += 1ms;
    ASSERT_LE(to.on_the_line(), from.on_the_line());
  }
  EXPECT_GT(to.datagrams, 0U);
}

// Servers draw tokens from the kernel, simulations from the seed. Two connections, or two simulations with different
// seeds, share no token.
TEST(PathTokens, DifferBetweenTwoSimulatedSessions) {
  SessionFixture one("one_axis", 3), same("one_axis", 3), other("one_axis", 4);
  int equal = 0;
  for (std::size_t n = 0; n < PathTokens::kMax; ++n) {
    const auto a = one.session->path_tokens().take(), b = same.session->path_tokens().take(),
               c = other.session->path_tokens().take();
    ASSERT_TRUE(a && b && c);
    EXPECT_EQ(a, b);
    equal += a == c ? 1 : 0;
  }
  EXPECT_EQ(equal, 0);
}

}  // namespace
}  // namespace tandem::server
