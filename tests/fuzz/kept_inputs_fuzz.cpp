// Fuzzes kept inputs of a session: entries of a spool, and the blocks in them, which recordings have too. The target
// itself corrects the CRC of an entry. An accepted block gives a piece that packs and unpacks to the same piece.
#include "common/base/raw_bytes.h"
#include "common/mcap/crc32.h"
#include "proto/spec/scene_spec.h"
#include "server/recording/input_packer.h"
#include "server/recording/input_unpacker.h"
#include "server/recording/kept_block.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace tandem;

void unpack(std::span<const std::byte> block) {
  static const Lesson no_rows;
  static const SceneSpec no_scene;
  server::InputUnpacker unpacker(no_rows);
  const auto piece = unpacker.unpack(block);
  if (!piece || piece->size() <= sizeof(std::uint64_t)) return;
  const std::vector<std::byte> bytes(piece->begin(), piece->end());
  server::InputPacker packer(no_scene);
  FUZZ_EXPECT(packer.add(bytes));
  std::string again;
  packer.take(again, true);
  const auto back = unpacker.unpack(bytes_of(again));
  FUZZ_EXPECT(back && std::ranges::equal(*back, bytes));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto in = fuzz::bytes(data, size);
  unpack(in);
  if (size <= server::KeptBlockHead::kSize) return 0;
  auto head = server::KeptBlockReader::read_head(in.first<server::KeptBlockHead::kSize>());
  if (!head) return 0;
  const auto packed = in.subspan(server::KeptBlockHead::kSize);
  head->packed = static_cast<std::uint32_t>(packed.size());
  head->crc = mcap::crc32(packed);
  server::KeptBlockReader reader;
  if (const auto block = reader.read(*head, packed)) {
    FUZZ_EXPECT(block->size() == head->size);
    unpack(bytes_of(*block));
  }
  return 0;
}
