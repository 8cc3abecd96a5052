#pragma once

#include <gtest/gtest.h>

#include "tests/server/rig.h"

namespace tandem::server::test {

/// Holds a client's keys and says under them whatever a test wants, under any counter.
class Liar {
 public:
  Liar(const link::Link::Params& params, std::size_t dof, PortSpace port)
      : cid_(params.peer_cid), seal_(link::key_of(params.secrets.to_server, params.secrets.cipher)), hears_(link::key_of(params.secrets.to_client, params.secrets.cipher)), codec_(dof, port) {}
  Liar(const Rig& rig, std::size_t seat) : Liar(rig.seats[seat].params, rig.scene.dof, rig.scene.port) {}

  wire::Received<wire::StateMessage> read(const Bytes& d) {
    Bytes plain(d.size() - 32);
    EXPECT_TRUE(seal_.open(link::read_header(d)->counter, d, plain));
    return *codec_.decode_state(plain);
  }
  /// Of a challenge that the server sent to it.
  std::uint64_t token(const Bytes& d) {
    Bytes plain(d.size() - 32);
    EXPECT_TRUE(hears_.open(link::read_header(d)->counter, d, plain));
    return codec_.decode_path(plain)->message.token;
  }
  template <class Message>
  Bytes say(std::uint64_t counter, wire::Type type, const wire::Preamble& preamble, const Message& message, std::size_t cut = 0) {
    Bytes out(link::kDatagramMax);
    const std::size_t plain = codec_.encode(preamble, message, std::span{out}.subspan(link::kHeaderSize)) - cut;
    out.resize(plain + 32);
    link::write_header({type, 0, cid_, counter}, std::span{out}.first<link::kHeaderSize>());
    EXPECT_TRUE(seal_.seal(counter, out));
    return out;
  }

 private:
  std::uint32_t cid_;
  link::Seal seal_, hears_;
  wire::Codec codec_;
};

}  // namespace tandem::server::test
