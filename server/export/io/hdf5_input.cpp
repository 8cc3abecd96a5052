#include "server/export/io/hdf5_input.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>
#include <type_traits>

#include "common/base/sanitize.h"
#include "server/export/io/hdf5_file.h"
#include "server/export/io/hdf5_id.h"

namespace tandem::server {

namespace {

constexpr unsigned kReadOnly = 0;  // H5F_ACC_RDONLY, which as a macro calls the library
constexpr int kRankMax = 2;
constexpr std::uint64_t kNumberBytes = 8;
constexpr std::size_t kAttributesMax = 1000;

template <class Number>
hid_t stored_number() {
  return std::is_same_v<Number, double> ? h5().stored_real : h5().stored_whole;
}
template <class Number>
hid_t memory_number() {
  return std::is_same_v<Number, double> ? h5().memory_real : h5().memory_whole;
}
template <class Number>
const char* type_words() {
  return std::is_same_v<Number, double> ? "IEEE double, little endian" : "signed integer of 64 bits, little endian";
}

template <class Sizes>
std::string size_words(const Sizes& size) {
  std::string text;
  for (const auto part : size) text += (text.empty() ? "" : " x ") + std::to_string(part);
  return text.empty() ? "a single value" : text;
}

herr_t keep_name(hid_t /*object*/, const char* name, const H5A_info_t* /*info*/, void* names) {
  auto& out = *static_cast<std::vector<std::string>*>(names);
  if (out.size() >= kAttributesMax) return -1;
  out.emplace_back(name);
  return 0;
}

/// Closes a dataset. Unlike `h5().H5Dclose` its address is known when the library could not be loaded.
herr_t h5_close_dataset(hid_t data) { return h5().H5Dclose(data); }

bool is_single(hid_t attribute) {
  const Hdf5Id space(h5().H5Aget_space(attribute), h5().H5Sclose);
  return space.good() && h5().H5Sget_simple_extent_npoints(space.get()) == 1;
}

}  // namespace

Hdf5Input::Hdf5Input(const std::string& path) : path_(path) {
  std::error_code code;
  bytes_ = std::filesystem::file_size(path, code);
  if (code) {
    error_ = path + ": " + code.message();
    return;
  }
  if (const auto& library = Hdf5Library::load(); !library) {
    error_ = path + ": " + library.error();
    return;
  }
  file_ = h5().H5Fopen(path.c_str(), kReadOnly, H5P_DEFAULT);
  if (file_ < 0) fail("", "is no HDF5 file that libhdf5 can open; it is cut or damaged");
}

Hdf5Input::~Hdf5Input() {
  if (file_ >= 0) h5().H5Fclose(file_);
}

void Hdf5Input::fail(const std::string& what, const std::string& problem) {
  if (!error_.empty()) return;
  error_ = path_ + (what.empty() ? "" : ", " + sanitize(what)) + ": " + problem + "; " + kHdf5NextStep;
}

std::string Hdf5Input::storage_problem(std::int64_t data) const {
  const Hdf5Id settings(h5().H5Dget_create_plist(data), h5().H5Pclose);
  if (!settings.good()) return "has damaged settings";
  const H5D_layout_t layout = h5().H5Pget_layout(settings.get());
  if (layout != H5D_CONTIGUOUS && layout != H5D_CHUNKED) return "is stored neither in one piece nor in chunks";
  if (h5().H5Pget_external_count(settings.get()) != 0) return "has its values in another file";
  if (layout == H5D_CONTIGUOUS) return {};
  std::array<hsize_t, kRankMax> chunk{1, 1};
  if (h5().H5Pget_chunk(settings.get(), kRankMax, chunk.data()) < 0) return "has damaged settings of chunks";
  if (chunk[0] > kChunkMax || chunk[1] > kChunkMax || chunk[0] * chunk[1] * kNumberBytes > kChunkMax)
    return "has chunks of " + size_words(chunk) + " numbers; at most " + std::to_string(kChunkMax >> 20) +
           " MiB are read";
  return {};
}

std::int64_t Hdf5Input::open(const std::string& path, std::vector<std::uint64_t>& size) {
  if (!error_.empty()) return -1;
  const hid_t data = h5().H5Dopen2(file_, path.c_str(), H5P_DEFAULT);
  if (data < 0) {
    fail("dataset " + path, "is missing or damaged");
    return -1;
  }
  const Hdf5Id space(h5().H5Dget_space(data), h5().H5Sclose);
  const int rank = space.good() ? h5().H5Sget_simple_extent_ndims(space.get()) : -1;
  std::array<hsize_t, kRankMax> parts{};
  if (rank < 1 || rank > kRankMax || h5().H5Sget_simple_extent_dims(space.get(), parts.data(), nullptr) < 0) {
    fail("dataset " + path, "has " + std::to_string(rank) + " dimensions; it must have 1 or 2");
  } else if (std::string problem = storage_problem(data); !problem.empty()) {
    fail("dataset " + path, problem);
  }
  size.assign(parts.begin(), parts.begin() + std::clamp(rank, 0, kRankMax));
  if (error_.empty()) return data;
  h5().H5Dclose(data);
  return -1;
}

std::size_t Hdf5Input::rows(const std::string& path, std::size_t columns) {
  std::vector<std::uint64_t> size;
  const Hdf5Id data(open(path, size), h5_close_dataset);
  if (!data.good()) return 0;
  if (size.size() != (columns > 0 ? 2u : 1u) || (columns > 0 && size[1] != columns)) {
    fail("dataset " + path, "has the size " + size_words(size) + "; it must have " +
                                (columns > 0 ? std::to_string(columns) + " columns" : "one dimension"));
    return 0;
  }
  // Each compressed row of an export takes more than one byte.
  if (size[0] > bytes_) {
    fail("dataset " + path, "has " + std::to_string(size[0]) + " rows; a file of " + std::to_string(bytes_) +
                                " bytes has at most as many");
    return 0;
  }
  return size[0];
}

template <class Number>
void Hdf5Input::matrix(const std::string& path, std::size_t rows, std::size_t columns, const Sink<Number>& sink) {
  std::vector<std::uint64_t> size;
  const Hdf5Id data(open(path, size), h5_close_dataset);
  if (!data.good()) return;
  std::vector<std::uint64_t> expected{rows};
  if (columns > 0) expected.push_back(columns);
  if (size != expected)
    return fail("dataset " + path, "has the size " + size_words(size) + "; it must have " + size_words(expected));
  const Hdf5Id type(h5().H5Dget_type(data.get()), h5().H5Tclose);
  if (!type.good() || h5().H5Tequal(type.get(), stored_number<Number>()) <= 0)
    return fail("dataset " + path, std::string("has another type than ") + type_words<Number>());
  if (!sink) return;
  const Hdf5Id space(h5().H5Dget_space(data.get()), h5().H5Sclose);
  const std::size_t width = std::max<std::size_t>(columns, 1);
  std::vector<Number> buffer;
  for (std::size_t first = 0; first < rows && error_.empty(); first += Hdf5File::kChunkRows) {
    const std::size_t count = std::min(Hdf5File::kChunkRows, rows - first);
    buffer.resize(count * width);
    const std::array<hsize_t, 2> start{first, 0}, block{count, columns};
    const Hdf5Id part(h5().H5Screate_simple(static_cast<int>(size.size()), block.data(), nullptr), h5().H5Sclose);
    if (h5().H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr, block.data(), nullptr) < 0 ||
        h5().H5Dread(data.get(), memory_number<Number>(), part.get(), space.get(), H5P_DEFAULT, buffer.data()) < 0)
      return fail("dataset " + path, "has damaged values from row " + std::to_string(first) + " on");
    sink(first, buffer);
  }
}

void Hdf5Input::real(const std::string& path, std::size_t rows, std::size_t columns, const Sink<double>& sink) {
  matrix(path, rows, columns, sink);
}

void Hdf5Input::whole(const std::string& path, std::size_t rows, std::size_t columns, const Sink<std::int64_t>& sink) {
  matrix(path, rows, columns, sink);
}

void Hdf5Input::check_real(const std::string& path, std::size_t rows) { matrix<double>(path, rows, 0, nullptr); }

std::vector<std::string> Hdf5Input::texts(const std::string& path, std::optional<std::size_t> rows) {
  std::vector<std::uint64_t> size;
  const Hdf5Id data(open(path, size), h5_close_dataset);
  if (!data.good()) return {};
  const std::string what = "dataset " + path;
  const Hdf5Id type(h5().H5Dget_type(data.get()), h5().H5Tclose);
  const std::size_t longest = type.good() ? h5().H5Tget_size(type.get()) : 0;
  if (longest == 0 || h5().H5Tget_class(type.get()) != H5T_STRING || h5().H5Tis_variable_str(type.get()) != 0) {
    fail(what, "has another type than text of fixed length");
  } else if (size.size() != 1 || (rows && size[0] != *rows)) {
    fail(what,
         "has the size " + size_words(size) + "; it must have " + (rows ? std::to_string(*rows) : "one dimension"));
  } else if (size[0] > bytes_ / longest) {
    fail(what, "has " + std::to_string(size[0]) + " texts of " + std::to_string(longest) +
                   " bytes, more than the file of " + std::to_string(bytes_) + " bytes holds");
  }
  if (!error_.empty()) return {};
  std::vector<char> bytes(longest * size[0]);
  if (size[0] > 0 && h5().H5Dread(data.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) < 0) {
    fail(what, "has damaged texts");
    return {};
  }
  std::vector<std::string> out;
  for (std::size_t k = 0; k < size[0]; ++k) {
    const std::string_view text(bytes.data() + k * longest, longest);
    out.emplace_back(text.substr(0, text.find_last_not_of('\0') + 1));
  }
  return out;
}

std::string Hdf5Input::text_attribute(const std::string& path, const std::string& name) {
  if (!error_.empty()) return {};
  const std::string what = "attribute " + name + " of " + path;
  const Hdf5Id attribute(h5().H5Aopen_by_name(file_, path.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                         h5().H5Aclose);
  if (!attribute.good()) {
    fail(what, "is missing or damaged");
    return {};
  }
  const Hdf5Id type(h5().H5Aget_type(attribute.get()), h5().H5Tclose);
  if (!type.good() || h5().H5Tget_class(type.get()) != H5T_STRING || h5().H5Tis_variable_str(type.get()) <= 0 ||
      !is_single(attribute.get())) {
    fail(what, "is no single text of variable length");
    return {};
  }
  char* value = nullptr;
  if (h5().H5Aread(attribute.get(), type.get(), static_cast<void*>(&value)) < 0) {
    fail(what, "is damaged");
    return {};
  }
  std::string out(value == nullptr ? "" : value);
  if (value != nullptr) h5().H5free_memory(value);
  return out;
}

template <class Number>
Number Hdf5Input::number_attribute(const std::string& path, const std::string& name) {
  if (!error_.empty()) return {};
  const std::string what = "attribute " + name + " of " + path;
  const Hdf5Id attribute(h5().H5Aopen_by_name(file_, path.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                         h5().H5Aclose);
  if (!attribute.good()) {
    fail(what, "is missing or damaged");
    return {};
  }
  Number value{};
  const Hdf5Id type(h5().H5Aget_type(attribute.get()), h5().H5Tclose);
  if (!type.good() || h5().H5Tequal(type.get(), stored_number<Number>()) <= 0 || !is_single(attribute.get())) {
    fail(what, std::string("is no single number of the type ") + type_words<Number>());
  } else if (h5().H5Aread(attribute.get(), memory_number<Number>(), &value) < 0) {
    fail(what, "is damaged");
  }
  return value;
}

double Hdf5Input::real_attribute(const std::string& path, const std::string& name) {
  return number_attribute<double>(path, name);
}

std::int64_t Hdf5Input::whole_attribute(const std::string& path, const std::string& name) {
  return number_attribute<std::int64_t>(path, name);
}

std::vector<std::string> Hdf5Input::attributes(const std::string& path) {
  if (!error_.empty()) return {};
  std::vector<std::string> names;
  const Hdf5Id object(h5().H5Oopen(file_, path.c_str(), H5P_DEFAULT), h5().H5Oclose);
  if (!object.good() ||
      h5().H5Aiterate2(object.get(), H5_INDEX_NAME, H5_ITER_INC, nullptr, keep_name, static_cast<void*>(&names)) < 0)
    fail("group " + path, "is missing or damaged, or has more than " + std::to_string(kAttributesMax) + " attributes");
  return names;
}

}  // namespace tandem::server
