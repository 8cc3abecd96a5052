#include "server/session/checkpoint.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numeric>
#include <string_view>

#include "common/base/secret.h"
#include "common/transport/digest.h"
#include "proto/text/scene_text.h"

namespace tandem::server {

namespace {

// "CKP3": the first layout whose resume hashes include the workstation's key.
constexpr std::uint32_t kLayout = 0x33504b43;
constexpr double kPoseMax = 1000;  // [m] or [rad]: beyond the range of any tool
static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie in memory");

/// Copies the fields of a checkpoint to bytes. Counts what does not fit.
class Writer {
 public:
  explicit Writer(std::span<std::byte> out) noexcept : out_(out) {}
  template <class T>
  void field(const T& value) noexcept {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_same_v<T, Checkpoint::Hash>);
    if (size_ + sizeof value <= out_.size()) std::memcpy(out_.data() + size_, &value, sizeof value);
    size_ += sizeof value;
  }
  template <class T>
  void field(const T& value, T /*least*/, T /*most*/) noexcept {
    field(value);
  }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }

 private:
  std::span<std::byte> out_;
  std::size_t size_ = 0;
};

/// Copies bytes to the fields of a checkpoint, and checks their ranges.
class Reader {
 public:
  explicit Reader(std::span<const std::byte> in) noexcept : in_(in) {}
  void field(bool& value) noexcept {
    std::uint8_t flag = 0;
    field(flag, std::uint8_t{0}, std::uint8_t{1});
    value = flag == 1;
  }
  template <class T>
  void field(T& value) noexcept {
    value = {};
    if (size_ + sizeof value <= in_.size()) std::memcpy(&value, in_.data() + size_, sizeof value);
    size_ += sizeof value;
  }
  /// A number outside `least` to `most` marks the input as invalid.
  template <class T>
  void field(T& value, T least, T most) noexcept {
    field(value);
    in_range_ = in_range_ && value >= least && value <= most;
  }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] bool in_range() const noexcept { return in_range_; }

 private:
  std::span<const std::byte> in_;
  std::size_t size_ = 0;
  bool in_range_ = true;
};

/// The layout of a checkpoint up to its counts, for both directions.
template <class Archive, class State>
void visit_head(Archive& archive, State& c) noexcept {
  constexpr std::uint8_t kNone = 0;
  archive.field(c.scene);
  archive.field(c.epoch);
  archive.field(c.session_tick);
  archive.field(c.authority_version);
  archive.field(c.stops);
  archive.field(c.stop, StopLatch::Level::kNone, StopLatch::Level::kStopped);
  archive.field(c.begun);
  archive.field(c.seats_n, kNone, static_cast<std::uint8_t>(kSeatsMax));
  archive.field(c.masters_n, kNone, static_cast<std::uint8_t>(kMastersMax));
  archive.field(c.tools_n, kNone, static_cast<std::uint8_t>(kToolsMax));
  archive.field(c.dof, kNone, static_cast<std::uint8_t>(kAxesMax));
}

/// Seats and tools. @pre the counts are in range
template <class Archive, class State>
void visit_seats_and_tools(Archive& archive, State& c) noexcept {
  for (auto& seat : std::span{c.seats}.first(c.seats_n)) {
    archive.field(seat.taken);
    archive.field(seat.resume);
    archive.field(seat.force_scale, 0.0, 1.0);
  }
  for (auto& tool : std::span{c.tools}.first(c.tools_n)) {
    for (auto& alpha : std::span{tool.alpha}.first(c.masters_n)) archive.field(alpha, 0.0, 1.0);
    for (auto& x : std::span{tool.x}.first(c.dof)) archive.field(x, -kPoseMax, kPoseMax);
    for (auto& x : tool.slave) archive.field(x, -kPoseMax, kPoseMax);
  }
}

}  // namespace

Checkpoint::Hash scene_hash(const SceneSpec& scene) {
  const std::string text = effective_scene_text(scene);
  return transport::sha256(std::as_bytes(std::span{text}));
}

Checkpoint::Hash resume_hash(std::span<const std::byte, 32> secret, const Checkpoint::Hash& workstation) noexcept {
  constexpr std::string_view kLabel = "tandem resume v2";
  std::array<std::byte, kLabel.size() + sizeof(Checkpoint::Hash) + 32> all{};
  std::memcpy(all.data(), kLabel.data(), kLabel.size());
  std::memcpy(all.data() + kLabel.size(), workstation.data(), workstation.size());
  std::memcpy(all.data() + kLabel.size() + workstation.size(), secret.data(), secret.size());
  const Checkpoint::Hash hash = transport::sha256(all);
  wipe(all);
  return hash;
}

std::size_t encode_checkpoint(const Checkpoint& c, std::span<std::byte> out) noexcept {
  Writer w{out};
  w.field(kLayout);
  visit_head(w, c);
  visit_seats_and_tools(w, c);
  const std::size_t size = w.size();
  if (size + sizeof(Checkpoint::Hash) > std::min(out.size(), kCheckpointMax)) return 0;
  const Checkpoint::Hash digest = transport::sha256(out.first(size));
  std::memcpy(out.data() + size, digest.data(), digest.size());
  return size + digest.size();
}

std::expected<Checkpoint, CheckpointError> decode_checkpoint(std::span<const std::byte> bytes) noexcept {
  constexpr std::size_t kDigest = sizeof(Checkpoint::Hash);
  if (bytes.size() < sizeof kLayout + kDigest || bytes.size() > kCheckpointMax)
    return std::unexpected(CheckpointError::kSize);
  const auto body = bytes.first(bytes.size() - kDigest);
  Reader r{body};
  std::uint32_t layout = 0;
  r.field(layout);
  if (layout != kLayout) return std::unexpected(CheckpointError::kVersion);
  const Checkpoint::Hash digest = transport::sha256(body);
  if (!std::equal(digest.begin(), digest.end(), bytes.end() - kDigest))
    return std::unexpected(CheckpointError::kDigest);
  Checkpoint c;
  visit_head(r, c);
  if (!r.in_range()) return std::unexpected(CheckpointError::kRange);
  visit_seats_and_tools(r, c);
  if (r.size() != body.size()) return std::unexpected(CheckpointError::kSize);
  const auto whole = [](const Checkpoint::Tool& tool) {
    return std::abs(std::accumulate(tool.alpha.begin(), tool.alpha.end(), 0.0) - 1) <= 1e-9;
  };
  if (!r.in_range() || !std::ranges::all_of(std::span{c.tools}.first(c.tools_n), whole))
    return std::unexpected(CheckpointError::kRange);
  return c;
}

std::string incompatibility(const Checkpoint& c, const SceneSpec& scene) {
  if (c.scene != scene_hash(scene))
    return "the checkpoint belongs to another scene, or to this one before it was changed";
  if (c.seats_n != scene.seats.size() || c.masters_n != scene.masters() || c.tools_n != scene.tools.size() ||
      c.dof != scene.dof)
    return "the checkpoint has other numbers of seats, tools or axes than the scene";
  return {};
}

}  // namespace tandem::server
