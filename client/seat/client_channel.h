#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "common/transport/secure_channel.h"
#include "proto/wire/wire_codec.h"

namespace tandem::client {

/// The client's end of a datagram connection: the secure channel, the codec of its messages, and the replies to the
/// server's address validation. A seat and a link test use the same one. No heap after construction.
class ClientChannel {
 public:
  static constexpr unsigned kCloseRepeats = 3;  ///< of a CLOSE that ends the connection, because one can be lost

  /// @throws std::runtime_error if the crypto library lacks the cipher
  ClientChannel(const transport::SecureChannel::Params& link, const wire::Codec& codec)
      : link_(std::make_unique<transport::SecureChannel>(link)), codec_(codec) {}

  [[nodiscard]] transport::SecureChannel& link() noexcept { return *link_; }
  [[nodiscard]] const transport::SecureChannel& link() const noexcept { return *link_; }
  [[nodiscard]] const wire::Codec& codec() const noexcept { return codec_; }
  /// Replaces the secure channel and drops a reply that is due. @param next  the new one; holds the old one afterwards
  void swap_link(std::unique_ptr<transport::SecureChannel>& next) noexcept TANDEM_REALTIME {
    std::swap(link_, next);
    path_answer_.reset();
  }

  /// Takes a PATH_CHALLENGE. The newest one is answered; an invalid one is counted as dropped.
  void on_path_challenge(std::span<const std::byte> plaintext) noexcept TANDEM_REALTIME {
    const auto decoded = codec_.decode_path(plaintext);
    if (!decoded) return link_->drop_body();
    link_->accept_other();
    path_answer_ = decoded->message;
  }
  /// True if a PATH_RESPONSE is due.
  [[nodiscard]] bool answer_due() const noexcept { return path_answer_.has_value(); }
  /// Writes the PATH_RESPONSE that is due. @return as `seal`  @pre answer_due()
  [[nodiscard]] std::optional<std::size_t> seal_answer(Time now, std::uint32_t tick,
                                                       std::span<std::byte> buffer) noexcept TANDEM_REALTIME {
    return seal(now, tick, wire::Type::kPathResponse, *std::exchange(path_answer_, std::nullopt), buffer);
  }
  /// Writes a sealed datagram with one message into `buffer`.
  /// @param tick  number of the sender's tick
  /// @return its size [bytes]; nullopt if it does not fit  @pre buffer.size() >= transport::kHeaderSize
  template <class Message>
  [[nodiscard]] std::optional<std::size_t> seal(Time now, std::uint32_t tick, wire::Type type, const Message& message,
                                                std::span<std::byte> buffer) noexcept TANDEM_REALTIME {
    return seal(now, tick, type, message, codec_, buffer);
  }
  /// The same for a message of another codec.
  template <class Message, class Codec>
  [[nodiscard]] std::optional<std::size_t> seal(Time now, std::uint32_t tick, wire::Type type, const Message& message,
                                                const Codec& codec,
                                                std::span<std::byte> buffer) noexcept TANDEM_REALTIME {
    const std::size_t plain = codec.encode(link_->preamble(now, tick), message, buffer.subspan(transport::kHeaderSize));
    const std::size_t size = plain == 0 ? 0 : link_->seal(now, type, buffer, plain);
    return size == 0 ? std::nullopt : std::optional{size};
  }

 private:
  std::unique_ptr<transport::SecureChannel> link_;
  wire::Codec codec_;
  std::optional<wire::PathMessage> path_answer_;  ///< reply due to a PATH_CHALLENGE (address validation)
};

}  // namespace tandem::client
