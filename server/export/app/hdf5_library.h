#pragma once

#include <hdf5.h>

#include <expected>
#include <string>

namespace tandem::server {

/// The functions and types of libhdf5 that exports use, under the names of the library. The library is loaded when the
/// first HDF5 file is written: linked, it would bring thirty more libraries (HTTP, LDAP, Kerberos) into every server,
/// and as a static library code without the hardening of Tandem's programs.
struct Hdf5Library {
  decltype(&::H5dont_atexit) H5dont_atexit = nullptr;
  decltype(&::H5open) H5open = nullptr;
  decltype(&::H5get_libversion) H5get_libversion = nullptr;
  decltype(&::H5Eset_auto2) H5Eset_auto2 = nullptr;
  decltype(&::H5Ewalk2) H5Ewalk2 = nullptr;
  decltype(&::H5Fcreate) H5Fcreate = nullptr;
  decltype(&::H5Fclose) H5Fclose = nullptr;
  decltype(&::H5Gcreate2) H5Gcreate2 = nullptr;
  decltype(&::H5Gclose) H5Gclose = nullptr;
  decltype(&::H5Screate) H5Screate = nullptr;
  decltype(&::H5Screate_simple) H5Screate_simple = nullptr;
  decltype(&::H5Sselect_hyperslab) H5Sselect_hyperslab = nullptr;
  decltype(&::H5Sclose) H5Sclose = nullptr;
  decltype(&::H5Pcreate) H5Pcreate = nullptr;
  decltype(&::H5Pset_chunk) H5Pset_chunk = nullptr;
  decltype(&::H5Pset_shuffle) H5Pset_shuffle = nullptr;
  decltype(&::H5Pset_deflate) H5Pset_deflate = nullptr;
  decltype(&::H5Pclose) H5Pclose = nullptr;
  decltype(&::H5Dcreate2) H5Dcreate2 = nullptr;
  decltype(&::H5Dwrite) H5Dwrite = nullptr;
  decltype(&::H5Dclose) H5Dclose = nullptr;
  decltype(&::H5Tcopy) H5Tcopy = nullptr;
  decltype(&::H5Tset_size) H5Tset_size = nullptr;
  decltype(&::H5Tset_strpad) H5Tset_strpad = nullptr;
  decltype(&::H5Tset_cset) H5Tset_cset = nullptr;
  decltype(&::H5Tclose) H5Tclose = nullptr;
  decltype(&::H5Acreate_by_name) H5Acreate_by_name = nullptr;
  decltype(&::H5Awrite) H5Awrite = nullptr;
  decltype(&::H5Aclose) H5Aclose = nullptr;
  hid_t dataset_create = -1;                  ///< H5P_DATASET_CREATE
  hid_t text = -1;                            ///< H5T_C_S1
  hid_t stored_real = -1, stored_whole = -1;  ///< H5T_IEEE_F64LE, H5T_STD_I64LE
  hid_t memory_real = -1, memory_whole = -1;  ///< H5T_NATIVE_DOUBLE, H5T_NATIVE_INT64

  /// Loads the library once. @return the library, or the error with its remedy
  [[nodiscard]] static const std::expected<Hdf5Library, std::string>& load();
};

}  // namespace tandem::server
