#pragma once

#include <expected>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/time.h"
#include "netsim/path_spec.h"
#include "proto/input_error.h"

namespace tandem::netsim {

/// A recorded network as a link.
struct RecordedNetwork {
  LinkSpec link;           ///< the same recording in both directions
  bool rtt_split = false;  ///< the file held round trips; each direction got half, which a report must say
  std::size_t rows = 0;
  std::size_t lost = 0;
  Duration length{};  ///< after which the recording starts again
  /// Where it has gaps: rows more than a second and twenty times their median distance apart. The row before a gap stays
  /// in force through it, which a report must say.
  std::size_t gaps = 0;
  Duration gap_longest{};
  std::size_t gap_line = 0;  ///< after which the longest begins
  bool timed = false;        ///< it has a column of times; else its rows are `interval` apart
};

/// What a report must say of a recording, one line each: round trips split, gaps with their line.
[[nodiscard]] std::vector<std::string> notes_of(const RecordedNetwork& network, std::string_view file_name);

/// Reads a CSV recording (common/base/csv.h) with a header of `name[unit]` columns:
/// `rtt_ms` or `delay_ms` (one of them; empty: lost), `t_s` or `t_send_s` (ascending; the first row is time 0) and
/// `lost` (0 or 1), the last two optional; other columns are ignored. Units must be ms, s and 1, words after them are free
/// (`s since first row`): another unit is a mistake. A row is in force until the next.
/// @param interval  between rows of a file without a time column; 0: such a file is a mistake
/// @return the link, or every mistake with its line
[[nodiscard]] std::expected<RecordedNetwork, InputErrors> parse_network_csv(std::string_view text,
                                                                            std::string_view file_name,
                                                                            Duration interval);

}  // namespace tandem::netsim
