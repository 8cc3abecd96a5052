#include "server/console/recording_request.h"

#include <algorithm>
#include <charconv>
#include <system_error>

#include "server/policy/roles.h"

namespace tandem::console {
namespace {

constexpr std::string_view kTarget = "/recordings";
constexpr std::string_view kPieces = "/pieces/";

bool is_id(std::string_view text) noexcept {
  return text.size() == RecordingRequest::kIdLength &&
         std::ranges::all_of(text, [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); });
}

/// A number without sign, spaces and leading zeros.
std::optional<std::uint32_t> number_of(std::string_view text) noexcept {
  std::uint32_t number = 0;
  const auto [last, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool whole = !text.empty() && error == std::errc{} && last == text.data() + text.size();
  const bool plain = text.size() == 1 || !text.starts_with('0');
  return whole && plain && number <= RecordingRequest::kPieceMax ? std::optional(number) : std::nullopt;
}

}  // namespace

bool is_recording_target(std::string_view target) noexcept { return target.starts_with(kTarget); }

std::optional<RecordingRequest> parse_recording_request(std::string_view target) {
  using What = RecordingRequest::What;
  if (!target.starts_with(kTarget)) return std::nullopt;
  target.remove_prefix(kTarget.size());
  if (target.empty()) return RecordingRequest{};
  if (!target.starts_with('/')) return std::nullopt;
  target.remove_prefix(1);
  const std::string_view id = target.substr(0, RecordingRequest::kIdLength);
  if (!is_id(id)) return std::nullopt;
  target.remove_prefix(id.size());
  if (target.empty()) return RecordingRequest{What::kOutline, std::string(id)};
  if (target == "/scores") return RecordingRequest{What::kScores, std::string(id)};
  if (!target.starts_with(kPieces)) return std::nullopt;
  const auto piece = number_of(target.substr(kPieces.size()));
  return piece ? std::optional(RecordingRequest{What::kPiece, std::string(id), *piece}) : std::nullopt;
}

bool may_review(AccessRole role) noexcept { return server::allowed_without_seat(role, rpc::Kind::kNote); }

}  // namespace tandem::console
