#pragma once

#include <atomic>
#include <cstdint>
#include <expected>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "common/base/time.h"
#include "server/app/process/live_session.h"
#include "server/app/process/tick_feed.h"
#include "server/app/recording/kept_inputs.h"
#include "server/app/recording/recording_desk.h"
#include "server/recording/io/recording_files.h"

namespace tandem::server {

/// A recording of a running session, on a thread of its own. The session's thread never waits for it: ticks come
/// through a bounded queue, and what does not fit is counted in the file. A full or slow disk costs ticks of the
/// recording only; it continues when the disk does.
class LiveRecording {
 public:
  /// A line for the operator of the server.
  struct Message {
    bool warning = false;
    const char* event = "";  ///< one word, of static duration
    std::string text;
  };

  /// @param path  of the first file, NAME.mcap, which does not exist
  /// @param session  must outlive this
  /// @param inputs   of the session from its begin; those from before the recording are added little by little. Null:
  /// the file has no inputs, so that it cannot be replayed bit for bit
  [[nodiscard]] static std::expected<std::unique_ptr<LiveRecording>, std::string> start(
      const std::string& path, const LiveSession& session, const RecordingInfo& info, const RecordingLimits& limits,
      bool pseudonyms, std::shared_ptr<RecordingDesk> desk, std::unique_ptr<KeptInputs::Reader> inputs);
  /// Ends the recording; bytes that the disk has not accepted are lost.
  ~LiveRecording();

  /// Receives the session's ticks from one thread.
  [[nodiscard]] const std::shared_ptr<TickFeed>& ticks() const noexcept { return ticks_; }

  // ---- The main loop's thread ----
  /// Messages since the last call.
  [[nodiscard]] std::vector<Message> take_messages();
  /// Ends the recording when the queue is empty. `done` says when its last file is complete.
  void begin_finish() noexcept { finish_.store(true, std::memory_order_release); }
  /// No more work: the last file is complete, or the limit of all files is reached, or the disk did not take the end
  /// within kEndLimit.
  [[nodiscard]] bool done() const noexcept { return done_.load(std::memory_order_acquire); }
  /// Ticks in the files, and ticks since the first one that are in no file.
  [[nodiscard]] std::uint64_t recorded() const noexcept { return recorded_.load(std::memory_order_relaxed); }
  [[nodiscard]] std::uint64_t lost() const noexcept { return lost_.load(std::memory_order_relaxed); }
  /// Processor time of this recording's threads.
  [[nodiscard]] Duration cpu() const noexcept { return Duration{cpu_ns_.load(std::memory_order_relaxed)}; }

  static constexpr Duration kEndLimit = std::chrono::seconds(5);
  /// Time for the inputs from before the recording that are not in the files when it ends.
  static constexpr Duration kCopyLimit = std::chrono::seconds(120);

 private:
  LiveRecording(std::unique_ptr<RecordingFiles> files, const LiveSession& session, bool pseudonyms,
                std::shared_ptr<RecordingDesk> desk, std::unique_ptr<KeptInputs::Reader> inputs);
  void run();
  void step(Time now);
  /// Adds what precedes the end of the recording, as long as the disk takes it, at most kCopyLimit.
  void finish_inputs();
  /// Begins the file at the first tick of the session.
  void begin(Time now);
  void add_ticks();
  void add_inputs();
  [[nodiscard]] bool add_next_inputs();
  void add_links();
  void report();
  void say(bool warning, const char* event, std::string text);

  const LiveSession* session_;
  bool pseudonyms_;
  std::shared_ptr<RecordingDesk> desk_;
  std::uint32_t number_;  ///< at the desk
  std::unique_ptr<KeptInputs::Reader> inputs_;
  std::shared_ptr<TickFeed> ticks_;
  std::unique_ptr<RecordingFiles> files_;
  Time next_links_{}, next_files_{};
  std::uint32_t tick_ = 0;      ///< newest session tick
  std::uint64_t unqueued_ = 0;  ///< ticks that did not fit into the queue, as reported to the file
  std::string trouble_;         ///< as reported
  std::mutex lock_;
  std::vector<Message> messages_;
  std::atomic<bool> finish_{false}, abandon_{false}, done_{false};
  std::atomic<std::uint64_t> recorded_{0}, lost_{0};
  std::atomic<std::int64_t> cpu_ns_{0};
  std::thread thread_;
};

}  // namespace tandem::server
