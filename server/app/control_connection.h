#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "common/trust/io/control_stream.h"
#include "server/app/control_plane.h"

namespace tandem::server {

/// One connection at the door: handshake, then frame by frame, each answered before the next is read. Until its first yes it lives under
/// a deadline and an allowance of bytes. Every frame looks the workstation up anew, so who is revoked is refused at his next word.
class ControlConnection : public std::enable_shared_from_this<ControlConnection> {
 public:
  ControlConnection(ControlPlane& plane, trust::PendingPlaces::Id id, asio::ip::tcp::socket socket, const trust::Origin& origin, const trust::Source& source,
                    std::string address);
  /// @param deadline  for its first yes
  void start(std::chrono::milliseconds deadline);
  void stop();
  /// Ends it without a word; `why` is noted.
  void close(ControlEvent why);
  [[nodiscard]] trust::PendingPlaces::Id id() const noexcept { return id_; }
  [[nodiscard]] const trust::Origin& origin() const noexcept { return origin_; }
  [[nodiscard]] const trust::Source& source() const noexcept { return source_; }
  [[nodiscard]] const trust::Pin& pin() const noexcept { return pin_; }
  /// What it was welcomed to; null: nothing.
  [[nodiscard]] const control::Welcome* standing() const noexcept { return standing_ ? &*standing_ : nullptr; }
  /// Ends it, with a word, if its workstation was revoked.
  void look_for_revocation();

 private:
  void read_next();
  void took(SecretBuffer bytes);
  void on_enrol(const control::Enrol& enrol);
  void on_hello(control::Hello hello);
  void on_command(const control::Body& command);
  void admitted(const std::shared_ptr<JoinRequest>& request, Admission admission);
  /// Sends an answer; afterwards reads on, or ends if `last`.
  void answer(control::Body body, bool last = false);
  void refuse(control::Reason reason, std::string text, bool last, std::uint32_t retry_after_s = 0);
  /// Ends the connection then, whatever it is waiting for: its client, or an answer from inside.
  void must_be_over_in(std::chrono::milliseconds time);
  /// Its key is in the book.
  void proved();
  /// The first yes: from now on this connection may stay.
  void accepted();
  void over(const trust::StreamFault& fault);
  void finish();
  /// Whether too many wrong codes came from there, or from this key; then it has been told so.
  bool blocked(Duration left);
  [[nodiscard]] std::optional<trust::Pin> enrolled_key() const { return workstation_ ? std::optional(pin_) : std::nullopt; }

  ControlPlane& plane_;
  trust::PendingPlaces::Id id_;
  std::shared_ptr<trust::ControlStream> stream_;
  trust::Origin origin_;
  trust::Source source_;
  std::string address_;
  trust::Pin pin_;
  std::optional<WorkstationRow> workstation_;
  std::optional<control::Welcome> standing_;
  [[nodiscard]] trust::TokenBucket& bucket_of(control::Kind kind) noexcept;

  trust::TokenBucket commands_, stops_, authority_;  ///< a stop waits for nothing else
  trust::TokenBucket complaints_{1, 1};              ///< about what his role may not, in the audit log
  std::uint32_t request_ = 0;
  bool acted_ = false, refused_ = false;  ///< an order of his was carried out; one was not
  bool pending_ = true, proved_ = false, finished_ = false, writing_ = false;
};

}  // namespace tandem::server
