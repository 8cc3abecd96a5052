#include "server/archive/app/recording_deletion.h"

#include <unistd.h>

#include <cerrno>

#include "common/io/output_file.h"

namespace tandem::server {

std::string delete_recording(const std::string& folder, RecordingIndex& index, const RecordingRow& row,
                             const std::string& reason, const AuditLine& audit) {
  const std::string detail = reason + "; " + std::to_string(row.bytes) + " bytes; session " + row.summary.session;
  if (const std::string problem = audit("recording_deleted", row.file, detail); !problem.empty())
    return row.file + " is kept, because the audit log cannot record its deletion: " + problem;
  const std::string path = folder + "/" + row.file;
  if (::unlink(path.c_str()) != 0 && errno != ENOENT) {
    const std::string why = io::write_error_text(errno);
    const std::string unrecorded = audit("recording_kept", row.file, why);
    return row.file + " cannot be deleted: " + why + (unrecorded.empty() ? "" : "; the audit log: " + unrecorded);
  }
  return index.remove(row.file);
}

}  // namespace tandem::server
