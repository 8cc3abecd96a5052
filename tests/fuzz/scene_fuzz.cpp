// Scene texts, strict and lenient form alike, and the setup of a seat as it travels: mistakes with their places, or a scene whose
// explanation can be printed and whose seats' setups are read back.
#include "proto/scene_text.h"
#include "proto/seat_setup.h"
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
