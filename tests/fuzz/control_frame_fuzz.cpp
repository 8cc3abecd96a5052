// Fuzzes frames of the control connection: decoding gives an error, or a message that encodes to the same bytes.
#include "proto/rpc/rpc_codec.h"
#include "tests/fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tandem::rpc;
  const auto in = tandem::fuzz::bytes(data, size);
  if (size >= kLengthSize) {
    const auto length = frame_length(in.first<kLengthSize>());
    FUZZ_EXPECT(!length || (*length >= 1 && *length <= kFrameMax));
  }
  const auto head = peek(in);
  const auto got = decode(in);
  if (!got) return 0;
  FUZZ_EXPECT(head && *head == (Head{kind_of(*got), got->request}));
  const auto again = encode(*got);
  FUZZ_EXPECT(again && std::ranges::equal(again->bytes().subspan(kLengthSize), in));
  return 0;
}
