// Fuzzes scene texts in strict and lenient form, and encoded seat setups. Parsing a scene gives errors with their
// locations, or a scene whose seat setups can be encoded and decoded.
#include "proto/text/scene_text.h"
#include "proto/text/seat_setup.h"
#include "tests/fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tandem;
  const auto text = fuzz::text(data, size);
  for (const char* name : {"fuzz.textproto", "fuzz.json"}) {
    const auto scene = parse_scene(text, name);
    if (!scene) {
      FUZZ_EXPECT(!scene.error().empty());
      continue;
    }
    FUZZ_EXPECT(!scene->seats.empty() && scene->seats.size() <= kSeatsMax);
    for (std::size_t i = 0; i < scene->seats.size(); ++i) {
      std::array<char, wire::kSetupMax> out;
      const std::size_t written = encode_seat_setup(seat_setup(*scene, i), out);
      FUZZ_EXPECT(written > 0 && decode_seat_setup(std::span{out}.first(written)));
    }
  }
  static_cast<void>(decode_seat_setup(std::span{text.data(), text.size()}));
  return 0;
}
