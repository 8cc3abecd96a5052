#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tandem::server {

/// Next step of each error of a file that an export wrote.
inline constexpr const char* kHdf5NextStep = "export the recording again with `tandem-server recordings export`";

/// An HDF5 file that is being read, with libhdf5. Type, size and storage of each dataset are checked before its values
/// are read, so that memory is bounded by the size of the file. The first error is kept; later calls return empty
/// values. One file at a time per process, because libhdf5 has global state.
class Hdf5Input {
 public:
  /// Largest chunk of a dataset [bytes]. Exports write at most 256 KiB.
  static constexpr std::uint64_t kChunkMax = std::uint64_t{1} << 24;

  explicit Hdf5Input(const std::string& path);
  ~Hdf5Input();
  Hdf5Input(const Hdf5Input&) = delete;
  Hdf5Input& operator=(const Hdf5Input&) = delete;

  /// Returns the size of the file [bytes].
  [[nodiscard]] std::uint64_t bytes() const noexcept { return bytes_; }
  /// Returns the number of rows of a dataset with `columns` numbers per row; 0: one number, without a second dimension.
  /// Error: a dataset that is missing, or has another shape or more rows than the file has bytes.
  [[nodiscard]] std::size_t rows(const std::string& path, std::size_t columns);

  /// Receives rows [first, first + from.size() / width) of a dataset, row by row.
  template <class Number>
  using Sink = std::function<void(std::size_t first, std::span<const Number> from)>;
  /// Reads a dataset of `rows` numbers, or of `rows` times `columns` numbers if `columns` > 0.
  /// Error: another type (IEEE double, or integer of 64 bits, little endian), another size, damaged values.
  void real(const std::string& path, std::size_t rows, std::size_t columns, const Sink<double>& sink);
  void whole(const std::string& path, std::size_t rows, std::size_t columns, const Sink<std::int64_t>& sink);
  /// Checks type and size of a dataset of real numbers that is not read.
  void check_real(const std::string& path, std::size_t rows);
  /// Reads a list of texts of fixed length. @param rows  their number, if it is known
  [[nodiscard]] std::vector<std::string> texts(const std::string& path, std::optional<std::size_t> rows = {});

  // Attributes of a group or dataset. Error: missing, of another type or size.
  [[nodiscard]] std::string text_attribute(const std::string& path, const std::string& name);
  [[nodiscard]] double real_attribute(const std::string& path, const std::string& name);
  [[nodiscard]] std::int64_t whole_attribute(const std::string& path, const std::string& name);
  /// Returns the names of all attributes.
  [[nodiscard]] std::vector<std::string> attributes(const std::string& path);

  /// Keeps an error of the file, such as a value outside its range. @param what  dataset or attribute, or empty
  void fail(const std::string& what, const std::string& problem);
  /// Returns the first error with file, dataset, problem and next step; empty if there is none.
  [[nodiscard]] const std::string& error() const noexcept { return error_; }
  [[nodiscard]] bool good() const noexcept { return error_.empty(); }

 private:
  template <class Number>
  void matrix(const std::string& path, std::size_t rows, std::size_t columns, const Sink<Number>& sink);
  template <class Number>
  Number number_attribute(const std::string& path, const std::string& name);
  /// Opens a dataset whose values lie in this file, and reads its dimensions. @return its identifier; negative: failed
  std::int64_t open(const std::string& path, std::vector<std::uint64_t>& size);
  /// Returns why a dataset is not stored as exports do; empty: it is.
  std::string storage_problem(std::int64_t data) const;

  std::string path_, error_;
  std::uint64_t bytes_ = 0;
  std::int64_t file_ = -1;  ///< hid_t
};

}  // namespace tandem::server
