#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/base/time.h"
#include "server/console/one_time_token.h"

namespace tandem::console {

/// How long a cookie stays.
enum class CookieLife : std::uint8_t {
  kIdle,     ///< ends a while after the last open socket with it
  kLasting,  ///< does not end by idling
  kPinned,   ///< never ends: it is not made again
};

/// Browsers that have access, by the secret of their cookie. Several cookies may have the same person. Bounded: the
/// cookie that is idle for longest ends when one more is added, unless it is pinned.
template <class Person>
class BrowserSessions {
 public:
  static constexpr std::size_t kMax = 64;

  /// @param idle  how long a cookie stays without an open socket
  explicit BrowserSessions(Duration idle) : idle_(idle) {}

  /// @return false: kMax cookies have open sockets or are pinned, and nothing was added
  [[nodiscard]] bool add(std::string secret, std::shared_ptr<Person> person, CookieLife life, Time now) {
    if (rows_.size() >= kMax) {
      auto oldest = rows_.end();
      for (auto row = rows_.begin(); row != rows_.end(); ++row) {
        if (row->sockets > 0 || row->life == CookieLife::kPinned) continue;
        if (oldest == rows_.end() || row->idle_since < oldest->idle_since) oldest = row;
      }
      if (oldest == rows_.end()) return false;
      rows_.erase(oldest);
    }
    rows_.push_back({std::move(secret), std::move(person), life, 0, now});
    return true;
  }
  /// Returns the person of a cookie; null: unknown. The time depends on the number of cookies only.
  [[nodiscard]] std::shared_ptr<Person> find(std::string_view secret) const {
    std::shared_ptr<Person> found;
    for (const Row& row : rows_)
      if (!secret.empty() && equal_secrets(row.secret, secret)) found = row.person;
    return found;
  }
  /// A socket with this cookie was opened.
  void opened(std::string_view secret) noexcept {
    for (Row& row : rows_)
      if (row.secret == secret) ++row.sockets;
  }
  /// A socket with this cookie was closed.
  void closed(std::string_view secret, Time now) noexcept {
    for (Row& row : rows_) {
      if (row.secret != secret || row.sockets == 0) continue;
      --row.sockets;
      row.idle_since = now;
    }
  }
  /// Ends the cookies that were idle for too long. @return their number
  std::size_t expire(Time now) {
    return std::erase_if(rows_, [&](const Row& row) {
      return row.life == CookieLife::kIdle && row.sockets == 0 && now - row.idle_since >= idle_;
    });
  }
  /// Returns whether `accepts` holds for the person of any cookie.
  template <class Accepts>
  [[nodiscard]] bool any(Accepts accepts) const {
    return std::ranges::any_of(rows_, [&](const Row& row) { return accepts(*row.person); });
  }
  /// Calls `use` for the person of each cookie.
  template <class Use>
  void each(Use use) const {
    for (const Row& row : rows_) use(row.person);
  }
  [[nodiscard]] std::size_t size() const noexcept { return rows_.size(); }

 private:
  struct Row {
    std::string secret;
    std::shared_ptr<Person> person;
    CookieLife life = CookieLife::kIdle;
    std::size_t sockets = 0;
    Time idle_since{};
  };
  Duration idle_;
  std::vector<Row> rows_;
};

}  // namespace tandem::console
