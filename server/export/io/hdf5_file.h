#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace tandem::server {

/// An HDF5 file that is being written, with libhdf5. The first error is kept, and later calls do nothing. One file at a
/// time per process, because libhdf5 has global state.
class Hdf5File {
 public:
  /// Rows of one chunk, and of one call of a source.
  static constexpr std::size_t kChunkRows = 4096;
  /// Longest text of an attribute [bytes]: the format stores at most 64 KiB there.
  static constexpr std::size_t kAttributeMax = 60'000;

  explicit Hdf5File(const std::string& path);
  ~Hdf5File();  ///< closes; `close` reports errors
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;

  /// Creates a group in a group that exists, such as `/seats/trainer`.
  void group(const std::string& path);
  /// Fills `to`, which holds rows [first, first + count) of a dataset, row by row.
  template <class Number>
  using Source = std::function<void(std::size_t first, std::size_t count, std::span<Number> to)>;
  /// Writes a dataset of `rows` numbers, or of `rows` times `columns` numbers if `columns` > 0; compressed losslessly.
  void real(const std::string& path, std::size_t rows, std::size_t columns, const Source<double>& source);
  void whole(const std::string& path, std::size_t rows, std::size_t columns, const Source<std::int64_t>& source);

  /// A dataset that is written piece by piece; its number in the file.
  template <class Number>
  struct Dataset {
    std::size_t number = 0;
  };
  /// Begins a dataset of `rows` times `columns` numbers as above. It is open, with a cache of at most 1 MiB, until
  /// `close`.
  [[nodiscard]] Dataset<double> begin_real(const std::string& path, std::size_t rows, std::size_t columns);
  [[nodiscard]] Dataset<std::int64_t> begin_whole(const std::string& path, std::size_t rows, std::size_t columns);
  /// Writes rows [first, first + count). @pre the dataset has them
  void put(Dataset<double> to, std::size_t first, std::size_t count, std::span<const double> numbers);
  void put(Dataset<std::int64_t> to, std::size_t first, std::size_t count, std::span<const std::int64_t> numbers);

  /// Writes a list of texts as bytes of UTF-8, each as long as the longest, filled up with zeros.
  void texts(const std::string& path, const std::vector<std::string>& texts);

  // Attributes of a group or dataset.
  void attribute(const std::string& path, const std::string& name, const std::string& text);
  void attribute(const std::string& path, const std::string& name, const std::vector<std::string>& texts);
  void attribute(const std::string& path, const std::string& name, double number);
  void attribute(const std::string& path, const std::string& name, std::int64_t number);

  /// Returns the first error; empty if there is none.
  [[nodiscard]] const std::string& error() const noexcept { return error_; }
  /// Writes the rest and closes. @return the first error; empty if the file is complete
  [[nodiscard]] std::string close();

 private:
  struct Open;  ///< a dataset that is open
  template <class Number>
  [[nodiscard]] std::unique_ptr<Open> create(const std::string& path, std::size_t rows, std::size_t columns);
  template <class Number>
  void write(Open& data, std::size_t first, std::size_t count, std::span<const Number> numbers);
  template <class Number>
  [[nodiscard]] Dataset<Number> begin(const std::string& path, std::size_t rows, std::size_t columns);
  template <class Number>
  void matrix(const std::string& path, std::size_t rows, std::size_t columns, const Source<Number>& source);
  template <class Value>
  void number_attribute(const std::string& path, const std::string& name, Value number);
  /// Keeps the error of a failed call. @return whether it failed
  bool failed(bool wrong, const std::string& what);

  std::string path_, error_;
  std::int64_t file_ = -1;  ///< hid_t
  std::vector<std::unique_ptr<Open>> datasets_;
};

}  // namespace tandem::server
