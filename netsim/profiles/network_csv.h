#pragma once

#include <expected>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/time.h"
#include "netsim/models/path_spec.h"
#include "proto/spec/input_error.h"

namespace tandem::netsim {

/// Link that plays a recorded network.
struct RecordedNetwork {
  LinkSpec link;           ///< the same recording in both directions
  bool rtt_split = false;  ///< true: the file holds round trips and each direction got half; reports state this
  std::size_t rows = 0;    ///< rows of the recording
  std::size_t lost = 0;    ///< rows that mean a lost datagram
  Duration length{};       ///< period after which the recording repeats
  /// Number of gaps: adjacent rows more than 1 s and more than twenty times their median distance apart. The row before
  /// a gap stays in force through it; reports state this.
  std::size_t gaps = 0;
  Duration gap_longest{};    ///< longest gap
  std::size_t gap_line = 0;  ///< line after which the longest gap begins
  bool timed = false;        ///< true: the file has a time column; false: rows are `interval` apart
};

/// Returns the notes that a report must contain about a recording, one line each: halved round trips, and gaps with
/// their line.
[[nodiscard]] std::vector<std::string> notes_of(const RecordedNetwork& network, std::string_view file_name);

/// Parses a CSV recording (common/base/csv.h) with a header of `name[unit]` columns. Required: `rtt_ms` or `delay_ms`
/// (exactly one; an empty value means lost). Optional: `t_s` or `t_send_s` (ascending; the first row is time 0) and
/// `lost` (0 or 1). Other columns are ignored. Units must be ms, s and 1; other units are errors. Any words may follow
/// the unit (`s since first row`). Each row is in force until the next.
/// @param text       whole file
/// @param file_name  name in messages
/// @param interval   time between rows of a file without a time column; 0: such a file is an error
/// @return network, or all errors with their lines
[[nodiscard]] std::expected<RecordedNetwork, InputErrors> parse_network_csv(std::string_view text,
                                                                            std::string_view file_name,
                                                                            Duration interval);

}  // namespace tandem::netsim
