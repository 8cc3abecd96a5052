#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "proto/spec/access_role.h"

namespace tandem::console {

/// A request of a page about recordings. It names a recording by the id that the gateway gave it; no part of a request
/// becomes a part of a path.
struct RecordingRequest {
  enum class What : std::uint8_t { kList, kOutline, kPiece, kScores };
  static constexpr std::size_t kIdLength = 32;           ///< lower-case hex digits
  static constexpr std::uint32_t kPieceMax = 9'999'999;  ///< largest number of a piece

  What what = What::kList;
  std::string id{};         ///< empty for kList
  std::uint32_t piece = 0;  ///< of kPiece
  friend bool operator==(const RecordingRequest&, const RecordingRequest&) = default;
};

/// Returns whether a request target belongs to recordings, valid or not.
[[nodiscard]] bool is_recording_target(std::string_view target) noexcept;

/// Parses `/recordings`, `/recordings/ID`, `/recordings/ID/pieces/N` and `/recordings/ID/scores`, exactly so.
/// @return nullopt: any other target
[[nodiscard]] std::optional<RecordingRequest> parse_recording_request(std::string_view target);

/// Whether persons of this role may see recordings and scores: those who may write marks and sheets of an assessment
/// (server/policy/roles.h), which are instructors, evaluators and operators.
[[nodiscard]] bool may_review(AccessRole role) noexcept;

}  // namespace tandem::console
