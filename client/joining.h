#pragma once

#include <optional>
#include <span>
#include <string>

#include "common/base/time.h"
#include "common/link/link.h"
#include "hal/device.h"
#include "proto/seat_setup.h"
#include "proto/wire_codec.h"

namespace tandem::client {

/// Asks a server for a seat until it answers or patience ends. Sans-I/O. Ends in a setup for a Seat, or in a reason.
class Joining {
 public:
  struct Params {
    std::string seat;
    hal::DeviceCaps caps;
    std::uint64_t nonce = 0;       ///< drawn by the caller: names this attempt
    std::uint32_t own_cid = 1;     ///< what the server shall put on its datagrams; not 0
    Duration patience = std::chrono::seconds(5);
  };
  enum class Outcome { kAsking, kAccepted, kRefused, kNoAnswer };

  explicit Joining(const Params& p);
  void on_datagram(Time now, std::span<const std::byte> bytes) noexcept;
  [[nodiscard]] std::optional<std::size_t> poll_transmit(Time now, std::span<std::byte> buffer) noexcept;

  [[nodiscard]] Outcome outcome(Time now) const noexcept;
  [[nodiscard]] wire::BindResult result() const noexcept { return result_; }
  [[nodiscard]] const std::string& reason() const noexcept { return reason_; }
  [[nodiscard]] const SeatSetup& setup() const noexcept { return setup_; }
  [[nodiscard]] link::Link::Params link() const noexcept;

 private:
  Params params_;
  link::Seal sealing_, opening_;
  wire::Codec codec_;
  bool started_ = false, answered_ = false;
  Time first_{}, last_{};
  std::uint64_t counter_ = 0;
  std::uint32_t server_cid_ = 0;
  wire::BindResult result_ = wire::BindResult::kNoSuchSeat;
  std::string reason_;
  SeatSetup setup_;
};

}  // namespace tandem::client
