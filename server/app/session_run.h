#pragma once

#include <expected>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/trust/io/server_trust.h"
#include "server/app/attendance.h"
#include "server/app/hosted_session.h"
#include "server/app/recorder.h"
#include "server/app/session_ending.h"
#include "server/kept_session.h"

namespace tandem::server {

/// A session that somebody wants hosted, everything checked.
struct SessionPlan {
  std::string name;          ///< for people: 1 to 32 of A-Z a-z 0-9 _ -
  SceneSpec scene;
  std::string json, trace;   ///< file names; `-` (JSON only) is standard output; empty: not wanted
  std::string reports;       ///< folder for a report of every run; empty: none
  std::uint64_t seed = 1;    ///< for the report: nothing in a live session is drawn from it
  bool tickets_only = false;
  bool restart = false;      ///< when it is over, another one takes its place
};

/// One run of a planned session, from its opening to its report.
class SessionRun {
 public:
  struct Trouble {
    int code = 1;  ///< exit code
    std::vector<std::string> texts;
  };
  /// @param plan  must outlive it  @param kept  what it goes on from, one epoch later; null: it is new
  /// @return the session, ready to be hosted in `slot`, or what is wrong
  [[nodiscard]] static std::expected<std::unique_ptr<SessionRun>, Trouble> open(const SessionPlan& plan, std::uint8_t slot, std::uint64_t epoch, bool with_code,
                                                                                const KeptSession* kept = nullptr);

  [[nodiscard]] const SessionPlan& plan() const noexcept { return *plan_; }
  [[nodiscard]] HostedSession& hosted() noexcept { return *hosted_; }
  [[nodiscard]] const trust::Id16& id() const noexcept { return id_; }
  [[nodiscard]] const std::string& code() const noexcept { return code_; }
  [[nodiscard]] std::uint64_t epoch() const noexcept { return epoch_; }
  [[nodiscard]] bool writes_to_stdout() const noexcept { return json_.on_stdout(); }

  /// What it went on from; null: it is new.
  [[nodiscard]] const KeptSession* kept() const noexcept { return kept_ ? &*kept_ : nullptr; }
  /// Until when who sat there may come back. @pre kept()
  [[nodiscard]] Time back_until() const noexcept { return back_until_; }

  Attendance attendance;
  std::string waited_for;  ///< whom it still waited for, as last seen while it waited
  std::optional<End> end;  ///< set: it was made to end

  /// Once it is over: judges, writes the reports.
  struct Verdict {
    RunReport report;
    std::string problem;   ///< a report that could not be written; empty: none
    int code = 0;          ///< exit code of a run of only this
  };
  [[nodiscard]] Verdict finish();
  /// `pass, 12.3 s`, or that it never began, and who was missing.
  [[nodiscard]] std::string how_it_went(const RunReport& report) const;

 private:
  SessionRun(const SessionPlan& plan, Slaves slaves, std::uint8_t slot, const KeptSession* kept);

  const SessionPlan* plan_;
  trust::Id16 id_;
  std::string code_;
  std::uint64_t epoch_ = 1;
  std::optional<KeptSession> kept_;
  Time back_until_{};
  io::OutputFile json_, trace_;
  TickQueue queue_;
  Recorder recorder_;
  std::unique_ptr<HostedSession> hosted_;
};

}  // namespace tandem::server
