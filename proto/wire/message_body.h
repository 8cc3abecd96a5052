#pragma once

#include <cstddef>
#include <cstring>
#include <expected>
#include <span>
#include <type_traits>

#include "proto/wire/wire_codec.h"
#include "proto/wire/wire_fields.h"

/// Private to the codecs of this folder: writes and reads a whole plaintext, the preamble and then the fields. Internal
/// linkage keeps the functions inlined.
namespace tandem::wire::body {

static_assert(sizeof(Preamble) == kPreambleSize && std::is_trivially_copyable_v<Preamble>);

/// Writes the preamble, then the body by `values`. @param size  size of both  @return size; 0 if `out` is too small
template <class Write>
static std::size_t write(const Preamble& preamble, std::size_t size, std::span<std::byte> out,
                         Write&& values) noexcept {
  if (out.size() < size) return 0;
  std::memcpy(out.data(), &preamble, kPreambleSize);
  FieldWriter writer{out.subspan(kPreambleSize, size - kPreambleSize)};
  values(writer);
  return size;
}

static inline Preamble read_preamble(std::span<const std::byte> in) noexcept {
  Preamble preamble;
  std::memcpy(&preamble, in.data(), kPreambleSize);
  return preamble;
}

/// Checks the size first, because every value has a fixed offset. The output of `values` is valid only without an
/// error.
template <class Read>
static std::expected<Preamble, DecodeError> read_into(std::span<const std::byte> in, std::size_t size,
                                                      Read&& values) noexcept {
  if (in.size() != size) return std::unexpected(DecodeError::kSize);
  FieldReader reader{in.subspan(kPreambleSize)};
  values(reader);
  if (!reader.well_formed()) [[unlikely]]
    return std::unexpected(DecodeError::kMalformed);
  if (!reader.finite()) [[unlikely]]
    return std::unexpected(DecodeError::kNotFinite);
  if (!reader.in_range()) [[unlikely]]
    return std::unexpected(DecodeError::kOutOfRange);
  return read_preamble(in);
}

/// A single result object with one return statement, so that the message is never copied.
template <class Message, class Read>
static Decoded<Message> read(std::span<const std::byte> in, std::size_t size, Read&& values) noexcept {
  Decoded<Message> result{std::in_place};
  const auto preamble = read_into(in, size, [&](FieldReader& reader) { values(reader, result->message); });
  if (preamble) {
    result->preamble = *preamble;
  } else {
    result = std::unexpected(preamble.error());
  }
  return result;
}

}  // namespace tandem::wire::body
