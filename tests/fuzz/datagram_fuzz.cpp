// Fuzzes datagrams at both ends of a connection: first as from an unknown sender, then as plaintext with a valid tag,
// because a peer with a key may send any content. Each accepted message is finite and in range, and encodes to as many
// bytes as it was decoded from.
#include <cmath>
#include <utility>

#include "common/transport/secure_channel.h"
#include "proto/wire/wire_codec.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace tandem;

transport::SecureChannel::Params end_of(transport::Direction outgoing) {
  transport::SecureChannel::Params p;
  p.outgoing = outgoing;
  p.own_cid = outgoing == transport::Direction::kToServer ? 11 : 22;
  p.peer_cid = 33 - p.own_cid;
  p.secrets.cipher = transport::Cipher::kChaCha20Poly1305;
  return p;
}

void expect_sound(const PortSample& p, std::size_t axes, double position_max) {
  for (std::size_t a = 0; a < axes; ++a) {
    FUZZ_EXPECT(std::abs(p.x[a]) <= position_max);
    FUZZ_EXPECT(std::abs(p.v[a]) <= wire::kVelocityMax);
    FUZZ_EXPECT(std::abs(p.f[a]) <= wire::kEffortMax);
    FUZZ_EXPECT(p.e_in[a] <= wire::kEnergyMax);
  }
}

template <class Message>
void expect_same(wire::Codec& codec, const wire::Decoded<Message>& decoded, std::span<const std::byte> in) {
  std::array<std::byte, wire::kPlaintextMax> out;
  const std::size_t size = codec.encode(decoded->preamble, decoded->message, out);
  FUZZ_EXPECT(size == in.size());
}

/// Port, and whether the seat is a MASTER of law REPLICA (else a SLAVE).
constexpr std::pair<PortSpace, bool> kSeats[]{
    {PortSpace::kTip, true}, {PortSpace::kTip, false}, {PortSpace::kJoint, false}};

void as_insider(std::span<const std::byte> plain) {
  for (const std::size_t axes : {1, 3, 7})
    for (const auto& [port, seat] : kSeats) {
      wire::Codec codec{wire::BodyLayout{.axes = axes, .port = port, .tool_copies = seat, .environment = !seat}};
      const double position_max = port == PortSpace::kTip ? wire::kPositionMaxM : wire::kPositionMaxRad;
      if (const auto m = codec.decode_state(plain)) {
        expect_sound(m->message.port, axes, position_max);
        expect_same(codec, m, plain);
      }
      if (const auto m = codec.decode_force(plain)) {
        expect_sound(m->message.port, axes, position_max);
        for (const LocalContact& contact : m->message.contacts.all())
          FUZZ_EXPECT(is_surface(contact, axes) && in_range(contact));
        FUZZ_EXPECT(m->message.ghost.leader <= kMastersMax);
        for (std::size_t k = 0; k < 3; ++k)
          FUZZ_EXPECT(std::abs(m->message.ghost.x[k]) <= wire::kPositionMaxM &&
                      std::abs(m->message.ghost.v[k]) <= wire::kVelocityMax);
        expect_same(codec, m, plain);
      }
      if (const auto m = codec.decode_authority(plain)) expect_same(codec, m, plain);
      if (const auto m = codec.decode_path(plain)) expect_same(codec, m, plain);
      if (const auto m = codec.decode_close(plain)) expect_same(codec, m, plain);
      if (const auto m = codec.decode_ping(plain)) expect_same(codec, m, plain);
      if (const auto m = codec.decode_link_probe(plain)) expect_same(codec, m, plain);
      if (const auto m = codec.decode_link_report(plain)) expect_same(codec, m, plain);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto in = fuzz::bytes(data, size);
  static transport::SecureChannel client{end_of(transport::Direction::kToServer)},
      server{end_of(transport::Direction::kToClient)};
  const Time now{std::chrono::hours(1)};
  FUZZ_EXPECT(!client.open(now, in));
  FUZZ_EXPECT(!server.open(now, in));
  as_insider(in);

  if (size == 0 || size > wire::kPlaintextMax) return 0;
  transport::SecureChannel sender{end_of(transport::Direction::kToServer)},
      receiver{end_of(transport::Direction::kToClient)};
  std::array<std::byte, transport::kDatagramMax> datagram{};
  std::ranges::copy(in, datagram.begin() + transport::kHeaderSize);
  const std::size_t sealed = sender.seal(now, wire::Type::kState, datagram, size);
  FUZZ_EXPECT(sealed == size + transport::kHeaderSize + transport::kTagSize);
  const auto opened = receiver.open(now, std::span{datagram}.first(sealed));
  FUZZ_EXPECT(opened && std::ranges::equal(opened->plaintext, in));
  return 0;
}
