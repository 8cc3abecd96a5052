#include "server/export/io/hdf5_library.h"

#include <dlfcn.h>

namespace tandem::server {

namespace {

/// Looks up the symbols of an open library.
class Symbols {
 public:
  explicit Symbols(void* library) : library_(library) {}

  template <class Function>
  void function(Function*& to, const char* name) {
    to = reinterpret_cast<Function*>(find(name));
  }
  /// An identifier that the library keeps in a variable.
  void identifier(hid_t& to, const char* name) {
    if (const auto* const at = static_cast<const hid_t*>(find(name)); at != nullptr) to = *at;
  }
  /// Name of the first symbol that the library lacks; empty: none.
  [[nodiscard]] const std::string& missing() const noexcept { return missing_; }

 private:
  void* find(const char* name) {
    void* const at = ::dlsym(library_, name);
    if (at == nullptr && missing_.empty()) missing_ = name;
    return at;
  }

  void* library_;
  std::string missing_;
};

void find_functions(Symbols& symbols, Hdf5Library& h5) {
  symbols.function(h5.H5dont_atexit, "H5dont_atexit");
  symbols.function(h5.H5open, "H5open");
  symbols.function(h5.H5get_libversion, "H5get_libversion");
  symbols.function(h5.H5Eset_auto2, "H5Eset_auto2");
  symbols.function(h5.H5Ewalk2, "H5Ewalk2");
  symbols.function(h5.H5Fcreate, "H5Fcreate");
  symbols.function(h5.H5Fclose, "H5Fclose");
  symbols.function(h5.H5Gcreate2, "H5Gcreate2");
  symbols.function(h5.H5Gclose, "H5Gclose");
  symbols.function(h5.H5Screate, "H5Screate");
  symbols.function(h5.H5Screate_simple, "H5Screate_simple");
  symbols.function(h5.H5Sselect_hyperslab, "H5Sselect_hyperslab");
  symbols.function(h5.H5Sclose, "H5Sclose");
  symbols.function(h5.H5Pcreate, "H5Pcreate");
  symbols.function(h5.H5Pset_chunk, "H5Pset_chunk");
  symbols.function(h5.H5Pset_shuffle, "H5Pset_shuffle");
  symbols.function(h5.H5Pset_deflate, "H5Pset_deflate");
  symbols.function(h5.H5Pclose, "H5Pclose");
  symbols.function(h5.H5Dcreate2, "H5Dcreate2");
  symbols.function(h5.H5Dwrite, "H5Dwrite");
  symbols.function(h5.H5Dclose, "H5Dclose");
  symbols.function(h5.H5Tcopy, "H5Tcopy");
  symbols.function(h5.H5Tset_size, "H5Tset_size");
  symbols.function(h5.H5Tset_strpad, "H5Tset_strpad");
  symbols.function(h5.H5Tset_cset, "H5Tset_cset");
  symbols.function(h5.H5Tclose, "H5Tclose");
  symbols.function(h5.H5Acreate_by_name, "H5Acreate_by_name");
  symbols.function(h5.H5Awrite, "H5Awrite");
  symbols.function(h5.H5Aclose, "H5Aclose");
}

void find_reading_functions(Symbols& symbols, Hdf5Library& h5) {
  symbols.function(h5.H5Fopen, "H5Fopen");
  symbols.function(h5.H5Dopen2, "H5Dopen2");
  symbols.function(h5.H5Dget_space, "H5Dget_space");
  symbols.function(h5.H5Dget_type, "H5Dget_type");
  symbols.function(h5.H5Dget_create_plist, "H5Dget_create_plist");
  symbols.function(h5.H5Dread, "H5Dread");
  symbols.function(h5.H5Sget_simple_extent_ndims, "H5Sget_simple_extent_ndims");
  symbols.function(h5.H5Sget_simple_extent_dims, "H5Sget_simple_extent_dims");
  symbols.function(h5.H5Sget_simple_extent_npoints, "H5Sget_simple_extent_npoints");
  symbols.function(h5.H5Tequal, "H5Tequal");
  symbols.function(h5.H5Tget_class, "H5Tget_class");
  symbols.function(h5.H5Tget_size, "H5Tget_size");
  symbols.function(h5.H5Tis_variable_str, "H5Tis_variable_str");
  symbols.function(h5.H5Pget_layout, "H5Pget_layout");
  symbols.function(h5.H5Pget_chunk, "H5Pget_chunk");
  symbols.function(h5.H5Pget_external_count, "H5Pget_external_count");
  symbols.function(h5.H5PLset_loading_state, "H5PLset_loading_state");
  symbols.function(h5.H5Aopen_by_name, "H5Aopen_by_name");
  symbols.function(h5.H5Aget_space, "H5Aget_space");
  symbols.function(h5.H5Aget_type, "H5Aget_type");
  symbols.function(h5.H5Aread, "H5Aread");
  symbols.function(h5.H5Aiterate2, "H5Aiterate2");
  symbols.function(h5.H5Oopen, "H5Oopen");
  symbols.function(h5.H5Oclose, "H5Oclose");
  symbols.function(h5.H5free_memory, "H5free_memory");
}

std::expected<Hdf5Library, std::string> load_library() {
  void* const library = ::dlopen(TANDEM_HDF5_LIBRARY, RTLD_NOW | RTLD_LOCAL);  // stays loaded until the program ends
  if (library == nullptr)
    return std::unexpected(std::string("HDF5 files need ") + TANDEM_HDF5_LIBRARY + ": apt install " +
                           TANDEM_HDF5_PACKAGE + ". CSV does not need it");
  Hdf5Library h5;
  Symbols symbols(library);
  find_functions(symbols, h5);
  find_reading_functions(symbols, h5);
  // The first call: at exit libhdf5 would try again to write a file that could not be closed, and crash.
  if (symbols.missing().empty()) h5.H5dont_atexit();
  unsigned major = 0, minor = 0, release = 0;
  if (!symbols.missing().empty() || h5.H5get_libversion(&major, &minor, &release) < 0 || major != H5_VERS_MAJOR ||
      minor != H5_VERS_MINOR)
    return std::unexpected(std::string(TANDEM_HDF5_LIBRARY) + " is of another version than " + H5_VERS_INFO +
                           ", for which this program was built; install that of " + TANDEM_HDF5_PACKAGE);
  if (h5.H5open() < 0) return std::unexpected(std::string(TANDEM_HDF5_LIBRARY) + " cannot be started");
  symbols.identifier(h5.dataset_create, "H5P_CLS_DATASET_CREATE_ID_g");
  symbols.identifier(h5.text, "H5T_C_S1_g");
  symbols.identifier(h5.stored_real, "H5T_IEEE_F64LE_g");
  symbols.identifier(h5.stored_whole, "H5T_STD_I64LE_g");
  symbols.identifier(h5.memory_real, "H5T_NATIVE_DOUBLE_g");
  symbols.identifier(h5.memory_whole, "H5T_NATIVE_INT64_g");
  if (!symbols.missing().empty())
    return std::unexpected(std::string(TANDEM_HDF5_LIBRARY) + " lacks " + symbols.missing());
  h5.H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  h5.H5PLset_loading_state(0);  // a file must not choose libraries that are loaded
  return h5;
}

}  // namespace

const std::expected<Hdf5Library, std::string>& Hdf5Library::load() {
  static const std::expected<Hdf5Library, std::string> library = load_library();
  return library;
}

}  // namespace tandem::server
