#pragma once

#include <expected>
#include <string>
#include <string_view>

#include "proto/spec/lesson.h"

namespace tandem::netsim::score {

/// Reads a table of recorded motion, as `--hand SEAT=FILE` does, into a Lesson without a tool.
///
/// The first line is `name[unit],...`. Needed: a column of time, `t_s[s]`, `t[s]`, `time[s]` or `t_ms[ms]`, and one
/// triple of positions in [m] or [mm]: names that differ in one letter x, y, z, such as `px_m`, `py_m`, `pz_m`. Each
/// triple is the hand of a seat named after it. A triple of forces in [N] belongs to the seat whose name begins with
/// the same word, or to the only seat. Rows of another `rec[1]` are another recording: a phase, after a stop.
///
/// The rate is that of the median step. A tick has a row if a row of the file is within half a step; its values are
/// interpolated linearly. Other ticks are gaps, so uneven steps of a logger show as missing samples. An empty position
/// is unknown.
///
/// @param csv   text of the file
/// @param file  name for messages
/// Error: `FILE:LINE: column N: ...`. Rejected: no time, no position, text or infinity, time that decreases or repeats
/// inside a recording, fewer than five rows, more than 16 triples.
[[nodiscard]] std::expected<Lesson, std::string> read_motion(std::string_view csv, const std::string& file);

}  // namespace tandem::netsim::score
