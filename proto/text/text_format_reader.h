#pragma once

#include <string_view>

#include "proto/text/message_validator.h"

/// Private to proto/text: reads Protocol Buffers text format into any message and continues after errors.
namespace tandem::text {

/// Largest file that is read [bytes].
inline constexpr std::size_t kTextMax = 1 << 20;

/// Reads text format with protobuf's tokenizer. TextFormat::Parser stops at its first error and accepts `nan`, `1e400`
/// and an empty file. It also cannot locate a value that was written twice. Users need all errors at once. This reader
/// accepts a subset: singular keys once, colon before scalars, decimal numbers, `true`/`false`, no extensions. The
/// readable fields are merged into `message`; locations and errors go to `validator`.
void read_text_format(std::string_view text, google::protobuf::Message& message, MessageValidator& validator);

/// The same for JSON of the same schema. Stops at the first error, which names the path of the key.
void read_json(std::string_view text, google::protobuf::Message& message, MessageValidator& validator);

/// Reads text format, or JSON if `file_name` ends in `.json`, then checks the limits of the schema. A message with no
/// field set is an error.
/// @return whether enough was read for the caller to check its own rules; errors may exist even then
bool read_document(std::string_view text, std::string_view file_name, google::protobuf::Message& message,
                   MessageValidator& validator);

}  // namespace tandem::text
