#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "proto/text/scene_bytes.h"
#include "proto/text/seat_setup.h"
#include "proto/wire/wire_messages.h"

namespace tandem::server {

[[nodiscard]] inline std::vector<std::byte> bytes_of_setup(std::span<const char> text) {
  const auto bytes = std::as_bytes(text);
  return {bytes.begin(), bytes.end()};
}

/// `setup` of a Welcome: the seat's setup, or for watchers the scene; empty: it does not fit.
[[nodiscard]] inline std::vector<std::byte> encoded(const SeatSetup& setup) {
  std::array<char, wire::kSetupMax> text;
  return bytes_of_setup(std::span{text}.first(encode_seat_setup(setup, text)));
}
[[nodiscard]] inline std::vector<std::byte> encoded(const SceneSpec& scene) {
  std::array<char, wire::kSetupMax> text;
  return bytes_of_setup(std::span{text}.first(encode_scene(scene, text)));
}

}  // namespace tandem::server
