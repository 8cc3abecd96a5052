#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/time.h"
#include "common/io/append_file.h"
#include "server/recording/recording_writer.h"

namespace tandem::server {

/// Limits of a recording.
struct RecordingLimits {
  std::uint64_t file_bytes = std::uint64_t{256} << 20U;  ///< a longer file goes on in another one
  double file_s = 600;                                   ///< [s] likewise, from its first tick on
  std::uint64_t total_bytes = std::uint64_t{64} << 30U;  ///< of all files; then the recording ends
  double bytes_per_s = 128.0 * (1 << 20) / 60;  ///< ticks beyond this rate, over 10 s, are left out and counted
};

/// The files of one recording, each a complete MCAP file: NAME.mcap, then NAME-2.mcap and so on. The next file begins
/// with the first tick beyond the limits, so that a session that waits makes none; inputs alone begin one at
/// `file_bytes`. Ticks that the disk, the rate or a
/// queue did not let through are counted in the file in which they are missing. A recording without a tick, a mark or a
/// sheet leaves no file. Not thread-safe; no member waits for the disk but `close`.
class RecordingFiles {
 public:
  /// @param path   NAME.mcap, which does not exist
  /// @param scene  must outlive this
  /// @return error: why the first file cannot be made
  [[nodiscard]] static std::expected<std::unique_ptr<RecordingFiles>, std::string> open(const std::string& path,
                                                                                        const SceneSpec& scene,
                                                                                        const RecordingInfo& info,
                                                                                        const RecordingLimits& limits,
                                                                                        Time now);

  /// Sets the wall clock at TickRecord::time_ns = 0 [ns since 1970]; 0: not known. Call it before everything below.
  void begin(std::int64_t start_unix_ns);
  [[nodiscard]] bool begun() const noexcept { return writer_ != nullptr; }
  /// Adds a tick, unless the disk or the rate does not let it through.
  void add(const TickRecord& record);
  /// Ticks whose records were dropped since the last `add`, because a queue was full.
  void count_dropped(std::uint64_t ticks) { writer_->count_dropped(ticks); }
  /// Adds a piece of the input journal; it is lost while the disk does not accept.
  void add_inputs(std::span<const std::byte> piece);
  /// Adds inputs from before the recording, beside the rate. @pre accepts()
  /// @param block   as RecordingWriter::add_input_block takes it
  /// @param stored  size of the block in its spool, about that in the file [bytes]
  void add_input_block(std::string_view block, std::size_t stored);
  /// The disk takes more at present.
  [[nodiscard]] bool accepts() const { return trouble_.empty() && !closing_ && file_ && file_->accepts(); }
  /// The writer of the present file, for events, marks, sheets and links. They are few: they are never left out.
  [[nodiscard]] RecordingWriter& writer() noexcept { return *writer_; }
  /// Participants by seat, from now on.
  void set_persons(std::vector<std::string> persons, std::vector<bool> workstations = {});

  /// Passes what is complete to the disk and changes files. Call it at least every 250 ms.
  void step(Time now);
  /// Ends the last file; `closed` says when it is complete.
  void begin_close();
  /// Gives up what the disk did not accept; `problems` name the files.
  void abandon();
  /// All files are complete, or those that are not have a reason in `problems`.
  [[nodiscard]] bool closed();

  /// `begin_close` was called, or the limit of all files is reached.
  [[nodiscard]] bool ended() const noexcept { return closing_; }
  /// Why ticks are dropped now; empty: none are.
  [[nodiscard]] const std::string& trouble() const noexcept { return trouble_; }
  /// Names of the files that are complete, of those without content, which were removed, and reasons for those that are
  /// not complete, since the last call.
  [[nodiscard]] std::vector<std::string> take_completed();
  [[nodiscard]] std::vector<std::string> take_removed();
  [[nodiscard]] std::vector<std::string> take_problems();
  [[nodiscard]] std::uint64_t recorded() const noexcept { return recorded_; }
  /// TickRecord::time_ns of the last tick; 0: there is none.
  [[nodiscard]] std::int64_t time_ns() const noexcept { return time_ns_; }
  /// Session ticks since the first one that are in no file.
  [[nodiscard]] std::uint64_t lost() const noexcept { return any_ ? last_tick_ - first_tick_ + 1 - recorded_ : 0; }
  [[nodiscard]] std::uint64_t lost_inputs() const noexcept { return lost_inputs_; }
  /// Bytes of all files so far.
  [[nodiscard]] std::uint64_t bytes() const noexcept { return total_bytes_ + file_bytes_; }
  /// Processor time of the threads that write the files [ns].
  [[nodiscard]] Duration disk_cpu() const;
  /// The file that grows now, NAME.mcap.part.
  [[nodiscard]] std::string part() const { return file_ ? file_->part() : std::string(); }

 private:
  struct EndingFile {
    std::unique_ptr<io::AppendFile> file;
    std::uint64_t unsynced = 0;  ///< failed syncs that were reported
  };
  RecordingFiles(std::string path, const SceneSpec& scene, RecordingInfo info, const RecordingLimits& limits);
  /// Opens the next file. @return the error
  [[nodiscard]] std::string open_next();
  /// @param last  no other file follows
  void end_file(bool last);
  [[nodiscard]] bool full() const;
  /// Begins the next file; if it cannot be made, the present one goes on.
  void change_file();
  [[nodiscard]] bool pass_on();
  void update_trouble();
  /// Writes an event about the ticks lost since the last one, so that the file says where and why.
  void note_gap();

  std::string stem_;  ///< path without .mcap
  const SceneSpec* scene_;
  RecordingInfo info_;
  RecordingLimits limits_;
  std::unique_ptr<RecordingWriter> writer_;  ///< null before `begin`
  std::unique_ptr<io::AppendFile> file_;     ///< present file; null after `begin_close`
  std::vector<EndingFile> ending_;           ///< files that are being completed
  bool empty_ = false;                       ///< the last of them has no content and is to be removed
  std::vector<std::string> completed_, removed_, problems_;
  std::string trouble_, open_error_;
  unsigned number_ = 0;  ///< in the name of the present file
  unsigned part_ = 0;    ///< of the present file, from 1
  Time now_{}, passed_on_{}, budget_at_{}, retry_at_{};
  std::optional<Time> file_began_;  ///< first tick of the present file
  double budget_ = 0;               ///< [bytes] that the rate allows now
  std::uint64_t exempt_ = 0;        ///< [bytes] that the rate does not count, of inputs from before the recording
  std::uint64_t total_bytes_ = 0, file_bytes_ = 0, recorded_ = 0, lost_inputs_ = 0;
  Duration disk_cpu_{};         ///< of files that are complete
  std::uint64_t unsynced_ = 0;  ///< failed syncs of the present file that were reported
  std::uint64_t gap_ = 0;       ///< ticks lost since the last event about them
  std::int64_t time_ns_ = 0;    ///< TickRecord::time_ns of the last tick
  std::string gap_reason_;
  bool any_ = false, closing_ = false;
  std::uint32_t first_tick_ = 0, last_tick_ = 0;
};

}  // namespace tandem::server
