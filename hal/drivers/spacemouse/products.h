#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

/// USB ids of 3Dconnexion's six-axis devices. The maker's ordinary mice and keyboards share the vendor's id and must
/// not be opened.
/// Source: ids as published by spacenavd, PySpaceMouse and users' descriptors.
namespace tandem::hal::spacemouse {

struct Product {
  std::uint16_t vendor, product;
  std::string_view name;
};

inline constexpr std::uint16_t kLogitech = 0x046D, k3Dconnexion = 0x256F;
/// HID usage of a SpaceMouse: generic desktop, multi-axis controller.
inline constexpr std::uint16_t kUsagePage = 0x01, kUsage = 0x08;

inline constexpr std::array<Product, 23> kProducts{{
    {kLogitech, 0xC603, "SpaceMouse Plus XT"},
    {kLogitech, 0xC605, "CadMan"},
    {kLogitech, 0xC606, "SpaceMouse Classic"},
    {kLogitech, 0xC621, "SpaceBall 5000"},
    {kLogitech, 0xC623, "SpaceTraveler"},
    {kLogitech, 0xC625, "SpacePilot"},
    {kLogitech, 0xC626, "SpaceNavigator"},
    {kLogitech, 0xC627, "SpaceExplorer"},
    {kLogitech, 0xC628, "SpaceNavigator for Notebooks"},
    {kLogitech, 0xC629, "SpacePilot Pro"},
    {kLogitech, 0xC62B, "SpaceMouse Pro"},
    {kLogitech, 0xC640, "NuLOOQ"},
    {k3Dconnexion, 0xC62E, "SpaceMouse Wireless (cable)"},
    {k3Dconnexion, 0xC62F, "SpaceMouse Wireless (receiver)"},
    {k3Dconnexion, 0xC631, "SpaceMouse Pro Wireless (cable)"},
    {k3Dconnexion, 0xC632, "SpaceMouse Pro Wireless (receiver)"},
    {k3Dconnexion, 0xC633, "SpaceMouse Enterprise"},
    {k3Dconnexion, 0xC635, "SpaceMouse Compact"},
    {k3Dconnexion, 0xC636, "SpaceMouse Module"},
    {k3Dconnexion, 0xC638, "SpaceMouse Pro Wireless BT"},
    {k3Dconnexion, 0xC63A, "SpaceMouse Wireless BT"},
    {k3Dconnexion, 0xC641, "SpaceMouse USB"},
    {k3Dconnexion, 0xC652, "Universal Receiver"},
}};

/// CadMice, keyboards, number pads: never treated as a SpaceMouse, whatever usage they report.
inline constexpr std::array<std::uint16_t, 11> kExcluded{0xC650, 0xC651, 0xC654, 0xC655, 0xC656, 0xC657,
                                                         0xC658, 0xC664, 0xC665, 0xC668, 0xC62C};

/// Returns the name of a SpaceMouse product; empty: another device.
[[nodiscard]] constexpr std::string_view product_name(std::uint16_t vendor, std::uint16_t product) noexcept {
  const auto found =
      std::ranges::find_if(kProducts, [&](const Product& p) { return p.vendor == vendor && p.product == product; });
  return found == kProducts.end() ? std::string_view{} : found->name;
}
[[nodiscard]] constexpr bool is_excluded(std::uint16_t vendor, std::uint16_t product) noexcept {
  return (vendor == k3Dconnexion || vendor == kLogitech) && std::ranges::find(kExcluded, product) != kExcluded.end();
}
/// Returns whether a device is a SpaceMouse: a listed product, or one with 3Dconnexion's own id and the SpaceMouse
/// usage that is newer than the list.
[[nodiscard]] constexpr bool is_spacemouse(std::uint16_t vendor, std::uint16_t product, std::uint16_t usage_page,
                                           std::uint16_t usage) noexcept {
  if (is_excluded(vendor, product) || usage_page != kUsagePage || usage != kUsage) return false;
  return vendor == k3Dconnexion || !product_name(vendor, product).empty();
}

}  // namespace tandem::hal::spacemouse
