#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/raw_bytes.h"
#include "server/recording/input_packer.h"
#include "server/recording/io/input_spool.h"
#include "server/recording/kept_block.h"
#include "server/session/input_journal.h"

namespace tandem::server {

/// The inputs of a session from its begin, so that a recording that begins later can be replayed. It has the session's
/// journal, drains it into memory, and keeps blocks of it in a spool (server/recording/io/input_spool.h). Recordings
/// read the spool first and then what is drained. If the inputs cannot be kept further, recordings that read already
/// lose none of them: the spool may grow to twice its limit while one reads it. Thread-safe but for `journal`; only
/// `keep` and `Reader::next` may wait for the disk.
class KeptInputs : public std::enable_shared_from_this<KeptInputs> {
 public:
  static constexpr std::size_t kBlockBytes = std::size_t{128} << 10U;  ///< of the journal in one block [bytes]
  static constexpr std::size_t kPendingMax = std::size_t{8} << 20U;    ///< that wait for the spool [bytes]
  static constexpr std::size_t kUnreadMax = std::size_t{64} << 20U;    ///< that wait for a recording [bytes]

  /// @param folder  of recordings, for the spool
  /// @param limit   size of the spool, at most [bytes]; 0: only a recording from the session's begin has inputs
  [[nodiscard]] static std::shared_ptr<KeptInputs> make(std::unique_ptr<InputJournal> journal, std::string folder,
                                                        std::uint64_t limit);
  KeptInputs(const KeptInputs&) = delete;
  KeptInputs& operator=(const KeptInputs&) = delete;

  /// The journal that the session writes; it lives as long as this.
  [[nodiscard]] InputJournal& journal() noexcept { return *journal_; }

  /// Takes what the journal has. Call it so often that the journal never fills.
  void drain();
  /// Packs the oldest inputs into the spool if they are enough for a block. Only one thread calls it, with the same
  /// writer for all sessions.
  /// @return whether a block was written: there may be more
  bool keep(KeptBlockWriter& writer);
  /// Why no further inputs are kept; empty: they are.
  [[nodiscard]] std::string problem() const;
  /// The problem, at most once, for the operator; empty: there is no new one.
  [[nodiscard]] std::string take_problem();
  /// Size of the spool [bytes].
  [[nodiscard]] std::uint64_t spooled() const;

  class Reader;
  /// Begins to read from the session's begin. @return error: why its first inputs are not kept
  [[nodiscard]] std::expected<std::unique_ptr<Reader>, std::string> read();

 private:
  KeptInputs(std::unique_ptr<InputJournal> journal, std::string folder, std::uint64_t limit);
  void take_journal();
  void append(std::string_view bytes);
  /// Ends the spool. Readers get the inputs that wait.
  void end(std::string why, bool known);
  [[nodiscard]] std::string spool(const std::string& entry, bool beyond);

  std::unique_ptr<InputJournal> journal_;
  std::string folder_;
  std::uint64_t limit_;
  mutable std::mutex lock_;  ///< of everything below but what belongs to `keep`
  std::string pending_;      ///< bytes of the journal that are not in the spool
  std::uint64_t pending_at_ = 0;
  std::size_t packed_ = 0;     ///< bytes of `pending_` that the packer has
  std::uint64_t drained_ = 0;  ///< bytes of the journal so far
  std::uint64_t spooled_ = 0;  ///< bytes of the spool
  std::string problem_;
  bool told_ = false;
  std::vector<Reader*> readers_;
  std::optional<InputSpool> spool_;  ///< made by `keep`; readers use it once `spooled_` > 0
  // Of the thread that calls `keep`.
  InputPacker packer_;
};

/// One recording's way through the inputs of a session. Used by one thread.
class KeptInputs::Reader {
 public:
  ~Reader();
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  enum class Kind : std::uint8_t {
    kNothing,  ///< at present
    kBlock,    ///< as InputPacker::take gave it without rows
    kPiece,    ///< as InputJournal::drain gives it
    kLost,     ///< nothing follows; `bytes` say why
  };
  struct Item {
    Kind kind = Kind::kNothing;
    std::string_view bytes{};  ///< valid until the next call
    std::size_t stored = 0;    ///< size of a block in the spool [bytes]
  };
  /// The next inputs. All of them together are the journal without a gap.
  [[nodiscard]] Item next();
  /// The session ran before the recording, so that its inputs precede the first row.
  [[nodiscard]] bool late() const noexcept { return late_; }
  /// Blocks of the spool are next.
  [[nodiscard]] bool behind() const;
  /// They are, and what follows them waits in memory, because the spool has ended: read faster.
  [[nodiscard]] bool urgent() const;

 private:
  friend class KeptInputs;
  Reader(std::shared_ptr<KeptInputs> inputs, bool late) : inputs_(std::move(inputs)), late_(late) {}
  /// Gets what waits for the spool, and everything that is drained from now on. @pre the lock is held
  void attach();
  [[nodiscard]] bool is_behind() const noexcept;
  [[nodiscard]] Item read_block();
  [[nodiscard]] Item lose(std::string why);

  std::shared_ptr<KeptInputs> inputs_;
  bool late_;
  std::uint64_t at_ = 0;                        ///< in the spool
  bool attached_ = false, overflowed_ = false;  ///< under the lock
  std::uint64_t end_ = 0;                       ///< likewise: place in the spool at which `unread_` follows
  std::string unread_;                          ///< likewise: bytes of the journal
  std::uint64_t unread_at_ = 0;                 ///< likewise
  std::string piece_, why_;
  std::vector<std::byte> packed_;
  KeptBlockReader blocks_;
};

}  // namespace tandem::server
