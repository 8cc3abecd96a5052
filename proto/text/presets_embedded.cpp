#include "proto/text/presets_embedded.h"

namespace tandem {
namespace {

ShippedPreset preset_table[] = {
#include "presets_embedded_data.inc"
};

std::string_view first_preset_comment(std::string_view text) {
  if (!text.starts_with('#')) return {};
  text = text.substr(0, text.find('\n'));
  const auto start = text.find_first_not_of("# ");
  return start == std::string_view::npos ? std::string_view{} : text.substr(start);
}

std::span<const ShippedPreset> summarised() noexcept {
  for (auto& preset : preset_table) preset.summary = first_preset_comment(preset.text);
  return preset_table;
}

}  // namespace

std::span<const ShippedPreset> shipped_presets() noexcept {
  static const auto presets = summarised();
  return presets;
}

const ShippedPreset* find_shipped_preset(std::string_view name) noexcept {
  for (const auto& preset : shipped_presets()) {
    if (preset.name == name) return &preset;
  }
  return nullptr;
}

}  // namespace tandem
