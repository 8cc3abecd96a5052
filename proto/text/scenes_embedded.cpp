#include "proto/text/scenes_embedded.h"

namespace tandem {
namespace {

ShippedScene scene_table[] = {
#include "scenes_embedded_data.inc"
};

std::string_view first_scene_comment(std::string_view text) {
  if (!text.starts_with('#')) return {};
  text = text.substr(0, text.find('\n'));
  const auto start = text.find_first_not_of("# ");
  return start == std::string_view::npos ? std::string_view{} : text.substr(start);
}

std::span<const ShippedScene> summarised() noexcept {
  for (auto& scene : scene_table) scene.summary = first_scene_comment(scene.text);
  return scene_table;
}

}  // namespace

std::span<const ShippedScene> shipped_scenes() noexcept {
  static const auto scenes = summarised();
  return scenes;
}

const ShippedScene* find_shipped_scene(std::string_view name) noexcept {
  for (const auto& scene : shipped_scenes()) {
    if (scene.name == name) return &scene;
  }
  return nullptr;
}

}  // namespace tandem
