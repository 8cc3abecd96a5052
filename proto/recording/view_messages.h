#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

/// Foxglove's messages for viewers (proto/schema/foxglove.proto), made from plain values. Positions are in metres in
/// frame kViewFrame, times in nanoseconds.
namespace tandem::rec {

using Triple = std::array<double, 3>;

inline constexpr const char* kViewFrame = "task";  ///< frame of the scene

/// Red, green, blue, opacity, each from 0 to 1.
using ViewColor = std::array<double, 4>;
/// A hand or a tool: a ball, and its force as an arrow.
struct ViewBody {
  std::string id;  ///< unique within the scene
  Triple position{};
  Triple force{};       ///< [N]; drawn with kViewMetresPerNewton
  double diameter = 0;  ///< [m]
  ViewColor color{};
  std::string label;
};
inline constexpr double kViewMetresPerNewton = 0.02;
/// A box, such as a wall.
struct ViewBox {
  std::string id;
  Triple center{}, size{};
  ViewColor color{};
};

/// A SceneUpdate. Bodies whose position is not finite are left out, and so is the arrow of a force that is not finite
/// or below 1 mN.
[[nodiscard]] std::string encode_scene_update(std::uint64_t time_ns, const std::vector<ViewBody>& bodies,
                                              const std::vector<ViewBox>& boxes);
/// A FrameTransform from kViewFrame to a frame without rotation at `position`.
[[nodiscard]] std::string encode_transform(std::uint64_t time_ns, const std::string& child, const Triple& position);
/// A PoseInFrame without rotation.
[[nodiscard]] std::string encode_pose(std::uint64_t time_ns, const Triple& position);
enum class LogLevel : std::uint8_t { kInfo, kWarning };
/// A Log. @param name  source of the message, such as a seat
[[nodiscard]] std::string encode_log(std::uint64_t time_ns, LogLevel level, const std::string& name,
                                     const std::string& text);

}  // namespace tandem::rec
