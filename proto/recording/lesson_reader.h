#pragma once

#include <cstddef>
#include <expected>
#include <span>
#include <string>

#include "proto/spec/lesson.h"

namespace tandem {

/// Reads a recording. Any bytes are safe. A cut or damaged file gives what is whole: then `Lesson::complete` is false,
/// and ticks of damaged chunks are gaps.
/// @param bytes  of the whole MCAP file; they may be mapped
/// @return the lesson, or why this is no recording of this project: another kind of file, another format, a scene that
/// is not valid. The text names neither the file nor a next step; the caller does.
/// @throws std::bad_alloc  a row takes about 0.4 kB per seat and tool; a file has at most one row per 16 bytes
[[nodiscard]] std::expected<Lesson, std::string> read_lesson(std::span<const std::byte> bytes);

}  // namespace tandem
