#pragma once

#include <cstddef>
#include <span>

#include "proto/wire/session_telemetry.h"
#include "proto/wire/wire_codec.h"

namespace tandem::wire {

/// Numbers that decide the length of a TELEMETRY: those of the scene. Each at least 1, at most kSeatsMax, kMastersMax,
/// kToolsMax; masters are at most seats, and come first.
struct TelemetryLayout {
  std::size_t seats = 1, masters = 1, tools = 1;
  friend bool operator==(const TelemetryLayout&, const TelemetryLayout&) = default;
};

namespace detail {
inline constexpr std::size_t kWatchPadding = 64;
inline constexpr std::size_t kWatchedHandBody = 2 * packed(3, 4);
inline constexpr std::size_t kWatchedToolBody = scalar(2, 1, 4) + 2 * packed(3, 4);
inline constexpr std::size_t kWatchedLinkBody = scalar(11, 1, 4);
constexpr std::size_t watched_authority_body(std::size_t masters) { return scalar(2, 1, 4) + 2 * packed(masters, 4); }
}  // namespace detail

/// Exact plaintext sizes [bytes].
inline constexpr std::size_t kWatchSize = kPreambleSize + detail::nested(detail::kWatchPadding);
constexpr std::size_t telemetry_size(const TelemetryLayout& l) {
  return kPreambleSize + detail::scalar(4, 1, 4) + detail::packed(l.seats, 4) +
         l.masters * detail::nested(detail::kWatchedHandBody) + l.tools * detail::nested(detail::kWatchedToolBody) +
         detail::nested(detail::kWatchedLinkBody) + detail::nested(detail::watched_authority_body(l.masters));
}
static_assert(telemetry_size({kSeatsMax, kMastersMax, kToolsMax}) <= kPlaintextMax, "the largest scene fits");
static_assert(kWatchSize > kPathSize, "a challenge is smaller than its trigger");

/// Encodes and decodes TELEMETRY and WATCH like wire::Codec: one layout of fields, no heap, total.
class TelemetryCodec {
 public:
  explicit TelemetryCodec(const TelemetryLayout& layout) noexcept : layout_(layout) {}
  [[nodiscard]] const TelemetryLayout& layout() const noexcept { return layout_; }

  /// @return bytes written; 0 if `out` is too small. A value that is not finite is sent as unknown.
  [[nodiscard]] std::size_t encode(const Preamble&, const SessionTelemetry&,
                                   std::span<std::byte> out) const noexcept TANDEM_REALTIME;
  [[nodiscard]] std::size_t encode(const Preamble&, const WatchMessage&,
                                   std::span<std::byte> out) const noexcept TANDEM_REALTIME;

  [[nodiscard]] Decoded<SessionTelemetry> decode_telemetry(std::span<const std::byte> plaintext) const noexcept;
  [[nodiscard]] Decoded<WatchMessage> decode_watch(std::span<const std::byte> plaintext) const noexcept TANDEM_REALTIME;

 private:
  TelemetryLayout layout_;
};

}  // namespace tandem::wire
