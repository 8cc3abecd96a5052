#include "server/export/app/csv_export.h"

#include "common/io/output_file.h"
#include "server/recording/lesson_record.h"
#include "server/report/trace_csv.h"

namespace tandem::server {

std::string export_csv(LessonSource& lesson, const std::string& file, const ExportProgress& progress) {
  constexpr std::size_t kBytesAtOnce = 60'000;  // rows are collected up to this size before a write
  PendingPath pending(file);
  io::OutputFile out;
  if (std::string problem = out.open(pending.path(), false); !problem.empty()) return problem;
  const TraceCsv csv(lesson.head().scene);
  const auto all = static_cast<double>(lesson.extent().rows);
  TickRecord record;
  std::string text = csv.header();
  std::size_t done = 0;
  for (;;) {
    const auto rows = lesson.next();
    if (!rows) return rows.error();
    if (*rows == nullptr) break;
    for (std::size_t row = 0; row < (*rows)->rows(); ++row, ++done) {
      if ((*rows)->running[row] != 0) {
        fill_record(**rows, row, record);
        csv.append(record, text);
      }
      if (text.size() < kBytesAtOnce) continue;
      out.write(text);
      text.clear();
      if (!progress(static_cast<double>(done) / all)) return kExportInterrupted;
    }
  }
  out.write(text);
  if (std::string problem = out.close(); !problem.empty()) return problem;
  return pending.commit();
}

}  // namespace tandem::server
