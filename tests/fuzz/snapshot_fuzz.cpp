// Fuzzes snapshots of sessions, which a server reads from its state folder and from the directory of its service. The
// target itself adds the two digests, because a holder of etcd's credentials can compute them too. An accepted snapshot
// encodes to the same bytes.
#include "common/transport/digest.h"
#include "proto/rpc/rpc_texts.h"
#include "server/session/session_snapshot.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace tandem;

void append_digest(std::vector<std::byte>& bytes, std::size_t from) {
  const auto digest = transport::sha256(std::span<const std::byte>(bytes).subspan(from));
  bytes.insert(bytes.end(), digest.begin(), digest.end());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto in = fuzz::bytes(data, size);
  static_cast<void>(server::decode_snapshot(in));
  if (size < 2) return 0;
  // The first two bytes say where the checkpoint begins.
  const auto rest = in.subspan(2);
  const std::size_t head =
      (std::to_integer<std::size_t>(in[0]) | std::to_integer<std::size_t>(in[1]) << 8) % (rest.size() + 1);
  std::vector<std::byte> bytes(rest.begin(), rest.end());
  append_digest(bytes, head);
  append_digest(bytes, 0);
  if (const auto kept = server::decode_snapshot(bytes)) {
    FUZZ_EXPECT(std::ranges::equal(server::encode_snapshot(*kept), bytes));
    for (const std::string& person : kept->persons) FUZZ_EXPECT(person.empty() || rpc::is_name(person));
  }
  return 0;
}
