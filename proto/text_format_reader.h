#pragma once

#include <string_view>

#include "proto/checker.h"

/// Private to proto/*.cpp. Reads Protocol Buffers text format into any message, and keeps going after a mistake.
namespace tandem::text {

/// Longest file that is read [bytes].
inline constexpr std::size_t kTextMax = 1 << 20;

/// Reads text format on protobuf's own tokenizer. TextFormat::Parser stops at its first error, accepts `nan`, `1e400`
/// and an empty file, and cannot tell where a value stands that was written twice; people want all their mistakes at
/// once. This reader accepts a subset: singular keys once, colon before scalars, decimal numbers, `true`/`false`, no
/// extensions. What could be read is in `message` (merged into it), every value's place and every mistake in `checker`.
void read_text_format(std::string_view text, google::protobuf::Message& message, Checker& checker);

/// The same for JSON of the same schema. Stops at the first mistake, which names the key's path.
void read_json(std::string_view text, google::protobuf::Message& message, Checker& checker);

/// Text format, or JSON if `file_name` ends in `.json`; then the limits of the schema. A message with no field set is a
/// mistake.
/// @return whether enough was read for the caller to hold its own rules against `message`; mistakes may have been found
/// all the same
bool read_document(std::string_view text, std::string_view file_name, google::protobuf::Message& message,
                   Checker& checker);

}  // namespace tandem::text
