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

/// `FILE.csv[,columns=PREFIX][,rec=N][,scale=auto|S][,axes=+x+y+z][,end=hold|loop]`
struct MotionOptions {
  struct Axis {
    int from = 0;
    double sign = 1;
  };
  std::string file;
  std::string columns;                                       ///< empty: the only position triple in the file
  std::optional<double> rec;                                 ///< empty: the first one
  std::optional<double> scale;                               ///< empty: auto
  std::array<Axis, 3> axes{{{0, 1.0}, {1, 1.0}, {2, 1.0}}};  ///< device axis i is `sign` times recorded axis `from`
  bool loop = false;
};

/// The words a motion option may start with, for suggestions.
inline constexpr std::array<std::string_view, 5> kMotionOptionNames{"columns", "rec", "scale", "axes", "end"};

/// Sets one `name=value` of a motion option text. The error names the value and what is allowed.
[[nodiscard]] std::expected<void, std::string> set_motion_option(MotionOptions& options, std::string_view name,
                                                                 std::string_view value);
/// Reads the whole option text. The error names the option, its value and what is allowed.
[[nodiscard]] std::expected<MotionOptions, std::string> parse_motion_options(std::string_view text);

/// A recorded motion, centred and scaled, interpolated by cubic Hermite splines with three-point tangents (exact for
/// parabolas, also with uneven steps). Immutable.
class RecordedMotion {
 public:
  /// Remembers the last interval so that playing on costs O(1). One per player.
  struct Cursor {
    std::size_t i = 0;
  };

  /// @param csv   text of the file: header `name[unit],...`, a time column `t_s[s]` (or `t[s]`, `time[s]`, `t_ms[ms]`),
  /// a
  ///              triple of position columns in [m] or [mm], perhaps `rec[1]`
  /// @param name  the file's name for messages
  /// Error: one line `FILE:LINE: COLUMN: ...` naming the value; a position that is missing, text or not finite, time
  /// that goes back inside a recording, two positions at one time, fewer than two rows.
  [[nodiscard]] static std::expected<RecordedMotion, std::string> parse(std::string_view csv,
                                                                        const MotionOptions& options,
                                                                        std::string_view name);

  /// A motion that a program made: neither centred nor scaled, held at its ends.
  /// @param t  ascending, from 0 [s]  @param x  one position per time [m]
  /// Error: fewer than two points, another count of positions, time that does not ascend, a number that is not finite.
  [[nodiscard]] static std::expected<RecordedMotion, std::string> from_points(std::vector<double> t, std::vector<Vec3> x);

  /// Position [m] and velocity [m/s] at `t` [s] after the first row; before it the first position, after the last row
  /// held at rest or, with `end=loop`, moved back to the start with minimum jerk and played again.
  [[nodiscard]] MotionPoint at(double t, Cursor& cursor) const noexcept TANDEM_REALTIME;

  /// Where a played motion asks for more than a device gives: line of the file [from 1], the device axis (0 x, 1 y, 2 z; -1: its
  /// speed) and the value [m] or [m/s], after `scale` and `axes`.
  struct Beyond {
    std::size_t line = 0;
    int axis = 0;
    double value = 0;
  };
  /// The first row outside [-reach, reach] [m] along an axis, or further from the row before than `speed_max` [m/s] goes.
  [[nodiscard]] std::optional<Beyond> first_beyond(double reach, double speed_max) const noexcept;

  [[nodiscard]] double duration() const noexcept { return t_.back(); }   ///< [s]
  [[nodiscard]] double scale() const noexcept { return scale_; }         ///< factor applied to the recorded motion
  [[nodiscard]] const Vec3& middle() const noexcept { return middle_; }  ///< subtracted [m], recorded axes
  [[nodiscard]] std::size_t rows() const noexcept { return t_.size(); }  ///< rows kept
  [[nodiscard]] std::size_t repeated() const noexcept {
    return repeated_;
  }  ///< rows left out because they said nothing new
  [[nodiscard]] const std::string& columns() const noexcept { return columns_; }
  /// One line for a person: which columns, how long, the factor.
  [[nodiscard]] std::string describe() const;

 private:
  RecordedMotion() = default;
  void drop_repeats();
  void fit(const MotionOptions& options);
  void make_tangents();

  std::vector<double> t_;
  std::vector<Vec3> x_;
  std::vector<Vec3> v_;
  std::vector<std::size_t> line_;  ///< of the file, per row kept
  double scale_ = 1;
  Vec3 middle_ = Vec3::Zero();
  std::size_t repeated_ = 0;
  double back_ = 0;  ///< time of the way back when looping [s]
  bool loop_ = false;
  std::string columns_;
};

}  // namespace tandem::hal::sim
