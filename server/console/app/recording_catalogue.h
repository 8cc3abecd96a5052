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
/// `tandem-server recordings`. Each has an id, the digest of its name, by which pages ask for it.
class RecordingCatalogue {
 public:
  static constexpr std::size_t kListedMax = 1000;

  /// @param folder  empty: only `files`
  RecordingCatalogue(std::string folder, std::vector<std::string> files);

  /// Returns the list, the newest recordings first. A call reads new files of the folder for about two seconds; while
  /// some are left, `RecordingList::to_read` is not 0, and another call goes on.
  [[nodiscard]] RecordingList list();

  struct Found {
    std::string file;  ///< for display
    std::string path;
  };
  /// Returns a recording by its id; nullopt: there is none. Damaged ones are found, too.
  [[nodiscard]] std::optional<Found> find(const std::string& id) const;

 private:
  void scan(RecordingList& list);
  void list_files(RecordingList& list);
  void keep(RecordingList& list, std::vector<server::RecordingRow> rows);

  std::string folder_;
  std::vector<std::string> files_;
  std::map<std::string, Found> known_;  ///< by id
  std::vector<server::RecordingRow> file_rows_;
};

}  // namespace tandem::console
