#include "tests/hal/emulation/devices/falcon_model.h"

#include <algorithm>
#include <chrono>

#include "hal/drivers/falcon/falcon_ftdi.h"

namespace tandem::hal::emulation {
namespace {

using namespace std::chrono_literals;

constexpr Duration kStep = 50us;
constexpr Duration kHandPeriod = 1ms;
constexpr Duration kCtsDelay = 8ms;                            // assumed
constexpr double kOutAngle = 60.0 * std::numbers::pi / 180.0;  // assumed: angle from which a leg counts as pulled out,
constexpr double kInAngle = 20.0 * std::numbers::pi / 180.0;   // and angle below which it counts as pushed in again
constexpr std::size_t kImageMax = 16384;
constexpr std::array kGreeting{std::byte{0x0A}, std::byte{0x43}, std::byte{0x0D}};
constexpr std::array kGreeted{std::byte{0x0A}, std::byte{0x44}, std::byte{0x2C}, std::byte{0x0D}};

template <class... Values>
constexpr auto bytes(Values... values) {
  return std::array<std::byte, sizeof...(Values)>{static_cast<std::byte>(values)...};
}
// USB 1.1 as FT232 bridges report it; bcdDevice and the current are unknown.
constexpr auto kDevice = bytes(18, 1, 0x10, 0x01, 0, 0, 0, 8, kFalconVendor & 0xFF, kFalconVendor >> 8,
                               kFalconProduct & 0xFF, kFalconProduct >> 8, 0x00, 0x04, 1, 2, 0, 1);
constexpr auto kConfig = bytes(9, 2, 32, 0, 1, 1, 0, 0xC0, 50,         //
                               9, 4, 0, 0, 2, 0xFF, 0xFF, 0xFF, 2,     //
                               7, 5, kFalconIn, 2, kFtdiPacket, 0, 0,  //
                               7, 5, kFalconOut, 2, kFtdiPacket, 0, 0);

bool use_up(int& count) {
  if (count <= 0) return false;
  --count;
  return true;
}

}  // namespace

FalconModel::FalconModel(const FalconModelSpec& spec) : spec_(spec), mechanics_(spec.mechanics) {
  image_.reserve(kImageMax);
  if (!spec.running) return;
  state_ = State::kRunning;
  if (!spec.homed) return;
  homed_ = kFalconAllHomed;
  for (std::size_t i = 0; i < 3; ++i) mechanics_.find_origin(i);
}

std::span<const std::byte> FalconModel::device_descriptor() const noexcept { return kDevice; }
std::span<const std::byte> FalconModel::config_descriptor() const noexcept { return kConfig; }
std::string_view FalconModel::string(std::uint8_t index) const noexcept {
  return index == 1 ? "FTDI" : index == 2 ? "FALCON HAPTIC" : "";
}

void FalconModel::unplug() noexcept { plugged_in_ = false; }

void FalconModel::plug_in() noexcept {
  plugged_in_ = true;
  halted_in_ = halted_out_ = false;
  line_.reset();
  framer_.clear();
  kept_size_ = delayed_size_ = 0;
  if (state_ != State::kRunning) state_ = State::kBootLoader;
}

void FalconModel::lose_power() noexcept {
  state_ = State::kBootLoader;
  order_ = {};
  homed_ = out_seen_ = 0;
  frozen_ = wants_edge_ = cts_ = false;
  image_.clear();
  heard_ = {};
  framer_.clear();
  line_.reset();
  kept_size_ = delayed_size_ = 0;
  mechanics_.lose_origin();
}

void FalconModel::drop_homed(std::uint8_t mask) noexcept {
  homed_ = static_cast<std::uint8_t>(homed_ & ~mask);
  out_seen_ = static_cast<std::uint8_t>(out_seen_ & ~mask);
  wants_edge_ = true;
}

TransferResult FalconModel::control(const SetupPacket& setup, std::span<std::byte> data) noexcept {
  if (!plugged_in_) return std::unexpected(TransferStatus::kGone);
  if (use_up(faults.stall_control)) return std::unexpected(TransferStatus::kStall);
  constexpr std::uint8_t kVendorOut = 0x40, kVendorIn = 0xC0, kEndpointOut = 0x02;
  if (setup.request_type == kEndpointOut && setup.request == 1 && setup.value == 0) {
    ((setup.index & 0x80) != 0 ? halted_in_ : halted_out_) = false;
    return std::size_t{0};
  }
  if (setup.request_type == kVendorIn && setup.request == 0x0A && !data.empty()) {
    data[0] = static_cast<std::byte>(line_.latency_ms());
    return std::size_t{1};
  }
  if (setup.request_type != kVendorOut || !line_.request(setup.request, setup.value)) {
    return std::unexpected(TransferStatus::kStall);
  }
  take_line_changes();
  return std::size_t{0};
}

TransferResult FalconModel::bulk_out(std::uint8_t ep, std::span<const std::byte> bytes) noexcept {
  if (!plugged_in_) return std::unexpected(TransferStatus::kGone);
  if (use_up(faults.stall_out)) halted_out_ = true;
  if (ep != kFalconOut || halted_out_) return std::unexpected(TransferStatus::kStall);
  line_.from_host(bytes);
  return bytes.size();
}

TransferResult FalconModel::bulk_in(std::uint8_t ep, std::span<std::byte> into) noexcept {
  if (!plugged_in_) return std::unexpected(TransferStatus::kGone);
  if (use_up(faults.stall_in)) halted_in_ = true;
  if (ep != kFalconIn || halted_in_) return std::unexpected(TransferStatus::kStall);
  const auto size = line_.to_host(into);
  return size ? TransferResult(*size) : std::unexpected(TransferStatus::kNak);
}

void FalconModel::advance(Duration dt) noexcept {
  while (dt > Duration{0}) {
    const Duration h = std::min(dt, kStep);
    step(h);
    dt -= h;
  }
}

void FalconModel::step(Duration h) noexcept {
  now_ += h;
  line_.advance(h);
  while (const auto b = line_.next_for_device()) take(*b);
  if (cts_in_ > Duration{0} && (cts_in_ -= h) <= Duration{0}) {
    cts_ = !faults.never_cts;
    line_.set_cts(cts_);
  }
  if (delayed_size_ > 0 && (delayed_for_ -= h) <= Duration{0}) {
    for (std::size_t i = 0; i < delayed_size_; ++i) line_.from_device(delayed_[i]);
    delayed_size_ = 0;
  }
  if (hand_ && (hand_left_ -= h) <= Duration{0}) {
    hand_left_ += kHandPeriod;
    mechanics_.set_pull(hand_->advance(mechanics_.tip(), seconds(kHandPeriod)));
  }
  mechanics_.advance(order_.motor, seconds(h));
  if (state_ == State::kRunning) find_origins();
}

void FalconModel::take_line_changes() noexcept {
  if (line_.dtr_pulses() != pulses_seen_) {  // a DTR pulse at 9600 baud resets the processor into its boot loader
    pulses_seen_ = line_.dtr_pulses();
    if (line_.divisor() == ftdi::k9600 && !line_.rts()) {
      state_ = State::kBootLoader;
      order_ = {};
      homed_ = out_seen_ = 0;
      frozen_ = wants_edge_ = cts_ = false;
      cts_in_ = {};
      image_.clear();
      heard_ = {};
      mechanics_.lose_origin();
      line_.set_cts(false);
    }
  }
  if (state_ == State::kGreeted && line_.divisor() == ftdi::k143k && !line_.dtr() && !cts_ && cts_in_ == Duration{0}) {
    cts_in_ = kCtsDelay;
  }
  if (state_ == State::kLoading && line_.divisor() == ftdi::k1500k && image_.size() == spec_.image_bytes) {
    ++loads_;
    if (use_up(faults.dead_loads)) {
      state_ = State::kBootLoader;
    } else {
      state_ = State::kRunning;
      frozen_ = use_up(faults.frozen_loads);
      frozen_at_ = mechanics_.encoder();
      framer_.clear();
    }
  }
}

void FalconModel::take(std::byte b) noexcept {
  if (state_ == State::kRunning) {
    if (line_.divisor() != ftdi::k1500k) return;  // at another speed the bytes are noise
    if (const auto frame = framer_.push(b)) {
      const auto order = decode_command(*frame, spec_.bits);
      if (order) return take_frame(*order);
      ++bad_frames_;
    }
    return;
  }
  if (state_ == State::kLoading) return take_image(b);
  take_boot(b);
}

void FalconModel::take_boot(std::byte b) noexcept {
  if (state_ == State::kGreeted && line_.divisor() == ftdi::k143k) {
    if (faults.needs_cts && !cts_) return;
    if (b != std::byte{0x41}) return;
    state_ = State::kLoading;
    image_.clear();
    if (faults.leading_13) send(bytes(0x13));
    send(bytes(0x41));
    return;
  }
  if (line_.divisor() != ftdi::k9600) return;
  std::ranges::rotate(heard_, heard_.begin() + 1);
  heard_.back() = b;
  if (heard_ != kGreeting || pulses_seen_ == 0 || use_up(faults.deaf_greetings)) return;
  state_ = State::kGreeted;
  if (faults.leading_zero) send(bytes(0x00));
  send(kGreeted);
}

void FalconModel::take_image(std::byte b) noexcept {
  if (line_.divisor() != ftdi::k143k || image_.size() >= kImageMax) return;
  image_.push_back(b);
  const std::byte echo = use_up(faults.wrong_echoes) ? b ^ std::byte{0x10} : b;
  if (echo != b) image_.back() = echo;
  send(std::span(&echo, 1));
}

void FalconModel::take_frame(const FalconCommand& order) noexcept {
  remembered_[frames_++ % kRemembered] = {now_, order.motor};
  const bool pushes = order.motor != std::array<std::int16_t, 3>{};
  unsafe_frames_ += pushes && homed_ != kFalconAllHomed ? 1 : 0;
  order_ = order;
  if (!order.homing) wants_edge_ = false;
  answer();
}

void FalconModel::find_origins() noexcept {
  if (!order_.homing || wants_edge_ || frozen_) return;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto bit = static_cast<std::uint8_t>(1u << i);
    const double theta = mechanics_.theta()[static_cast<int>(i)];
    if ((homed_ & bit) != 0) continue;
    if (theta > kOutAngle) out_seen_ |= bit;
    if ((out_seen_ & bit) != 0 && theta < kInAngle) {
      homed_ |= bit;
      mechanics_.find_origin(i);
    }
  }
}

void FalconModel::answer() noexcept {
  if (faults.silent || use_up(faults.lost_replies)) return;
  FalconReply reply{.encoder = frozen_ ? frozen_at_ : mechanics_.encoder(), .buttons = buttons_, .homed = homed_};
  if (faults.jump_counts != 0) {
    reply.encoder[0] = static_cast<std::int16_t>(reply.encoder[0] + faults.jump_counts);
    faults.jump_counts = 0;
  }
  FalconBytes out = encode(reply);
  if (use_up(faults.flipped_replies)) out[6] = std::byte{0xEE};
  std::size_t size = out.size();
  if (use_up(faults.short_replies)) size -= 2;

  const auto room = [](std::size_t used) { return used + kFalconFrame <= 4 * kFalconFrame; };
  if (use_up(faults.glued_replies) && room(kept_size_)) {
    std::copy_n(out.begin(), size, kept_.begin() + static_cast<std::ptrdiff_t>(kept_size_));
    kept_size_ += size;
    return;
  }
  if (use_up(faults.line_errors)) line_.mark_line_error();
  for (; faults.noise_bytes > 0; --faults.noise_bytes) send(bytes(faults.noise_bytes % 2 == 0 ? 0x3E : 0x55));
  if (kept_size_ > 0) send(std::span(kept_).first(kept_size_));
  kept_size_ = 0;
  if (use_up(faults.split_replies)) {
    constexpr std::size_t kHalf = kFalconFrame / 2;
    std::copy(out.begin() + kHalf, out.begin() + static_cast<std::ptrdiff_t>(size), kept_.begin());
    kept_size_ = size - kHalf;
    size = kHalf;
  }
  send(std::span(out).first(size));
}

void FalconModel::send(std::span<const std::byte> out) noexcept {
  if (faults.late == Duration{0}) {
    for (const std::byte b : out) line_.from_device(b);
    return;
  }
  if (delayed_size_ == 0) delayed_for_ = faults.late;
  for (const std::byte b : out) {
    if (delayed_size_ < delayed_.size()) delayed_[delayed_size_++] = b;
  }
}

}  // namespace tandem::hal::emulation
