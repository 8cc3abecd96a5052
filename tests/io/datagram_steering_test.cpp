// The kernel's program that distributes datagrams to sockets, run by an interpreter and by the kernel.
#include "common/io/datagram_steering.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/base/rng.h"
#include "common/io/processors.h"
#include "common/io/udp_socket.h"

namespace tandem::io {
namespace {

struct Result {
  std::uint32_t socket = 0;
  std::size_t steps = 0;
};

/// Runs the program on a datagram. @return nullopt: it has an instruction or a jump that it must not have
std::optional<Result> run(const std::vector<sock_filter>& program, const std::vector<std::uint8_t>& datagram) {
  std::uint32_t accumulator = 0;
  std::size_t at = 0;
  for (std::size_t steps = 1; at < program.size(); ++steps) {
    const sock_filter& i = program[at];
    switch (i.code) {
      case BPF_LD | BPF_B | BPF_ABS:
        if (i.k >= datagram.size()) return Result{0, steps};  // as the kernel does
        accumulator = datagram[i.k];
        ++at;
        break;
      case BPF_JMP | BPF_JGE | BPF_K:
        at += 1 + (accumulator >= i.k ? i.jt : i.jf);
        break;
      case BPF_RET | BPF_K:
        return Result{i.k, steps};
      default:
        return std::nullopt;
    }
  }
  return std::nullopt;
}

void expect_assignment(const Steering& steering) {
  const SteeringProgram program{steering};
  ASSERT_LE(program.instructions().size(), 512U) << "the kernel accepts 4096";
  std::vector<std::uint8_t> datagram(8, 0xff);
  for (std::size_t value = 0; value < 256; ++value) {
    datagram[steering.byte] = static_cast<std::uint8_t>(value);
    const auto result = run(program.instructions(), datagram);
    ASSERT_TRUE(result) << value;
    ASSERT_EQ(result->socket, steering.socket_of[value]) << value;
    ASSERT_LE(result->steps, 10U) << value;
  }
  const auto empty = run(program.instructions(), {});
  ASSERT_TRUE(empty);
  EXPECT_EQ(empty->socket, 0U);
}

TEST(SteeringProgram, GivesEveryValueToItsSocketWithinTenSteps) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream r{RandomKey{seed}};
    Steering steering{.byte = 5, .sockets = 1 + r.below(Steering::kSocketsMax), .socket_of = {}};
    const std::uint64_t run_length = 1 + r.below(100);  // from alternating sockets to few long runs
    for (auto& socket : steering.socket_of) {
      const bool same = &socket != steering.socket_of.data() && r.below(run_length) != 0;
      socket = same ? *(&socket - 1) : static_cast<std::uint8_t>(r.below(steering.sockets));
    }
    expect_assignment(steering);
  }
  Steering alternating{.byte = 5, .sockets = 2, .socket_of = {}};
  for (std::size_t i = 0; i < 256; ++i) alternating.socket_of[i] = i % 2;
  expect_assignment(alternating);
  Steering all{.byte = 5, .sockets = 64, .socket_of = {}};
  for (std::size_t i = 0; i < 256; ++i) all.socket_of[i] = i % 64;
  expect_assignment(all);
}

/// Number of datagrams in a socket.
int waiting(const UdpSocket& socket) {
  int count = 0;
  std::array<std::byte, 64> buffer;
  while (::recv(socket.fd.get(), buffer.data(), buffer.size(), MSG_DONTWAIT) > 0) ++count;
  return count;
}

TEST(SteeringProgram, TakesEffectAtOnceWhenItIsReplaced) {
  Steering steering{.byte = 5, .sockets = 3, .socket_of = {}};
  const auto sockets = bind_udp_steered(*parse_address("127.0.0.1:0", 0), steering);
  ASSERT_TRUE(sockets) << sockets.error();
  const auto client = connect_udp(sockets->front().local);
  ASSERT_TRUE(client);
  const std::array<std::uint8_t, 6> datagram{0, 0, 0, 0, 0, 200};
  for (std::uint8_t round = 0; round < 30; ++round) {
    const std::uint8_t to = round % 3;
    steering.socket_of[200] = to;
    ASSERT_TRUE(SteeringProgram{steering}.attach((*sockets)[(to + 1) % 3].fd.get()));
    for (int i = 0; i < 5; ++i) ASSERT_EQ(::send(client->fd.get(), datagram.data(), datagram.size(), 0), 6);
    for (std::uint8_t i = 0; i < 3; ++i) EXPECT_EQ(waiting((*sockets)[i]), i == to ? 5 : 0) << int{round};
  }
}

TEST(SteeredSockets, GetNoDatagramBeforeTheProgramNamesThemWhenTheyAreAdded) {
  Steering steering{.byte = 5, .sockets = 1, .socket_of = {}, .grows = true};
  auto sockets = bind_udp_steered(*parse_address("127.0.0.1:0", 0), steering);
  ASSERT_TRUE(sockets) << sockets.error();
  const auto client = connect_udp(sockets->front().local);
  ASSERT_TRUE(client);
  std::array<std::uint8_t, 6> datagram{};
  const auto sent_to = [&](std::size_t slot) {
    datagram[5] = static_cast<std::uint8_t>(slot);
    EXPECT_EQ(::send(client->fd.get(), datagram.data(), datagram.size(), 0), 6);
    for (std::size_t i = 0; i < sockets->size(); ++i)
      if (waiting((*sockets)[i]) == 1) return i;
    return Steering::kSocketsMax;
  };
  while (sockets->size() < 5) {
    auto added = bind_udp_beside(sockets->front());
    ASSERT_TRUE(added) << added.error();
    EXPECT_EQ(to_text(added->local), to_text(sockets->front().local));
    sockets->push_back(std::move(*added));
    for (std::size_t slot = 0; slot < 256; slot += 5) EXPECT_EQ(sent_to(slot), steering.socket_of[slot]);
    steering.socket_of[5 * sockets->size()] = static_cast<std::uint8_t>(sockets->size() - 1);
    steering.sockets = sockets->size();
    ASSERT_TRUE(SteeringProgram{steering}.attach(sockets->front().fd.get()));
    for (std::size_t slot = 0; slot < 256; slot += 5) EXPECT_EQ(sent_to(slot), steering.socket_of[slot]);
  }
  EXPECT_FALSE(bind_udp_beside(*bind_udp(*parse_address("127.0.0.1:0", 0))))
      << "a socket that shares its port with no other";
}

TEST(SteeredSockets, LeaveThePortOfAnotherServerAlone) {
  Steering steering{.byte = 5, .sockets = 2, .socket_of = {}};
  steering.socket_of[200] = 1;
  const auto first = bind_udp_steered(*parse_address("127.0.0.1:0", 0), steering);
  ASSERT_TRUE(first) << first.error();
  const auto second = bind_udp_steered(first->front().local, Steering{.byte = 5, .sockets = 2, .socket_of = {}});
  ASSERT_FALSE(second);
  EXPECT_NE(second.error().find("is in use by another program"), std::string::npos) << second.error();
  const auto client = connect_udp(first->front().local);
  ASSERT_TRUE(client);
  const std::array<std::uint8_t, 6> datagram{0, 0, 0, 0, 0, 200};
  ASSERT_EQ(::send(client->fd.get(), datagram.data(), datagram.size(), 0), 6);
  EXPECT_EQ(waiting((*first)[0]), 0);
  EXPECT_EQ(waiting((*first)[1]), 1) << "by its own program";
}

TEST(SteeringProgram, ReportsThatTheKernelRejectedIt) {
  const SteeringProgram program{Steering{}};
  EXPECT_FALSE(program.attach(-1));
  const auto alone = bind_udp(*parse_address("127.0.0.1:0", 0));
  ASSERT_TRUE(alone);
  EXPECT_FALSE(program.attach(alone->fd.get())) << "a socket that shares its port with no other";
}

TEST(Processors, AreAtLeastOne) { EXPECT_GE(available_processors(), 1U); }

}  // namespace
}  // namespace tandem::io
