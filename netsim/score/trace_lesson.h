#pragma once

#include <array>
#include <cstddef>
#include <expected>
#include <string>
#include <string_view>
#include <vector>

#include "proto/spec/lesson.h"

namespace tandem::netsim::score {

/// Reads the rows that `--trace` writes (server/report/trace_csv.h) into a Lesson, piece by piece. The columns
/// `tick[1]` and `SEAT.x[m]`, `SEAT.y[m]`, `SEAT.z[m]` of one MASTER seat at least are required. The values of other
/// columns that are not there are unknown. A row that repeats the tick of the one before is left out: the session was
/// stopped. Columns that a trace does not have stay empty: velocity, gate, freshness, accounts, links, events.
class TraceReader {
 public:
  static constexpr std::size_t kRowsMax = 40'000'000;  ///< 11 h at 1 kHz
  static constexpr std::size_t kLineMax = 1 << 16;     ///< [bytes]

  /// @param scene  of the session: names, rate, phases
  /// @param file   name for messages
  TraceReader(SceneSpec scene, std::string file);

  /// Takes the next bytes of the file. Error: `FILE:LINE: column NAME: ...` with the value and what is allowed. After
  /// an error no more bytes may be given.
  [[nodiscard]] std::expected<void, std::string> append(std::string_view bytes);
  /// Returns the lesson after the last byte. Error: no header, no row, a cut last line.
  [[nodiscard]] std::expected<Lesson, std::string> finish();

  /// Whether this is the first line of such a file.
  [[nodiscard]] static bool is_trace(std::string_view header) noexcept { return header.starts_with("tick[1],"); }

 private:
  static constexpr std::size_t kNone = ~std::size_t{0};
  using Three = std::array<std::size_t, 3>;
  static constexpr Three kNoThree{kNone, kNone, kNone};
  static constexpr std::array<std::size_t, kAxesMax> kNoAxes{kNone, kNone, kNone, kNone, kNone, kNone, kNone};
  struct SeatColumns {
    std::size_t alpha = kNone, leader = kNone;
    Three x = kNoThree, f_cmd = kNoThree, f_out = kNoThree, ghost = kNoThree;
    std::array<std::size_t, kAxesMax> q = kNoAxes, e_in = kNoAxes, e_out = kNoAxes;
  };
  struct ToolColumns {
    std::size_t penetration = kNone, held = kNone;
    Three x = kNoThree, f_cmd = kNoThree, f_env = kNoThree;
    std::array<std::size_t, kAxesMax> q = kNoAxes, e_p = kNoAxes;  ///< a lesson keeps three axes of e_p
  };

  [[nodiscard]] std::expected<void, std::string> line(std::string_view text);
  [[nodiscard]] std::expected<void, std::string> header(std::string_view text);
  [[nodiscard]] std::expected<void, std::string> row(std::string_view text);
  void store_row();
  /// Returns where the value of a column called `name` goes; null: no such column exists in this scene.
  [[nodiscard]] std::size_t* place_of(std::string_view name, std::string_view unit);
  [[nodiscard]] std::unexpected<std::string> error(const std::string& what) const;
  [[nodiscard]] std::unexpected<std::string> error_at(std::size_t column, const std::string& what) const;

  Lesson lesson_;
  std::string file_, rest_;
  std::size_t line_ = 0;
  std::vector<std::string> names_;
  std::vector<double> cells_;
  std::size_t tick_ = kNone, time_ = kNone;
  std::vector<SeatColumns> seats_;
  std::vector<ToolColumns> tools_;
};

}  // namespace tandem::netsim::score
