// An insider that holds a seat's keys and sends false messages (tests/FAILURES.md). The force on the other hand is
// compared with a twin session whose same seat fell silent at the same time: false messages must have no more effect
// than silence.
#include <gtest/gtest.h>

#include <cstdio>
#include <functional>
#include <limits>

#include "tests/server/session/forging_client.h"

namespace tandem::server {
namespace {

using namespace test;

constexpr std::size_t kTrainer = 0, kTrainee = 1;

using Lie = std::function<std::vector<Bytes>(ForgingClient&, const Bytes& honest, int ms)>;

struct Felt {
  double worst_n = 0;       ///< largest difference of the trainer's force between the session and its twin [N]
  double strongest_n = 0;   ///< largest force of the trainer: without force the comparison would mean nothing [N]
  std::uint32_t trips = 0;  ///< of the trainer's gate
  std::uint64_t refused = 0;
  double alpha = 0;  ///< authority of the insider at the end
};

/// @param lie  sent by the trainee in place of its STATE; the twin's trainee sends nothing
Felt felt(const Lie& lie, int milliseconds = 500) {
  SessionFixture rig("free_motion"), twin("free_motion");
  for (SessionFixture* r : {&rig, &twin}) r->run(3s);
  EXPECT_EQ(rig.session->state(), wire::SessionState::kRunning);
  ForgingClient liar{rig, kTrainee};
  Felt out;
  for (int ms = 0; ms < milliseconds; ++ms) {
    for (SessionFixture* r : {&rig, &twin}) {
      for (const Bytes& d : r->client_tick(kTrainer)) r->session->on_datagram(r->now, address(1), d);
      for (const Bytes& d : r->client_tick(kTrainee))
        if (r == &rig)
          for (const Bytes& forged : lie(liar, d, ms)) r->session->on_datagram(r->now, address(2), forged);
      r->to_clients(r->server_tick());
      r->now += 1ms;
    }
    const hal::Vec3 difference = rig.seats[kTrainer].device->state().f_out - twin.seats[kTrainer].device->state().f_out;
    out.worst_n = std::max(out.worst_n, difference.norm());
    out.strongest_n = std::max(out.strongest_n, twin.seats[kTrainer].device->state().f_out.norm());
  }
  out.trips = rig.seats[kTrainer].core->gate().trips();
  out.refused = rig.refused(transport::DropReason::kBody, kTrainee);
  out.alpha = rig.session->tool(0).authority.alpha(kTrainee);
  std::printf("[ hostile  ] the other hand's force of up to %.2f N differs by at most %.4f N; %llu refused\n",
              out.strongest_n, out.worst_n, static_cast<unsigned long long>(out.refused));
  return out;
}

void expect_only_he_is_isolated(const Felt& f) {
  EXPECT_LE(f.worst_n, 0.2);
  EXPECT_GT(f.strongest_n, 0.01);
  EXPECT_EQ(f.trips, 0U);
  EXPECT_EQ(f.alpha, 0);
}

// "NaN, 1e308, 100 m jumps": none of them is a valid message, so the seat counts as silent from the first one on.
TEST(Insider, CountsAsSilentWhileItSendsInvalidNumbers) {
  const double wrong[] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e308, 100,
                          -100};
  for (const double value : wrong)
    for (int field = 0; field < 3; ++field) {
      if (std::abs(value) == 100 && field > 0) continue;  // 100 N and 100 m/s are in range
      SCOPED_TRACE(std::to_string(value) + " in " + std::to_string(field));
      const Felt f = felt([&](ForgingClient& liar, const Bytes& honest, int ms) {
        auto [preamble, m] = liar.read(honest);
        (field == 0 ? m.port.x : field == 1 ? m.port.v : m.port.f)[static_cast<std::size_t>(ms) % 3] = value;
        return std::vector<Bytes>{liar.say(transport::read_header(honest)->counter, wire::Type::kState, preamble, m)};
      });
      expect_only_he_is_isolated(f);
      EXPECT_LE(f.worst_n, 1e-9) << "exactly as if that seat were silent";
      EXPECT_EQ(f.refused, 500U);
    }
}

// "Wrong lengths": a sealed plaintext that is one to forty bytes short is dropped.
TEST(Insider, CountsAsSilentWhileItSendsWrongLengths) {
  const Felt f = felt([](ForgingClient& liar, const Bytes& honest, int ms) {
    const auto [preamble, m] = liar.read(honest);
    return std::vector<Bytes>{liar.say(transport::read_header(honest)->counter, wire::Type::kState, preamble, m,
                                       1 + static_cast<std::size_t>(ms) % 40)};
  });
  expect_only_he_is_isolated(f);
  EXPECT_LE(f.worst_n, 1e-9);
}

// "Instructor messages from a trainee", and all messages that only servers send.
TEST(Insider, HasNoEffectWithMessagesOfOtherRoles) {
  const Felt f = felt([](ForgingClient& liar, const Bytes& honest, int ms) {
    const auto [preamble, m] = liar.read(honest);
    wire::AuthorityMessage all_to_me;
    all_to_me.version = static_cast<std::uint32_t>(ms % 6);
    all_to_me.masters = 2;
    all_to_me.alpha = {0, 1};
    const std::uint64_t counter = 1'000'000 + 4 * static_cast<std::uint64_t>(ms);
    return std::vector<Bytes>{liar.say(counter, wire::Type::kAuthority, preamble, all_to_me),
                              liar.say(counter + 1, wire::Type::kForce, preamble, wire::ForceMessage{}),
                              liar.say(counter + 2, wire::Type::kPathChallenge, preamble, wire::PathMessage{1}),
                              liar.say(counter + 3, wire::Type::kPathResponse, preamble, wire::PathMessage{1})};
  });
  expect_only_he_is_isolated(f);
  EXPECT_LE(f.worst_n, 1e-9);
}

// "10 kHz", and jumps within the range of positions: a trainee without authority moves no tool, at any rate and with
// any content.
TEST(Insider, DoesNotDisturbTheAuthorityHolderByJumpsAtTenKilohertz) {
  const Felt f = felt([](ForgingClient& liar, const Bytes& honest, int ms) {
    std::vector<Bytes> out;
    auto [preamble, m] = liar.read(honest);
    for (int k = 0; k < 10; ++k) {
      m.port.x[0] = k % 2 == 0 ? 9 : -9;
      m.port.f[0] = k % 2 == 0 ? 9e3 : -9e3;
      m.port.e_in[0] += wire::kEnergyMax / 100'000;
      out.push_back(liar.say(1'000'000 + 10 * static_cast<std::uint64_t>(ms) + static_cast<std::uint64_t>(k),
                             wire::Type::kState, preamble, m));
    }
    return out;
  });
  expect_only_he_is_isolated(f);
}

}  // namespace
}  // namespace tandem::server
