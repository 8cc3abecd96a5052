#include "server/export/app/csv_export.h"

#include "common/io/output_file.h"
#include "server/recording/lesson_record.h"
#include "server/report/trace_csv.h"

namespace tandem::server {

std::string export_csv(const Lesson& lesson, const std::string& file, const ExportProgress& progress) {
  constexpr std::size_t kBytesAtOnce = 60'000;  // rows are collected up to this size before a write
  PendingPath pending(file);
  io::OutputFile out;
  if (std::string problem = out.open(pending.path(), false); !problem.empty()) return problem;
  const TraceCsv csv(lesson.scene);
  TickRecord record;
  std::string rows = csv.header();
  for (std::size_t row = 0; row < lesson.rows(); ++row) {
    if (lesson.running[row] != 0) {
      fill_record(lesson, row, record);
      csv.append(record, rows);
    }
    if (rows.size() < kBytesAtOnce) continue;
    out.write(rows);
    rows.clear();
    if (!progress(static_cast<double>(row) / static_cast<double>(lesson.rows()))) return kExportInterrupted;
  }
  out.write(rows);
  if (std::string problem = out.close(); !problem.empty()) return problem;
  return pending.commit();
}

}  // namespace tandem::server
