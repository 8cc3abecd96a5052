#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <span>
#include <string>
#include <vector>

#include "proto/recording/lesson_source.h"

/// Data sets in the format of LeRobot (huggingface/lerobot, versions 2.1 and 3.0 of its data sets). One lesson is one
/// episode. A frame is one row of the data set: a window of consecutive ticks of the session.
namespace tandem::server {

/// Types of a feature.
enum class LerobotType : std::uint8_t { kFloat32, kInt64, kBool };
/// Returns the name in `info.json`: float32, int64, bool.
[[nodiscard]] const char* to_text(LerobotType type) noexcept;

/// A column of the data set.
struct LerobotFeature {
  std::string name;
  LerobotType type = LerobotType::kFloat32;
  std::vector<std::size_t> shape;    ///< numbers per frame: {n}, or {ticks, n} for a window
  std::vector<std::string> columns;  ///< names of the n numbers with their units, such as `trainer.measured_cp.x[m]`

  /// Numbers per frame.
  [[nodiscard]] std::size_t size() const noexcept {
    std::size_t product = 1;
    for (const std::size_t n : shape) product *= n;
    return product;
  }
  friend bool operator==(const LerobotFeature&, const LerobotFeature&) = default;
};

/// Where a frame belongs.
struct LerobotPlace {
  std::int64_t episode = 0;  ///< number of the episode
  std::int64_t frame = 0;    ///< number of the frame in its episode
  std::int64_t index = 0;    ///< number of the frame in the data set
  /// Session tick at which the episode begins: that of its first row.
  std::uint32_t first_tick = 0;
};

/// The features of a scene at one rate of frames, and their values.
///
/// - `observation.state`: tips of the tools [m], tips [m] and velocities [m/s] of the hands, at the end of the window
/// - `observation.force`: forces delivered to the hands, and of the environment on the tools [N]
/// - `observation.alpha`: authority of each hand over the first tool that it follows
/// - `observation.intervention`: at any tick of the window instructors together had more than half of the authority
/// over
///   a tool
/// - `observation.gap`, `observation.missing_ticks`: ticks of the window that were not recorded
/// - `observation.window`: state and force at every tick of the window; NaN where no row was recorded
/// - `action`: virtual mass of each tool [m] and force commanded to its slave [N]; `action.window` likewise
/// - the columns of every data set: `timestamp`, `frame_index`, `episode_index`, `index`, `task_index`
///
/// A window without any row repeats the values before it; `observation.gap` tells.
class LerobotLayout {
 public:
  /// @param fps  frames per second
  /// @return     the layout, or why the scene has none: its rate is no multiple of `fps`
  [[nodiscard]] static std::expected<LerobotLayout, std::string> make(const SceneSpec& scene, unsigned fps);

  [[nodiscard]] const std::vector<LerobotFeature>& features() const noexcept { return features_; }
  [[nodiscard]] unsigned fps() const noexcept { return fps_; }
  /// Ticks per frame.
  [[nodiscard]] std::size_t window() const noexcept { return window_; }
  /// Number of whole frames of a lesson. @pre it has a row
  [[nodiscard]] std::size_t frames(const LessonExtent& lesson) const noexcept;
  /// Writes the numbers of one feature of one frame.
  /// @param lesson  rows of the lesson; at least those of the window and the last one before its end
  /// @pre the lesson has the scene's seats and tools; place.frame < frames(extent); out.size() == the feature's size
  void fill(const Lesson& lesson, const LerobotPlace& place, std::size_t feature, std::span<double> out) const;

 private:
  /// Order of `features_`.
  enum Feature : std::size_t {
    kState,
    kForce,
    kAlpha,
    kIntervention,
    kGap,
    kMissing,
    kWindow,
    kAction,
    kActionWindow,
    kTimestamp,
    kFrameIndex,
    kEpisodeIndex,
    kIndex,
    kTaskIndex
  };
  struct Rows {
    std::size_t begin = 0, end = 0;  ///< rows of the window
    std::size_t last = 0;            ///< newest row at the end of the window
    std::uint32_t first_tick = 0;    ///< session tick at which the window begins
  };

  LerobotLayout() = default;
  void add(const char* name, LerobotType type, std::vector<std::size_t> shape, std::vector<std::string> columns = {});
  [[nodiscard]] Rows rows_of(const Lesson& lesson, const LerobotPlace& place) const;
  void fill_window(const Lesson& lesson, const Rows& rows, bool action, std::span<double> out) const;

  unsigned fps_ = 0;
  std::size_t window_ = 0;
  std::size_t masters_ = 0;
  std::vector<bool> instructors_;  ///< of the masters
  std::vector<LerobotFeature> features_;
};

}  // namespace tandem::server
