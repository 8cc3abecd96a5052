#pragma once

#include <expected>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/auth/io/server_keystore.h"
#include "server/app/monitor/presence_tracker.h"
#include "server/app/monitor/session_ending.h"
#include "server/app/process/live_session.h"
#include "server/app/process/recorder.h"
#include "server/app/process/snapshot_keeper.h"
#include "server/app/recording/input_keeper.h"
#include "server/app/recording/live_recording.h"
#include "server/app/recording/recording_target.h"
#include "server/session/session_snapshot.h"

namespace tandem::server {

/// Options of one session, validated.
struct SessionOptions {
  std::string name{};  ///< for users: 1 to 32 characters of A-Z a-z 0-9 _ -
  SceneSpec scene{};
  double scene_duration = 0;    ///< of the scene before another one replaced it [s]; 0: none did
  std::string json{}, trace{};  ///< file names; `-` (JSON only) is standard output; empty: none
  std::string reports{};        ///< directory for a report of every run; empty: none
  std::uint64_t seed = 1;       ///< for the report only: a live session draws nothing from it
  RecordingOptions record{};
  bool tickets_only = false;
  std::vector<std::string> replayed{};  ///< seats that recorded hands take, which no client can join
  bool restart = false;                 ///< when the session is over, a new one replaces it
};

/// One run of a configured session, from its start to its report.
class SessionInstance {
 public:
  struct OpenError {
    int code = 1;  ///< exit code
    std::vector<std::string> texts;
  };
  struct Opening {
    std::uint8_t slot = 0;
    std::uint64_t epoch = 1;                ///< lowest epoch; a restored session has at least the next one
    bool with_code = true;                  ///< clients may join by a code
    const SessionSnapshot* kept = nullptr;  ///< snapshot to restore; null: a new session
    std::optional<auth::Id16> id{};         ///< of a new session; nullopt: a random one
    std::string code{};                     ///< of a new session; empty: a random one
  };
  /// @param plan  must outlive this
  /// @param inputs  keeps the inputs of a session that may be recorded
  /// @return the session, ready to be served, or the errors
  [[nodiscard]] static std::expected<std::unique_ptr<SessionInstance>, OpenError> open(const SessionOptions& plan,
                                                                                       const Opening& opening,
                                                                                       InputKeeper& inputs);

  [[nodiscard]] const SessionOptions& options() const noexcept { return *options_; }
  [[nodiscard]] LiveSession& live_session() noexcept { return *live_session_; }
  [[nodiscard]] const auth::Id16& id() const noexcept { return id_; }
  [[nodiscard]] const std::string& code() const noexcept { return code_; }
  [[nodiscard]] std::uint64_t epoch() const noexcept { return epoch_; }

  /// Snapshot from which the session was restored; null: a new session.
  [[nodiscard]] const SessionSnapshot* snapshot() const noexcept { return snapshot_ ? &*snapshot_ : nullptr; }
  /// Time until which former participants can resume. @pre snapshot() is not null
  [[nodiscard]] Time resume_until() const noexcept { return resume_until_; }
  /// Time until which one of them must have come back, or the session ends. nullopt: it waits for its first
  /// participants, or has begun without any because its scene requires none.
  [[nodiscard]] std::optional<Time> return_until() const noexcept;

  /// Whether an operator created the session at run time.
  [[nodiscard]] bool created() const noexcept { return created_ != nullptr; }
  /// Keeps the options of `open` alive. @param ends_at time limit; nullopt: none
  void keep_options(std::shared_ptr<const SessionOptions> options, std::optional<Time> ends_at) {
    created_ = std::move(options);
    ends_at_ = ends_at;
  }
  [[nodiscard]] std::optional<Time> ends_at() const noexcept { return ends_at_; }

  /// Keeps the newest snapshots of the session; null: nothing does. It must outlive this.
  [[nodiscard]] SnapshotKeeper* keeper() const noexcept { return keeper_; }
  void set_keeper(SnapshotKeeper* keeper);
  /// Which orders of the session are stored; null: nothing is.
  [[nodiscard]] std::shared_ptr<const StoredOrders> stored() const noexcept { return stored_; }
  /// Makes this a session of a service: both as OwnedSession has them.
  void set_owned(std::function<void(bool)> on_over, std::vector<auth::Id16> consoles) {
    on_over_ = std::move(on_over);
    consoles_ = std::move(consoles);
  }
  /// Tickets of the consoles at its former owner.
  [[nodiscard]] const std::vector<auth::Id16>& consoles() const noexcept { return consoles_; }
  /// Called when a session of a service is over; null: it is of this server only.
  [[nodiscard]] const std::function<void(bool)>& on_over() const noexcept { return on_over_; }

  /// Notes and participants for a recording, and its state; it exists without one too.
  [[nodiscard]] const std::shared_ptr<RecordingDesk>& recording_desk() const noexcept { return desk_; }
  /// The recording that runs; null: none.
  [[nodiscard]] LiveRecording* recording() noexcept { return recording_.get(); }
  /// Starts a recording in a new file. @return the error; empty: it runs
  [[nodiscard]] std::string start_recording();
  /// Ends the recording, if one runs. Its last file is complete when `recordings_busy` is false.
  void end_recording();
  /// Messages of all recordings since the last call. A recording that reached its limit is ended.
  [[nodiscard]] std::vector<LiveRecording::Message> service_recordings();
  /// A recording runs, or its last file is not complete: this must not be destroyed.
  [[nodiscard]] bool recordings_busy() const noexcept { return recording_ != nullptr || !ending_.empty(); }

  PresenceTracker presence;
  std::string missing_seats;     ///< seats it waited for, as of the last check while it waited
  std::optional<EndReason> end;  ///< set when the server ended the session

  /// Builds the report and writes the files. Call it when the session is over; a recording goes on until
  /// `end_recording`.
  struct Verdict {
    RunReport report;
    std::string problem;  ///< error of a report that could not be written; empty: none
    int code = 0;         ///< exit code if this were the only session
  };
  [[nodiscard]] Verdict finish();
  /// Outcome in words: `pass, 12.3 s`, or that the session never began and which seats were missing. A session that its
  /// service goes on with says so.
  [[nodiscard]] std::string outcome_text(const RunReport& report) const;

 private:
  SessionInstance(const SessionOptions& plan, LocalSlaves slaves, const Opening& opening);
  /// Keeps the session's inputs from its begin. @param start  time at which its slaves were made
  void keep_inputs(Time start, InputKeeper& keeper, const SessionSnapshot* kept);

  std::shared_ptr<const SessionOptions> created_;  ///< first, because the other members refer to it
  const SessionOptions* options_;
  std::optional<Time> ends_at_;
  SnapshotKeeper* keeper_ = nullptr;
  std::shared_ptr<const StoredOrders> stored_;
  std::function<void(bool)> on_over_;
  std::vector<auth::Id16> consoles_;
  auth::Id16 id_;
  std::string code_;
  std::uint64_t epoch_ = 1;
  std::optional<SessionSnapshot> snapshot_;
  Time resume_until_{};
  io::OutputFile json_, trace_;
  TickQueue queue_;
  Recorder recorder_;
  std::shared_ptr<KeptInputs> inputs_;  ///< null: no recording can have them; before the session
  std::unique_ptr<LiveSession> live_session_;
  std::shared_ptr<RecordingDesk> desk_;
  std::unique_ptr<LiveRecording> recording_;
  std::vector<std::unique_ptr<LiveRecording>> ending_;  ///< whose last file is not complete
};

}  // namespace tandem::server
