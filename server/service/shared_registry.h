#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "server/directory/directory_mark.h"
#include "server/directory/prefix_follower.h"
#include "server/service/registry_entries.h"
#include "server/service/spent_codes.h"

namespace tandem::server {

/// Last agreement of files and directory.
struct RegistryAgreement {
  std::string mark;  ///< of that directory
  RegistryEntries entries;
  directory::Revision created = 0;  ///< of the mark; 0: unknown, a server of an older version has stored this
  /// A revision that the directory has reached; a lower one tells that it was put back while this server was stopped.
  directory::Revision revision = 0;
  std::int64_t epoch_base = 0;  ///< highest one of a session that the server knows
  bool waits = false;           ///< it waited for leases of another directory, and waits again after a restart
  SpentCodes::Codes spent{};    ///< enrolment codes
  friend bool operator==(const RegistryAgreement&, const RegistryAgreement&) = default;
};
/// As one text for a file, and back. Reads any bytes; nullopt: they are no such text.
[[nodiscard]] std::string to_text(const RegistryAgreement& agreed);
[[nodiscard]] std::optional<RegistryAgreement> parse_registry_agreement(std::string_view text);

/// Keeps the workstations and codes of a server equal to those of its service: an enrolment, code or revocation
/// of one server holds at all. Each server has its own files, which its commands change; this class compares three
/// states of each name: as of the last agreement, in the files, in the directory. A change on one side goes to the
/// other. If both sides changed, a revocation wins, else key and code are merged (`merged_entry`). The files take only
/// what they can hold (`tenable`); of one key under two names the later enrolment is revoked.
///
/// While the directory does not answer, the files hold as they are. A missing entry is a revocation only in the
/// directory of the last agreement. Any other gets the content of the files: one that was begun from nothing, or was
/// put back to an older state while this server ran; codes that were spent meanwhile stay spent. Its mark tells it
/// (DirectoryMark), and revisions that go back. A server that notices the latter replaces the mark, so that all servers
/// notice. Each change has the condition that the mark is the known one. Pure: no clock, file, socket or thread.
class SharedRegistry {
 public:
  static constexpr Duration kPause = std::chrono::milliseconds(50);  ///< after a change that was not written

  /// @param prefix  of the directory's keys, begins and ends with "/"
  /// @param agreed  entries of `agreed()` from the time before a restart, of the directory of the mark
  /// @param spent   its spent codes
  /// @param mark    of the directory, with the key `mark_key(prefix)`; must outlive this
  SharedRegistry(const std::string& prefix, RegistryEntries agreed, SpentCodes::Codes spent,
                 directory::DirectoryMark& mark)
      : prefix_(prefix + "registry/"),
        follower_(prefix_),
        mark_(mark),
        agreed_(std::move(agreed)),
        spent_(std::move(spent)) {}

  [[nodiscard]] static std::string mark_key(const std::string& prefix) { return prefix + "registry/.mark"; }

  /// Sets the entries of the files as they are now. Nothing changes on either side before the first call.
  void set_local(RegistryEntries local);
  /// @param now_s  wall clock [s since 1970, UTC]
  void forget_expired_codes(std::int64_t now_s) { spent_.forget_expired(now_s); }

  /// Returns the request to begin now, if there is one.
  [[nodiscard]] std::optional<directory::Request> poll_request(Time now, directory::OperationId operation,
                                                               Duration retry_after);
  /// Takes a reply. Returns whether it belongs to this object.
  bool on_reply(const directory::Reply& reply);

  /// Returns the entries that the files must have, if they have others. The caller writes them, unless the files have
  /// changed meanwhile, and calls `set_local`.
  [[nodiscard]] std::optional<RegistryEntries> wanted() const;
  /// Entries on which files and directory agree; the caller stores them for the next start.
  [[nodiscard]] RegistryAgreement agreed() const {
    return {.mark = mark_.known().text, .entries = agreed_, .created = mark_.known().created, .spent = spent_.codes()};
  }
  /// The copy of the directory is complete and follows it.
  [[nodiscard]] bool follows() const noexcept { return follower_.follows(); }
  /// Has the directory read again: it may be another one than before.
  void read_again() noexcept { follower_.restart(); }
  /// Takes the directory for another one than that of the last agreement.
  void begin_again();
  /// Keys of the directory that cannot be read; they change nothing here.
  [[nodiscard]] std::uint64_t rejected() const noexcept { return rejected_; }

 private:
  struct Stored {
    std::string text;  ///< empty: it cannot be read
    directory::Revision modified = 0, created = 0;
  };
  void apply(const directory::Change& change);
  /// Text that both sides should have; empty: none.
  [[nodiscard]] std::string merged(const std::string& name) const;
  [[nodiscard]] const std::string& stored_text(const std::string& name) const;
  [[nodiscard]] bool unreadable(const std::string& name) const;
  [[nodiscard]] std::vector<std::string> names() const;
  [[nodiscard]] directory::Request change(const std::string& key, std::string text, Time now,
                                          directory::OperationId operation);
  void agree();
  /// The mark in the directory is the one of the last agreement.
  [[nodiscard]] bool as_agreed() const;
  /// The directory needs another mark.
  [[nodiscard]] bool unmarked() const;
  void on_news(const directory::PrefixFollower::News& news);
  [[nodiscard]] Stored mark() const;

  std::string prefix_;
  directory::PrefixFollower follower_;
  directory::DirectoryMark& mark_;
  RegistryEntries agreed_;
  SpentCodes spent_;
  RegistryEntries local_;
  bool local_known_ = false;
  RegistryEntries lost_;  ///< as agreed in directories that are lost, without names that the files have
  std::map<std::string, Stored, std::less<>> stored_;
  directory::OperationId operation_ = 0;  ///< of a change under way; 0: none
  std::string changing_, change_;         ///< its name and text
  Time sent_{}, next_{};
  bool refused_ = false;
  std::uint64_t rejected_ = 0;
};

}  // namespace tandem::server
