#include "server/session/checkpoint.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
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

class Writer {
 public:
  explicit Writer(std::span<std::byte> out) noexcept : out_(out) {}
  template <class T>
  void put(const T& value) noexcept {
    static_assert(std::is_arithmetic_v<T> || std::is_same_v<T, Checkpoint::Hash>);
    if (size_ + sizeof value <= out_.size()) std::memcpy(out_.data() + size_, &value, sizeof value);
    size_ += sizeof value;
  }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }

 private:
  std::span<std::byte> out_;
  std::size_t size_ = 0;
};

class Reader {
 public:
  explicit Reader(std::span<const std::byte> in) noexcept : in_(in) {}
  template <class T>
  T take() noexcept {
    T value{};
    if (at_ + sizeof value <= in_.size()) std::memcpy(&value, in_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }
  /// A flag or a number of at most `most`; a larger one marks the input as invalid.
  template <class T>
  T at_most(T most) noexcept {
    const T value = take<T>();
    whole_ = whole_ && value <= most;
    return value;
  }
  double within(double low, double high) noexcept {
    const auto value = take<double>();
    whole_ = whole_ && value >= low && value <= high;
    return value;
  }
  [[nodiscard]] std::size_t at() const noexcept { return at_; }
  [[nodiscard]] bool whole() const noexcept { return whole_; }

 private:
  std::span<const std::byte> in_;
  std::size_t at_ = 0;
  bool whole_ = true;
};

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
  w.put(kLayout);
  w.put(c.scene);
  w.put(c.epoch);
  w.put(c.session_tick);
  w.put(c.authority_version);
  w.put(c.stops);
  for (const std::uint8_t n : {static_cast<std::uint8_t>(c.stop), static_cast<std::uint8_t>(c.begun), c.seats_n,
                               c.masters_n, c.tools_n, c.dof})
    w.put(n);
  for (std::size_t i = 0; i < c.seats_n; ++i) {
    w.put(static_cast<std::uint8_t>(c.seats[i].taken));
    w.put(c.seats[i].resume);
    w.put(c.seats[i].force_scale);
  }
  for (std::size_t j = 0; j < c.tools_n; ++j) {
    for (std::size_t i = 0; i < c.masters_n; ++i) w.put(c.tools[j].alpha[i]);
    for (std::size_t a = 0; a < c.dof; ++a) w.put(c.tools[j].x[a]);
    for (const double x : c.tools[j].slave) w.put(x);
  }
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
  if (r.take<std::uint32_t>() != kLayout) return std::unexpected(CheckpointError::kVersion);
  const Checkpoint::Hash digest = transport::sha256(body);
  if (!std::equal(digest.begin(), digest.end(), bytes.end() - kDigest))
    return std::unexpected(CheckpointError::kDigest);
  Checkpoint c;
  c.scene = r.take<Checkpoint::Hash>();
  c.epoch = r.take<std::uint64_t>();
  c.session_tick = r.take<std::uint32_t>();
  c.authority_version = r.take<std::uint32_t>();
  c.stops = r.take<std::uint32_t>();
  c.stop = static_cast<StopLatch::Level>(r.at_most(static_cast<std::uint8_t>(StopLatch::Level::kStopped)));
  c.begun = r.at_most(std::uint8_t{1}) != 0;
  c.seats_n = r.at_most(static_cast<std::uint8_t>(kSeatsMax));
  c.masters_n = r.at_most(static_cast<std::uint8_t>(kMastersMax));
  c.tools_n = r.at_most(static_cast<std::uint8_t>(kToolsMax));
  c.dof = r.at_most(static_cast<std::uint8_t>(kAxesMax));
  if (!r.whole()) return std::unexpected(CheckpointError::kRange);
  for (std::size_t i = 0; i < c.seats_n; ++i) {
    c.seats[i].taken = r.at_most(std::uint8_t{1}) != 0;
    c.seats[i].resume = r.take<Checkpoint::Hash>();
    c.seats[i].force_scale = r.within(0, 1);
  }
  bool whole = true;
  for (std::size_t j = 0; j < c.tools_n; ++j) {
    double sum = 0;
    for (std::size_t i = 0; i < c.masters_n; ++i) sum += c.tools[j].alpha[i] = r.within(0, 1);
    for (std::size_t a = 0; a < c.dof; ++a) c.tools[j].x[a] = r.within(-kPoseMax, kPoseMax);
    for (double& x : c.tools[j].slave) x = r.within(-kPoseMax, kPoseMax);
    whole = whole && std::abs(sum - 1) <= 1e-9;
  }
  if (r.at() != body.size()) return std::unexpected(CheckpointError::kSize);
  if (!whole || !r.whole()) return std::unexpected(CheckpointError::kRange);
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
