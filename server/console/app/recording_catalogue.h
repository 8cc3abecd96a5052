#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "server/archive/app/recording_index.h"
#include "server/console/recording_json.h"

namespace tandem::console {

/// Recordings that a gateway shows: given files, or those of a folder and its subfolders by the index of
/// `tandem-server recordings`. The files of a long recording are one. Each has an id, the digest of the name of its
/// first file, by which pages ask for it.
class RecordingCatalogue {
 public:
  static constexpr std::size_t kListedMax = 1000;

  /// @param folder  empty: only `files`
  RecordingCatalogue(std::string folder, std::vector<std::string> files);

  /// Returns the list, the newest recordings first. A call reads new files of the folder for about two seconds; while
  /// some are left, `RecordingList::to_read` is not 0, and another call goes on.
  [[nodiscard]] RecordingList list();

  struct Found {
    RecordingFiles files;            ///< for display
    std::vector<std::string> paths;  ///< of its files, in their order
  };
  /// Returns a recording by its id; nullopt: there is none. Damaged ones are found, too.
  [[nodiscard]] std::optional<Found> find(const std::string& id) const;

 private:
  void scan(RecordingList& list);
  void list_files(RecordingList& list);
  void keep(RecordingList& list, const std::vector<server::RecordingRow>& rows,
            const std::vector<std::string>& unfinished);

  std::string folder_;
  std::vector<std::string> files_;
  std::map<std::string, Found> known_;  ///< by id
  std::vector<server::RecordingRow> file_rows_;
};

}  // namespace tandem::console
