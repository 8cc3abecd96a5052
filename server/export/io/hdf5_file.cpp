#include "server/export/io/hdf5_file.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <type_traits>
#include <utility>

#include "common/io/output_file.h"
#include "server/export/io/hdf5_id.h"

namespace tandem::server {

namespace {

static_assert(std::is_same_v<hid_t, std::int64_t>);

constexpr unsigned kTruncate = 2;  // H5F_ACC_TRUNC, which as a macro calls the library

/// Finds `errno = N` in the descriptions of libhdf5's error stack.
herr_t find_errno(unsigned /*number*/, const H5E_error2_t* error, void* found) {
  constexpr std::string_view kMark = "errno = ";
  const std::string_view text = error->desc == nullptr ? "" : error->desc;
  const std::size_t at = text.find(kMark);
  if (at != std::string_view::npos) *static_cast<int*>(found) = std::atoi(text.data() + at + kMark.size());
  return 0;
}

std::string hdf5_reason() {
  int code = 0;
  h5().H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, find_errno, &code);
  return code != 0 ? io::write_error_text(code) : "libhdf5 gives no reason";
}

template <class Number>
hid_t stored_type() {
  return std::is_same_v<Number, double> ? h5().stored_real : h5().stored_whole;
}
template <class Number>
hid_t memory_type() {
  return std::is_same_v<Number, double> ? h5().memory_real : h5().memory_whole;
}

}  // namespace

/// Identifiers of an open dataset.
struct Hdf5File::Open {
  Open(std::string name, std::size_t columns, hid_t space_id, hid_t data_id)
      : path(std::move(name)), width(columns), space(space_id, h5().H5Sclose), data(data_id, h5().H5Dclose) {}

  std::string path;
  std::size_t width;  ///< columns; 0: the dataset is a list of numbers
  Hdf5Id space, data;
};

Hdf5File::Hdf5File(const std::string& path) : path_(path) {
  if (const auto& library = Hdf5Library::load(); !library) {
    error_ = library.error();
    return;
  }
  file_ = h5().H5Fcreate(path.c_str(), kTruncate, H5P_DEFAULT, H5P_DEFAULT);
  failed(file_ < 0, "");
}

Hdf5File::~Hdf5File() {
  datasets_.clear();
  if (file_ >= 0) h5().H5Fclose(file_);
}

bool Hdf5File::failed(bool wrong, const std::string& what) {
  if (wrong && error_.empty())
    error_ = path_ + (what.empty() ? "" : ", " + what) + " could not be written: " + hdf5_reason();
  return wrong;
}

void Hdf5File::group(const std::string& path) {
  if (!error_.empty()) return;
  const Hdf5Id made(h5().H5Gcreate2(file_, path.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), h5().H5Gclose);
  failed(!made.good(), path);
}

template <class Number>
std::unique_ptr<Hdf5File::Open> Hdf5File::create(const std::string& path, std::size_t rows, std::size_t columns) {
  const int rank = columns > 0 ? 2 : 1;
  const std::array<hsize_t, 2> size{rows, columns};
  const std::array<hsize_t, 2> chunk{std::min(std::max<std::size_t>(rows, 1), kChunkRows), columns};
  const Hdf5Id settings(h5().H5Pcreate(h5().dataset_create), h5().H5Pclose);
  if (rows > 0 && (h5().H5Pset_chunk(settings.get(), rank, chunk.data()) < 0 ||
                   h5().H5Pset_shuffle(settings.get()) < 0 || h5().H5Pset_deflate(settings.get(), 1) < 0)) {
    failed(true, path);
    return nullptr;
  }
  const hid_t space = h5().H5Screate_simple(rank, size.data(), nullptr);
  auto made = std::make_unique<Open>(
      path, columns, space,
      h5().H5Dcreate2(file_, path.c_str(), stored_type<Number>(), space, H5P_DEFAULT, settings.get(), H5P_DEFAULT));
  return failed(!made->data.good(), path) ? nullptr : std::move(made);
}

template <class Number>
void Hdf5File::write(Open& data, std::size_t first, std::size_t count, std::span<const Number> numbers) {
  const int rank = data.width > 0 ? 2 : 1;
  const std::array<hsize_t, 2> start{first, 0}, block{count, data.width};
  const Hdf5Id part(h5().H5Screate_simple(rank, block.data(), nullptr), h5().H5Sclose);
  failed(h5().H5Sselect_hyperslab(data.space.get(), H5S_SELECT_SET, start.data(), nullptr, block.data(), nullptr) < 0 ||
             h5().H5Dwrite(data.data.get(), memory_type<Number>(), part.get(), data.space.get(), H5P_DEFAULT,
                           numbers.data()) < 0,
         data.path);
}

template <class Number>
void Hdf5File::matrix(const std::string& path, std::size_t rows, std::size_t columns, const Source<Number>& source) {
  if (!error_.empty()) return;
  const auto data = create<Number>(path, rows, columns);
  if (data == nullptr) return;
  std::vector<Number> buffer;
  for (std::size_t first = 0; first < rows && error_.empty(); first += kChunkRows) {
    const std::size_t count = std::min(kChunkRows, rows - first);
    buffer.resize(count * std::max<std::size_t>(columns, 1));
    source(first, count, buffer);
    write<Number>(*data, first, count, buffer);
  }
  failed(data->data.close_fails(), path);
}

template <class Number>
Hdf5File::Dataset<Number> Hdf5File::begin(const std::string& path, std::size_t rows, std::size_t columns) {
  if (error_.empty())
    if (auto made = create<Number>(path, rows, columns); made != nullptr) datasets_.push_back(std::move(made));
  return {datasets_.size() - 1};
}

Hdf5File::Dataset<double> Hdf5File::begin_real(const std::string& path, std::size_t rows, std::size_t columns) {
  return begin<double>(path, rows, columns);
}

Hdf5File::Dataset<std::int64_t> Hdf5File::begin_whole(const std::string& path, std::size_t rows, std::size_t columns) {
  return begin<std::int64_t>(path, rows, columns);
}

void Hdf5File::put(Dataset<double> to, std::size_t first, std::size_t count, std::span<const double> numbers) {
  if (error_.empty()) write(*datasets_[to.number], first, count, numbers);
}

void Hdf5File::put(Dataset<std::int64_t> to, std::size_t first, std::size_t count,
                   std::span<const std::int64_t> numbers) {
  if (error_.empty()) write(*datasets_[to.number], first, count, numbers);
}

void Hdf5File::real(const std::string& path, std::size_t rows, std::size_t columns, const Source<double>& source) {
  matrix(path, rows, columns, source);
}

void Hdf5File::whole(const std::string& path, std::size_t rows, std::size_t columns,
                     const Source<std::int64_t>& source) {
  matrix(path, rows, columns, source);
}

void Hdf5File::texts(const std::string& path, const std::vector<std::string>& texts) {
  if (!error_.empty()) return;
  std::size_t longest = 1;
  for (const std::string& text : texts) longest = std::max(longest, text.size());
  std::vector<char> bytes(longest * texts.size());
  for (std::size_t k = 0; k < texts.size(); ++k) std::ranges::copy(texts[k], bytes.data() + k * longest);
  const Hdf5Id type(h5().H5Tcopy(h5().text), h5().H5Tclose);
  h5().H5Tset_size(type.get(), longest);
  h5().H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
  // The type stays that of ASCII, although the bytes are UTF-8: Octave fails to load a file with texts of type UTF-8.
  const hsize_t size = texts.size();
  const Hdf5Id space(h5().H5Screate_simple(1, &size, nullptr), h5().H5Sclose);
  const Hdf5Id data(
      h5().H5Dcreate2(file_, path.c_str(), type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
      h5().H5Dclose);
  failed(!data.good() ||
             (size > 0 && h5().H5Dwrite(data.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) < 0),
         path);
}

void Hdf5File::attribute(const std::string& path, const std::string& name, const std::string& text) {
  if (!error_.empty()) return;
  if (text.size() > kAttributeMax) {
    error_ = path_ + ", attribute " + name + " of " + path + " has " + std::to_string(text.size()) +
             " bytes; HDF5 stores at most " + std::to_string(kAttributeMax) + " there";
    return;
  }
  const Hdf5Id type(h5().H5Tcopy(h5().text), h5().H5Tclose);
  h5().H5Tset_size(type.get(), H5T_VARIABLE);
  h5().H5Tset_cset(type.get(), H5T_CSET_UTF8);
  const Hdf5Id space(h5().H5Screate(H5S_SCALAR), h5().H5Sclose);
  const Hdf5Id made(h5().H5Acreate_by_name(file_, path.c_str(), name.c_str(), type.get(), space.get(), H5P_DEFAULT,
                                           H5P_DEFAULT, H5P_DEFAULT),
                    h5().H5Aclose);
  const char* const value = text.c_str();
  failed(!made.good() || h5().H5Awrite(made.get(), type.get(), static_cast<const void*>(&value)) < 0,
         path + " attribute " + name);
}

void Hdf5File::attribute(const std::string& path, const std::string& name, const std::vector<std::string>& texts) {
  if (!error_.empty()) return;
  const Hdf5Id type(h5().H5Tcopy(h5().text), h5().H5Tclose);
  h5().H5Tset_size(type.get(), H5T_VARIABLE);
  h5().H5Tset_cset(type.get(), H5T_CSET_UTF8);
  const hsize_t size = texts.size();
  const Hdf5Id space(h5().H5Screate_simple(1, &size, nullptr), h5().H5Sclose);
  const Hdf5Id made(h5().H5Acreate_by_name(file_, path.c_str(), name.c_str(), type.get(), space.get(), H5P_DEFAULT,
                                           H5P_DEFAULT, H5P_DEFAULT),
                    h5().H5Aclose);
  std::vector<const char*> values;
  for (const std::string& text : texts) values.push_back(text.c_str());
  failed(!made.good() || h5().H5Awrite(made.get(), type.get(), static_cast<const void*>(values.data())) < 0,
         path + " attribute " + name);
}

template <class Value>
void Hdf5File::number_attribute(const std::string& path, const std::string& name, Value number) {
  if (!error_.empty()) return;
  const Hdf5Id space(h5().H5Screate(H5S_SCALAR), h5().H5Sclose);
  const Hdf5Id made(h5().H5Acreate_by_name(file_, path.c_str(), name.c_str(), stored_type<Value>(), space.get(),
                                           H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                    h5().H5Aclose);
  failed(!made.good() || h5().H5Awrite(made.get(), memory_type<Value>(), &number) < 0, path + " attribute " + name);
}

void Hdf5File::attribute(const std::string& path, const std::string& name, double number) {
  number_attribute(path, name, number);
}

void Hdf5File::attribute(const std::string& path, const std::string& name, std::int64_t number) {
  number_attribute(path, name, number);
}

std::string Hdf5File::close() {
  for (const auto& data : datasets_) failed(data->data.close_fails(), data->path);
  datasets_.clear();
  if (file_ >= 0) failed(h5().H5Fclose(std::exchange(file_, -1)) < 0, "");
  return error_;
}

}  // namespace tandem::server
