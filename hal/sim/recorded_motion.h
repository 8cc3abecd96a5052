#pragma once

#include <array>
#include <cstddef>
#include <expected>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/sim/trajectory.h"

namespace tandem::hal::sim {

/// Options of a recorded motion:
/// `FILE.csv[,columns=PREFIX][,rec=N][,scale=auto|S][,axes=+x+y+z][,end=hold|loop][,middle=zero|keep]`
struct MotionOptions {
  struct Axis {
    int from = 0;
    double sign = 1;
  };
  std::string file;
  std::string columns;                                       ///< empty: the file has one position triple, which is used
  std::optional<double> rec;                                 ///< empty: the first recording
  std::optional<double> scale;                               ///< empty: auto
  std::array<Axis, 3> axes{{{0, 1.0}, {1, 1.0}, {2, 1.0}}};  ///< device axis i is `sign` times recorded axis `from`
  bool loop = false;
  bool keep_middle = false;  ///< false: the middle of the motion is moved to zero, the working pose of a device
};

/// Names of the motion options, for suggestions.
inline constexpr std::array<std::string_view, 6> kMotionOptionNames{"columns", "rec", "scale", "axes", "end", "middle"};

/// Sets one `name=value` of a motion option text. The error names the value and the allowed values.
[[nodiscard]] std::expected<void, std::string> set_motion_option(MotionOptions& options, std::string_view name,
                                                                 std::string_view value);
/// Parses the whole option text. The error names the option, its value and the allowed values.
[[nodiscard]] std::expected<MotionOptions, std::string> parse_motion_options(std::string_view text);

/// A recorded motion, scaled, and centred unless `keep_middle` is set. It is interpolated by cubic Hermite splines with
/// three-point tangents, exact for parabolas also with uneven steps. Immutable.
class RecordedMotion {
 public:
  /// Last interval used, so that sequential playback costs O(1). One per player.
  struct Cursor {
    std::size_t i = 0;
  };

  /// Parses a recording.
  /// @param csv   text of the file: header `name[unit],...`; a time column `t_s[s]` (or `t[s]`, `time[s]`, `t_ms[ms]`);
  ///           a triple of position columns in [m] or [mm]; optionally `rec[1]`
  /// @param name  name of the file for messages
  /// Error: one line `FILE:LINE: COLUMN: ...` with the value. Rejected: a position that is missing, text or not finite;
  /// time that decreases inside a recording; two positions at one time; fewer than two rows.
  [[nodiscard]] static std::expected<RecordedMotion, std::string> parse(std::string_view csv,
                                                                        const MotionOptions& options,
                                                                        std::string_view name);

  /// Returns a motion from points: neither centred nor scaled, held at its ends.
  /// @param t  ascending, from 0 [s]  @param x  one position per time [m]
  /// Error: fewer than two points, a different count of positions, time that does not ascend, a number that is not
  /// finite.
  [[nodiscard]] static std::expected<RecordedMotion, std::string> from_points(std::vector<double> t,
                                                                              std::vector<Vec3> x);

  /// Returns position [m] and velocity [m/s] at `t` [s] after the first row. Before it: the first position.
  /// After the last row: the last position at rest. With `end=loop` the motion returns to the start with minimum jerk
  /// and repeats.
  [[nodiscard]] MotionPoint at(double t, Cursor& cursor) const noexcept TANDEM_REALTIME;

  /// A row that exceeds the limits of a device: line of the file [from 1], device axis (0 x, 1 y, 2 z; -1: speed) and
  /// value. The value [m] or [m/s] is taken after `scale` and `axes`.
  struct Beyond {
    std::size_t line = 0;
    int axis = 0;
    double value = 0;
  };
  /// Returns the first row outside [-reach, reach] [m] along an axis, or faster than `speed_max` [m/s] since the
  /// previous row.
  [[nodiscard]] std::optional<Beyond> first_beyond(double reach, double speed_max) const noexcept;

  [[nodiscard]] double duration() const noexcept { return t_.back(); }   ///< [s]
  [[nodiscard]] double scale() const noexcept { return scale_; }         ///< factor applied to the recorded motion
  [[nodiscard]] const Vec3& middle() const noexcept { return middle_; }  ///< subtracted [m], recorded axes
  [[nodiscard]] std::size_t rows() const noexcept { return t_.size(); }  ///< rows kept
  [[nodiscard]] std::size_t repeated() const noexcept {
    return repeated_;
  }  ///< rows omitted because they repeated the previous position
  [[nodiscard]] const std::string& columns() const noexcept { return columns_; }
  /// Returns one line of text: columns, duration, scale factor.
  [[nodiscard]] std::string describe() const;

 private:
  RecordedMotion() = default;
  void drop_repeats();
  void fit(const MotionOptions& options);
  void make_tangents();

  std::vector<double> t_;
  std::vector<Vec3> x_;
  std::vector<Vec3> v_;
  std::vector<std::size_t> line_;  ///< line in the file, per kept row
  double scale_ = 1;
  Vec3 middle_ = Vec3::Zero();
  std::size_t repeated_ = 0;
  double back_ = 0;  ///< duration of the return to the start when looping [s]
  bool loop_ = false;
  std::string columns_;
};

}  // namespace tandem::hal::sim
