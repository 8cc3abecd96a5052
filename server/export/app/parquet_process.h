#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "common/io/fd.h"

namespace tandem::server {

/// A column of a Parquet file (server/export/parquet/src/parquet_writer.mjs).
struct ParquetColumn {
  enum class Type : std::uint8_t { kFloat, kDouble, kInt64, kBoolean, kString };
  std::string name;
  Type type = Type::kFloat;
  std::vector<std::size_t> shape;  ///< empty: one value per row; {n}: a list; {n, m}: a list of lists
};

/// Writes Parquet files with Node.js, because Debian has no C++ library for them. The program that Node.js runs, with
/// the npm package hyparquet-writer in it, is part of this program: no file and no network are needed. The first error
/// is kept, and later calls do nothing.
class ParquetProcess {
 public:
  /// Starts `node`, which must be in $PATH, version 18 or later.
  ParquetProcess();
  ~ParquetProcess();  ///< kills a process that still runs
  ParquetProcess(const ParquetProcess&) = delete;
  ParquetProcess& operator=(const ParquetProcess&) = delete;

  /// Begins a file. @param metadata  key-value pairs of the file
  void begin(const std::string& path, const std::vector<ParquetColumn>& columns,
             const std::map<std::string, std::string>& metadata = {});
  /// Writes rows. @param numbers  the numbers of all columns but texts, one column after the other
  /// @param texts  by column, one text per row
  void rows(std::size_t count, std::span<const std::byte> numbers,
            const std::map<std::string, std::vector<std::string>>& texts = {});
  /// Completes the file.
  void end();
  /// Waits until all files are written. @return the first error, empty if they are complete
  [[nodiscard]] std::string finish();

  [[nodiscard]] const std::string& error() const noexcept { return error_; }

 private:
  void send(std::span<const std::byte> bytes);
  void send_json(const std::string& json);
  /// Waits for the end of the process and keeps its error.
  void reap();

  pid_t pid_ = 0;
  io::Fd stream_, messages_;
  std::string error_;
};

}  // namespace tandem::server
