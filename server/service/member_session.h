#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "server/service/epoch_base.h"
#include "server/service/service_directory.h"
#include "server/service/service_session.h"

namespace tandem::server {

/// One session that this server claims, serves or ends: its phase, and the reads and writes of its keys before it is
/// open and when it ends. Each of them has the condition that this server still owns the session.
class MemberSession {
 public:
  enum class Phase : std::uint8_t {
    kClaiming,
    kLoading,  ///< spec and snapshot are being read
    kWriting,  ///< the spec is being written
    kOpening,  ///< kOpen was reported
    kOpen,
    kMoving,     ///< kHandOver was reported
    kLosing,     ///< kGiveUp was reported
    kEnding,     ///< the keys are being erased
    kReleasing,  ///< the owner key is being erased
  };
  /// Where the session begins from.
  enum class Origin : std::uint8_t {
    kDirectory,   ///< spec and state of the directory
    kConfigured,  ///< the configuration, if it has changed or the directory has no spec
    kCreated,     ///< a creation: the spec may not exist before
    kKept,        ///< the state that this server has
  };
  /// A session as it is served.
  struct Run {
    ServiceSession spec;
    std::string snapshot{}, consoles{};  ///< newest
  };

  /// A session of the directory.
  explicit MemberSession(std::string name) : name_(std::move(name)) {}
  MemberSession(std::string name, Origin origin, Run from)
      : name_(std::move(name)),
        origin_(origin),
        spec_(std::move(from.spec)),
        snapshot_(std::move(from.snapshot)),
        consoles_(std::move(from.consoles)) {}

  [[nodiscard]] Phase phase() const noexcept { return phase_; }
  void set_phase(Phase phase) noexcept { phase_ = phase; }
  [[nodiscard]] bool is_open() const noexcept { return phase_ == Phase::kOpen; }
  /// It is over, and its keys are being erased.
  [[nodiscard]] bool ends() const noexcept { return phase_ == Phase::kEnding || phase_ == Phase::kReleasing; }
  /// Of its ownership.
  [[nodiscard]] directory::Revision revision() const noexcept { return revision_; }
  /// Its state may be set: it is served here, or was until it moves.
  [[nodiscard]] bool has_state() const noexcept {
    return phase_ == Phase::kOpen || phase_ == Phase::kOpening || phase_ == Phase::kMoving;
  }
  void set_snapshot(std::string bytes) { snapshot_ = std::move(bytes); }
  void set_consoles(std::string text) { consoles_ = std::move(text); }
  /// As opened; with the newest state. @pre `on_reply` has returned kOpen, and `take_run` was not called since
  [[nodiscard]] Run run() const { return {*served_, snapshot_, consoles_}; }
  /// The same, once; nullopt: it was not served here.
  [[nodiscard]] std::optional<Run> take_run();

  /// This server owns it.
  void on_owned(directory::Revision revision);
  /// Its creation was refused while the spec was being written: the spec is erased again.
  void abandon();
  /// A move is taken back: the session is opened here again, from the state that it had at its end here, which the
  /// directory may not have.
  void open_again();
  /// Another run replaces the open one.
  void replace(ServiceSession spec);
  /// Erases its keys.
  void end();

  /// Returns the request to begin now, if there is one. The caller calls `begun`.
  [[nodiscard]] std::optional<directory::Request> poll_request(Time now, Duration retry_after,
                                                               const ServiceDirectory& directory);
  void begun(Time now, directory::OperationId operation) noexcept;
  [[nodiscard]] bool waits_for(directory::OperationId operation) const noexcept { return operation_ == operation; }
  /// Next step of the caller.
  enum class Next : std::uint8_t {
    kNothing,
    kOpen,        ///< `run` is to be opened
    kRelease,     ///< the ownership is to be released: no key is left
    kUnreadable,  ///< the same, and its keys stay: another release may have written them
    kTaken,       ///< the same: the name of the creation belongs to a session without owner
  };
  /// Takes the reply that it waits for.
  [[nodiscard]] Next on_reply(Time now, const directory::Reply& reply, EpochBase& base);

 private:
  [[nodiscard]] std::optional<directory::Request> request(const ServiceDirectory& directory) const;
  [[nodiscard]] directory::Transaction write(directory::Condition owned, const ServiceDirectory& directory) const;
  Next on_loaded(const directory::Reply& reply, EpochBase& base);
  Next on_written(Time now, const directory::Reply& reply, EpochBase& base);
  Next open(ServiceSession spec, EpochBase& base);
  /// Does the phase without a request under way.
  void enter(Phase phase) noexcept;

  std::string name_;
  Phase phase_ = Phase::kClaiming;
  Origin origin_ = Origin::kDirectory;
  directory::Revision revision_ = 0;
  std::optional<ServiceSession> spec_{};    ///< to be written
  std::optional<ServiceSession> served_{};  ///< as opened
  std::string snapshot_{}, consoles_{};     ///< newest
  bool abandoned_ = false;
  bool has_newest_ = false;               ///< snapshot and consoles are newer than those in the directory
  directory::OperationId operation_ = 0;  ///< under way; 0: none
  Time sent_{}, next_attempt_{};
};

}  // namespace tandem::server
