#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "server/directory/directory.h"

namespace tandem::directory {

/// The mark of a directory: a random text in it that no other directory has. A server that finds another mark than the
/// one that it knows, or a mark that another write has created, has another directory than before.
///
/// This class has the known mark and draws marks for directories without one. It asks the store for the mark at the
/// start, and whenever `doubt` is called.
class DirectoryMark {
 public:
  struct Text {
    std::string text{};    ///< empty: none
    Revision created = 0;  ///< 0: unknown, a server of an older version has stored the text
  };

  /// @param known  from before a restart
  /// @param drawn  random text, the beginning of drawn marks
  DirectoryMark(std::string key, Text known, std::string drawn)
      : key_(std::move(key)), known_(std::move(known)), drawn_(std::move(drawn)) {}

  [[nodiscard]] const std::string& key() const noexcept { return key_; }
  /// Whether a text can be a mark: at most 64 of printable ASCII, so that files can have it.
  [[nodiscard]] static bool valid(std::string_view text) noexcept;
  /// Each attempt to write a mark has one of its own: a mark that was written into a directory which is lost now is
  /// never seen again.
  [[nodiscard]] std::string draw();

  [[nodiscard]] const Text& known() const noexcept { return known_; }
  [[nodiscard]] bool is_known(const Text& now) const noexcept { return same(known_, now); }
  /// The text is the mark of a directory that is lost: the present one was put back to an older state.
  [[nodiscard]] bool is_outdated(std::string_view text) const noexcept { return !lost_.empty() && text == lost_; }
  void set_known(Text now) { known_ = std::move(now); }
  /// The directory is not the one of the known mark.
  void lose();
  /// Times at which a known mark was lost.
  [[nodiscard]] std::uint64_t losses() const noexcept { return losses_; }

  /// Has the mark asked for, because the directory may be another one.
  void doubt() noexcept;
  /// The store has answered since the last doubt.
  [[nodiscard]] bool answered() const noexcept { return answered_; }
  [[nodiscard]] std::optional<Request> poll_request(Time now, OperationId operation, Duration retry_after);
  enum class Found : std::uint8_t { kNothing, kSame, kOther };
  /// Takes a reply. kNothing: it belongs to another object. The answer counts against the mark that was known when it
  /// was asked for.
  [[nodiscard]] Found on_reply(const Reply& reply);

 private:
  static constexpr Duration kAskAgain = std::chrono::milliseconds(100);  ///< after an error

  [[nodiscard]] static bool same(const Text& known, const Text& now) noexcept {
    return now.text == known.text && (known.created == 0 || known.created == now.created);
  }

  std::string key_;
  Text known_;
  std::string drawn_, lost_;
  std::uint64_t draws_ = 0, losses_ = 0;
  OperationId operation_ = 0;  ///< asks for the mark; 0: none
  Text expected_{};            ///< known mark at that time
  std::optional<Time> asked_;
  bool answered_ = false;
};

}  // namespace tandem::directory
