#pragma once

#include <hdf5.h>

#include <expected>
#include <string>

namespace tandem::server {

/// The functions and types of libhdf5 that exports and their reader use, under the names of the library. The library is
/// loaded when the first HDF5 file is written or read: linked, it would bring thirty more libraries (HTTP, LDAP,
/// Kerberos) into every server, and as a static library code without the hardening of Tandem's programs.
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
  decltype(&::H5Fopen) H5Fopen = nullptr;
  decltype(&::H5Dopen2) H5Dopen2 = nullptr;
  decltype(&::H5Dget_space) H5Dget_space = nullptr;
  decltype(&::H5Dget_type) H5Dget_type = nullptr;
  decltype(&::H5Dget_create_plist) H5Dget_create_plist = nullptr;
  decltype(&::H5Dread) H5Dread = nullptr;
  decltype(&::H5Sget_simple_extent_ndims) H5Sget_simple_extent_ndims = nullptr;
  decltype(&::H5Sget_simple_extent_dims) H5Sget_simple_extent_dims = nullptr;
  decltype(&::H5Sget_simple_extent_npoints) H5Sget_simple_extent_npoints = nullptr;
  decltype(&::H5Tequal) H5Tequal = nullptr;
  decltype(&::H5Tget_class) H5Tget_class = nullptr;
  decltype(&::H5Tget_size) H5Tget_size = nullptr;
  decltype(&::H5Tis_variable_str) H5Tis_variable_str = nullptr;
  decltype(&::H5Pget_layout) H5Pget_layout = nullptr;
  decltype(&::H5Pget_chunk) H5Pget_chunk = nullptr;
  decltype(&::H5Pget_external_count) H5Pget_external_count = nullptr;
  decltype(&::H5PLset_loading_state) H5PLset_loading_state = nullptr;
  decltype(&::H5Aopen_by_name) H5Aopen_by_name = nullptr;
  decltype(&::H5Aget_space) H5Aget_space = nullptr;
  decltype(&::H5Aget_type) H5Aget_type = nullptr;
  decltype(&::H5Aread) H5Aread = nullptr;
  decltype(&::H5Aiterate2) H5Aiterate2 = nullptr;
  decltype(&::H5Oopen) H5Oopen = nullptr;
  decltype(&::H5Oclose) H5Oclose = nullptr;
  decltype(&::H5free_memory) H5free_memory = nullptr;
  hid_t dataset_create = -1;                  ///< H5P_DATASET_CREATE
  hid_t text = -1;                            ///< H5T_C_S1
  hid_t stored_real = -1, stored_whole = -1;  ///< H5T_IEEE_F64LE, H5T_STD_I64LE
  hid_t memory_real = -1, memory_whole = -1;  ///< H5T_NATIVE_DOUBLE, H5T_NATIVE_INT64

  /// Loads the library once. @return the library, or the error with its remedy
  [[nodiscard]] static const std::expected<Hdf5Library, std::string>& load();
};

}  // namespace tandem::server
