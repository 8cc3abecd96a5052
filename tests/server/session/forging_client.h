#pragma once

#include <gtest/gtest.h>

#include "tests/server/session/session_fixture.h"

namespace tandem::server::test {

/// A client that seals any message under the keys of a seat, with any counter.
class ForgingClient {
 public:
  ForgingClient(const transport::SecureChannel::Params& params, std::size_t dof, PortSpace port)
      : cid_(params.peer_cid),
        seal_(transport::key_of(params.secrets.to_server, params.secrets.cipher)),
        hears_(transport::key_of(params.secrets.to_client, params.secrets.cipher)),
        codec_(dof, port) {}
  ForgingClient(const SessionFixture& rig, std::size_t seat)
      : ForgingClient(rig.seats[seat].params, rig.scene.dof, rig.scene.port) {}

  wire::Received<wire::StateMessage> read(const Bytes& d) {
    Bytes plain(d.size() - 32);
    EXPECT_TRUE(seal_.open(transport::read_header(d)->counter, d, plain));
    return *codec_.decode_state(plain);
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
    const std::size_t plain = codec_.encode(preamble, message, std::span{out}.subspan(transport::kHeaderSize)) - cut;
    out.resize(plain + 32);
    transport::write_header({type, 0, cid_, counter}, std::span{out}.first<transport::kHeaderSize>());
    EXPECT_TRUE(seal_.seal(counter, out));
    return out;
  }

 private:
  std::uint32_t cid_;
  transport::Aead seal_, hears_;
  wire::Codec codec_;
};

}  // namespace tandem::server::test
