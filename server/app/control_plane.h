#pragma once

#include <array>
#include <asio/executor_work_guard.hpp>
#include <asio/io_context.hpp>
#include <asio/ip/tcp.hpp>
#include <asio/ssl/context.hpp>
#include <asio/steady_timer.hpp>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <expected>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

#include "common/io/clock.h"
#include "common/io/socket_address.h"
#include "common/trust/attempts.h"
#include "common/trust/connection_places.h"
#include "common/trust/io/server_trust.h"
#include "common/trust/limiter.h"
#include "common/trust/pending_places.h"
#include "common/trust/returning.h"
#include "server/app/admissions.h"

namespace tandem::server {

class ControlConnection;

/// What happened at the door. Each is counted; the interesting ones are told too.
enum class ControlEvent : std::uint8_t {
  kAccepted, kTooFast, kHandshakeFailed, kDeadline, kTooMuchInput, kBadFrame, kNotEnrolled, kBlocked, kEnrolled, kCodeRefused, kWelcomed, kRefused,
  kCommand, kCommandTooFast, kTrouble, kForbidden,
  kEvicted,   ///< had proved no enrolled key, and made room for another
  kIdle,      ///< had not joined, and asked nothing for too long
  kTooMany,   ///< had not joined, and was one too many of its key or source, or made room for another
};
inline constexpr std::size_t kControlEvents = 19;
[[nodiscard]] std::string_view to_text(ControlEvent event) noexcept;  ///< one word, for logs and metrics
[[nodiscard]] std::string_view words_of(ControlEvent event) noexcept;  ///< for people: what is to be said of who came

/// For logs and audit; never holds a secret.
struct ControlNews {
  ControlEvent event = ControlEvent::kAccepted;
  std::string address, workstation, detail;
};

struct ControlLimits {
  std::chrono::milliseconds deadline{5000};        ///< from accept to the first frame that is answered with yes
  std::chrono::milliseconds frame_deadline{5000};  ///< later: from the first byte of a frame to its last, and for an order to be carried out
  std::chrono::milliseconds answer_deadline{2000};  ///< for an answer to be taken: who does not read is let go of
  int unread_max = 256 * 1024;                      ///< [bytes] of answers that the kernel keeps for who does not read
  std::size_t input_before_auth = 8192;            ///< [bytes], TLS included
  std::size_t pending = 256;                       ///< TLS handshakes, and connections of keys that are not enrolled; four times as many wait for theirs
  std::size_t connections = 2048;                  ///< of enrolled keys
  std::chrono::milliseconds first_byte{5000}, first_byte_pressed{1000};  ///< from accept to the first byte; while half of the waiting places are taken
  std::chrono::milliseconds bare_idle{10000};      ///< of a connection that has not joined
  std::size_t bare_per_key = 4, bare_per_source = 16;  ///< connections that have not joined
  bool loopback_exempt = true;                     ///< sources on this computer, of wrong codes
  trust::AcceptLimits accept;
};

/// Connections without a proved key, for each of `ControlLimits::pending`: they wait for a first byte, then for a handshake.
inline constexpr std::size_t kMostPerPending = 4;

/// Times as the control plane sees them; tests bring their own.
struct ControlClocks {
  std::function<std::int64_t()> wall = trust::wall_seconds;  ///< [s] since 1970, UTC
  std::function<Time()> monotonic = io::monotonic_now;
};

/// The door of a server: takes TLS connections, enrols workstations, hands who wants to join to `Admissions`, passes on commands.
/// Everything runs on the thread of `context`; nothing blocks but the books' files.
class ControlPlane {
 public:
  /// @param trust  after begin_serving; belongs to the context's thread from now on
  /// Before this goes: `stop`, and the context has run until nothing was left (ControlThread does both).
  ControlPlane(asio::io_context& context, trust::ServerTrust& trust, Admissions& admissions, const ControlLimits& limits = {}, ControlClocks clocks = {},
               std::function<void(const ControlNews&)> tell = {});
  ~ControlPlane();
  ControlPlane(const ControlPlane&) = delete;
  ControlPlane& operator=(const ControlPlane&) = delete;

  /// May be called several times, before the context runs. @return the address with the port that was taken, or what is wrong
  [[nodiscard]] std::expected<io::SocketAddress, std::string> listen(const io::SocketAddress& at);
  /// No newcomers, every connection closed. From the context's thread.
  void stop();

  /// Ends the connections of workstations that are not in the book any more: they need not speak first. From the context's thread.
  void look_for_revoked();

  /// From any thread.
  [[nodiscard]] std::uint64_t count(ControlEvent event) const noexcept { return counts_[static_cast<std::size_t>(event)].load(std::memory_order_relaxed); }

 private:
  friend class ControlConnection;
  using Id = trust::PendingPlaces::Id;
  struct Door {
    asio::ip::tcp::acceptor acceptor;
    asio::steady_timer pause;
    bool accepting = false;
  };

  /// A connection before its TLS handshake: no more than a socket.
  struct Waiting {
    asio::ip::tcp::socket socket;
    trust::Origin origin;
    trust::Source source;
    std::string address;
    Time arrived;
  };

  void accept_next(Door& door);
  void rest(Door& door, Duration time);
  void took(asio::ip::tcp::socket socket);
  void wait_for_first_byte(Id id);
  void first_byte(Id id);
  void begin_handshake(Id id);
  /// Closes what is beyond its time, begins handshakes that may begin, and comes again when the next is due.
  void tend();
  void close_unproven(Id id, ControlEvent why);
  /// Closes connections that have not joined, as far as they are too many or idle.
  void close_bare();
  /// Looks who still speaks for a seat or a console, some times a second.
  void sweep_now_and_then();
  void note(ControlEvent event, std::string address, std::string workstation = {}, std::string detail = {});
  // Of connections.
  /// It proved an enrolled key: strangers compete with it no longer.
  void proved(const ControlConnection& connection);
  void joined(const ControlConnection& connection, const control::Welcome& welcome);
  void busy(const ControlConnection& connection, bool busy);
  void ended(const ControlConnection& connection);

  asio::io_context& context_;
  trust::ServerTrust& trust_;
  Admissions& admissions_;
  ControlLimits limits_;
  ControlClocks clocks_;
  std::function<void(const ControlNews&)> tell_;
  asio::ssl::context tls_;
  trust::TokenBucket taken_;        ///< from the kernel: what accepting alone may cost
  trust::AcceptLimiter accepts_;
  trust::Attempts attempts_;
  trust::PendingPlaces pending_;
  trust::ConnectionPlaces places_;
  trust::ReturningAddresses returning_;
  std::list<Door> doors_;
  std::map<Id, std::shared_ptr<Waiting>> waiting_;
  std::map<Id, std::shared_ptr<ControlConnection>> connections_;
  asio::steady_timer tend_, sweep_;
  std::optional<Time> tend_at_;
  bool stopped_ = false, tending_ = false;
  std::array<std::atomic<std::uint64_t>, kControlEvents> counts_{};
};

/// A thread that runs one io_context for a control plane, with all signals left to others.
class ControlThread {
 public:
  [[nodiscard]] asio::io_context& context() noexcept { return context_; }
  void start();
  /// Runs `last` on the thread, then lets it end.
  void stop(std::function<void()> last);
  ~ControlThread();

 private:
  asio::io_context context_{1};
  std::optional<asio::executor_work_guard<asio::io_context::executor_type>> work_;
  std::thread thread_;
};

}  // namespace tandem::server
