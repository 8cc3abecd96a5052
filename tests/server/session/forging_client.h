#pragma once

#include <gtest/gtest.h>

#include <type_traits>
#include <vector>

#include "tests/server/session/session_fixture.h"

namespace tandem::server::test {

/// A client that seals any message under the keys of a seat, with any counter.
class ForgingClient {
 public:
  ForgingClient(const transport::SecureChannel::Params& params, const wire::BodyLayout& layout)
      : cid_(params.peer_cid),
        seal_(transport::key_of(params.secrets.to_server, params.secrets.cipher)),
        hears_(transport::key_of(params.secrets.to_client, params.secrets.cipher)),
        codec_(layout),
        further_(codec_.further()) {}
  ForgingClient(const SessionFixture& rig, std::size_t seat)
      : ForgingClient(rig.seats[seat].params, body_layout(seat_setup(rig.scene, seat))) {}

  wire::Received<wire::StateMessage> read(const Bytes& d) {
    Bytes plain(d.size() - 32);
    EXPECT_TRUE(seal_.open(transport::read_header(d)->counter, d, plain));
    wire::Received<wire::StateMessage> out;
    const auto preamble = codec_.decode_state(plain, out.message, further_);
    EXPECT_TRUE(preamble);
    if (preamble) out.preamble = *preamble;
    return out;
  }
  /// Token in a challenge that the server sent to this client.
  std::uint64_t token(const Bytes& d) {
    Bytes plain(d.size() - 32);
    EXPECT_TRUE(hears_.open(transport::read_header(d)->counter, d, plain));
    return codec_.decode_path(plain)->message.token;
  }
  template <class Message>
  Bytes say(std::uint64_t counter, wire::Type type, const wire::Preamble& preamble, const Message& message,
            std::size_t cut = 0) {
    Bytes out(transport::kDatagramMax);
    const auto body = std::span{out}.subspan(transport::kHeaderSize);
    std::size_t plain = 0;
    if constexpr (std::is_same_v<Message, wire::StateMessage>) {
      plain = codec_.encode(preamble, wire::StateWithTools{message, further_}, body) - cut;
    } else {
      plain = codec_.encode(preamble, message, body) - cut;
    }
    out.resize(plain + 32);
    transport::write_header({type, 0, cid_, counter}, std::span{out}.first<transport::kHeaderSize>());
    EXPECT_TRUE(seal_.seal(counter, out));
    return out;
  }

 private:
  std::uint32_t cid_;
  transport::Aead seal_, hears_;
  wire::Codec codec_;
  std::vector<PortSample> further_;  ///< of the last STATE that was read
};

}  // namespace tandem::server::test
